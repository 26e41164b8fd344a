"""Every public function says what it returns and shows it, with an example that make test runs."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
from collections.abc import Callable, Iterator
from typing import Any

import orderconds

EXEMPT = {
    "orderconds.cli.main": "runs the program on the command line's arguments and exits",
    "orderconds.exit_status.catch_signals": "changes how this process answers signals",
    "orderconds.solve.cluster.on_cluster": "needs a cluster; tests/orderconds/solve/test_search.py has one",
    "orderconds.pytest_plugin.pytest_addoption": "a hook, called by pytest",
    "orderconds.pytest_plugin.pytest_collect_file": "a hook, called by pytest",
    "orderconds.pytest_plugin.pytest_pycollect_makemodule": "a hook, called by pytest",
    "orderconds.pytest_plugin.pytest_terminal_summary": "a hook, called by pytest",
}
"""Functions that have no example, and why."""

PARSER = doctest.DocTestParser()


def modules() -> Iterator[Any]:
    for found in pkgutil.walk_packages(orderconds.__path__, "orderconds."):
        if not found.name.endswith("__main__"):
            yield importlib.import_module(found.name)


def public_functions() -> Iterator[tuple[str, Callable[..., Any]]]:
    for module in modules():
        for name, value in sorted(vars(module).items()):
            # Cached functions are objects of another type that wrap one.
            function = inspect.unwrap(value) if callable(value) else value
            own = getattr(function, "__module__", "") == module.__name__
            if inspect.isfunction(function) and own and not name.startswith("_"):
                yield f"{module.__name__}.{name}", function


def without_example(functions: Iterator[tuple[str, Callable[..., Any]]]) -> list[str]:
    return [name for name, function in functions if not PARSER.get_examples(inspect.getdoc(function) or "")]


def test_every_module_says_its_idea() -> None:
    assert [module.__name__ for module in modules() if not (module.__doc__ or "").strip()] == []


def test_every_public_function_has_an_example() -> None:
    found = [name for name in without_example(public_functions()) if name not in EXEMPT]
    assert found == []


def test_exemptions_are_needed() -> None:
    names = set(without_example(public_functions()))
    assert set(EXEMPT) <= names


def test_a_function_without_example_is_found() -> None:
    assert without_example(iter([("bare", test_every_module_says_its_idea)])) == ["bare"]
    assert len(list(public_functions())) > 300
