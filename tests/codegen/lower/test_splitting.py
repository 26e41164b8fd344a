"""Splittings: which parts have exact flows, what the flows are, and the order of their words."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from sympy import Matrix, Rational, Symbol, diag, exp, sin

from codegen import scenes
from codegen.certify import certified_order
from codegen.emitter import emit
from codegen.errors import MethodError, SceneError
from codegen.flows.drift import Drift
from codegen.flows.isotropic import Isotropic
from codegen.flows.kick import Kick
from codegen.flows.linear import Linear
from codegen.flows.quadratic_form import squares
from codegen.flows.recognise import recognise
from codegen.flows.stated import Stated
from codegen.flows.turn import Turn
from codegen.groups import SO3, Rn
from codegen.ir.domain import PreciseDomain, SeriesDomain
from codegen.ir.number import Number
from codegen.lab.orders.local_error import local_error, valuation
from codegen.lower import families_for, lower, problem_for
from codegen.method import Method, parse
from codegen.scene import HamiltonianScene
from orderconds.ring import QQ
from orderconds.tableau import Tableau
from tests.compilations import compiled, emitted
from tests.strategies import quarter_turn, shipped, top_scene


def particle(T, V, n=2, **more):
    """T(q, p) + V(q, p) on T*R^n."""
    group = Rn(n)
    q, p = group.point("q"), group.dual("p")
    T, V = T(q, p), V(q, p)
    start = {"q0": [Rational(k + 1, 3) for k in range(n)], "mu0": [Rational(1, k + 2) for k in range(n)]}
    start["span"] = (0, 1)
    return HamiltonianScene(
        group=group,
        q=q,
        mu=p,
        H=T + V,
        parts={"T": T, "V": V},
        name="particle",
        **(start | more),
    )


SYMMETRIC = diag(2, 3, 2)
SKEWED = Matrix([[3, 1, 1], [1, 3, 1], [1, 1, 3]])  # 2 + a projection on (1, 1, 1)
ASYMMETRIC = diag(1, 2, 4)
GENERAL = Matrix([[2, 1, 0], [1, 3, -1], [0, -1, 5]])
PRINCIPAL = [(SYMMETRIC, True), (SYMMETRIC, False), (SKEWED, True), (SKEWED, False)]


def parts(scene):
    return {part.name: part for part in recognise(scene)}


def kinds(part):
    return [[type(flow) for _, flow in piece.flows] for piece in part.summands]


@pytest.mark.parametrize(("B", "body"), PRINCIPAL)
def test_a_symmetric_top_is_one_exact_flow_of_two_commuting_turns(B, body):
    part = parts(top_scene(B, body=body))["T"]
    assert kinds(part) == [[Isotropic, Turn]]
    assert part.exact


def test_an_isotropic_top_is_a_rotation_about_its_momentum():
    assert kinds(parts(top_scene(diag(2, 2, 2)))["T"]) == [[Isotropic]]


def test_an_asymmetric_top_is_split_into_a_symmetric_one_and_a_turn_at_the_least_rate():
    part = parts(top_scene(ASYMMETRIC))["T"]
    assert kinds(part) == [[Isotropic, Turn], [Turn]]
    (_, mean), (_, fast) = part.summands[0].flows
    ((_, slow),) = part.summands[1].flows
    assert (mean.rate, fast.rate, slow.rate) == (2, 2, -1)
    assert (fast.axis, slow.axis) == ((0, 0, 1), (1, 0, 0))


def test_a_gyrostat_turns_at_a_rate_of_its_own():
    (piece,) = parts(top_scene(diag(0, 0, 3), w=(0, 0, 5)))["T"].summands
    ((_, turn),) = piece.flows
    assert (turn.rate, turn.offset) == (3, 5)
    assert len(parts(top_scene(SYMMETRIC, w=(1, 0, 0)))["T"].summands) == 2


@pytest.mark.parametrize(
    "B", [SYMMETRIC, SKEWED, ASYMMETRIC, GENERAL, Matrix([[0, 1, 0], [1, 0, 2], [0, 2, 0]])]
)
def test_lagranges_squares_add_up_to_the_matrix(B):
    rows = [[Fraction(int(x)) for x in B.row(i)] for i in range(3)]
    total = [[sum(d * e[i] * e[j] for d, e in squares(rows)) for j in range(3)] for i in range(3)]
    assert total == rows


def test_on_a_vector_space_parts_are_kicks_drifts_and_linear_flows():
    found = parts(particle(lambda q, p: p[0] ** 4 + p[0] * p[1], lambda q, p: sin(q[0]) * q[1]))
    assert (kinds(found["T"]), kinds(found["V"])) == ([[Drift]], [[Kick]])
    found = parts(
        particle(lambda q, p: p.dot(p) / 2 + 2 * q.dot(q) + q[0], lambda q, p: q[0] * p[1] - q[1] * p[0])
    )
    assert (kinds(found["T"]), kinds(found["V"])) == ([[Linear]], [[Linear]])


EXACT = {
    "body": lambda: top_scene(SYMMETRIC),
    "space": lambda: top_scene(SKEWED, body=False),
    "skewed": lambda: top_scene(SKEWED),
    "gyrostat": lambda: top_scene(diag(0, 0, 3), w=(0, 0, 5)),
    "space gyrostat": lambda: top_scene(diag(0, 2, 0), w=(0, 1, 0), body=False),
    "drift": lambda: particle(lambda q, p: p[0] ** 3 + p[0] * p[1], lambda q, p: q[0] ** 3 * q[1]),
    "oscillators": lambda: particle(
        lambda q, p: p.dot(p) / 2 + 2 * q[0] ** 2 + q[1] ** 2 / 3 + q[0] - p[1], lambda q, p: q[0] ** 2 * q[1]
    ),
    "Coriolis": lambda: particle(lambda q, p: 3 * (q[0] * p[1] - q[1] * p[0]), lambda q, p: q[0] ** 2 * q[1]),
}


@pytest.mark.parametrize("name", sorted(EXACT))
def test_flows_solve_the_equations_of_their_part_to_the_last_coefficient(name):
    """Over Q[[h]] the composed flows of one part are its solution, by Picard's iteration."""
    scene = EXACT[name]()
    order = 7
    for part in recognise(scene):
        view = problem_for(scene, Method("splitting", shipped("strang")))
        assert part.exact
        d = SeriesDomain(QQ, order)
        state = scene.initial(d)
        n = scene.group.size
        q, mu = state[:n], state[n:]
        for flow_name, _ in part.summands[0].flows:
            q, mu = view.flow(d, flow_name, d.h, (q, mu))
        assert (*q, *mu) == solution(scene, scene.parts[part.name], d, order)


