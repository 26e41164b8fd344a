"""Batches of systems: each system of a batch makes the steps of the scalar module, whatever the others do."""

from __future__ import annotations

import re
import shutil
import subprocess
from fractions import Fraction

import numpy as np
import pytest

import codegen
from codegen.build import build, find_compiler
from codegen.integrator import Status, StepFailed
from codegen.printers.c.module import FLAGS, VECTOR_FLAGS
from codegen.run.batch import BLOCK, LANES
from orderconds.errors import InputError

MANY = BLOCK + 3
"""Systems in two blocks, the second of which is not full."""

CASES = (
    ("driven_spin", "cf:cf4", ("nu", "b")),
    ("free_rigid_body", "rkmk(2):rk4", ()),
    ("heavy_top", "cg:cg3", ()),
    ("driven_spin", "cg:cg5", ("b",)),  # a scalar module of this method has functions of its own
    ("linear_oscillator", "rk:rk4", ("alpha",)),
    ("dipole", "vcg:midpoint", ()),
    ("dipole", "composition:mclachlan4", ()),
    ("free_rigid_body", "taylor(8)", ()),
)
"""Explicit and implicit methods, with and without time, parameters and flows."""

GALLERY = pytest.mark.parametrize(("scene", "method", "parameters"), CASES)


INPUTS = ("u0", "u2")


def emitted(scene, method, parameters=(), target="c", batch=True, **options):
    return codegen.emit(scene, method, target=target, parameters=parameters, batch=batch, **options)


def starts(integrator, count, seed=1):
    """Return states that differ a little from the initial state of the scene."""
    random = np.random.default_rng(seed)
    return np.array(integrator.initial) * (1 + 0.01 * random.normal(size=(count, integrator.interface.size)))


def alone(integrator, state, h, steps, values):
    """Return the status, the number of completed steps and the last state of a scalar run."""
    try:
        return Status.OK, steps, integrator.run(state, h, steps, **values)
    except StepFailed as failure:
        return failure.status, failure.step, failure.state


def values_of(integrator, count, seed=2):
    random = np.random.default_rng(seed)
    return {name: random.uniform(0.5, 2.0, count) for name in integrator.interface.parameters}


@GALLERY
def test_each_system_has_the_roundings_of_the_scalar_run(scene, method, parameters):
    integrator = codegen.load(emitted(scene, method, parameters))
    states, values = starts(integrator, MANY), values_of(integrator, MANY)
    result = integrator.run_batch(states, 0.02, 7, t=0.5, **values)
    assert result.ok
    assert (result.completed == 7).all()
    for k in range(MANY):
        own = {name: x[k] for name, x in values.items()}
        assert (integrator.run(states[k], 0.02, 7, t=0.5, **own) == result.states[k]).all()


@GALLERY
def test_a_system_that_fails_reports_its_status_and_disturbs_no_other(scene, method, parameters):
    integrator = codegen.load(emitted(scene, method, parameters))
    states, values = starts(integrator, MANY), values_of(integrator, MANY)
    whole = integrator.run_batch(states, 0.02, 5, **values)
    bad = {2: np.nan, 40: 1e200, MANY - 1: np.inf}
    for k, x in bad.items():
        states[k, 0] = x
    result = integrator.run_batch(states, 0.02, 5, **values)
    others = [k for k in range(MANY) if k not in bad]
    assert (result.states[others] == whole.states[others]).all()
    assert not result.statuses[others].any()
    for k in bad:
        own = {name: x[k] for name, x in values.items()}
        status, completed, last = alone(integrator, states[k], 0.02, 5, own)
        assert (result.statuses[k], result.completed[k]) == (status, completed)
        assert np.array_equal(result.states[k], last, equal_nan=True)
    assert result.statuses[2] == Status.NOT_FINITE


