"""Implicit methods on chains and lattices: against the product of all sites, orders, failures."""

from __future__ import annotations

import subprocess
from functools import cache

import numpy as np
import pytest
from click.testing import CliRunner
from sympy import Matrix, sqrt, symbols

from codegen import emit, load_lattice
from codegen.arrival import Status
from codegen.build import compile_files
from codegen.errors import MethodError
from codegen.groups import LeftMultiplication, Rn
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.lower import lower, method_for, problem_for
from codegen.scene import SiteScene, left, param, right
from codegen.scene.unrolled import unrolled
from orderconds.cli import program
from tests.codegen.bodies import bodies, joined, springs
from tests.codegen.chains import chain, open_chain, open_plane, oscillators, plane
from tests.promises import sanitizes

SCENES = {
    "chain": chain,
    "open_chain": open_chain,
    "plane": plane,
    "open_plane": open_plane,
    "oscillators": oscillators,
}


@cache
def module(name, method):
    return load_lattice(emit(SCENES[name](), method, target="c"))


def states(shape, size=3):
    found = np.random.default_rng(1).normal(size=(*shape, size))
    return found / np.linalg.norm(found, axis=-1, keepdims=True)


def step_of_the_product(name, method, start, h, t=0.0):
    """Return a step of the unrolled program on the product of the groups of all sites."""
    whole = unrolled(SCENES[name](), start.shape[:-1])
    chosen = method_for(whole, method)
    lowered, problem = lower(whole, chosen), problem_for(whole, chosen)
    inputs = {"y": tuple(start.ravel().tolist())}
    inputs |= {"t": t} if any(v.name == "t" for v in lowered.inputs) else {}
    return np.reshape(interpret(lowered, problem, FloatDomain(h), inputs)["y"], start.shape)


@pytest.mark.parametrize(
    ("name", "method", "shape"),
    [
        ("oscillators", "rk:gauss1", (4,)),
        pytest.param("oscillators", "rk:crouzeix3", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "rkmk:gauss2", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "rkmk:gauss2", (2,), marks=pytest.mark.slow),
        pytest.param("chain", "rkmk:gauss3", (4,), marks=pytest.mark.slow),
        pytest.param("open_chain", "cf:gauss2", (4,), marks=pytest.mark.slow),
        pytest.param("open_chain", "cf:gauss2", (1,), marks=pytest.mark.slow),
        pytest.param("open_chain", "ambient:lobatto3a3", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "cg:kahan_triple_jump", (4,), marks=pytest.mark.slow),
        pytest.param("plane", "ambient:gauss1", (2, 3), marks=pytest.mark.slow),
        pytest.param("open_plane", "rkmk:radau2a2", (2, 2), marks=pytest.mark.slow),
        pytest.param("oscillators", "rk:gauss2", (1,), marks=pytest.mark.slow),
    ],
)
def test_an_implicit_step_is_the_step_of_the_product(name, method, shape):
    lattice = module(name, method)
    start = states(shape, lattice.interface.size)
    found = lattice.run(start, 0.1, 1, t=0.3)
    assert (found.status, found.completed) == (Status.OK, 1)
    expected = step_of_the_product(name, method, start, 0.1, 0.3)
    assert np.abs(found.states - expected).max() < 2e-14


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "method", "order"),
    [("chain", "rkmk:gauss2", 4), ("open_chain", "cf:gauss1", 2), ("oscillators", "rk:gauss2", 4)],
)
def test_the_order_is_seen_from_below_and_above(name, method, order):
    lattice = module(name, method)
    start = states((4,), lattice.interface.size)
    exact = module(name, "rkmk:gauss3").run(start, 1 / 256, 256, t=0.2).states
    errors = []
    for n in (16, 32):
        result = lattice.run(start, 1 / n, n, t=0.2)
        assert result.ok
        errors.append(np.abs(result.states - exact).max())
    assert order - 0.1 < np.log2(errors[0] / errors[1]) < order + 0.1


