"""The laws of exact flows, for every kind of flow: in 40 digits, rates exactly over Q[[h]]."""

from __future__ import annotations

from fractions import Fraction

import pytest
from sympy import Matrix, Max, Rational, Symbol, cos, diag, eye, sin

from codegen.flows.drift import Drift
from codegen.flows.isotropic import Isotropic
from codegen.flows.kick import Kick
from codegen.flows.linear import Linear
from codegen.flows.recognise import recognise
from codegen.flows.stated import Stated
from codegen.flows.turn import Turn
from codegen.groups import SO3, Cotangent, Rn
from codegen.groups.capabilities import Coadjoint
from codegen.ir.domain import PreciseDomain, SeriesDomain
from codegen.ir.expr import evaluate
from codegen.scene import HamiltonianScene
from orderconds.ring import QQ
from tests.strategies import top_scene

TAU = Symbol("tau")


def particle(H, flows=None):
    """One part H(q, p) on T*R^2."""
    group = Rn(2)
    q, p = group.point("q"), group.dual("p")
    H = H(q, p)
    start = {"q0": [Rational(1, 3), Rational(2, 3)], "mu0": [Rational(1, 2), Rational(-1, 3)]}
    return HamiltonianScene(
        group=group, q=q, mu=p, H=H, parts={"H": H}, flows=flows or {}, span=(0, 1), name="particle", **start
    )


def rotated():
    """The flow of q_1 p_0 - q_0 p_1 + q_0, which rotates q and p, stated by its scene."""
    q, p = Rn(2).point("q"), Rn(2).dual("p")
    turn = Matrix([[cos(TAU), sin(TAU)], [-sin(TAU), cos(TAU)]])
    return particle(lambda q, p: q[1] * p[0] - q[0] * p[1], {"H": (turn * q, turn * p)})


CASES = {
    "kick": (particle(lambda q, p: q[0] ** 3 + q[0] * q[1]), Kick),
    "kick with time": (particle(lambda q, p: q[0] ** 2 * (1 + Symbol("t"))), Kick),
    "drift": (particle(lambda q, p: p[0] ** 4 + p[0] * p[1] ** 2), Drift),
    "linear": (particle(lambda q, p: p.dot(p) / 2 + 2 * q[0] ** 2 + q[1] ** 2 / 3 + q[1]), Linear),
    "turn in the body": (top_scene(diag(0, 0, 2), (0, 0, 1)), Turn),
    "turn in space": (top_scene(diag(0, 3, 0), body=False), Turn),
    "isotropic": (top_scene(diag(2, 2, 2)), Isotropic),
    "stated": (rotated(), Stated),
}

RECOGNISED = [name for name, (_, kind) in CASES.items() if kind is not Stated]


@pytest.fixture(params=CASES)
def case(request):
    """A problem and the flow of its first part."""
    problem, kind = CASES[request.param]
    part = recognise(problem)[0]
    assert part.exact, part.reason
    ((_, flow),) = part.summands[0].flows
    assert isinstance(flow, kind)
    return problem, flow


def advanced(d, problem, flow, tau, z, t=0):
    """(q, mu) after the time tau."""
    size = problem.group.size
    q, mu = tuple(z[:size]), tuple(z[size:])
    values = problem.values(d, z, d.rational(t))
    new = flow.advance(d, problem.group.require(Coadjoint), values, tau, q, mu)
    return (*new[0], *new[1])


def near(a, b):
    return all(abs(x - y) < 1e-34 * max(1, abs(x)) for x, y in zip(a, b, strict=True))


class TestAFlow:
    D = PreciseDomain(0, 40)

    def test_does_nothing_in_no_time(self, case):
        problem, flow = case
        start = problem.initial(self.D)
        assert near(advanced(self.D, problem, flow, self.D.rational(0), start), start)

    def test_composes_with_itself(self, case):
        problem, flow = case
        d, start = self.D, problem.initial(self.D)
        first = advanced(d, problem, flow, d.rational(2, 7), start)
        both = advanced(d, problem, flow, d.rational(3, 5), first)
        assert near(both, advanced(d, problem, flow, d.rational(31, 35), start))

    def test_keeps_its_part_of_the_hamiltonian(self, case):
        problem, flow = case
        d, start = self.D, problem.initial(self.D)

        def value(z):
            return evaluate([next(iter(problem.parts.values()))], d, problem.values(d, z))

        assert near(value(advanced(d, problem, flow, d.rational(2, 7), start)), value(start))

    @pytest.mark.parametrize("case", RECOGNISED, indirect=True)
    def test_has_the_field_of_the_canonical_equations_as_its_rate(self, case):
        """d/dtau at 0, exactly: the coefficient of h in the flow for the time h is (xi.q, n - ad*_xi mu).

        A stated flow has no field; reading its scene compares its rates.
        """
        problem, flow = case
        d = SeriesDomain(QQ, 1)
        start, size = problem.initial(d), problem.group.size
        moved = advanced(d, problem, flow, d.h, start)
        values = problem.values(d, start)
        q, mu = start[:size], start[size:]
        xi, n = flow.field(d, problem.group.require(Coadjoint), values, q, mu)
        rate = Cotangent(problem.group).velocity(d, (*xi, *n), start)
        assert [x.coefficients[1] for x in moved] == [x.coefficients[0] for x in rate]


