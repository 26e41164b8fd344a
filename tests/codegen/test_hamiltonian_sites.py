"""Hamiltonian chains and lattices: forces of bonds, emitted steps against those of the product, orders."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from sympy import Matrix, Symbol, cos, sin

from codegen import emit, load, load_lattice
from codegen.arrival import Status
from codegen.emitter import compile_method
from codegen.errors import MethodError, SceneError
from codegen.groups import SO3, Rn
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.precision import DOUBLE
from codegen.lower import lower, method_for
from codegen.run.execute import Machine
from codegen.run.plan import Plan
from codegen.run.site_terms import padded
from codegen.run.unit import unit_of
from codegen.scene import Bond, HamiltonianSiteScene, neighbour
from codegen.scene.unrolled import unrolled
from tests.codegen.bodies import bodies, joined, open_bodies, sheet, spinning, springs, string

D = PreciseDomain(0, 40)
SCENES = {"bodies": bodies, "open_bodies": open_bodies, "sheet": sheet, "springs": springs, "string": string}


@cache
def module(name, method):
    return load_lattice(emit(SCENES[name](), method, target="c"))


def sites(number, seed=1, name="bodies"):
    """Return states of some sites in 40 digits, as a list of (q, mu)."""
    scene, rng = SCENES[name](), np.random.default_rng(seed)
    group = scene.group
    listed = []
    for _ in range(number):
        x = [D.rational(int(k), 100) for k in rng.integers(-90, 90, 2 * group.dim)]
        listed.append((group.exp(D, tuple(x[: group.dim])), tuple(x[group.dim :])))
    return listed


def states(shape, seed=1, name="bodies"):
    """Return an array of states."""
    listed = sites(int(np.prod(shape)), seed, name)
    return np.array([[float(x) for x in (*q, *mu)] for q, mu in listed]).reshape((*shape, -1))


def largest(xs, ys):
    return max(abs(x - y) for x, y in zip(xs, ys, strict=True))


@pytest.mark.parametrize(
    ("name", "shape", "pairs"),
    [
        ("bodies", (4,), [(0, 1), (1, 2), (2, 3), (3, 0)]),
        ("sheet", (2, 2), [(0, 1), (1, 0), (2, 3), (3, 2), (0, 3), (1, 2), (2, 1), (3, 0)]),
    ],
)
def test_forces_of_bonds_are_those_of_the_total_energy(name, shape, pairs):
    whole, product = unrolled(SCENES[name](), shape), joined(4, pairs)
    listed = sites(4, name=name)
    split = [x for q, _ in listed for x in q], [x for _, mu in listed for x in mu]
    expected = product.velocity(D, [*split[0], *split[1]])
    found = whole.velocity(D, [x for site in listed for part in site for x in part])
    for i in range(4):
        there = [*expected[9 * i : 9 * i + 9], *expected[36 + 3 * i : 39 + 3 * i]]
        assert largest(found[12 * i : 12 * i + 12], there) < D.rational(1, 10**36)
    # The check can fail: the forces differ from those of a chain in which one bond is missing.
    fewer = joined(4, pairs[1:]).velocity(D, [*split[0], *split[1]])
    assert largest(fewer, expected) > D.rational(1, 100)


@pytest.mark.parametrize(
    ("name", "method", "shape"),
    [
        ("bodies", "cf:cf3", (4,)),
        pytest.param("open_bodies", "rkmk:rk4", (4,), marks=pytest.mark.slow),
        pytest.param("open_bodies", "cg:cg3", (1,), marks=pytest.mark.slow),
        pytest.param("sheet", "cf:cf4", (2, 3), marks=pytest.mark.slow),
        pytest.param("springs", "cf:cf4", (4,), marks=pytest.mark.slow),
    ],
)
def test_a_step_in_forty_digits_is_the_step_of_the_product(name, method, shape):
    scene = SCENES[name]()
    number, size = int(np.prod(shape)), len(scene.symbols)
    plan = Plan(compile_method(scene, method).kernel, DOUBLE)
    domain = PreciseDomain(D.rational(1, 7), 40)
    whole = unrolled(scene, shape)
    start = [x for q, mu in sites(number, name=name) for x in (*q, *mu)]
    program = lower(whole, method_for(whole, method))
    expected = interpret(program, whole, domain, {"y": tuple(start)})["y"]
    found = run(plan, domain, shape, start, size)
    assert largest(found, expected) < D.rational(1, 10**35)


def run(plan, domain, shape, start, size, *t):
    """Return the states after one step of an emitted module from the time t, executed in 40 digits."""
    number = int(np.prod(shape))
    rows = [start[size * i + k] for k in range(size) for i in range(number)]
    work = [domain.rational(0)] * (padded(number) * plan.kernel.sites.workspace)
    parameters = [domain.rational(3, 2)] if plan.parameters else []
    h = domain.rational(1, 7)
    machine = Machine(unit_of(plan), domain)
    assert machine.call("run", list(shape), rows, *t, h, 1, *parameters, work, [0]) == Status.OK
    return [rows[number * k + i] for i in range(number) for k in range(size)]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "method", "order"),
    [
        ("bodies", "splitting:strang", 2),
        ("bodies", "composition:triple_jump", 4),
        ("open_bodies", "splitting:strang", 2),
        ("open_bodies", "cg:cg3", 3),
        ("springs", "splitting:strang", 2),
        ("springs", "composition:triple_jump", 4),
        ("springs", "rkmk:rk4", 4),
    ],
)
def test_the_order_is_seen_from_below_and_above(name, method, order):
    start = states((4,), name=name)
    exact = module(name, "cf:cf4").run(start, 1 / 4096, 4096).states
    errors = []
    for n in (128, 256):
        result = module(name, method).run(start, 1 / n, n)
        assert result.ok
        errors.append(np.abs(result.states - exact).max())
    slope = np.log2(errors[0] / errors[1])
    assert order - 0.15 < slope < order + 0.2


@pytest.mark.slow
def test_emitted_code_of_a_chain_is_that_of_the_product():
    whole = load(emit(unrolled(open_bodies(), (4,)), "cf:cf4", target="c"))
    start = states((4,))
    found = module("open_bodies", "cf:cf4").run(start, 0.1, 5).states
    assert np.abs(found.ravel() - whole.run(start.ravel().tolist(), 0.1, 5)).max() < 1e-13


def test_a_splitting_conserves_the_momentum_of_a_free_chain():
    start = states((6,), name="springs")
    lattice = module("springs", "splitting:strang")
    result = lattice.run(start, 0.02, 500)
    assert result.ok
    # The linear momentum, and the angular momentum about the origin.
    moments = [x[:, 12:].sum(axis=0) for x in (start, result.states)]
    assert np.abs(moments[1] - moments[0]).max() < 1e-12
    assert np.abs(result.states[:, 12:] - start[:, 12:]).max() > 0.1
    R = result.states[:, :9].reshape(-1, 3, 3)
    assert np.abs(R @ R.transpose(0, 2, 1) - np.eye(3)).max() < 1e-13


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"bonds": []}, "a lattice without bonds"),
        ({"bonds": [Bond((1,), SO3().point("q")[0])]}, "coordinates of fewer than two sites"),
        ({"bonds": [Bond((1,), SO3().dual("mu")[0])]}, "contains mu0"),
        ({"bonds": [Bond((0,), SO3().point("q")[0])]}, r"a neighbour with the offset \(0,\)"),
        ({"boundary": "open"}, r"no state for the neighbour \(-1,\)"),
        ({"parts": {"kinetic": SO3().dual("mu")[0]}}, "the parts kinetic add up to"),
        ({"q0": [1, 1, 1, 0, 1, 0, 0, 0, 1]}, "the initial state violates"),
        ({"mu": [1]}, "expected"),
        ({"H": Symbol("nu")}, "the symbol nu in H has no value"),
    ],
)
def test_wrong_energies_are_refused(options, message):
    with pytest.raises(SceneError, match=message):
        spinning(**options)


def test_bonds_of_different_dimensions_are_refused():
    q = SO3().point("q")
    listed = [Bond(o, q[0] * neighbour(q, o)[0]) for o in ((1,), (0, 1))]
    with pytest.raises(SceneError, match="bond offsets with different numbers of entries"):
        spinning(bonds=listed)


def test_splittings_need_parts():
    with pytest.raises(MethodError, match="a lattice without parts"):
        emit(spinning(parts=None), "splitting:strang", target="c")


def test_splittings_need_parts_with_momenta_that_do_not_depend_on_time():
    G, t = Rn(1), Symbol("t")
    (x,), (p,) = G.point("x"), G.dual("p")
    scene = HamiltonianSiteScene(
        group=G,
        q=[x],
        mu=[p],
        H=p**2 / 2 + (1 + t) * p,
        parts={"kinetic": p**2 / 2, "wind": (1 + t) * p},
        bonds=[Bond((1,), x * neighbour([x], (1,))[0])],
        q0=[0],
        mu0=[1],
        span=(0, 1),
    )
    with pytest.raises(
        MethodError, match="the part wind has no exact flow: it depends on the momentum and on t"
    ):
        emit(scene, "splitting:strang", target="c")


def test_a_driven_end_moves_with_the_time():
    scene = spinning(boundary="open", outside={(-1,): turned(), (1,): SO3().point("q")})
    plan = Plan(compile_method(scene, "cf:cf3").kernel, DOUBLE)
    domain, whole = PreciseDomain(D.rational(1, 7), 40), unrolled(scene, (2,))
    start = [x for q, mu in sites(2) for x in (*q, *mu)]
    program = lower(whole, method_for(whole, "cf:cf3"))
    expected = interpret(program, whole, domain, {"y": tuple(start), "t": D.rational(1, 3)})["y"]
    found = run(plan, domain, (2,), start, 12, D.rational(1, 3))
    assert largest(found, expected) < D.rational(1, 10**35)


def turned():
    """Return a rotation with the angle t."""
    t = Symbol("t")
    return Matrix([[cos(t), -sin(t), 0], [sin(t), cos(t), 0], [0, 0, 1]])


@pytest.mark.parametrize(
    ("method", "bound"),
    # In Strang's splitting the kick is first and last, so the state is copied before and after.
    [("composition:triple_jump", 1e-8), ("splitting:strang", 1e-4), ("splitting:position_verlet", 1e-4)],
)
def test_a_chain_of_springs_oscillates_as_in_the_closed_form(method, bound):
    n, T = 8, 3.0
    phase = 2 * np.pi * np.arange(n) / n
    start = np.stack([np.cos(phase), 0 * phase], axis=-1)
    rate = 2 * np.sin(np.pi / n)
    result = module("string", method).run(start, T / 200, 200).states
    error = np.abs(result[:, 0] - np.cos(phase) * np.cos(rate * T)).max()
    assert bound / 100 < error < bound
