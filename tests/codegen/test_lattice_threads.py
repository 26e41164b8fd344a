"""Loops over the sites of a lattice on several processors: the same bits as on one processor."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from functools import cache

import cffi
import numpy as np
import pytest
from sympy import Matrix, eye, symbols

from codegen import emit, load_lattice
from codegen.arrival import Status
from codegen.build import Compiler, build
from codegen.emitter import compile_method
from codegen.groups import SO3, LeftMultiplication, Rn, Rotation
from codegen.ir.precision import DOUBLE
from codegen.lattice import CompiledLattice
from codegen.loader import LOOP_FLAGS
from codegen.printers.interface import Interface
from codegen.run.identifiers import identify
from codegen.run.language import Assign, Call, For, assigned, statements
from codegen.run.plan import Plan
from codegen.run.scope import declarations
from codegen.run.site_terms import CHUNK, MANY_SITES
from codegen.run.unit import unit_of
from codegen.scene import Pair, SiteScene, left, neighbour, right
from tests.codegen.bodies import open_bodies, string
from tests.codegen.chains import S, chain, open_chain, open_plane

REGION = {"gcc": b"GOMP_parallel", "clang": b"__kmpc_fork_call"}
"""The library function that starts the threads of a loop."""


@cache
def pairs(dimension, boundary="periodic"):
    """Return spins with the exact flows of their pairs, along all axes."""
    offsets = [tuple(int(e == k) for k in range(dimension)) for e in range(dimension)]
    bonds = [S + neighbour(S, o) for o in offsets]
    parts = {f"axis{k}": Pair(o, b, b) for k, (o, b) in enumerate(zip(offsets, bonds, strict=True))}
    field = sum((neighbour(S, tuple(-x for x in o)) for o in offsets), Matrix([0, 0, 0]))
    field += sum((neighbour(S, o) for o in offsets), Matrix([0, 0, 0]))
    outside = {"outside": [0, 0, 0]} if boundary == "open" else {}
    given = {"group": SO3(), "action": Rotation(), "y": S, "f": field, "y0": [1, 0, 0], "span": (0, 1)}
    return SiteScene(**given, parts=parts, boundary=boundary, **outside)


@cache
def row():
    """Return a periodic chain of points on a line with stiff springs."""
    y = Matrix(symbols("q p", real=True))
    force = 10**4 * (left(y)[0] - 2 * y[0] + right(y)[0])
    given = {"group": Rn(2), "action": LeftMultiplication(), "y": y, "f": [y[1], force], "y0": [1, 0]}
    return SiteScene(**given, span=(0, 1))


def library(artifact, compiler, *flags):
    """Return a module that is compiled with further flags, and the path of its library."""
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is missing")
    path = build(artifact.files, (*LOOP_FLAGS, *flags), Compiler((compiler,), compiler))
    # After a loop, threads of clang's OpenMP wait in the code of their library, so the library must stay
    # loaded. ctypes never unloads a library.
    ctypes.CDLL(str(path))
    interface = Interface.from_json(artifact.manifest["interface"])
    return CompiledLattice(interface, artifact.manifest["defaults"], path), path


def require_openmp(compiler, folder):
    """Skip the test if a compiler cannot link a program that uses OpenMP."""
    source = folder / "probe.c"
    source.write_text("#include <omp.h>\nint main(void) { return omp_get_max_threads() < 1; }\n")
    command = [compiler, "-fopenmp", str(source), "-o", str(folder / "probe")]
    if shutil.which(compiler) is None or subprocess.run(command, capture_output=True, check=False).returncode:
        pytest.skip(f"{compiler} has no OpenMP")


def states(shape, size):
    """Return random states of all sites; frames of bodies are the identity."""
    found = np.random.default_rng(3).normal(size=(*shape, size))
    if size == 12:
        found[..., :9] = np.array(eye(3), float).ravel()
    return found / np.linalg.norm(found, axis=-1, keepdims=True) if size == 3 else found


PERIOD = 6
LONG = (PERIOD * ((3 * MANY_SITES + CHUNK // 2) // PERIOD),)
assert LONG[0] % CHUNK
assert CHUNK % PERIOD
CASES = [
    pytest.param(chain, "cf:cf4", LONG, 0.1, {}, id="chain"),
    pytest.param(open_chain, "rkmk:rk4", LONG, 0.1, {}, id="open chain"),
    # The rotations have more than one radian, so each site is computed alone.
    pytest.param(chain, "cf:cf4", LONG, 3.0, {}, id="large rotations"),
    pytest.param(open_plane, "cf:cf4", (70, 83), 0.1, {}, id="open plane"),
    pytest.param(lambda: pairs(1), "splitting:strang", LONG, 0.1, {}, id="pairs of a chain"),
    pytest.param(lambda: pairs(1, "open"), "splitting:strang", LONG, 0.1, {}, id="pairs of an open chain"),
    pytest.param(lambda: pairs(2), "splitting:strang", (70, 84), 0.1, {}, id="pairs of a plane"),
    pytest.param(lambda: pairs(3), "splitting:strang", (18, 16, 20), 2.0, {}, id="pairs of a cube"),
    pytest.param(chain, "rkmk:gauss2", LONG, 0.1, {}, id="fixed point"),
    pytest.param(open_bodies, "vcg:midpoint", LONG, 0.02, {}, id="variational"),
    pytest.param(open_bodies, "splitting:strang", LONG, 0.1, {}, id="kicks"),
    pytest.param(string, "discrete_gradient:midpoint", LONG, 0.1, {}, id="sums over all sites"),
    pytest.param(open_chain, "taylor(4)", LONG, 0.1, {}, id="Taylor"),
    pytest.param(row, "rk:gauss1", LONG, 0.1, {"solver": "simplified-newton"}, id="Newton"),
]
SLOW_CASES = [pytest.param(*case.values, id=case.id, marks=pytest.mark.slow) for case in CASES[1:]]


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize(("scene", "method", "shape", "h", "options"), [CASES[0], *SLOW_CASES])
def test_two_threads_compute_the_bits_of_one(scene, method, shape, h, options, compiler, tmp_path):
    require_openmp(compiler, tmp_path)
    artifact = emit(scene(), method, target="c", **options)
    alone, without = library(artifact, compiler)
    shared, path = library(artifact, compiler, "-fopenmp")
    assert REGION[compiler] in path.read_bytes()
    assert REGION[compiler] not in without.read_bytes()
    start = states(shape, alone.interface.size)
    expected = alone.run(start, h, 3)
    assert expected.status == Status.OK
    assert np.abs(expected.states - start).max() > 1e-3
    ffi = cffi.FFI()
    ffi.cdef("void omp_set_num_threads(int); int omp_get_max_threads(void);")
    openmp = ffi.dlopen(str(path))
    for threads in (1, 2, 3):
        openmp.omp_set_num_threads(threads)
        assert openmp.omp_get_max_threads() == threads
        for _ in range(3):
            found = shared.run(start, h, 3)
            assert (found.status, found.completed) == (expected.status, 3)
            assert found.states.tobytes() == expected.states.tobytes()


PERIODIC = [
    pytest.param(chain, "cf:cf4", 0.1, {}, id="chain"),
    pytest.param(chain, "cf:cf4", 3.0, {}, id="large rotations", marks=pytest.mark.slow),
    pytest.param(lambda: pairs(1), "splitting:strang", 0.1, {}, id="pairs"),
    pytest.param(lambda: pairs(1), "splitting:strang", 3.0, {}, id="large pairs", marks=pytest.mark.slow),
    pytest.param(chain, "rkmk:gauss2", 0.1, {}, id="fixed point", marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("scene", "method", "h", "options"), PERIODIC)
def test_states_with_a_period_keep_it_in_a_long_chain(scene, method, h, options):
    # The short chain has fewer sites than a chunk, and the limits of chunks are no multiples of the period.
    lattice = load_lattice(emit(scene(), method, target="c", **options))
    start = states((PERIOD,), lattice.interface.size)
    expected = lattice.run(start, h, 3)
    found = lattice.run(np.tile(start, (LONG[0] // PERIOD, 1)), h, 3)
    assert found.ok
    assert found.states.tobytes() == np.tile(expected.states, (LONG[0] // PERIOD, 1)).tobytes()


@pytest.mark.parametrize(
    ("scene", "method", "options"),
    [
        *(pytest.param(*(case.values[k] for k in (0, 1, 4)), id=case.id) for case in CASES[:1]),
        *(
            pytest.param(*(case.values[k] for k in (0, 1, 4)), id=case.id, marks=pytest.mark.slow)
            for case in CASES[1:]
        ),
    ],
)
def test_a_parallel_loop_changes_only_its_own_scalars_and_its_reductions(scene, method, options):
    unit = unit_of(Plan(compile_method(scene(), method, **options).kernel, DOUBLE))
    names, count = identify(unit, ()), 0
    for function in unit.functions:
        declared = declarations(function, names[function.name])
        for loop in statements(function.body):
            if not isinstance(loop, For) or not loop.parallel:
                continue
            count += 1
            inner = list(statements(loop.body))
            private = {n for s in inner for n, _ in declared.before.get(id(s), [])}
            private |= {n for s in inner for n in declared.by.get(id(s), {})}
            private |= {names[function.name].of(s.index) for s in inner if isinstance(s, For)}
            changed = {
                names[function.name].of(target)
                for s in inner
                if isinstance(s, Assign | Call)
                for target in assigned(s)
                if target.op == "name"
            }
            assert changed - private == {names[function.name].of(x) for _, x in loop.reductions}
    assert count > 1


@pytest.mark.parametrize(
    ("method", "size"), [("cf:cf4", 3), pytest.param("rkmk:gauss2", 3, marks=pytest.mark.slow)]
)
def test_a_failure_at_any_site_is_found_by_all_threads(method, size, tmp_path):
    require_openmp("gcc", tmp_path)
    shared, path = library(emit(chain(), method, target="c"), "gcc", "-fopenmp")
    ffi = cffi.FFI()
    ffi.cdef("void omp_set_num_threads(int);")
    ffi.dlopen(str(path)).omp_set_num_threads(2)
    for site in (0, LONG[0] // 3, LONG[0] - 1):
        start = states(LONG, size)
        start[site] = 1e300
        found = shared.run(start, 0.1, 2)
        assert (found.status, found.completed) == (Status.NOT_FINITE, 0)
        assert found.states.tobytes() == start.tobytes()
