"""The package's front: cheap to import, and its functions are not hidden by the modules that hold them."""

from __future__ import annotations

import importlib.util
import subprocess
import sys

import pytest

import orderconds


def run(code: str) -> str:
    return subprocess.check_output([sys.executable, "-c", code], text=True).strip()


def test_importing_the_package_imports_only_what_loads_its_names() -> None:
    code = "import sys, orderconds; print(sorted(m for m in sys.modules if m.startswith('orderconds')))"
    assert run(code) == "['orderconds', 'orderconds.lazy']"


FUNCTIONS = [name for name in orderconds.__all__ if name.islower()]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_of_the_interface_is_found_whatever_was_imported_before(name: str) -> None:
    assert run(f"import orderconds; print(type(orderconds.{name}).__name__)") == "function"
    if importlib.util.find_spec(f"orderconds.{name}") is not None:
        code = f"import orderconds.{name} as module; from orderconds import {name}; print(callable({name}))"
        assert run(code) == "True"


def test_packages_with_the_names_of_functions_can_be_imported() -> None:
    code = "import orderconds; from orderconds.trees import rooted; from orderconds.solve import spec; "
    assert run(code + "print(rooted.__name__, orderconds.trees.__name__)") == "orderconds.trees.rooted trees"


@pytest.mark.parametrize("package", ["orderconds", "codegen"])
def test_importing_a_package_imports_no_library(package: str) -> None:
    heavy = ("sympy", "numpy", "scipy", "matplotlib", "networkx", "flint", "msgspec", "click")
    assert run(f"import sys, {package}; print(sorted(set({heavy}) & set(sys.modules)))") == "[]"


def test_public_names_are_listed_loaded_or_not() -> None:
    assert set(orderconds.__all__) <= set(dir(orderconds))


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="chekc"):
        orderconds.chekc  # noqa: B018  # the lookup is the test