def test_a_system_with_a_large_angle_is_stepped_by_the_scalar_code():
    integrator = codegen.load(emitted("free_rigid_body", "cf:cf4"))
    states = np.array([[0.6, 0.0, 0.8], [60.0, 0.0, 80.0]])
    result = integrator.run_batch(states, 0.05, 3)
    assert result.ok
    for k in range(2):
        assert (integrator.run(states[k], 0.05, 3) == result.states[k]).all()


def test_a_parameter_with_which_a_system_fails_is_that_system_s_own():
    integrator = codegen.load(emitted("driven_spin", "cf:cf4", ("b",)))
    states = np.array([[0.6, 0.0, 0.8]] * 3)
    huge = np.array([0.2, 1e160, 0.2])
    result = integrator.run_batch(states, 0.1, 4, b=huge)
    assert list(result.statuses) == [Status.OK, result.statuses[1], Status.OK]
    assert result.statuses[1] != Status.OK
    assert (result.states[1] == states[1]).all()


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_module_without_a_batch_steps_one_system_after_another(target):
    plain = codegen.load(emitted("driven_spin", "cf:cf4", ("nu",), target=target, batch=False))
    states, values = starts(plain, 3), {"nu": [1.0, 2.0, 3.0]}
    states[1, 0] = np.nan
    result = plain.run_batch(states, 0.1, 4, **values)
    assert list(result.completed) == [4, 0, 4]
    assert result.statuses[1] == Status.NOT_FINITE
    assert (result.states[2] == plain.run(states[2], 0.1, 4, nu=3.0)).all()


def test_run_time_inputs_are_constant_in_a_batch():
    integrator = codegen.load(emitted("actuated_rigid_body", "cf:cf4", inputs=INPUTS))
    states = starts(integrator, 3)
    held = np.array([[0.1, 0.2, 0.3], [0.0, 0.0, 0.0], [1.0, -1.0, 0.5]])[:, : len(INPUTS)]
    result = integrator.run_batch(states, 0.05, 4, inputs=held)
    for k in range(3):
        assert (integrator.run(states[k], 0.05, 4, inputs=lambda t, k=k: held[k]) == result.states[k]).all()


def test_a_batch_in_place_is_not_copied():
    integrator = codegen.load(emitted("free_rigid_body", "cf:cf4"))
    given = np.asfortranarray(starts(integrator, 5))
    expected = integrator.run_batch(given, 0.1, 3).states
    result = integrator.run_batch(given, 0.1, 3, out=given)
    assert np.shares_memory(result.states, given)
    assert (given == expected).all()


def test_an_array_with_misaligned_numbers_is_refused():
    integrator = codegen.load(emitted("free_rigid_body", "cf:cf4"))
    given = starts(integrator, 5)
    shifted = np.zeros(given.nbytes + 1, np.uint8)[1:].view(float).reshape(3, 5).T
    with pytest.raises(ValueError, match="expected a writeable, aligned array in Fortran order"):
        integrator.run_batch(given, 0.1, 3, out=shifted)


def test_wrong_inputs_of_a_batch_have_a_message():
    integrator = codegen.load(emitted("actuated_rigid_body", "cf:cf4", inputs=INPUTS))
    states = starts(integrator, 2)
    with pytest.raises(ValueError, match="expected an array of inputs, found rows of different lengths"):
        integrator.run_batch(states, 0.05, 4, inputs=[[1.0, 2.0], [1.0]])
    with pytest.raises(TypeError, match="expected real numbers"):
        integrator.run_batch(states, 0.05, 4, inputs=[1j, 0])