@pytest.mark.slow
def test_long_chains_repeat_the_bits_of_short_chains():
    # A short chain and its repetition have the same maxima, so they take the same number of sweeps.
    lattice, start = module("chain", "rkmk:gauss2"), states((4,))
    short = lattice.run(start, 0.1, 5).states
    tiled = lattice.run(np.tile(start, (1000, 1)), 0.1, 5).states
    assert np.array_equal(tiled, np.tile(short, (1000, 1)))


@pytest.mark.slow
def test_a_block_that_does_not_converge_leaves_the_last_good_state():
    lattice, start = module("open_chain", "cf:gauss2"), states((4,))
    result = lattice.run(start, 5.0, 3)
    assert (result.status, result.completed) == (Status.NOT_CONVERGED, 0)
    assert "did not converge" in result.reason
    assert np.array_equal(result.states, start)


def test_a_step_without_finite_numbers_is_reported():
    lattice, start = module("oscillators", "rk:gauss1"), states((3,), 2)
    result = lattice.run(start, 1e200, 3)
    assert (result.status, result.completed) == (Status.NOT_FINITE, 0)
    assert np.array_equal(result.states, start)


@pytest.mark.slow
def test_large_rotations_use_the_complete_functions():
    # The stages rotate spins by more than one radian, and the iteration still converges.
    lattice = load_lattice(emit(chain(), "rkmk:gauss1", target="c", parameters=["K"]))
    start = np.tile([0.0, 0.0, 1.0], (5, 1)) + 1e-3 * states((5,))
    start /= np.linalg.norm(start, axis=-1, keepdims=True)
    result = lattice.run(start, 0.5, 4, K=4.0)
    assert result.ok
    assert np.abs(np.linalg.norm(result.states, axis=-1) - 1).max() < 1e-14


def moving_bodies(number):
    """Return states of bodies with random frames and momenta, of shape (number, 12)."""
    random = np.random.default_rng(1)
    frames, _ = np.linalg.qr(random.normal(size=(number, 3, 3)))
    frames *= np.sign(np.linalg.det(frames))[:, None, None]
    return np.concatenate([frames.reshape(number, 9), random.normal(size=(number, 3))], axis=1)