def solution(scene, root, d, order):
    """The exact solution of one part, as power series."""
    from codegen.ir.differentiate import gradient
    from codegen.lab.orders.local_error import exact_flow
    from codegen.scene.canonical_equations import force

    qs, mus = (block.symbols for block in scene.state)
    slopes = gradient(root, qs + mus)
    roots = (*slopes[len(qs) :], *force(root.space, scene.group, qs, slopes[: len(qs)]))
    return exact_flow(replace(scene, roots=roots), QQ, order)


def error(scene, method, order):
    view = problem_for(scene, method)
    return valuation(local_error(lower(scene, method), view, method.ring, order))


def cubic(q):
    return q[0] ** 3 + q[0] * q[1] ** 2


ORDERS = {
    ("symmetric top", "splitting:lie_trotter"): 1,
    ("symmetric top", "splitting:strang"): 2,
    ("symmetric top", "splitting:ruth3"): 3,
    ("symmetric top", "splitting:forest_ruth4"): 4,
    ("asymmetric top", "splitting:lie_trotter"): 1,
    ("asymmetric top", "splitting:strang"): 2,
    ("asymmetric top", "splitting:strang3"): 2,
    ("asymmetric top", "splitting:ruth3"): 3,
    ("asymmetric top", "splitting:forest_ruth4"): 4,
    ("asymmetric top", "composition:triple_jump"): 4,
    ("asymmetric top", "composition:mclachlan4"): 4,
    ("particle", "splitting:strang"): 2,
    ("particle", "splitting:ruth3"): 3,
    ("particle", "composition:suzuki4"): 4,
    ("quartic particle", "splitting:ruth3"): 3,
    ("driven particle", "splitting:strang"): 2,
    ("driven particle", "splitting:forest_ruth4"): 4,
    ("driven particle", "composition:mclachlan4"): 4,
}
SCENES = {
    "symmetric top": lambda: top_scene(SYMMETRIC),
    "asymmetric top": lambda: top_scene(ASYMMETRIC),
    "particle": lambda: particle(lambda q, p: p[0] ** 2 + p[0] * p[1] + p[1] ** 2, lambda q, p: cubic(q)),
    "quartic particle": lambda: particle(lambda q, p: p[0] ** 4 + p[0] * p[1] ** 2, lambda q, p: cubic(q)),
    "driven particle": lambda: particle(
        lambda q, p: p[0] ** 2 + p[0] * p[1] + p[1] ** 2,
        lambda q, p: Symbol("t") * q[0] ** 3 + (1 + Symbol("t") ** 2) * q[0] * q[1],
        span=(1, 2),
    ),
}


