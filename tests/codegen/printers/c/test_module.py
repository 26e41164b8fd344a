"""A C module: header, source and prototypes agree, and no text of a user leaves its comment."""

from __future__ import annotations

import re
from dataclasses import replace
from types import SimpleNamespace

import pytest

from codegen.emitter import compile_method
from codegen.ir.kernel import Kernel
from codegen.ir.precision import DOUBLE, SINGLE
from codegen.printers.c.module import helpers, inverted, own_names, print_module, prototypes, stack, usage
from codegen.printers.interface import Interface
from codegen.printers.recipe import Recipe
from codegen.run.plan import Plan
from codegen.run.terms import STATUSES
from codegen.run.unit import unit_of
from codegen.snippets.graph import LIBRARY

PREFIX = "m_"
RECIPE = Recipe("title", (), (1.0,))
NAMES = ["single", "rigid", "pendulum", "powers"]


def interface_of(kernel: Kernel, precision: str = DOUBLE.name) -> Interface:
    return Interface.of(kernel, PREFIX, precision)


def heads(text: str) -> dict[str, list[str]]:
    """Return the types of the parameters of each function that C code declares."""
    found = {}
    for name, parameters in re.findall(r"^int (\w+)\(([^;{]*)\);", text, re.MULTILINE):
        found[name] = [typed(p) for p in " ".join(parameters.split()).split(", ")]
    return found


def typed(parameter: str) -> str:
    """Return the type of a parameter, with an array as the pointer that C passes."""
    kind, name, array = re.fullmatch(r"(?:const )?(\w+ \**)(\w*)(\[.*\])?", parameter).groups()  # type: ignore[union-attr]
    assert name
    return kind.replace(" ", "") + ("*" if array else "")


def all_kernels(kernels: SimpleNamespace) -> list[Kernel]:
    return [getattr(kernels, name)() for name in NAMES]


@pytest.mark.parametrize("precision", ["double", "single"])
def test_prototypes_have_the_parameters_of_the_header(kernels: SimpleNamespace, precision: str) -> None:
    adaptive = compile_method("driven_spin", "cf:cf43", adaptive=True).kernel
    for kernel in [*all_kernels(kernels), adaptive]:
        interface = interface_of(kernel, precision)
        header = print_module(kernel, interface, RECIPE)["m.h"]
        declared, promised = heads(header), heads(prototypes(interface))
        # The loader never calls the public single step.
        assert set(declared) - set(promised) == {"m_step"}
        assert promised == {name: declared[name] for name in promised}


@pytest.mark.parametrize("name", NAMES)
def test_the_source_defines_what_the_header_declares(kernels: SimpleNamespace, name: str) -> None:
    kernel = getattr(kernels, name)()
    files = print_module(kernel, interface_of(kernel), RECIPE)
    assert sorted(files) == ["m.c", "m.h"]
    declared = heads(files["m.h"])
    assert set(declared) == {"m_step", "m_run"}
    for function in declared:
        assert len(re.findall(rf"^int {function}\(", files["m.c"], re.MULTILINE)) == 1


def test_no_title_ends_the_comment_of_a_file(kernels: SimpleNamespace) -> None:
    kernel = kernels.rigid()
    title = "ends */ here /* again"
    recipe = replace(RECIPE, title=title, facts=(("method", title),), command=title)
    for text in print_module(kernel, interface_of(kernel), recipe).values():
        rest = text[text.index("*/") + 2 :].lstrip()
        assert rest.startswith("#")


@pytest.mark.parametrize("name", NAMES)
def test_the_example_passes_each_argument_of_a_run(kernels: SimpleNamespace, name: str) -> None:
    kernel = getattr(kernels, name)()
    interface = interface_of(kernel)
    lines = "\n".join(usage(interface, kernels.recipe(kernel)))
    call = re.search(r"m_run\((.*)\);", lines)
    assert call is not None
    header = print_module(kernel, interface, RECIPE)["m.h"]
    assert len(call[1].split(", ")) == len(heads(header)["m_run"])


@pytest.mark.parametrize("name", NAMES)
def test_names_of_a_module_are_hidden_by_no_variable(kernels: SimpleNamespace, name: str) -> None:
    kernel = getattr(kernels, name)()
    interface = interface_of(kernel)
    unit = unit_of(Plan(kernel, interface.format))
    names = own_names(interface, unit)
    assert {"m_step", "m_run", "M_H"} <= names
    assert {f"m_{function.name}" for function in unit.functions} <= names
    assert {f"m_{helper}" for helper in helpers(unit) if helper not in LIBRARY} <= names
    assert {f"M_{status}" for status in STATUSES} <= names


def test_the_bound_on_the_stack_grows_with_the_kernel_and_is_the_same_in_both_formats(
    kernels: SimpleNamespace,
) -> None:
    def bound(kernel: Kernel, precision: str) -> int:
        interface = interface_of(kernel, precision)
        plan = Plan(kernel, interface.format)
        found = re.search(r"at most (\d+) bytes", stack(unit_of(plan), plan, interface))
        assert found is not None
        return int(found[1])

    small, large = kernels.powers(), compile_method("dipole", "vcg:midpoint").kernel
    for name in (DOUBLE.name, SINGLE.name):
        assert bound(small, name) < bound(large, name)
    for kernel in (small, large):
        # At least the state itself, as an array and as local copies.
        size = sum(len(f.symbols) for f in kernel.state)
        assert 2 * 8 * size < bound(kernel, "double")
        # Pairs of singles take as much space in vector registers as doubles.
        assert bound(kernel, "single") == bound(kernel, "double")


def test_matrices_of_one_small_size_are_inverted_with_unrolled_rows(kernels: SimpleNamespace) -> None:
    assert inverted(kernels.pendulum()) == 0
    newton = compile_method("dipole", "vcg:gauss2", solver="newton").kernel
    sizes = {len(loop.unknowns) for loop in newton.loops if not loop.newton.inverted}  # type: ignore[union-attr]
    expected = sizes.pop() if len(sizes) == 1 else 0
    assert expected > 0
    assert inverted(newton) == expected
    source = print_module(newton, interface_of(newton), RECIPE)["m.c"]
    assert f"Here n is always {expected}." in source
