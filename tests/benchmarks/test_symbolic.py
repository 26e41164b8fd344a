"""The benchmark does what its table says: right counts, and verdicts that follow from the figures."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

SCRIPT = Path(__file__).parents[2] / "benchmarks" / "symbolic.py"


@pytest.fixture(scope="module")
def symbolic() -> ModuleType:
    spec = importlib.util.spec_from_file_location("symbolic", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["symbolic"] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("task", "results"),
    [("rooted", 53272), ("ordered", 82500), ("formulas", 1205), ("cf", 13), ("cg", 358), ("vcg4", 33)],
)
def test_tasks_have_the_counts_of_the_literature(symbolic: ModuleType, task: str, results: int) -> None:
    assert symbolic.TASKS[task].ours()() == results


def test_sympy_computes_the_same_polynomials(symbolic: ModuleType) -> None:
    from orderconds.derivation import derive
    from orderconds.stage_expansion import polynomials

    ours = polynomials(derive("rk", 5), 4, explicit=True)[2]
    theirs = symbolic.sympy_polynomials(order=5, size=4)
    assert theirs() == sum(map(len, ours))


@pytest.mark.parametrize(("seconds", "verdict"), [(0.5, "met"), (1.5, "missed")])
def test_verdicts_follow_from_the_figures(
    symbolic: ModuleType, monkeypatch: pytest.MonkeyPatch, seconds: float, verdict: str
) -> None:
    figures = {"one:ours": symbolic.Timing(seconds, 7, 50.0), "one:theirs": symbolic.Timing(10.0, 7, 50.0)}
    monkeypatch.setattr(symbolic, "measure", lambda one, repeats: figures[one])
    # SymPy is always there.
    monkeypatch.setitem(symbolic.TASKS, "one", symbolic.Task("x", int, "sympy", int, ratio=10))
    assert symbolic.row("one", 1)[-1] == verdict


def test_sides_that_disagree_are_no_comparison(symbolic: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    figures = {"one:ours": symbolic.Timing(1.0, 7, 50.0), "one:theirs": symbolic.Timing(10.0, 8, 50.0)}
    monkeypatch.setattr(symbolic, "measure", lambda one, repeats: figures[one])
    monkeypatch.setitem(symbolic.TASKS, "one", symbolic.Task("x", int, "sympy", int, ratio=10))
    with pytest.raises(SystemExit, match="7 results here, 8"):
        symbolic.row("one", 1)
