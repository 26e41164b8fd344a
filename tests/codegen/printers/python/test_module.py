"""A Python module: it imports what it uses, quotes what users wrote, and its example runs."""

from __future__ import annotations

import ast
import contextlib
import io
import sys
from dataclasses import replace
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from codegen.emitter import compile_method
from codegen.ir.kernel import Kernel
from codegen.printers.interface import Interface
from codegen.printers.python.module import keywords, print_module, usage
from codegen.printers.recipe import Recipe

NAMES = ["single", "rigid", "pendulum", "powers"]


def printed(kernel: Kernel, recipe: Recipe, precision: str = "double") -> str:
    files = print_module(kernel, Interface.of(kernel, "m_", precision), recipe)
    assert list(files) == ["m.py"]
    return files["m.py"]


def executed(text: str) -> dict[str, Any]:
    module: dict[str, Any] = {"__name__": "m"}
    exec(compile(text, "m.py", "exec"), module)
    return module


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("name", [*NAMES, "adaptive"])
def test_a_module_imports_exactly_the_names_that_it_reads(
    kernels: SimpleNamespace, name: str, precision: str
) -> None:
    if name == "adaptive":
        kernel = compile_method("driven_spin", "cf:cf43", adaptive=True).kernel
        recipe = Recipe("adaptive", (), (1.0, 0.0, 0.0))
    else:
        kernel = getattr(kernels, name)()
        recipe = kernels.recipe(kernel)
    tree = ast.parse(printed(kernel, recipe, precision))
    imported = {a.name for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) for a in n.names}
    read = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}
    assert imported <= read
    executed(ast.unparse(tree))


def test_no_title_ends_the_docstring(kernels: SimpleNamespace) -> None:
    kernel = kernels.rigid()
    title = '"""; raise SystemExit  # \\N{BULLET} \\'
    recipe = replace(kernels.recipe(kernel), title=title, command=title)
    document = executed(printed(kernel, recipe))["__doc__"]
    assert document.startswith(title.replace('"""', "'''").split()[0])
    assert "\\N{BULLET}" in document


@pytest.mark.parametrize("name", NAMES)
def test_the_example_prints_the_state_after_its_steps(
    kernels: SimpleNamespace, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    kernel = getattr(kernels, name)()
    recipe = kernels.recipe(kernel)
    module = executed(printed(kernel, recipe))
    fake = ModuleType("m")
    vars(fake).update(module)
    monkeypatch.setitem(sys.modules, "m", fake)
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        exec("\n".join(usage(Interface.of(kernel, "m_"), recipe)), {})
    times = (0.0,) if Interface.of(kernel, "m_").time else ()
    assert ast.literal_eval(output.getvalue()) == module["run"](
        recipe.initial, *times, recipe.h, recipe.steps
    )


def test_parameters_have_defaults_all_or_none(kernels: SimpleNamespace) -> None:
    kernel = kernels.pendulum()
    known = kernels.recipe(kernel)
    unknown = replace(known, defaults={})
    with_defaults, without = (executed(printed(kernel, r))["step"] for r in (known, unknown))
    assert with_defaults([0.5, 0.25], 0.0, 0.125) == without([0.5, 0.25], 0.0, 0.125, 2.0)
    with pytest.raises(TypeError):
        without([0.5, 0.25], 0.0, 0.125)


def test_options_are_keywords_only() -> None:
    assert keywords([]) == []
    assert keywords(["a=1", "b=2"]) == ["*", "a=1", "b=2"]
