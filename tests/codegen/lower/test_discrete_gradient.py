"""Discrete gradients on groups: the printed method, the energy to rounding, and what does not keep it."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from sympy import Matrix, Rational, sympify

from codegen import emit
from codegen.certify import certified_order
from codegen.emitter import emit_compiled
from codegen.errors import MethodError
from codegen.groups import SO3, Rn, Rotation
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.scene_operations import Secant
from codegen.ir.values import Kind
from codegen.kernel.translate import to_kernel
from codegen.loader import load
from codegen.lower import families_for
from codegen.method import parse
from codegen.passes.rewrite import rewrite
from codegen.scene import FieldScene, HamiltonianScene, energy
from codegen.scenes import load as gallery
from tests.compilations import compiled, emitted
from tests.strategies import field_scene, hamiltonian_scene, lowered

D = PreciseDomain(Fraction(1, 64), 40)
INERTIA, SPACE = (1, 5, 60), (1, Fraction(5, 2), -60)
"""Moments of inertia and the momentum in space of thesis section 2.6."""


def quaternion(a, b):
    real = a[0] * b[0] - sum(x * y for x, y in zip(a[1:], b[1:], strict=True))
    c = cross(a[1:], b[1:])
    return (real, *(a[0] * y + b[0] * x + z for x, y, z in zip(a[1:], b[1:], c, strict=True)))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def inner(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def rotated(q, v):
    """q v q^c."""
    conjugate = (q[0], *(-x for x in q[1:]))
    return quaternion(quaternion(q, (0, *v)), conjugate)[1:]


def velocity_and_slope(q, m0):
    """f = w/2 and gamma = 2 w cross m0, w = E I^-1 E^T m0 the angular velocity in space; and the energy."""
    body = rotated((q[0], *(-x for x in q[1:])), m0)
    w = rotated(q, tuple(m / i for m, i in zip(body, INERTIA, strict=True)))
    return tuple(x / 2 for x in w), tuple(2 * x for x in cross(w, m0)), inner(w, m0) / 2


def exponential(context, x):
    angle = context.sqrt(inner(x, x))
    return (context.cos(angle), *(context.sin(angle) / angle * a for a in x))


def printed_step(context, q, h):
    """(2.31) with the point exp(eta/2) q, omega frozen there, by momenta in place of derivatives."""
    m0 = tuple(context.mpf(Fraction(x).numerator) / Fraction(x).denominator for x in SPACE)
    eta = tuple(h * a for a in velocity_and_slope(q, m0)[0])
    for _ in range(150):
        end = quaternion(exponential(context, eta), q)
        middle = quaternion(exponential(context, tuple(a / 2 for a in eta)), q)
        f, gamma, _ = velocity_and_slope(middle, m0)
        rise = velocity_and_slope(end, m0)[2] - velocity_and_slope(q, m0)[2]
        factor = (rise - inner(gamma, eta)) / inner(eta, eta)
        d = tuple(g + factor * e for g, e in zip(gamma, eta, strict=True))
        size = inner(gamma, gamma)
        along, across = inner(gamma, d) / size, inner(f, d) / size
        eta = tuple(h * (along * a - across * b) for a, b in zip(f, gamma, strict=True))
    return quaternion(exponential(context, eta), q)


def test_the_midpoint_choice_is_the_printed_method():
    scene = gallery("free_rigid_body_s3")
    view, program = lowered("discrete_gradient", "midpoint", scene)
    c = D.context
    q = exponential(c, (c.mpf("0.3"), c.mpf("-0.2"), c.mpf("0.5")))
    found = interpret(program, view, D, {"y": q})["y"]
    pairs = zip(found, printed_step(c, q, D.h), strict=True)
    assert max(abs(x - y) for x, y in pairs) < 1e-35


@pytest.mark.parametrize("place", ["SO(3)", "GL(2)", "SE(2)", "R^3"])
def test_the_differential_of_h_determines_the_field_by_the_bivector(place):
    """omega(gamma, .) = f, and omega is skew: on T*G the canonical one."""
    view = hamiltonian_scene(place).as_field()
    y = view.initial(D)
    gamma = view.apply(D, "differential", None, (y,))[0]
    f = view.apply(D, "field", None, (y,))[0]
    pairs = zip(view.apply(D, "bivector", None, (y, gamma))[0], f, strict=True)
    assert max(abs(a - b) for a, b in pairs) < 1e-36 * max(map(abs, f))
    alpha = tuple(D.rational(2 * k - 3, 5) for k in range(view.group.dim))
    assert abs(inner(view.apply(D, "bivector", None, (y, alpha))[0], alpha)) < 1e-36


def test_the_bivector_of_a_field_scene_is_skew_and_gives_the_field():
    view = gallery("free_rigid_body_s3")
    q = (D.rational(2, 9), D.rational(4, 9), D.rational(-5, 9), D.rational(6, 9))
    gamma = energy.differential(view, D, q)
    pairs = zip(energy.bivector(view, D, q, gamma), view.apply(D, "field", None, (q,))[0], strict=True)
    assert max(abs(a - b) for a, b in pairs) < 1e-37
    alpha = tuple(D.rational(k, 7) for k in (3, -1, 2))
    assert abs(inner(energy.bivector(view, D, q, alpha), alpha)) < 1e-36


def test_the_secant_pairs_with_the_step_as_the_rise_and_is_the_slope_where_there_is_no_step():
    g, x = tuple(map(D.rational, (1, -2, 3))), tuple(map(D.rational, (2, 5, -1)))
    found = energy.secant(D, g, x, D.rational(7), D.rational(9))
    assert abs(inner(found, x) - 2) < 1e-38
    zero = (D.rational(0),) * 3
    assert energy.secant(D, g, zero, D.rational(7), D.rational(7)) == g


def h_of(rows):
    """The energy of attitudes on S^3."""
    real, axis = rows[:, :1], rows[:, 1:]
    m0 = np.array([float(x) for x in SPACE]) + 0 * axis
    c = 2 * np.cross(axis, m0)
    body = m0 - real * c + np.cross(axis, c)
    return (body**2 / np.array(INERTIA)).sum(axis=1) / 2


def attitudes(method, steps=64_000):
    emission = emitted("free_rigid_body_s3", method)
    return np.array(load(emission).trajectory(emission.manifest["initial"], 1 / 64, steps, 16))


@pytest.mark.parametrize("tableau", ["midpoint", "gauss3"])
def test_the_energy_is_kept_over_a_thousand_units_of_time(tableau):
    """H0 = 31.125, both discrete differentials of section 2.6."""
    rows = attitudes(f"discrete_gradient:{tableau}")
    energy = h_of(rows)
    assert energy[0] == 31.125
    assert np.abs(energy - 31.125).max() < 1e-11
    assert np.abs((rows**2).sum(axis=1) - 1).max() < 1e-12
    assert rows[:, 3].min() < -0.99
    assert rows[:, 3].max() > 0.99


def test_the_munthe_kaas_method_of_heun_leaves_the_surface_of_energy():
    rows = attitudes("rkmk:heun")
    assert np.abs(h_of(rows) - 31.125).max() > 1000
    assert np.abs((rows**2).sum(axis=1) - 1).max() < 1e-11


@pytest.mark.slow
def test_an_adaptive_method_with_a_millionth_of_tolerance_loses_half_a_unit():
    from scipy.integrate import solve_ivp

    m0 = tuple(float(x) for x in SPACE)

    def f(_, q):
        return quaternion((0, *velocity_and_slope(tuple(q), m0)[0]), tuple(q))

    rows = solve_ivp(f, (0, 1000), [1, 0, 0, 0], rtol=1e-6, atol=1e-6).y.T
    assert np.abs(h_of(rows) - 31.125).max() == pytest.approx(0.55, abs=0.05)


SCENES = [
    ("dipole", 0.01),
    pytest.param("fast_heavy_top", 0.0005, marks=pytest.mark.slow),
    ("free_rigid_body", 0.1),
    pytest.param("free_rigid_body_attitude", 0.05, marks=pytest.mark.slow),
    ("free_rigid_body_product", 0.05),
    ("duffing", 0.1),
    ("duffing_se2", 0.1),
    ("duffing_sl2", 0.1),
]


def drift(scene, emission, h, steps=2000):
    rows = load(emission).trajectory(emission.manifest["initial"], h, steps, 10)
    energy = [scene.invariant(FloatDomain(0.0), "energy", row) for row in rows]
    return max(abs(e - energy[0]) for e in energy) / max(1, abs(energy[0]))


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize(("name", "h"), SCENES)
def test_every_scene_with_an_energy_keeps_it_to_rounding(name, h, target):
    scene = gallery(name)
    steps = 2000 if target == "c" else 50
    assert drift(scene, emitted(name, "discrete_gradient:midpoint", target), h, steps) < 1e-12


@pytest.mark.parametrize("tableau", ["midpoint", pytest.param("gauss2", marks=pytest.mark.slow)])
def test_without_the_part_along_the_step_the_energy_is_kept_to_the_quadrature_only(tableau):
    """The control: <g, eta> in place of H(x1) - H(x0)."""
    made = compiled("dipole", f"discrete_gradient:{tableau}")

    def rule(rewriter, assign):
        return assign.args[:1] if isinstance(assign.operation, Secant) else rewriter.emit(assign)

    program = rewrite(made.program, rule)
    broken = replace(made, program=program, kernel=to_kernel(program, made.problem))
    assert drift(made.scene, emit_compiled(broken, "c"), 0.01) > {"midpoint": 1e-7, "gauss2": 1e-12}[tableau]


def there_and_back(method):
    integrator = load(emitted("free_rigid_body_s3", method))
    q = [0.5, -0.5, 0.5, 0.5]
    return math.dist(integrator.step(integrator.step(q, 1 / 64), -1 / 64), q)


def test_symmetric_nodes_give_a_reversible_map_and_others_do_not():
    assert there_and_back("discrete_gradient:midpoint") < 1e-14
    assert there_and_back("discrete_gradient:gauss3") < 1e-14
    assert there_and_back("discrete_gradient:euler") > 1e-6


def test_an_equilibrium_stays_where_it_is():
    """There f = gamma = 0, and the quotients have the limit 0."""
    for target in ("c", "python"):
        integrator = load(emitted("free_rigid_body", "discrete_gradient:midpoint", target))
        assert integrator.step([0.0, 0.0, 1.0], 0.1) == [0.0, 0.0, 1.0]


def test_the_order_is_that_of_the_quadrature_up_to_two():
    scene = gallery("free_rigid_body_s3")
    orders = {}
    for name in ("euler", "midpoint", "gauss3", "rk4", "radau2a1"):
        orders[name] = certified_order(parse(f"discrete_gradient:{name}", families_for(scene)), scene).order
    assert orders == {"euler": 1, "midpoint": 2, "gauss3": 2, "rk4": 2, "radau2a1": 1}


@pytest.mark.parametrize("name", ["linear_oscillator", "driven_spin"])
def test_scenes_without_an_energy_do_not_offer_it(name):
    scene = gallery(name)
    assert "discrete_gradient" not in families_for(scene)
    with pytest.raises(MethodError, match="family discrete_gradient cannot be used on this scene"):
        parse("discrete_gradient:midpoint", families_for(scene))


@pytest.mark.parametrize(
    ("scene", "why"), [("S^2", "which has no energy"), ("time", "which depends on time")]
)
def test_a_scene_without_an_energy_is_refused(scene, why):
    made = hamiltonian_scene("SO(3)", time=True) if scene == "time" else field_scene(scene)
    with pytest.raises(MethodError, match=why):
        lowered("discrete_gradient", "midpoint", made)


@pytest.mark.parametrize("energy", ["radius", "constant"])
def test_an_energy_that_says_nothing_of_the_field_is_refused(energy):
    """The radius is the same on all of the sphere: no bivector takes its differential to the field."""
    m = SO3().dual("m")
    kept = m.dot(m) if energy == "radius" else sympify(1)
    made = FieldScene(
        group=SO3(),
        action=Rotation(),
        y=m,
        f=[m[1], 2, m[2]],
        y0=[1, 0, 1],
        span=(0, 1),
        invariants={"energy": kept},
    )
    with pytest.raises(MethodError, match="energy is zero at a point where the field f is not"):
        lowered("discrete_gradient", "midpoint", made)


def test_the_unknown_is_one_velocity():
    made = compiled("dipole", "discrete_gradient:midpoint")
    (block,) = (s for s in made.program.body if hasattr(s, "unknowns"))
    assert [u.kind for u in block.unknowns] == [Kind.ALG]


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("mass", [Fraction(1, 10**16), Fraction(91, 10**32)])
def test_newtons_matrix_is_right_for_tiny_momenta(mass, target):
    group, m = Rn(1), Rational(mass.numerator, mass.denominator)
    q, p = group.point("q"), group.dual("p")
    H = p.dot(p) / (2 * m) + m * (q[0] ** 2 / 2 + q[0] ** 4 / 4)
    scene = HamiltonianScene(group=group, q=q, mu=p, H=H, q0=Matrix([1]), mu0=Matrix([0]), span=(0, 1))
    module = load(emit(scene, "discrete_gradient:midpoint", target=target, solver="newton"))
    position, momentum = module.run([1.0, 0.0], h=0.1, steps=10)
    # The displacement of the position is much larger than that of the momentum, so the position does not
    # depend on the mass. The energy keeps its initial value, 3/4 times the mass.
    assert position == pytest.approx(0.236397280748, rel=1e-11)
    speed = math.sqrt(2 * (0.75 - position**2 / 2 - position**4 / 4))
    assert momentum / float(mass) == pytest.approx(-speed, rel=1e-12)