@pytest.mark.slow
@pytest.mark.parametrize(
    "method",
    ["vcg:midpoint", "vcf:vcf4_s2", "vrkmk:gauss2", "vrkmk_pade(2):gauss2", "slgi:gauss2"],
)
def test_a_variational_step_is_the_step_of_the_product(method):
    lattice = load_lattice(emit(bodies(), method, target="c"))
    whole = joined(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    start, h = moving_bodies(4), 0.05
    found = lattice.run(start, h, 1)
    inputs = {"q": tuple(start[:, :9].ravel()), "mu": tuple(start[:, 9:].ravel())}
    end = interpret(lower(whole, method_for(whole, method)), whole, FloatDomain(h), inputs)
    expected = np.concatenate([np.reshape(end["q"], (4, 9)), np.reshape(end["mu"], (4, 3))], axis=1)
    assert np.abs(found.states - expected).max() < 2e-14


@pytest.mark.slow
def test_a_variational_method_conserves_the_momentum_of_a_free_chain():
    lattice = load_lattice(emit(springs(), "vcg:midpoint", target="c"))
    assert lattice.artifact.manifest["order"] == 2
    rest = moving_bodies(6)
    places = np.arange(18.0).reshape(6, 3) / 5
    start = np.concatenate([rest[:, :9], places, rest[:, 9:], rest[:, 9:] / 2], axis=1)
    result = lattice.run(start, 0.01, 300)
    assert result.ok
    moments = [x[:, 12:].sum(axis=0) for x in (start, result.states)]
    assert np.abs(moments[1] - moments[0]).max() < 1e-11
    assert np.abs(result.states[:, 12:] - start[:, 12:]).max() > 0.1


NEWTON = "simplified-newton"


def springs_in_a_row(**options):
    """Return a chain of points on a line with stiff springs."""
    y = Matrix(symbols("q p", real=True))
    force = 10**4 * (left(y)[0] - 2 * y[0] + right(y)[0])
    given = {"group": Rn(2), "action": LeftMultiplication(), "y": y, "f": [y[1], force], "y0": [1, 0]}
    return SiteScene(**(given | {"span": (0, 1), "name": "row"} | options))


OPEN_ROW = {"boundary": "open", "outside": {(-1,): [0, 0], (1,): Matrix(symbols("q p", real=True)) / 2}}


def midpoint_of_the_row(start, h, periodic):
    """Return a step of the midpoint rule by dense linear algebra."""
    n = len(start)
    second = -2 * np.eye(n)
    for i in range(n):
        for j in (i - 1, i + 1):
            if periodic or 0 <= j < n:
                second[i, j % n] += 1
    if not periodic:
        second[-1, -1] += 0.5
    A = np.block([[np.zeros((n, n)), np.eye(n)], [1e4 * second, np.zeros((n, n))]])
    unit = np.eye(2 * n)
    end = np.linalg.solve(unit - h / 2 * A, (unit + h / 2 * A) @ start.T.ravel())
    return end.reshape(2, n).T


@pytest.mark.parametrize(
    ("options", "numbers"),
    [(OPEN_ROW, (1, 2, 5)), pytest.param({}, (2, 3, 6), marks=pytest.mark.slow)],
    ids=["open", "periodic"],
)
def test_newtons_method_solves_stiff_chains(options, numbers):
    # Fixed-point iteration would multiply the error by about 1e4 in each sweep.
    lattice = load_lattice(emit(springs_in_a_row(**options), "rk:gauss1", target="c", solver=NEWTON))
    for n in numbers:
        start = states((n,), 2)
        result = lattice.run(start, 1.0, 1)
        expected = midpoint_of_the_row(start, 1.0, not options)
        assert (result.status, result.completed) == (Status.OK, 1)
        assert np.abs(result.states - expected).max() < 1e-11 * np.abs(expected).max()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "method", "shape"),
    [
        ("chain", "rkmk:gauss2", (4,)),
        ("chain", "rkmk:gauss2", (2,)),
        ("open_chain", "cf:gauss2", (4,)),
        ("open_chain", "rkmk:gauss1", (1,)),
        ("oscillators", "rk:crouzeix3", (4,)),
    ],
)
def test_newtons_method_has_the_solution_of_the_product(name, method, shape):
    lattice = load_lattice(emit(SCENES[name](), method, target="c", solver=NEWTON))
    start = states(shape, lattice.interface.size)
    for h in (0.1, 1.0):
        found = lattice.run(start, h, 1, t=0.3)
        expected = step_of_the_product(name, method, start, h, 0.3)
        assert found.ok
        assert np.abs(found.states - expected).max() < 2e-14


@pytest.mark.slow
def test_newtons_method_solves_variational_equations():
    newton = load_lattice(emit(bodies(), "vcg:midpoint", target="c", solver=NEWTON))
    fixed = load_lattice(emit(bodies(), "vcg:midpoint", target="c"))
    start = moving_bodies(6)
    found, expected = newton.run(start, 0.02, 5), fixed.run(start, 0.02, 5)
    assert found.ok
    assert np.abs(found.states - expected.states).max() < 1e-13


