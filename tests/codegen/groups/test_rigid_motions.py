"""Methods on SE(3), SU(2) and SL(2): orders of emitted code, and the symplectic form of variational steps."""

from __future__ import annotations

from functools import cache

import pytest
from sympy import Matrix, Rational, diag

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.groups import SE3, SL2, SU2, LeftMultiplication, Product, Rn
from codegen.ir.domain import FloatDomain
from codegen.lab.long_runs.symplecticity import symplectic_defect
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.loader import load
from codegen.scene import FieldScene, HamiltonianScene
from tests.strategies import UNIT, quarter_turn

INERTIA = diag(Rational(3, 5), Rational(4, 5), 1)


def body_on_a_spring():
    """A rigid body of mass 2 whose centre is held by a spring, in a field that acts on its attitude."""
    group = SE3()
    g, mu = group.point("g"), group.dual("p")
    R, a = Matrix(3, 3, list(g[:9])), Matrix(g[9:])
    m, p = Matrix(mu[:3]), Matrix(mu[3:])
    P = R.T * (m - a.cross(p))
    parts = {
        "rotation": P.dot(INERTIA.inv() * P) / 2,
        "translation": (R.T * p).dot(R.T * p) / 4,
        "potential": a.dot(a) / 2 + R[2, 1] + a[0] * R[0, 2],
    }
    return HamiltonianScene(
        group=group,
        q=g,
        mu=mu,
        H=sum(parts.values()),
        parts=parts,
        q0=[*quarter_turn(), Rational(1, 2), 0, Rational(-1, 3)],
        mu0=[1, Rational(1, 2), Rational(-2, 3), Rational(1, 3), 1, Rational(-1, 2)],
        span=(0, 1),
        name="body on a spring",
    )


def shear():
    """A Hamiltonian without symmetry on T*SL(2)."""
    group = SL2()
    g, mu = group.point("g"), group.dual("p")
    potential = (g[0, 0] ** 2 + g[0, 1] ** 2 + 2 * g[1, 0] ** 2 + g[1, 1] ** 2) / 4
    return HamiltonianScene(
        group=group,
        q=g,
        mu=mu,
        H=mu.dot(mu) / 2 + mu[0] * mu[2] / 3 + potential + g[0, 1] * mu[1] / 5,
        q0=[2, Rational(1, 2), 2, 1],
        mu0=[Rational(1, 2), Rational(-1, 3), Rational(1, 4)],
        span=(0, Rational(1, 2)),
        name="shear",
    )


def free_body():
    """A free rigid body of mass 2 on SE(3) x se(3)*: attitude and position, both momenta in the body.

    P' = P x W and L' = L x W with the angular velocity W = P/I. The velocity of the position is R L/2.
    """
    motions, vectors = SE3(), Rn(6)
    g, P = motions.point("g"), vectors.point("P")
    R, a = Matrix(3, 3, list(g[:9])), Matrix(g[9:])
    angular, linear = Matrix(P[:3]), Matrix(P[3:])
    W = INERTIA.inv() * angular
    w = R * W
    return FieldScene(
        group=Product(motions, vectors),
        action=LeftMultiplication(),
        y=[*g, *P],
        f=[*w, *(R * linear / 2 - w.cross(a)), *angular.cross(W), *linear.cross(W)],
        y0=[
            *quarter_turn(),
            Rational(1, 2),
            0,
            -1,
            Rational(9, 5),
            Rational(2, 5),
            Rational(-9, 10),
            1,
            2,
            -1,
        ],
        span=(0, 1),
        name="free body",
    )


def free_body_of_momenta():
    """The free body of mass 2 on T*SE(3)."""
    group = SE3()
    g, mu = group.point("g"), group.dual("p")
    R, a = Matrix(3, 3, list(g[:9])), Matrix(g[9:])
    m, p = Matrix(mu[:3]), Matrix(mu[3:])
    P = R.T * (m - a.cross(p))
    return HamiltonianScene(
        group=group,
        q=g,
        mu=mu,
        H=P.dot(INERTIA.inv() * P) / 2 + p.dot(p) / 4,
        q0=[*quarter_turn(), Rational(1, 2), 0, -1],
        mu0=[1, Rational(1, 2), Rational(-2, 3), Rational(1, 3), 1, Rational(-1, 2)],
        span=(0, 1),
        name="free body of momenta",
    )


