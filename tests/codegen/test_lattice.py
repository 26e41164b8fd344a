"""Chains and lattices: emitted C against the product of all sites, orders, boundaries, errors."""

from __future__ import annotations

import shutil
import subprocess
from functools import cache

import numpy as np
import pytest
from click.testing import CliRunner
from sympy import Matrix, Rational, Symbol

from codegen import emit, load, load_lattice
from codegen.arrival import Status
from codegen.emitter import compile_method
from codegen.errors import MethodError, SceneError
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.precision import DOUBLE
from codegen.lower import lower, method_for
from codegen.printers.c.module import FLAGS, VECTOR_FLAGS
from codegen.run.execute import Machine
from codegen.run.plan import Plan
from codegen.run.site_terms import padded
from codegen.run.unit import unit_of
from codegen.scene import Pair, SiteScene, neighbour
from codegen.scene.unrolled import unrolled
from orderconds.cli import program
from orderconds.errors import InputError
from tests.codegen.chains import (
    START,
    S,
    chain,
    linear_group_chain,
    open_chain,
    open_plane,
    oscillators,
    plane,
    special_unitary_chain,
)

SCENES = {"chain": chain, "open_chain": open_chain, "plane": plane, "open_plane": open_plane}
SHAPES = {1: (4,), 2: (2, 3)}


@cache
def module(name, method):
    scene = {**SCENES, "oscillators": oscillators}[name]()
    return load_lattice(emit(scene, method, target="c"))


def states(shape, seed=1, size=3):
    found = np.random.default_rng(seed).normal(size=(*shape, size))
    return found / np.linalg.norm(found, axis=-1, keepdims=True)


@pytest.mark.parametrize(
    ("name", "method", "shape"),
    [
        pytest.param("chain", "cf:cf4", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "cf:cf4", (2,), marks=pytest.mark.slow),
        pytest.param("chain", "rkmk:rk4", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "cg:cg3", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "ambient:rk4", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "cf:carpenter_kennedy4", (5,), marks=pytest.mark.slow),
        pytest.param("open_plane", "cf:williamson3", (3, 4), marks=pytest.mark.slow),
        pytest.param("open_chain", "cf:cf4", (4,), marks=pytest.mark.slow),
        pytest.param("open_chain", "cf:cf4", (1,), marks=pytest.mark.slow),
        pytest.param("plane", "cf:cf4", (2, 3), marks=pytest.mark.slow),
        pytest.param("plane", "rkmk(0):euler", (2, 6), marks=pytest.mark.slow),
        pytest.param("open_plane", "rkmk:rk4", (3, 4), marks=pytest.mark.slow),
        pytest.param("oscillators", "rk:rk4", (4,), marks=pytest.mark.slow),
    ],
)
def test_a_lattice_is_the_product_of_its_sites(name, method, shape):
    lattice = module(name, method)
    whole = load(emit(unrolled({**SCENES, "oscillators": oscillators}[name](), shape), method, target="c"))
    start = states(shape, size=lattice.interface.size)
    for h, steps in ((0.1, 7), (0.7, 2)):
        found = lattice.run(start, h, steps, t=0.3)
        expected = whole.run(start.ravel().tolist(), h, steps, t=0.3)
        assert (found.status, found.completed) == (Status.OK, steps)
        assert np.abs(found.states.ravel() - expected).max() < 2e-14


@pytest.mark.parametrize(
    ("scene", "method"),
    [
        (linear_group_chain, "rkmk(0):euler"),
        pytest.param(linear_group_chain, "rkmk:rk4", marks=pytest.mark.slow),
        pytest.param(special_unitary_chain, "cf:luescher3", marks=pytest.mark.slow),
        pytest.param(special_unitary_chain, "rkmk:rk4", marks=pytest.mark.slow),
    ],
)
def test_a_lattice_of_matrices_is_the_product_of_its_sites(scene, method):
    lattice = load_lattice(emit(scene(), method, target="c"))
    whole = load(emit(unrolled(scene(), (3,)), method, target="c"))
    start = np.array(whole.initial).reshape(3, -1)
    # One step with a large difference between neighbours makes the sites different.
    start = np.array(lattice.run(start + 0.3 * np.eye(3, start.shape[1]), 0.5, 1).states)
    for h, steps in ((0.1, 5), (2.0, 2)):
        found = lattice.run(start, h, steps)
        expected = whole.run(start.ravel().tolist(), h, steps)
        assert found.ok
        assert np.abs(found.states.ravel() - expected).max() < 1e-13


