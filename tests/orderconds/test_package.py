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


@pytest.mark.parametrize("name", ["check", "derive"])
def test_a_function_is_found_and_no_module_has_its_name(name: str) -> None:
    assert run(f"import orderconds; print(type(orderconds.{name}).__name__)") == "function"
    assert importlib.util.find_spec(f"orderconds.{name}") is None


def test_public_names_are_listed_loaded_or_not() -> None:
    assert set(orderconds.__all__) <= set(dir(orderconds))


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="chekc"):
        orderconds.chekc  # noqa: B018  # the lookup is the test