def test_a_kick_with_time_uses_the_time_of_its_start():
    problem, d = CASES["kick with time"][0], SeriesDomain(QQ, 0)
    flow = recognise(problem)[0].summands[0].flows[0][1]
    assert flow.timed
    start, tau = problem.initial(d), d.rational(1, 2)
    early, late = (advanced(d, problem, flow, tau, start, t) for t in (0, 3))
    gains = [(z[2] - start[2]).coefficients[0] for z in (early, late)]
    assert gains[1] == 4 * gains[0] != 0


def test_a_stated_flow_moves_for_the_time_that_it_is_given():
    problem, d = CASES["stated"][0], PreciseDomain(0, 40)
    ((_, flow),) = recognise(problem)[0].summands[0].flows
    start, tau = problem.initial(d), d.rational(2, 7)
    c, s = d.call("cos", tau), d.call("sin", tau)
    turned = (c * start[0] + s * start[1], c * start[1] - s * start[0])
    assert near(advanced(d, problem, flow, tau, start)[:2], turned)


def test_a_stated_flow_has_no_field():
    problem = CASES["stated"][0]
    ((_, flow),) = recognise(problem)[0].summands[0].flows
    d = SeriesDomain(QQ, 0)
    with pytest.raises(ArithmeticError, match="formulas for the flow of the part, but none for the field"):
        flow.field(d, problem.group, {}, (), ())


@pytest.mark.parametrize(
    ("H", "reason"),
    [
        (lambda q, p: Symbol("t") * p[0], "it depends on the momentum and on t"),
        (
            lambda q, p: p[0] ** 2 * q[0],
            "it is not a quadratic function of q and mu with constant coefficients",
        ),
        (
            lambda q, p: p[0] * q[0],
            "its flow solves z' = M z + c, but a formula is known only if M^2 is diagonal with entries <= 0",
        ),
    ],
)
def test_a_part_without_closed_form_has_a_reason(H, reason):
    (part,) = recognise(particle(H))
    assert (part.summands, part.exact, part.reason) == ((), False, reason)


def test_an_asymmetric_top_is_a_sum_of_summands_whose_flows_have_names():
    top = recognise(top_scene(diag(1, 2, 4)))[0]
    names = [[name for name, _ in summand.flows] for summand in top.summands]
    assert names == [["T.mean", "T.turn1"], ["T.turn2"]]
    assert not top.exact
    first = top.summands[0].flows[0][1]
    assert first == Isotropic(Fraction(2))


def test_a_group_without_invariant_inner_product_has_turns_only():
    from tests.strategies import BASE_GROUPS

    group = BASE_GROUPS["SE(2)"]
    q, mu = group.point("q"), group.dual("p")
    T = mu.dot(mu) / 2
    problem = HamiltonianScene(
        group=group, q=q, mu=mu, H=T, parts={"T": T}, q0=[1, 0, 0, 0], mu0=[1, 2, 3], span=(0, 1)
    )
    (part,) = recognise(problem)
    assert [[type(flow) for _, flow in s.flows] for s in part.summands] == [[Turn]] * 3
    assert SO3().abelian is False


def test_a_part_that_is_a_potential_only_near_the_initial_state_has_no_kick():
    """For p > 10, the velocity of the part is not zero. All sample points have smaller momenta."""
    q, p = Rn(1).point("q"), Rn(1).dual("p")
    V = q[0] ** 4 + Max(p[0] - 10, 0) ** 2
    scene = HamiltonianScene(group=Rn(1), q=q, mu=p, H=V, parts={"V": V}, q0=[1], mu0=[0], span=(0, 1))
    (part,) = recognise(scene)
    assert not part.summands


def test_a_part_that_is_quadratic_only_near_the_initial_state_has_no_turns():
    G = SO3()
    q, mu = G.point("q"), G.dual("mu")
    T = mu.dot(mu) / 2 + Max(mu[0] - 10, 0) ** 3
    scene = HamiltonianScene(group=G, q=q, mu=mu, H=T, parts={"T": T}, q0=eye(3), mu0=[1, 0, 0], span=(0, 1))
    (part,) = recognise(scene)
    assert not part.summands