@pytest.mark.parametrize(("name", "spelling"), sorted(ORDERS))
def test_the_local_error_starts_just_above_the_certified_order(name, spelling):
    scene = SCENES[name]()
    method = parse(spelling, families_for(scene))
    order = ORDERS[name, spelling]
    assert certified_order(method, scene).order == order
    assert error(scene, method, order + 1) == order + 1


NYSTROEM = """
name = "nystroem3"
family = "splitting"
parts = ["T", "V"]
rkn = "V"
step = [["V", "1 - r"], ["T", "r"], ["V", "r"], ["T", "1 - r"]]
numbers = { r = "1/2" }
source = "a test"
"""


def test_conditions_of_nystroem_count_only_where_v_commutes_three_times_with_t():
    method = Method("splitting", shipped("mclachlan_atela4"))
    assert certified_order(method, SCENES["particle"]()).order == 4
    assert certified_order(method, SCENES["symmetric top"]()).order == 4
    assert certified_order(method, SCENES["quartic particle"]()).order == 3


def rounded(scene, spelling, order):
    """The local error's coefficients in doubles, for tableaux of rounded digits."""
    method = parse(spelling, families_for(scene))
    view = problem_for(scene, method)
    ring = method.ring
    found = local_error(lower(scene, method), view, ring, order)
    sizes = [
        max(abs(float(ring.approximate(x.coefficients[k], 20))) for x in found) for k in range(order + 1)
    ]
    return certified_order(method, scene).order, sizes


@pytest.mark.parametrize("name", ["particle", "quartic particle", "symmetric top"])
def test_a_nystroem_splitting_has_its_order_where_the_bracket_vanishes_and_less_elsewhere(name):
    order, sizes = rounded(SCENES[name](), "splitting:mclachlan_atela4", 5)
    assert order == (3 if name == "quartic particle" else 4)
    assert max(sizes[: order + 1]) < 1e-17
    assert sizes[order + 1] > 1e-6