def test_a_step_in_forty_digits_is_the_step_of_the_product():
    scene, method = open_chain(), "rkmk(2):rk4"
    plan, domain = Plan(compile_method(scene, method).kernel, DOUBLE), PreciseDomain(0, 40)
    machine, whole = Machine(unit_of(plan), domain), unrolled(scene, (3,))
    start = [domain.rational(k * k % 7 - 3, 5) for k in range(9)]
    h, t = domain.rational(1, 7), domain.rational(1, 3)
    rows = [start[3 * i + k] for k in range(3) for i in range(3)]
    assert plan.kernel.sites is not None
    work = [domain.rational(0)] * (padded(3) * plan.kernel.sites.workspace)
    assert machine.call("run", [3], rows, t, h, 1, work, [0]) == Status.OK
    program = lower(whole, method_for(whole, method))
    expected = interpret(program, whole, replaced(domain, h), {"y": tuple(start), "t": t})["y"]
    errors = [abs(rows[3 * k + i] - expected[3 * i + k]) for k in range(3) for i in range(3)]
    # The coefficients of a kernel are exact, so all forty digits agree.
    assert max(errors) < domain.rational(1, 10**36)


def replaced(domain, h):
    """Return a domain in which the step size is h."""
    return PreciseDomain(h, 40)


@pytest.mark.parametrize(
    ("name", "method", "order"),
    [
        ("chain", "cf:cf4", 4),
        pytest.param("open_chain", "cg:cg3", 3, marks=pytest.mark.slow),
        pytest.param("open_plane", "rkmk(0):euler", 1, marks=pytest.mark.slow),
    ],
)
def test_the_order_is_seen_from_below_and_above(name, method, order):
    lattice, reference = module(name, method), module(name, "cf:cf4")
    start = states(SHAPES[lattice.interface.dimension])
    exact = reference.run(start, 1 / 1024, 1024, t=0.2).states
    counts = (32, 64) if order > 1 else (512, 1024)
    errors = [np.abs(lattice.run(start, 1 / n, n, t=0.2).states - exact).max() for n in counts]
    slope = np.log2(errors[0] / errors[1])
    assert order - 0.15 < slope < order + 0.35


def test_loops_over_many_sites_have_the_bits_of_single_sites():
    # In a chain of four sites, two are computed by the loop; in a long chain nearly all.
    lattice = module("chain", "cf:cf4")
    start = states((4,))
    short = lattice.run(start, 0.1, 5).states
    tiled = lattice.run(np.tile(start, (1000, 1)), 0.1, 5).states
    assert np.array_equal(tiled, np.tile(short, (1000, 1)))


def test_large_angles_use_the_complete_functions():
    lattice = module("chain", "cf:cf4")
    result = lattice.run(states((5,)), 40.0, 3)
    assert result.ok
    assert np.abs(np.linalg.norm(result.states, axis=-1) - 1).max() < 1e-14


def test_a_failed_step_leaves_the_last_good_state():
    lattice = module("oscillators", "rk:rk4")
    start = states((5,), size=2)
    result = lattice.run(start, 1e150, 9)
    assert (result.status, result.ok) == (Status.NOT_FINITE, False)
    assert result.completed < 9
    assert np.isfinite(result.states).all()
    assert "not finite" in result.reason
    if result.completed == 0:
        assert np.array_equal(result.states, start)
    assert lattice.run(start, np.inf, 1).status == Status.BAD_STEP


def magnet(dimension, **options):
    """Return a spin lattice without damping whose field is the sum of parts with exact flows."""
    steps = [tuple(int(e == k) for e in range(dimension)) for k in range(dimension)]
    around = [neighbour(S, tuple(s * x for x in step)) for step in steps for s in (1, -1)]
    single = Matrix([0, 0, S[2] / 2 + Rational(1, 5)])
    sums = [S + neighbour(S, step) for step in steps]
    parts = {f"axis{k}": Pair(step, x, x) for k, (step, x) in enumerate(zip(steps, sums, strict=True))}
    given = {"f": sum(around, single), "parts": {**parts, "single": single}, "name": "magnet"}
    return site_scene(**(given | options))