def spin():
    """A rotation of a unit quaternion whose angular velocity depends on it."""
    group = SU2()
    q = group.point("q")
    f = [q[0] * q[1] + 1, q[2] - q[3] * q[0], Rational(1, 2) - q[1]]
    return FieldScene(group=group, action=LeftMultiplication(), y=q, f=f, y0=UNIT, span=(0, 1), name="spin")


SCENES = {
    "body": body_on_a_spring,
    "shear": shear,
    "free body": free_body,
    "momenta": free_body_of_momenta,
    "spin": spin,
}


@cache
def scene(name):
    return SCENES[name]()


@cache
def exact(name):
    return reference(scene(name))


@cache
def compiled(name, method):
    return compile_method(scene(name), method)


def observed(name, method, target):
    """The convergence of an emitted method whose stated order is 4."""
    made = compiled(name, method)
    stated = certified_order(made.method, made.scene)
    assert stated.order == 4
    return converge(Emitted(made, target, stated), stated, exact(name))


VARIATIONAL = ("vcg:triple_jump", "vrkmk(2):gauss2", "vcf:vcf_gauss2")
FIELDS = ("rkmk:rk4", "cg:cg4a", "cf:cf4")
QUICK = (("shear", "vcg:triple_jump", "python"), ("spin", "rkmk:rk4", "c"))
PAIRS = [(name, method) for name in ("body", "shear") for method in VARIATIONAL]
PAIRS += [(name, method) for name in ("free body", "spin") for method in FIELDS]
PAIRS += [("body", "rkmk:rk4"), ("body", "splitting:blanes_moan4")]


@pytest.mark.parametrize(
    ("name", "method", "target"),
    [
        pytest.param(*case, id="-".join(case), marks=() if case in QUICK else pytest.mark.slow)
        for case in ((*pair, target) for pair in PAIRS for target in ("c", "python"))
    ],
)
def test_emitted_methods_of_order_four_have_order_four(name, method, target):
    found = observed(name, method, target)
    assert found.verdict == "holds", found.sentence()


@pytest.mark.slow
@pytest.mark.parametrize("method", VARIATIONAL)
@pytest.mark.parametrize("name", ["body", "shear"])
def test_variational_steps_keep_the_symplectic_form(name, method):
    made = compiled(name, method)
    state = [float(x) for x in made.problem.initial(FloatDomain(0.0))]
    assert symplectic_defect(made, state, 2.0**-7) < 1e-12


@pytest.mark.slow
def test_a_step_that_is_not_variational_changes_the_symplectic_form():
    made = compiled("shear", "rkmk:rk4")
    state = [float(x) for x in made.problem.initial(FloatDomain(0.0))]
    assert symplectic_defect(made, state, 2.0**-4) > 1e-12


@pytest.mark.parametrize("name", ["momenta", pytest.param("free body", marks=pytest.mark.slow)])
def test_attitude_and_position_of_a_free_body_have_order_four_each(name):
    made = compiled(name, "rkmk:rk4")
    emitted = Emitted(made, "c", certified_order(made.method, made.scene))
    end = [float(x) for x in exact(name).state]
    errors = []
    for steps in (16, 32, 64):
        state = emitted.integrator.run(emitted.initial, 1 / steps, steps)
        gaps = [abs(a - b) for a, b in zip(state, end, strict=True)]
        errors.append((max(gaps[:9]), max(gaps[9:12])))
    for coarse, fine in ((errors[0], errors[1]), (errors[1], errors[2])):
        for a, b in zip(coarse, fine, strict=True):
            assert 12 < a / b < 20


@pytest.mark.slow
@pytest.mark.parametrize(("name", "size"), [("body", 6), ("shear", 3)])
def test_the_jacobian_of_a_variational_step_is_the_limit_of_differences(name, size):
    integrator = load(emit(scene(name), "vcg:midpoint", "c", jacobian=True))
    state, h, eps = [float(x) for x in scene(name).initial(FloatDomain(0.0))], 2.0**-4, 2.0**-12
    first = len(state) - size
    jacobian = integrator.jacobian(state, h)
    for k in range(size):
        ends = []
        for sign in (1, -1):
            start = [x + sign * eps * (i == first + k) for i, x in enumerate(state)]
            ends.append(integrator.step(start, h)[first:])
        for i, (a, b) in enumerate(zip(*ends, strict=True)):
            assert jacobian[size + i][size + k] == pytest.approx((a - b) / (2 * eps), abs=1e-6)