def test_a_step_frozen_in_time_is_caught():
    """The control: a program whose kicks all see the time of the start has order one."""
    from codegen.ir.operations import Advance
    from codegen.ir.values import Coefficient

    scene = SCENES["driven particle"]()
    method = parse("splitting:strang", families_for(scene))
    program = lower(scene, method)
    still = Coefficient(Number.rational(0))
    body = tuple(
        replace(a, operation=replace(a.operation, coefficient=still))
        if isinstance(a.operation, Advance)
        else a
        for a in program.body
    )
    view = problem_for(scene, method)
    assert valuation(local_error(replace(program, body=body), view, QQ, 3)) == 2


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize(
    ("scene", "method"),
    [
        ("fast_heavy_top", "splitting:blanes_moan_rkn4"),
        ("dipole", "composition:triple_jump"),
        ("linear_oscillator", "splitting:strang"),
    ],
)
def test_emitted_steps_agree_with_the_interpreter(scene, method, target):
    from codegen.lab.runner import Emitted, Interpreted

    shared = compiled(scene, method)
    found, expected = Emitted(shared, target).final(20), Interpreted(shared).final(20)
    size = max(map(abs, expected))
    assert max(abs(a - b) for a, b in zip(found, expected, strict=True)) < 1e-13 * size


def test_steps_back_undo_symmetric_steps():
    from codegen.loader import load

    integrator = load(emitted("dipole", "splitting:strang"))
    start = [float(x) for x in scenes.load("dipole").initial(PreciseDomain(0, 20))]
    there = integrator.run(start, 0.01, 50)
    back = integrator.run(there, -0.01, 50)
    assert max(abs(a - b) for a, b in zip(start, back, strict=True)) < 1e-13
    assert max(abs(a - b) for a, b in zip(start, there, strict=True)) > 1e-2


def test_momenta_of_the_fast_top_are_kept_to_rounding():
    from codegen.loader import load

    scene = scenes.load("fast_heavy_top")
    integrator = load(emitted("fast_heavy_top", "splitting:blanes_moan_rkn4"))
    x = [float(v) for v in scene.initial(PreciseDomain(0, 20))]
    y = integrator.run(x, 0.01, 200)
    axis = lambda s: sum(s[9 + i] * s[3 * i + 1] for i in range(3))  # noqa: E731
    assert y[11] == x[11]
    assert axis(y) == pytest.approx(axis(x), rel=1e-14)
    assert abs(y[9] - x[9]) > 1


def refused(scene, spelling):
    with pytest.raises(MethodError) as error:
        lower(scene, parse(spelling, ("splitting", "composition", "vcg")))
    return str(error.value)


def test_what_cannot_be_split_is_told():
    group = SO3()
    g, mu = group.point("g"), group.dual("mu")
    start = {"q0": quarter_turn(), "mu0": [1, 2, 3], "span": (0, 1), "group": group, "q": g, "mu": mu}
    whole = HamiltonianScene(H=mu.dot(mu), **start)
    assert 'no parts; expected a Hamiltonian with named parts; write parts={"T": T, "V": V}' in refused(
        whole, "splitting:strang"
    )
    mixed = mu[0] ** 2 * g[0, 1]
    scene = HamiltonianScene(H=mu.dot(mu) + mixed, parts={"T": mu.dot(mu), "V": mixed}, **start)
    message = refused(scene, "splitting:strang")
    assert (
        "the part V has no exact flow: "
        "it is not a quadratic function of the momentum in the body or space frame" in message
    )
    assert "the tableau has 3 parts, but the scene has 2 parts;" in refused(
        SCENES["symmetric top"](), "splitting:strang3"
    )
    t = Symbol("t")
    scene = particle(lambda q, p: p.dot(p) / 2, lambda q, p: q[0] * t)
    kinetic = particle(lambda q, p: t * p.dot(p) / 2, lambda q, p: q[0] * t)
    lower(scene, parse("splitting:strang", families_for(scene)))
    assert "the part T has no exact flow: it depends on the momentum and on t" in refused(
        kinetic, "splitting:strang"
    )
    both = particle(lambda q, p: q[1] * t, lambda q, p: q[0] * t)
    assert "every part depends on t; expected at least one part that does not depend on t" in refused(
        both, "splitting:strang"
    )
    hyperbolic = particle(lambda q, p: p.dot(p) / 2 - q.dot(q) / 2, lambda q, p: q[0] ** 3)
    assert (
        "its flow solves z' = M z + c, but a formula is known only if M^2 is diagonal with entries <= 0"
        in refused(hyperbolic, "splitting:strang")
    )
    assert "the tableau rk4 has the format rk, which these families cannot use: splitting" in refused(
        SCENES["symmetric top"](), "splitting:rk4"
    )