def energy(spins):
    """Return the energy of a periodic magnet."""
    axes = range(spins.ndim - 1)
    pairs = sum((spins * np.roll(spins, 1, axis)).sum() for axis in axes)
    return -pairs - (spins[..., 2] ** 2 / 4 + spins[..., 2] / 5).sum()


OPEN = {"boundary": "open", "outside": [0, 0, 0]}


@pytest.mark.parametrize(
    ("options", "shape", "method", "order"),
    [
        ({}, (4,), "composition:triple_jump", 4),
        pytest.param({}, (4,), "splitting:strang", 2, marks=pytest.mark.slow),
        pytest.param({}, (4,), "splitting:lie_trotter", 1, marks=pytest.mark.slow),
        pytest.param({}, (2, 4), "splitting:blanes_moan4", 4, marks=pytest.mark.slow),
        pytest.param(OPEN, (5,), "splitting:strang", 2, marks=pytest.mark.slow),
        pytest.param(OPEN, (3, 5), "splitting:strang", 2, marks=pytest.mark.slow),
    ],
)
def test_splittings_have_their_order_and_turn_spins(options, shape, method, order):
    scene = magnet(len(shape), **options)
    lattice = load_lattice(emit(scene, method, target="c"))
    assert lattice.artifact.manifest["order"] == order
    start = states(shape)
    exact = load_lattice(emit(scene, "cf:cf4", target="c")).run(start, 1 / 1024, 1024).states
    errors = []
    for n in (64, 128):
        result = lattice.run(start, 1 / n, n)
        assert result.ok
        assert np.abs(np.linalg.norm(result.states, axis=-1) - 1).max() < 1e-13
        errors.append(np.abs(result.states - exact).max())
    assert order - 0.1 < np.log2(errors[0] / errors[1]) < order + 0.15
    # The largest angles of this step exceed one radian.
    assert np.abs(np.linalg.norm(lattice.run(start, 9.0, 5).states, axis=-1) - 1).max() < 1e-13


def test_pairs_alone_need_no_part_of_single_sites():
    pairs = {"bonds": Pair((1,), S + neighbour(S, (1,)), S + neighbour(S, (1,)))}
    scene = site_scene(f=neighbour(S, (1,)) + neighbour(S, (-1,)), parts=pairs, name="bonds")
    lattice, start = load_lattice(emit(scene, "splitting:strang", target="c")), states((6,))
    result = lattice.run(start, 0.05, 100)
    # The flow of a pair preserves the sum of its spins.
    assert np.abs(result.states.sum(axis=0) - start.sum(axis=0)).max() < 1e-13
    assert lattice.run(np.full((6, 3), 1e200), 0.05, 3).status == Status.NOT_FINITE
    with pytest.raises(ValueError, match="needs an even number"):
        lattice.run(states((5,)), 0.05, 1)


@pytest.mark.slow
def test_the_energy_of_a_splitting_is_bounded_and_spins_keep_their_length():
    lattice = load_lattice(emit(magnet(2), "splitting:strang", target="c"))
    spins = states((16, 16))
    first, errors = energy(spins), []
    for _ in range(100):
        spins = lattice.run(spins, 0.05, 1000).states
        errors.append(energy(spins) - first)
    changes = np.linalg.norm(spins, axis=-1) - 1
    # 1e5 steps: the error of the energy has no trend, and the lengths change by rounding errors only. The
    # changes are a random walk, so their mean square over all spins is tested. Its square root is 2.6e-14 to
    # 2.8e-14 for four initial states, and 3.7e-14 to 4.1e-14 if a rotation adds its small terms last.
    assert np.sqrt(np.mean(changes**2)) < 3.3e-14
    assert abs(changes.mean()) < 1e-14
    early, late = np.array(errors[:50]), np.array(errors[50:])
    assert np.abs(errors).max() < 0.02 * 256
    assert abs(late.mean() - early.mean()) < 3 * (late.std() + early.std())


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ({"single": S}, "the velocities of all parts do not add up to the velocity of the field f"),
        ({"single": S * S[0]}, "the velocities of all parts do not add up"),
        (
            {"single": Matrix([S[1], 0, 0])},
            "in the part single, generator 0 depends on the state y and is not constant along",
        ),
        (
            {"bonds": Pair((1,), neighbour(S, (1,)), S)},
            "in the part bonds, generator 0 depends on the state y and is not constant along",
        ),
        ({"bonds": Pair((-1,), S, S)}, r"the offset \(-1,\) of the part bonds"),
        (
            {"bonds": Pair((0, 1), S, S)},
            r"the offset \(0, 1\) of the part bonds; expected one entry for each",
        ),
        (
            {"bonds": Pair((1, 0), S, S)},
            r"the offset \(1, 0\) of the part bonds; expected one entry for each",
        ),
        ({"bonds": Pair((1,), S, [0])}, "has 1 components"),
        ({"single": [Symbol("t"), 0, 0]}, "the part single depends on t"),
        ({"single": neighbour(S, (1,))}, "has no value"),
    ],
)
def test_parts_without_exact_flows_are_refused(parts, message):
    with pytest.raises(SceneError, match=message):
        magnet(1, parts=parts)