SANITIZED = """
#include "m.h"
#include <stdio.h>
#include <stdlib.h>
int main(void)
{
    int statuses[8] = {0};
    for (size_t n = 0; n < 7; n++) {
        for (int trial = 0; trial < 4; trial++) {
            const size_t shape[1] = {n}, room = m_workspace(shape);
            double *state = malloc((%(size)d * n + 1) * sizeof *state);
            double *work = malloc((room + 1) * sizeof *work);
            if (!state || !work) {
                return 1;
            }
            for (size_t i = 0; i < %(size)d * n; i++) {
                state[i] = trial == 3 ? 1e300 : 1.0 / (double)(1 + i);
            }
            size_t completed;
            const double h[4] = {0.1, -0.3, 1e9, 0.5};
            statuses[m_run(shape, state, %(time)s h[trial], 3, work, &completed) %% 8]++;
            free(state);
            free(work);
        }
    }
    printf("%%d", statuses[0]);
    return 0;
}
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "method", "options"),
    [
        ("oscillators", "rk:gauss2", {"solver": NEWTON}),
        ("chain", "rkmk:gauss1", {"solver": NEWTON}),
        ("open_chain", "cf:gauss1", {}),
        ("chain", "cf:cf4", {}),
    ],
)
def test_lattices_of_every_length_are_clean_under_sanitizers(compiler, name, method, options, tmp_path):
    if not sanitizes(compiler):
        pytest.skip(f"{compiler.command[0]} has no library for its sanitizers")
    artifact = emit(SCENES[name](), method, target="c", prefix="m", **options)
    interface = artifact.manifest["interface"]
    time = "0.0," if interface["time"] else ""
    files = {**artifact.files, "main.c": SANITIZED % {"size": interface["size"], "time": time}}
    flags = ("-std=c11", "-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    compile_files(files, tmp_path, tmp_path / "main", flags, compiler)
    answer = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=False, timeout=300)
    assert (answer.returncode, answer.stderr) == (0, "")
    assert int(answer.stdout) >= 8


def test_a_singular_matrix_is_reported():
    (y,) = symbols("q:1", real=True)
    c = param("c", 1)
    given = {"group": Rn(1), "action": LeftMultiplication(), "y": [y], "y0": [1], "span": (0, 1)}
    scene = SiteScene(f=[2 * y + c * left([y])[0]], boundary="open", outside=[0], **given)
    options = {"target": "c", "solver": NEWTON, "parameters": ["c"]}
    lattice = load_lattice(emit(scene, "rk:gauss1", **options))
    result = lattice.run([[1.0], [2.0]], 1.0, 1, c=0.0)
    assert (result.status, result.completed) == (Status.SINGULAR, 0)
    assert "the matrix of the equations" in result.reason
    assert lattice.run([[1.0], [2.0]], 0.5, 1, c=1.0).ok


@pytest.mark.parametrize("boundary", ["open", "periodic"])
def test_an_infinite_matrix_is_no_solution(boundary):
    (y,) = symbols("q:1", real=True)
    given = {"group": Rn(1), "action": LeftMultiplication(), "y": [y], "y0": [1], "span": (0, 1)}
    given |= {"outside": [0]} if boundary == "open" else {}
    scene = SiteScene(f=[1 + sqrt(y) + left([y])[0] / 10], boundary=boundary, **given)
    lattice = load_lattice(emit(scene, "rk:gauss1", target="c", solver=NEWTON))
    assert lattice.run([[1.0], [2.0], [3.0]], 0.1, 1).ok
    for place in range(3):
        states = [[float(k != place)] for k in range(3)]
        assert lattice.run(states, 0.1, 1).status is Status.NOT_FINITE


def test_other_solvers_are_refused():
    with pytest.raises(MethodError, match="expected the solver fixed-point, or simplified-newton"):
        emit(oscillators(), "rk:gauss1", target="c", solver="newton")
    with pytest.raises(MethodError, match="a chain whose field reads the nearest neighbours only"):
        emit(plane(), "rkmk:gauss1", target="c", solver=NEWTON)


def test_explain_shows_the_sweeps_that_are_repeated():
    answer = CliRunner().invoke(program, ["emit", "spin_lattice", "-m", "rkmk:gauss1", "--explain"])
    assert answer.exit_code == 0
    assert "loop 1: k0 = field(y); v1 = k0" in answer.output
    assert "loops 2 to 3 are repeated until the unknowns v1 converge at all sites" in answer.output
    assert "in each iteration for the equations of v1" in answer.output
    assert "the equations of v1: fixed point, 3 unknowns" in answer.output
