"""What every emitted module promises, on hand-made kernels."""

from __future__ import annotations

import math
import os
import re
import shutil
import subprocess
import sys
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from sympy import Matrix, cos, exp, sin, symbols

from codegen.build import CompileError, Compiler, build, compile_files
from codegen.emitter import emit
from codegen.groups import SO3, LeftMultiplication, Rn, Rotation
from codegen.integrator import Statistics, Status, StepFailed
from codegen.loader import load
from codegen.prefix import prefix_of
from codegen.printers.c.module import FLAGS
from codegen.scene import FieldScene, param
from orderconds.errors import InputError
from tests.promises import sanitizes

GOLDEN = Path(__file__).parents[1] / "golden"
ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("name", ["rigid", "pendulum", "powers", "single"])
def test_emitted_code_agrees_with_the_interpreter(kernels, check_codegen, name):
    kernel = getattr(kernels, name)()

    def step(state, h, t):
        symbols = [s for f in kernel.state for s in f.symbols]
        return kernels.interpret(
            kernel, {**dict(zip(symbols, state, strict=True)), "h": h, "t": t, "lambda": 2.0}
        )

    c, python = (kernels.emission(kernel, target) for target in ("c", "python"))
    check_codegen(c, python, step, kernels.STATES[name], 0.125)


@pytest.mark.parametrize("name", ["pendulum", "powers"])
def test_c_and_python_and_the_interpreter_agree_to_the_last_bit_without_stumpff(kernels, name):
    kernel, state = getattr(kernels, name)(), kernels.STATES[name]
    symbols = [s for f in kernel.state for s in f.symbols]
    values = {**dict(zip(symbols, state, strict=True)), "h": 0.125, "t": 0.5, "lambda": 2.0}
    expected = list(kernels.interpret(kernel, values))
    for target in ("c", "python"):
        assert load(kernels.emission(kernel, target)).step(list(state), 0.125, 0.5) == expected


def test_compiled_runs_equal_stepping(kernels):
    for target in ("c", "python"):
        integrator = load(kernels.emission(kernels.pendulum(), target))
        state = [0.5, 0.25]
        for k in range(10):
            state = integrator.step(state, 0.125, 1.0 + k * 0.125)
        assert integrator.run([0.5, 0.25], 0.125, 10, 1.0) == state
        rows = integrator.trajectory([0.5, 0.25], 0.125, 10, stride=5, t=1.0)
        assert len(rows) == 3
        assert rows[0] == [0.5, 0.25]
        assert rows[2] == state


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_numpy_state_is_answered_by_a_numpy_state_and_left_alone(kernels, target):
    integrator = load(kernels.emission(kernels.rigid(), target))
    state = np.array([0.4, -0.3, 0.9])
    after = integrator.run(state, 0.1, 3)
    assert isinstance(after, np.ndarray)
    assert state.tolist() == [0.4, -0.3, 0.9]
    assert integrator.trajectory(state, 0.1, 3).shape == (4, 3)


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("h", [math.nan, math.inf])
def test_a_step_size_that_is_no_number_is_refused(kernels, target, h):
    integrator = load(kernels.emission(kernels.rigid(), target))
    with pytest.raises(StepFailed) as failure:
        integrator.run([0.4, -0.3, 0.9], h, 5)
    assert failure.value.status == Status.BAD_STEP
    assert failure.value.step == 0
    assert list(failure.value.state) == [0.4, -0.3, 0.9]


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_state_that_leaves_the_numbers_stops_the_run_at_the_last_good_one(kernels, target):
    integrator = load(kernels.emission(kernels.powers(), target))
    good = [1.25, 0.5]
    made = 0
    while True:
        try:
            good = integrator.step(good, 0.125)
        except StepFailed:
            break
        made += 1
    assert 0 < made < 100
    with pytest.raises(StepFailed) as failure:
        integrator.run([1.25, 0.5], 0.125, 100)
    assert failure.value.status == Status.NOT_FINITE
    assert failure.value.step == made
    assert list(failure.value.state) == good


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_block_that_does_not_converge_is_named(kernels, target):
    integrator = load(kernels.emission(kernels.pendulum(limit=3), target))
    statistics = Statistics()
    with pytest.raises(StepFailed, match="step 1: stage 1 did not converge") as failure:
        integrator.run([0.5, 0.25], 0.5, 5, statistics=statistics)
    assert failure.value.status == Status.NOT_CONVERGED
    assert list(failure.value.state) == [0.5, 0.25]
    assert (statistics.sweeps, statistics.most, statistics.failed) == ([3], 3, 1)


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_block_that_leaves_the_numbers_is_named(kernels, target):
    integrator = load(kernels.emission(kernels.pendulum(), target))
    with pytest.raises(StepFailed, match="not finite") as failure:
        integrator.run([math.inf, 0.25], 0.5, 5)
    assert failure.value.status == Status.NOT_FINITE