def test_splittings_need_parts_and_an_autonomous_field():
    with pytest.raises(MethodError, match="a lattice without parts"):
        emit(chain(), "splitting:strang", target="c")


@pytest.mark.slow
def test_a_million_spins_run():
    lattice = module("plane", "cf:cf4")
    result = lattice.run(states((1000, 1000)), 0.05, 3)
    assert result.ok
    assert np.abs(np.linalg.norm(result.states, axis=-1) - 1).max() < 1e-14


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (np.zeros((0, 3)), r"expected an array of shape \(n1, 3\), found an array of shape \(0, 3\)"),
        (np.zeros((4, 2)), r"expected an array of shape \(n1, 3\)"),
        (np.zeros(3), r"expected an array of shape \(n1, 3\)"),
        ([[1, 2, 3], [4, 5]], "rows of different lengths"),
        (np.ones((1, 3)), r"the method cannot be used on a lattice of shape \(1,\)"),
        ([[1, 0, 0], [np.nan, 0, 0], [0, 0, 1]], r"found the state \[nan, 0.0, 0.0\] at site \(1,\)"),
    ],
)
def test_states_of_another_form_are_refused(given, message):
    with pytest.raises(ValueError, match=message):
        module("chain", "cf:cf4").run(given, 0.1, 1)


def test_states_that_are_not_real_numbers_are_refused():
    with pytest.raises(TypeError, match="expected real numbers"):
        module("chain", "cf:cf4").run(np.array([["a"] * 3] * 4), 0.1, 1)


def test_more_sites_than_memory_are_refused():
    import codegen.lattice as lattices

    class Short(lattices.CompiledLattice):
        def _call(self, *arguments):
            raise AssertionError("not reached")

    lattice = module("chain", "cf:cf4")
    narrow = object.__new__(Short)
    narrow.interface = type(lattice.interface)(**{**vars(lattice.interface), "workspace": 2**50})
    narrow.defaults = {}
    with pytest.raises(InputError, match="numbers for each site"):
        narrow.run(states((4,)), 0.1, 1)


def test_arguments_are_named_in_errors():
    lattice = module("chain", "cf:cf4")
    with pytest.raises(TypeError, match="unknown parameter nu"):
        lattice.run(states((4,)), 0.1, 1, nu=1.0)
    with pytest.raises(TypeError, match="steps"):
        lattice.run(states((4,)), 0.1, 1.5)


def test_parameters_are_arguments_at_run_time():
    free = load_lattice(emit(chain(), "cf:cf4", target="c", parameters=["K"]))
    fixed = module("chain", "cf:cf4")
    start = states((4,))
    assert np.array_equal(free.run(start, 0.1, 5).states, fixed.run(start, 0.1, 5).states)
    assert not np.allclose(free.run(start, 0.1, 5, K=2.0).states, fixed.run(start, 0.1, 5).states)


