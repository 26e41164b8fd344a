"""What a scene and a method do not need is absent, read off the emitted text and off operation counts."""

from __future__ import annotations

import ast
import re
from functools import cache

import pytest

from codegen.build import CompileError, Compiler, compile_files, find_compiler
from codegen.emitter import compile_method, emit_compiled
from codegen.lower import lowering
from codegen.printers.c.module import FLAGS
from codegen.scenes import load
from tests.codegen.family_cases import CASES
from tests.compilations import compiled

EXPLICIT = {
    "rk": ("linear_oscillator", "rk:rk4"),
    "rkmk": ("free_rigid_body", "rkmk:rk4"),
    "cg": ("free_rigid_body", "cg:cg3"),
    "cf": ("driven_spin", "cf:cf4"),
    "ambient": ("dipole", "ambient:rk4"),
    "splitting": ("fast_heavy_top", "splitting:blanes_moan_rkn4"),
    "composition": ("linear_oscillator", "composition:triple_jump"),
}
IMPLICIT = {
    "rk": ("linear_oscillator", "rk:gauss2"),
    "rkmk": ("driven_spin", "rkmk(2):gauss2"),
    "cg": ("free_rigid_body", "cg:gauss1"),
    "cf": ("free_rigid_body", "cf:gauss1"),
    "vcg": ("dipole", "vcg:triple_jump"),
    "vrkmk": ("dipole", "vrkmk(2):gauss2"),
    "vcf": ("dipole", "vcf:cf4"),
    "vrkmk_pade": ("heavy_top", "vrkmk_pade(1):kutta3"),
    "slgi": ("dipole", "slgi:midpoint"),
    "discrete_gradient": ("free_rigid_body_s3", "discrete_gradient:midpoint"),
}
for family, cases in CASES.items():
    if family not in {*EXPLICIT, *IMPLICIT}:
        case = (cases[0].gallery, cases[0].method)
        (IMPLICIT if compiled(*case).kernel.loops else EXPLICIT)[family] = case
ALL = [*EXPLICIT.values(), *IMPLICIT.values()]


@cache
def texts(scene, method):
    """The texts of header, C source and Python module."""
    files = {}
    for target in ("c", "python"):
        files |= emit_compiled(compiled(scene, method), target, prefix="short_").files
    return files["short.h"], files["short.c"], files["short.py"]


def code(source):
    """C without comments."""
    return re.sub(r"/\*.*?\*/", "", source, flags=re.DOTALL)


SOLVING = ("sweep", "statistics", "NOT_CONVERGED", "previous", "greater", "fabs", "max(")


@pytest.mark.parametrize(("scene", "method"), EXPLICIT.values())
def test_explicit_modules_hold_no_solver(scene, method):
    header, source, module = texts(scene, method)
    for word in SOLVING:
        assert word not in code(header) + code(source)
    body = module[module.index("\ndef _") :]
    for word in SOLVING:
        assert word not in body
    assert "Statistics" not in module
    assert "sweep" not in module


@pytest.mark.parametrize(("scene", "method"), IMPLICIT.values())
def test_implicit_ones_do(scene, method):
    """The words looked for above are those that solvers are made of."""
    header, source, module = texts(scene, method)
    loops = compiled(scene, method).kernel.loops
    compared = all(loop.newton is not None and loop.newton.residuals for loop in loops)
    for word in SOLVING[:-1]:
        if not (word == "greater" and compared):  # where momenta are compared, changes are added up
            assert word in code(header) + code(source)
    assert "sweep += 1" in module


BRACKETS = {"ad", "ad*", "dexpinv", "dexpinv*", "P*", "Ad", "Ad*", "Ad*^-1", "dexp*"}
ON_VECTOR_SPACES = {
    "rk": "rk:rk4",
    "rkmk": "rkmk:rk4",
    "cg": "cg:cg3",
    "cf": "cf:cf4",
    "vcg": "vcg:triple_jump",
    "vrkmk": "vrkmk(2):gauss2",
    "vcf": "vcf:cf4",
    "vrkmk_pade": "vrkmk_pade(2):gauss2",
    "splitting": "splitting:forest_ruth4",
    "composition": "composition:suzuki4",
    "slgi": "slgi:midpoint",
    "ambient": "ambient:rk4",
}


WITH_BRACKETS = {"rkmk", "vcg", "vrkmk", "vcf", "vrkmk_pade", "slgi"}
"""Families whose programs have brackets or adjoint operations before the passes."""

ON_VECTOR_SPACES |= {
    family: cases[0].method
    for family, cases in CASES.items()
    if family not in ON_VECTOR_SPACES and lowering(family).objection(load("linear_oscillator")) is None
}
"""The methods of all families that serve this scene, which depends on time."""


@pytest.mark.parametrize("family", ON_VECTOR_SPACES)
def test_abelian_groups_have_no_brackets_and_no_trigonometry_of_rotations(family):
    made = compiled("linear_oscillator", ON_VECTOR_SPACES[family])
    assert not BRACKETS & set(made.program.counts())
    assert "stumpff" not in "".join(texts("linear_oscillator", ON_VECTOR_SPACES[family]))
    if family in WITH_BRACKETS:
        assert BRACKETS & set(made.lowered.counts())