def test_a_field_has_no_parts():
    with pytest.raises(MethodError, match="expected a Hamiltonian scene"):
        problem_for(scenes.load("free_rigid_body"), Method("splitting", shipped("strang")))


def test_nystroem_reading_needs_no_names():
    """Parts called otherwise than the tableau's: V of the tableau is the kick."""
    scene = particle(lambda q, p: p[0] ** 2 / 2 + p[1] ** 2, lambda q, p: q[0] ** 3 + q[0] * q[1])
    renamed = replace(scene, parts={"potential": scene.parts["V"], "kinetic": scene.parts["T"]})
    method = Method("splitting", Tableau.loads(NYSTROEM))
    first = lower(renamed, method).body[0]
    assert first.operation.part == "potential"


TAU = Symbol("tau")


def stated(flow, V=None):
    """A planar rotor on T*R^1 with H = p^2 (1 + q^2)/2 + V, whose first part no class of flows knows."""
    group = Rn(1)
    q, p = group.point("q"), group.dual("p")
    T = p[0] ** 2 / 2 + 3 * p[0] * q[0]
    V = q[0] ** 3 if V is None else V(q, p)
    return HamiltonianScene(
        group=group,
        q=q,
        mu=p,
        H=T + V,
        parts={"T": T, "V": V},
        flows={"T": flow(q[0], p[0])},
        q0=[1],
        mu0=[Rational(1, 2)],
        span=(0, 1),
        name="stated",
    )


def sheared(q, p):
    """q' = p + 3 q, p' = -3 p."""
    grown, shrunk = exp(3 * TAU), exp(-3 * TAU)
    return [q * grown + p * (grown - shrunk) / 6], [p * shrunk]


def test_a_flow_may_be_stated_where_it_is_not_recognised():
    scene = stated(sheared)
    assert kinds(parts(scene)["T"]) == [[Stated]]
    method = Method("splitting", shipped("ruth3"))
    assert error(scene, method, 4) == 4
    assert "T, given by formulas in the scene" in emit(scene, method).files["stated_splitting_ruth3.c"]
    unstated = replace(scene, stated={})
    assert "the part T has no exact flow" in refused(unstated, "splitting:ruth3")


@pytest.mark.parametrize(
    ("flow", "message"),
    [
        # Summands that do not commute: the flow of p^2/2, then that of 3 p q.
        (
            lambda q, p: ([(q + TAU * p) * exp(3 * TAU)], [p * exp(-3 * TAU)]),
            "the formula for q0 is wrong: the time derivative is",
        ),
        (lambda q, p: ([q + 1], [p]), "the formula for q0 is wrong: the value is 2"),
    ],
)
def test_what_is_stated_to_be_a_flow_and_is_none_is_refused(flow, message):
    with pytest.raises(SceneError) as failure:
        stated(flow)
    assert f"in the flow of T, {message}" in str(failure.value)
    assert (
        "by the differential equations of the part T; if the part is a sum of terms whose flows do not"
        in str(failure.value)
    )


def test_a_flow_is_that_of_a_part():
    group = Rn(1)
    q, p = group.point("q"), group.dual("p")
    with pytest.raises(SceneError, match="a flow of 'W'; expected a flow for one of the parts T"):
        HamiltonianScene(
            group=group,
            q=q,
            mu=p,
            H=p[0],
            parts={"T": p[0]},
            flows={"W": (q, p)},
            q0=[1],
            mu0=[1],
            span=(0, 1),
        )