def site_scene(**options):
    given = {"group": chain().group, "action": chain().action, "y": S, "f": neighbour(S, (1,)), "y0": START}
    return SiteScene(**(given | {"span": (0, 1)} | options))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"f": S}, "a field that reads no neighbour"),
        ({"f": neighbour(S, (1,)) + neighbour(S, (1, 0))}, "offsets with different numbers of entries: 1, 2"),
        ({"f": 1}, "f is 1"),
        ({"boundary": "closed"}, "the boundary 'closed'"),
        ({"outside": [0, 0, 0]}, 'the argument "outside" is not allowed for a periodic lattice'),
        ({"boundary": "open"}, r"the boundary is open, but there is no state for the neighbour \(1,\)"),
        ({"boundary": "open", "outside": {(-1,): [0, 0, 0]}}, r"no state for the neighbour \(1,\)"),
        ({"boundary": "open", "outside": {(1,): S, (2,): S}}, r"the neighbour \(2,\), but the field"),
        ({"boundary": "open", "outside": [0, 0]}, "has 2 components"),
        ({"y0": [1, 1]}, "y0 has 2 components"),
        ({"invariants": {"first": S[0]}}, "the invariant first changes"),
    ],
)
def test_contradictory_scenes_are_refused(options, message):
    with pytest.raises(SceneError, match=message):
        site_scene(**options)


@pytest.mark.parametrize("offset", [(0,), (0, 0), (9,), (1.5,), "a", (), (1, 0, 0, 0, 0), 3])
def test_impossible_offsets_are_refused(offset):
    with pytest.raises(SceneError, match="a neighbour with the offset"):
        neighbour(S, offset)


def test_an_operation_without_code_for_lattices_is_refused(monkeypatch):
    # The operations of built-in families have such code. Here one of them is treated as unknown.
    monkeypatch.setattr("codegen.kernel.site_kernel.EVALUATED", ())
    with pytest.raises(MethodError, match="the operation field of cf:cf3 is not available on lattices"):
        emit(chain(), "cf:cf3", target="c")


def test_other_methods_and_targets_are_refused():
    with pytest.raises(MethodError, match="an error estimate is not available on a chain or lattice"):
        emit(chain(), "cf:cf43", target="c", adaptive=True)
    with pytest.raises(InputError, match="python has no code for chains and lattices"):
        emit(chain(), "cf:cf4", target="python")
    with pytest.raises(InputError, match="load_lattice"):
        load(emit(chain(), "cf:cf4", target="c"))
    with pytest.raises(InputError, match="expected a module for a chain or lattice"):
        load_lattice(emit("free_rigid_body", "cf:cf4", target="c"))
    with pytest.raises(SceneError, match="at least"):
        unrolled(chain(), (1,))
    with pytest.raises(SceneError, match="at most"):
        unrolled(chain(), (65,))


def test_explain_shows_the_loops_and_the_memory_traffic(tmp_path):
    answer = CliRunner().invoke(program, ["emit", "spin_lattice", "-m", "cf:cf4", "--explain"])
    assert answer.exit_code == 0
    assert "loop 4: f4 = field(Y4)" in answer.output
    assert "workspace: 18 numbers (144 bytes) for each site, plus padding" in answer.output
    assert "264 bytes read and 168 bytes written for each site and step" in answer.output


@pytest.mark.slow
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_loops_become_vector_instructions(tmp_path, compiler):
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is missing")
    artifact = emit(chain(), "cf:cf4", target="c")
    artifact.write(tmp_path)
    report = {"gcc": ["-fopt-info-vec-optimized"], "clang": ["-Rpass=loop-vectorize"]}[compiler]
    source = next(name for name in artifact.files if name.endswith(".c"))
    command = [compiler, *FLAGS, *VECTOR_FLAGS, *report, "-c", source, "-o", "out.o"]
    answer = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    found = {int(x.split(":")[1]) for x in answer.stderr.splitlines() if "vectorized" in x and source in x}
    lines = artifact.files[source].splitlines()
    loops = [k + 1 for k, x in enumerate(lines) if "i < number" in x]
    assert len(loops) == 4
    assert set(loops) <= found


def test_the_workspace_that_python_allocates_has_the_length_that_c_states():
    lattice = load_lattice(emit(chain(), "cf:cf4", target="c"))
    stated = getattr(lattice._library, f"{lattice.interface.prefix}workspace")
    for n in (1, 2, 7, 8, 9, 24, 25, 500, 512, 1000, 1024):
        length = lattice.interface.workspace_of(n)
        assert stated([n]) == length
        assert length >= lattice.interface.workspace * n
        assert length // lattice.interface.workspace % 16 == 8