@pytest.mark.parametrize("family", ON_VECTOR_SPACES)
def test_the_energy_variable_of_a_scene_with_time_is_not_carried_along(family):
    """H depends on t; its conjugate variable u would be a ninth number of the state."""
    emission = emit_compiled(compiled("linear_oscillator", ON_VECTOR_SPACES[family]), "c")
    assert [f["name"] for f in emission.manifest["state"]] in (["q", "mu"], ["y"])
    assert emission.manifest["interface"]["size"] == 8


@pytest.mark.parametrize(
    ("method", "stages"), [("vcg:midpoint", 1), ("vcg:triple_jump", 3), ("vcg:suzuki4", 5)]
)
def test_composition_tableaux_are_solved_stage_by_stage(method, stages):
    """The block holds the unknowns of one stage, never those of two, as a tableau that is none must."""
    kernel = compiled("dipole", method).kernel
    (both,) = compiled("dipole", "vcg:gauss2").kernel.loops
    assert [len(loop.unknowns) for loop in kernel.loops] == [len(both.unknowns) // 2]
    assert len(kernel.substeps) == (stages if stages > 1 else 0)


@pytest.mark.parametrize("scene", ["free_rigid_body", "driven_spin"])
def test_cf4_has_five_exponentials_and_not_six(scene):
    """Its last stage starts from the second, whose exponential is not computed again."""
    counts = compiled(scene, "cf:cf4").program.counts()
    assert counts.get("exp", 0) + counts.get("actexp", 0) == 5
    _, source, module = texts(scene, "cf:cf4")
    assert source.count("stumpff_12(w") == 5
    assert len(re.findall(r"= _stumpff_12\(", module)) == 5


def test_rows_of_variational_crouch_grossman_methods_share_prefixes():
    """Six of the twelve exponentials of a triple jump differ; products that begin alike do so once."""
    made = compiled("dipole", "vcg:triple_jump")
    assert made.lowered.counts()["exp"] == 12
    assert made.program.counts()["exp"] <= 6
    assert made.lowered.counts()["mul"] == 16
    assert made.program.counts()["mul"] <= 8


@pytest.mark.parametrize(("scene", "method"), ALL)
def test_c_defines_nothing_that_it_does_not_call(scene, method):
    header, source, _ = texts(scene, method)
    found = code(source)
    for name in re.findall(r"^static (?:inline )?\w+ \*?(\w+)\(", found, re.MULTILINE):
        assert len(re.findall(rf"\b{name}\(", found)) > 1, name
    for status in re.findall(r"(SHORT_\w+) = \d", header):
        if status != "SHORT_BAD_STEP" or "SHORT_BAD_STEP" in source:
            assert status in found, status


@pytest.mark.parametrize(("scene", "method"), ALL)
def test_c_includes_nothing_that_it_can_do_without(scene, method, tmp_path):
    """Without any one of its includes it is refused, and the same with all of them compiles."""
    header, source, _ = texts(scene, method)
    strict = Compiler(find_compiler().command, "")
    compile_files({"short.h": header, "short.c": source}, tmp_path, tmp_path / "o", (*FLAGS, "-c"), strict)
    for line in re.findall(r"^#include <.*>\n", header + source, re.MULTILINE):
        files = {"short.h": header.replace(line, ""), "short.c": source.replace(line, "")}
        with pytest.raises(CompileError):
            compile_files(files, tmp_path, tmp_path / "without", (*FLAGS, "-fsyntax-only"), strict)


@pytest.mark.parametrize(("scene", "method"), ALL)
def test_c_declares_no_variable_or_argument_that_it_does_not_read(scene, method, tmp_path):
    header, source, _ = texts(scene, method)
    flags = (*FLAGS, "-Wunused", "-Wunused-but-set-variable", "-Wunused-parameter", "-Wunused-macros", "-c")
    files = {"short.h": header, "short.c": source}
    compile_files(files, tmp_path, tmp_path / "o", flags, find_compiler())


@pytest.mark.parametrize(("scene", "method"), ALL)
def test_python_imports_and_defines_nothing_that_it_does_not_use(scene, method):
    tree = ast.parse(texts(scene, method)[2])
    read = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}
    made = {a.name for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) for a in n.names}
    made |= {n.name for n in tree.body if isinstance(n, ast.FunctionDef | ast.ClassDef)}
    made |= {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    made |= {a.arg for n in ast.walk(tree) if isinstance(n, ast.FunctionDef) for a in n.args.args}
    public = {"step", "run", "labels", "self", "Statistics", "OK", "_"}
    assert made - read - public == set()


def test_run_time_parameters_are_arguments_only_where_they_are_asked_for():
    assert "double beta" not in "".join(texts(*IMPLICIT["vcg"]))
    kept = emit_compiled(compile_method("dipole", "vcg:midpoint", ["beta"]), "c")
    assert "double beta" in kept.files["dipole_vcg_midpoint.h"]