FAILURES = """
#include "pendulum.h"
#include <math.h>
#include <stdio.h>

/* Everything that a caller may leave out or that may go wrong, with buffers of exactly the size asked for. */
int main(void)
{
    double state[2] = {0.5, 0.25};
    double rows[2 * 3];
    pendulum_statistics statistics = {{0}, 0, 0};
    size_t completed = 99;
    if (pendulum_run(state, 0.0, 0.5, 5, 2.0, rows, 2, &statistics, &completed) != PENDULUM_OK) return 1;
    if (completed != 5 || statistics.sweeps[0] < 5 || rows[4] == rows[0]) return 2;
    if (pendulum_run(state, 0.0, 0.5, 5, 2.0, NULL, 0, NULL, NULL) != PENDULUM_OK) return 3;
    if (pendulum_run(state, 0.0, 0.5, 5, 2.0, rows, 0, NULL, NULL) != PENDULUM_OK) return 4;
    const double before = state[0];
    if (pendulum_run(state, 0.0, NAN, 5, 2.0, rows, 1, NULL, &completed) != PENDULUM_BAD_STEP) return 5;
    if (completed != 0 || state[0] != before) return 6;
    if (pendulum_step(state, 0.0, 50.0, 2.0, &statistics) != PENDULUM_NOT_CONVERGED) return 7;
    if (statistics.failed != 1 || statistics.most != 100 || state[0] != before) return 8;
    if (pendulum_step(state, 0.0, 0.5, INFINITY, NULL) != PENDULUM_NOT_FINITE) return 9;
    if (state[0] != before) return 10;
    return 0;
}
"""


def test_failures_and_absent_arguments_are_clean_under_the_sanitizers(kernels, compiler: Compiler, tmp_path):
    files = {**kernels.emission(kernels.pendulum(), "c").files, "failures.c": FAILURES}
    if not sanitizes(compiler):
        pytest.skip(f"{compiler.command[0]} has no library for its sanitizers")
    compile_files(files, tmp_path, tmp_path / "failures", kernels.SANITIZE, compiler)
    answer = subprocess.run([tmp_path / "failures"], capture_output=True, text=True, check=False)
    assert (answer.returncode, answer.stderr) == (0, "")


def test_a_negative_number_of_steps_is_refused(kernels):
    for target in ("c", "python"):
        with pytest.raises(ValueError, match=r"no negative number of steps|steps to be at least 0"):
            load(kernels.emission(kernels.rigid(), target)).run([0.4, -0.3, 0.9], 0.1, -1)
    with pytest.raises(ValueError, match=r"no negative number of steps|steps to be at least 0"):
        load(kernels.emission(kernels.rigid(), "python")).module.run([0.4, -0.3, 0.9], 0.1, -1)


def test_a_number_of_steps_that_is_no_integer_is_refused(kernels):
    run = load(kernels.emission(kernels.rigid(), "python")).module.run
    for steps in (2.5, 3.0, math.nan, "3", None):
        with pytest.raises(TypeError, match="expected an integer for steps, found"):
            run([0.4, -0.3, 0.9], 0.1, steps)
    assert run([0.4, -0.3, 0.9], 0.1, np.int64(3)) == run([0.4, -0.3, 0.9], 0.1, 3)


def test_statistics_of_c_and_python_are_equal_and_add_up(kernels):
    counts = []
    for target in ("c", "python"):
        statistics = Statistics()
        integrator = load(kernels.emission(kernels.pendulum(), target))
        for _ in range(2):
            integrator.run([0.5, 0.25], 0.125, 4, statistics=statistics)
        counts.append(statistics)
    assert counts[0] == counts[1]
    assert counts[0].sweeps[0] > 8


def test_parameters_replace_the_scenes_values(kernels):
    for target in ("c", "python"):
        integrator = load(kernels.emission(kernels.pendulum(), target))
        state = [0.5, 0.25]
        assert integrator.step(state, 0.1, **{"lambda": 2.0}) == integrator.step(state, 0.1)
        assert integrator.step(state, 0.1, **{"lambda": 3.0}) != integrator.step(state, 0.1)
        with pytest.raises(TypeError, match="unknown parameter mu"):
            integrator.step(state, 0.1, mu=1.0)


def test_what_a_kernel_does_not_use_is_not_emitted(kernels):
    source = kernels.emission(kernels.rigid(), "c").files["rigid.c"]
    for absent in ("double t", "statistics", "NOT_CONVERGED", "stumpff_series_3", "greater", "double s ="):
        assert absent not in source
    assert "stumpff_12(z, &c1_1, &c2_1);" in source
    assert "stumpff" not in kernels.emission(kernels.powers(), "python").files["powers.py"]