def test_single_precision_has_batches():
    integrator = codegen.load(emitted("driven_spin", "cf:cf4", precision="single"))
    states = starts(integrator, 3)
    result = integrator.run_batch(states, 0.1, 3)
    assert result.states.dtype == np.float32
    for k in range(3):
        assert (np.float32(integrator.run(states[k], 0.1, 3)) == result.states[k]).all()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"states": np.empty((0, 3))}, "array of N states"),
        ({"states": [1.0, 0.0, 0.0]}, r"found an array of shape \(3,\)"),
        ({"states": np.zeros((4, 2))}, r"3 numbers each, found arrays of shape \(4, 2\)"),
        ({"states": np.zeros((4, 3), complex)}, "expected real numbers"),
        ({"states": [[1.0, 0.0], [1.0]]}, "different lengths"),
        ({"h": "0.1"}, "expected a real number for h"),
        ({"steps": -1}, "expected steps to be at least 0"),
        ({"nu": [1.0, 2.0]}, "expected one number or 4 numbers for nu"),
        ({"mass": 1.0}, "unknown parameter mass"),
        ({"inputs": [1.0]}, "expected no inputs"),
        ({"out": np.zeros((4, 3))}, "Fortran order"),
        ({"out": np.zeros((4, 3), np.float32, order="F")}, "type float64 for out"),
        ({"out": np.zeros((5, 3), order="F")}, "expected 4 states in the argument out, found 5"),
    ],
)
def test_wrong_arguments_have_one_message(arguments, message):
    integrator = codegen.load(emitted("driven_spin", "cf:cf4", ("nu",)))
    given = {"states": np.ones((4, 3)), "h": 0.1, "steps": 2} | arguments
    with pytest.raises((TypeError, ValueError), match=message):
        integrator.run_batch(**given)


def test_an_infinite_step_changes_no_system():
    integrator = codegen.load(emitted("driven_spin", "cf:cf4"))
    states = starts(integrator, 3)
    result = integrator.run_batch(states, np.inf, 2)
    assert list(result.statuses) == [Status.BAD_STEP] * 3
    assert (result.states == states).all()


def test_a_python_module_has_no_batch():
    with pytest.raises(InputError, match=r"the target python has no code for batches; .*; add target c"):
        emitted("driven_spin", "cf:cf4", target="python")


@pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc reports the loops that it vectorises")
@pytest.mark.parametrize(
    ("scene", "method", "parameters", "given"),
    [
        # A case without parameters is the same module twice.
        pytest.param(*case, given, marks=() if given == bool(case[2]) or not k else pytest.mark.slow)
        for k, case in enumerate(CASES[:5])
        for given in (False, True)
    ],
)
def test_the_loop_over_systems_is_vectorised(scene, method, parameters, given, tmp_path):
    artifact = emitted(scene, method, parameters if given else ())
    name = next(n for n in artifact.files if n.endswith(".c"))
    for file, text in artifact.files.items():
        (tmp_path / file).write_text(text)
    lines = artifact.files[name].splitlines()
    begin = next(k for k, line in enumerate(lines, 1) if "_INDEPENDENT" in line and "#" not in line)
    flags = ("-std=c11", *VECTOR_FLAGS, "-ffp-contract=off", "-fopt-info-vec-optimized")
    done = subprocess.run(
        ["gcc", *flags, "-c", name, "-o", "x.o"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    vectorised = {int(n) for n in re.findall(r":(\d+):\d+: optimized:\s+loop vectorized", done.stderr)}
    assert begin + 1 in vectorised


def test_the_text_contains_no_number_of_systems_and_no_call_in_the_loop():
    artifact = emitted("driven_spin", "cf:cf4", ("nu",))
    text = next(t for n, t in artifact.files.items() if n.endswith(".c"))
    body = text[text.index(f"{LANES}(") :]
    body = body[: body.index("\n}\n")]
    called = set(re.findall(r"([a-z_0-9]+)\(", body)) - {"for"}
    assert {name.removeprefix("driven_spin_cf4_") for name in called} == {
        LANES,
        "sin_near",
        "cos_near",
        "stumpff_12_near",
    }


@pytest.mark.parametrize(("precision", "most"), [("double", 2.0), ("single", 2.0)])
def test_sine_and_cosine_without_branches_have_an_error_of_two_ulp(precision, most, tmp_path):
    from flint import arb, ctx

    from codegen.ir.precision import precision as known
    from codegen.snippets.graph import needed
    from codegen.snippets.lane_angles import LARGEST

    form = known(precision)
    kind = np.float64 if precision == "double" else np.float32
    texts = needed("c", ["sin_near", "cos_near"], form, batch=True).texts
    loop = "".join(
        f"void many_{n}(size_t n, const {form.c_type} *x, {form.c_type} *y)\n"
        f"{{ for (size_t i = 0; i < n; i++) y[i] = {n}_near(x[i]); }}\n"
        for n in ("sin", "cos")
    )
    (tmp_path / "a.c").write_text("#include <math.h>\n#include <stddef.h>\n" + "\n".join(texts) + loop)
    subprocess.run(
        [
            *find_compiler().command,
            "-std=c11",
            "-O3",
            "-ffp-contract=off",
            "-shared",
            "-fPIC",
            "a.c",
            "-o",
            "a.so",
            "-lm",
        ],
        cwd=tmp_path,
        check=True,
    )
    from cffi import FFI

    ffi = FFI()
    ffi.cdef(
        f"void many_sin(size_t n, const {form.c_type} *x, {form.c_type} *y);"
        f"void many_cos(size_t n, const {form.c_type} *x, {form.c_type} *y);"
    )
    library = ffi.dlopen(str(tmp_path / "a.so"))
    largest = float(LARGEST[form.bits])
    random = np.random.default_rng(5)
    samples = [random.uniform(-largest, largest, 500), random.normal(size=500)]
    # The worst arguments are close to multiples of pi/2, where all leading digits cancel.
    samples.append(np.arange(1, 400) * (np.pi / 2))
    samples.append(random.integers(1, int(largest / 1.6), 500) * (np.pi / 2))
    samples.append(np.array([0.0, 1e-300 if precision == "double" else 1e-30, largest, -largest]))
    x = np.ascontiguousarray(np.concatenate(samples).astype(kind))
    x = x[np.abs(x) <= largest]
    for name in ("sin", "cos"):
        y = np.empty_like(x)
        getattr(library, f"many_{name}")(
            len(x), ffi.cast(f"{form.c_type} *", x.ctypes.data), ffi.cast(f"{form.c_type} *", y.ctypes.data)
        )
        with ctx.workprec(400):
            for a, b in zip(x.tolist(), y, strict=True):
                exact = getattr(arb(Fraction(a).numerator) / Fraction(a).denominator, name)()
                unit = float(np.spacing(np.abs(b)))
                assert abs(float((exact - arb(float(b))).mid())) <= most * unit, (name, a)
    outside = np.array([2 * largest, np.inf, np.nan], kind)
    y = np.empty_like(outside)
    library.many_sin(
        3, ffi.cast(f"{form.c_type} *", outside.ctypes.data), ffi.cast(f"{form.c_type} *", y.ctypes.data)
    )
    assert np.isnan(y).all()


def test_a_batch_compiles_under_the_flags_of_the_project():
    artifact = emitted("driven_spin", "cf:cf4", ("nu",))
    assert build(artifact.files, FLAGS).exists()


def test_a_batch_of_a_scene_with_a_table_makes_the_steps_of_the_scalar_module(tmp_path):
    path = tmp_path / "thrust.py"
    path.write_text(
        "from sympy import Matrix, Symbol, symbols\n"
        "from codegen.groups import SO3, Rotation\n"
        "from codegen.scene import FieldScene, table\n"
        "t, m = Symbol('t'), Matrix(symbols('x y z', real=True))\n"
        "a, b = table([0, 1, 2], [0, 1, -1], t, 'linear'), table([-1, 0, 1], [1, 0, 2], m[2])\n"
        "f = Matrix([a, m[0] * b, 1])\n"
        "y0 = Matrix([1, 0, 0])\n"
        "scene = FieldScene(group=SO3(), action=Rotation(), y=m, f=f, y0=y0, span=(0, 2))\n"
    )
    integrator = codegen.load(emitted(str(path), "cf:cf4"))
    states = starts(integrator, 5)
    batch = integrator.run_batch(states, 0.1, 7, t=0.0)
    for before, after in zip(states, batch.states, strict=True):
        assert after.tolist() == list(integrator.run(before, 0.1, 7, 0.0))