def test_a_comment_cannot_be_ended_by_a_fact(kernels, compiler: Compiler, tmp_path):
    from dataclasses import replace

    from codegen.emitter import emit_kernel

    kernel = kernels.rigid()
    recipe = replace(kernels.recipe(kernel), title='*/ evil """ \\N{}', left_out=("*/ #error",))
    files = emit_kernel(kernel, recipe, "c", "rigid_").files
    compile_files(files, tmp_path, tmp_path / "out.o", (*FLAGS, "-c"), compiler)
    load(emit_kernel(kernel, recipe, "python", "rigid_"))


@pytest.mark.parametrize("target", ["c", "python"])
def test_emission_is_golden(kernels, target, request):
    for name, text in kernels.emission(kernels.rigid(), target).files.items():
        path = GOLDEN / name
        if request.config.getoption("--update"):
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
        assert path.read_text(encoding="utf-8") == text


def test_emitted_python_runs_without_this_project(kernels, tmp_path):
    (tmp_path / "rigid.py").write_text(kernels.emission(kernels.rigid(), "python").files["rigid.py"])
    program = (
        "import sys, rigid\n"
        "print(rigid.run([0.4, -0.3, 0.9], 0.125, 4))\n"
        "assert not {'codegen', 'orderconds', 'numpy'} & set(sys.modules)\n"
    )
    answer = subprocess.run(
        [sys.executable, "-I", "-S", "-c", f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n{program}"],
        capture_output=True,
        text=True,
        check=True,
    )
    expected = load(kernels.emission(kernels.rigid(), "python")).run([0.4, -0.3, 0.9], 0.125, 4)
    assert answer.stdout.strip() == str(expected)


def test_emitted_bytes_do_not_depend_on_the_hash_seed(tmp_path):
    program = (
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "import runpy, hashlib\n"
        "found = runpy.run_path(sys.argv[2])\n"
        "for name in sorted(found['KERNELS']):\n"
        "    for target in ('c', 'python'):\n"
        "        e = found['emission'](found['KERNELS'][name](), target)\n"
        "        print(name, target, hashlib.sha256(repr((e.files, e.manifest)).encode()).hexdigest())\n"
    )
    conftest = str(Path(__file__).with_name("conftest.py"))
    answers = [
        subprocess.run(
            [sys.executable, "-c", program, str(ROOT), conftest],
            capture_output=True,
            text=True,
            check=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout
        for seed in ("0", "1", "2")
    ]
    assert len(answers[0].splitlines()) == 8
    assert answers[0] == answers[1] == answers[2]


def test_c_refuses_to_be_compiled_without_checks_for_nan(kernels, tmp_path, compiler):
    """Under -ffast-math isfinite is always true, and a NaN would come back as a success."""
    emission = kernels.emission(kernels.rigid(), "c")
    with pytest.raises(CompileError, match="compile without -ffast-math"):
        compile_files(
            emission.files, tmp_path, tmp_path / "out.o", ("-std=c11", "-O3", "-ffast-math", "-c"), compiler
        )


@pytest.mark.parametrize("target", ["c", "python"])
def test_no_step_fails_where_none_is_asked_for(kernels, target):
    integrator = load(kernels.emission(kernels.rigid(), target))
    assert integrator.run([0.4, -0.3, 0.9], math.nan, 0) == [0.4, -0.3, 0.9]


def test_emitted_python_computes_in_floats_whatever_numbers_it_is_given(kernels):
    step = load(kernels.emission(kernels.pendulum(), "python")).module.step
    with np.errstate(all="raise"):
        given = step(np.array([0.5, 0.25]), np.float64(0.5), Fraction(1, 8), np.float32(2))
    assert {type(x) for x in given} == {float}
    assert given == step([0.5, 0.25], 0.5, 0.125, 2.0)


HOSTILE = [
    "exp",
    "sin",
    "made",
    "all",
    "new",
    "failure",
    "I",
    "errno",
    "class",
    "M_PI",
    "isfinite",
    "previous_1",
]
HOSTILE += ["odd_OK", "ODD_OK", "ODD_BAD_STEP", "odd_statistics", "odd_run"]
HOSTILE += ["solved", "part", "tries", "guess"]


def scene_with_parameters(names):
    y = Matrix(symbols("y0:3", real=True))
    field = y - y
    for k, name in enumerate(names):
        field += Matrix([cos(k), sin(k), 1]) * param(name, 1) * exp(y[k % 3]) * sin(y[(k + 1) % 3]) / 50
    return FieldScene(group=SO3(), action=Rotation(), y=y, f=field, y0=[1, 0, 0], span=(0, 1))


@pytest.mark.parametrize("target", ["c", "python"])
def test_parameters_may_be_named_like_anything_that_emitted_code_holds(target):
    results = []
    for names in (HOSTILE, [f"harmless{k}" for k in range(len(HOSTILE))]):
        integrator = load(
            emit(scene_with_parameters(names), "rkmk:gauss2", target, prefix="odd_", parameters=names)
        )
        values = {name: 0.5 + k / 8 for k, name in enumerate(names)}
        results.append(integrator.run([0.6, 0.0, 0.8], 0.125, 3, **values))
    assert results[0] == pytest.approx(results[1], rel=0, abs=1e-15)


def test_headers_are_read_by_c_plus_plus_whatever_parameters_are_called(tmp_path):
    if shutil.which("c++") is None:
        pytest.skip("c++ is not installed")
    files = emit(scene_with_parameters(HOSTILE), "rk4", "c", prefix="odd_", parameters=HOSTILE).files
    (tmp_path / "odd.h").write_text(files["odd.h"])
    (tmp_path / "use.cpp").write_text('#include <cerrno>\n#include <cmath>\n#include "odd.h"\n')
    command = ["c++", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "use.cpp"]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize("prefix", ["1a", "class", "lambda_", "math", "string_", "a-b", ""])
def test_a_prefix_that_no_file_or_name_can_take_is_refused(prefix):
    with pytest.raises(InputError, match=r"--prefix: (the prefix .* is|.* cannot be the prefix of)"):
        prefix_of(prefix)


def test_a_damaged_file_in_the_cache_is_built_anew(kernels, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    emission = kernels.emission(kernels.rigid(), "c")
    damaged = build(emission.files)
    damaged.unlink()
    damaged.write_bytes(b"no shared object")
    assert load(emission).run([0.4, -0.3, 0.9], 0.0, 1) == [0.4, -0.3, 0.9]


def stack_used(files, folder, compiler, level):
    """Return the bytes that -fstack-usage adds up to along the deepest calls: run, advance and helpers."""
    folder.mkdir()
    try:
        flags = ("-std=c11", level, "-ffp-contract=off", "-fstack-usage", "-c")
        compile_files(files, folder, folder / "out.o", flags, compiler)
    except CompileError:
        pytest.skip(f"{compiler.version} has no -fstack-usage")
    (found,) = folder.glob("*.su")
    usage = {}
    for line in found.read_text().splitlines():
        where, size, _ = line.split("\t")
        usage[where.rpartition(":")[2]] = int(size)
    ends = [size for name, size in usage.items() if name.endswith(("_run", "_step"))]
    return sum(usage.values()) - sum(ends) + max(ends)


@cache
def deep(scene, method, precision):
    return emit(scene, method, "c", prefix="deep_", precision=precision).files


@pytest.mark.parametrize("level", ["-O0", pytest.param("-O1", marks=pytest.mark.slow), "-O2"])
@pytest.mark.parametrize(
    ("scene", "method"),
    [("free_rigid_body", "cf4"), ("dipole", "vcg:triple_jump"), ("fast_heavy_top", "splitting:forest_ruth4")],
)
@pytest.mark.parametrize("precision", ["double", pytest.param("single", marks=pytest.mark.slow)])
def test_the_stated_stack_is_enough_and_not_far_too_much(compiler, scene, method, level, precision, tmp_path):
    files = deep(scene, method, precision)
    stated = int(re.search(r"stack: +at most (\d+) bytes", files["deep.c"])[1])
    used = stack_used(files, tmp_path / "built", compiler, level)
    assert used <= stated
    if level == "-O0" and precision == "double":
        assert stated <= 1.5 * used


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("bad", [float("nan"), float("inf")])
def test_a_coordinate_that_is_not_read_must_be_a_number_all_the_same(target, bad):
    """A splitting on a top carries two columns of the rotation; the third follows from them."""
    integrator = load(emit("fast_heavy_top", "splitting:strang", target))
    state = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.1, 0.2, 0.3]
    assert all(map(math.isfinite, integrator.step(state, 1e-3)))
    for place in range(len(state)):
        spoilt = [bad if i == place else x for i, x in enumerate(state)]
        with pytest.raises(StepFailed):
            integrator.step(spoilt, 1e-3)


def test_a_long_initial_state_is_left_to_the_manifest_and_the_module_compiles():
    n, y = 80, symbols("y0:80", real=True)
    start = [Fraction(k + 1, 8) for k in range(n)]
    turned = [y[(k + 1) % n] for k in range(n)]
    scene = FieldScene(
        group=Rn(n), action=LeftMultiplication(), y=y, f=turned, y0=start, span=(0, 1), name="long"
    )
    emission = emit(scene, "rkmk(0):euler", "c")
    after = load(emission).step(emission.manifest["initial"], 0.5)
    assert after == [(k + 1) / 8 + (k + 2) / 16 if k + 1 < n else n / 8 + 1 / 16 for k in range(n)]
