"""``orderconds recommend``: the printed command works, JSON has one structure, bad input is one message."""

from __future__ import annotations

import json
import math
import shlex
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from click.testing import CliRunner, Result

from codegen import scenes
from codegen.commands.recommend import unreached
from codegen.lab import timing
from codegen.lab.distance import distance
from codegen.lab.efficiency import race
from codegen.lab.efficiency.candidates import Recipe
from codegen.lab.efficiency.recommend import Recommendation, Request
from codegen.lab.reference import cached_reference
from codegen.loader import load
from orderconds.cli import program

QUICK = ("duffing", "--error", "1e-6", "--tableau", "rk4", "--tableau", "dormand_prince5")
PLACES = ("recommended", "runner_up", "most_accurate")


@pytest.fixture(autouse=True)
def _short_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    """Times of these races are coarse, because no test depends on them."""

    def coarse(run: Callable[[int], int], overhead: timing.Overhead, batch: float, _: int) -> list[float]:
        return timing.span_times(run, overhead, batch / 10, 2)

    monkeypatch.setattr(race, "span_times", coarse)


def run(*words: str) -> Result:
    return CliRunner().invoke(program, ["recommend", *words])


def found(*words: str) -> dict[str, Any]:
    result: dict[str, Any] = json.loads(run(*words, "--json").stdout)
    return result


@pytest.mark.parametrize("needs", [(), ("--need", "adaptive")])
def test_the_printed_command_emits_an_integrator_that_reaches_the_error(
    needs: tuple[str, ...], tmp_path: Path
) -> None:
    place = found(*QUICK, *needs)["recommended"]
    words = shlex.split(place["command"])
    assert words[0] == "orderconds"
    assert words[-2:] == ["-o", "."]
    emitted = CliRunner().invoke(program, [*words[1:-1], str(tmp_path)])
    assert emitted.exit_code == 0, emitted.output
    problem = scenes.load("duffing")
    start, (first, last) = list(map(float, _initial())), map(float, problem.span)
    integrator = load(tmp_path)
    if place["adaptive"]:
        tolerance = place["tolerance"]
        state = integrator.adaptive(start, first, last, rtol=tolerance, atol=tolerance).state
    else:
        assert math.isclose(place["h"] * place["steps"], last - first)
        state = integrator.run(start, place["h"], place["steps"], first)
    assert distance(problem, state, cached_reference(problem).state) <= 1e-6


def _initial() -> tuple[float, ...]:
    from codegen.ir.domain import FloatDomain

    return scenes.load("duffing").initial(FloatDomain(0.0))


def test_the_text_names_the_method_the_step_and_the_command() -> None:
    text = run(*QUICK).stdout
    place = found(*QUICK)["recommended"]
    assert "recommended" in text
    assert "runner-up" in text
    assert "orderconds emit duffing --method" in text
    assert place["command"].startswith("orderconds emit duffing --method")


def test_json_has_the_same_structure_if_the_error_is_not_reached() -> None:
    reached, missed = found(*QUICK), found("duffing", "--error", "1e-30", "--tableau", "rk4")
    assert reached.keys() == missed.keys()
    assert reached["recommended"].keys() == missed["most_accurate"].keys()
    assert [reached[name] is None for name in PLACES] == [False, False, True]
    assert [missed[name] is None for name in PLACES] == [True, True, False]


def test_an_error_that_nothing_reaches_exits_1_with_the_best_error() -> None:
    result = run("duffing", "--error", "1e-30", "--tableau", "rk4")
    assert result.exit_code == 1
    assert "no method reaches the error 1e-30; the smallest measured error is" in result.stdout


def missed(needs: tuple[str, ...] = (), lost: tuple[str, ...] = (), error: float = 2.5e-7) -> Recommendation:
    """A search for the error 1e-6 without a result, in which one run has the given error."""
    recipe = Recipe("rk:rk4", 4, 4, "rk4")
    alone = race.Result(cast(race.Entry, SimpleNamespace(recipe=recipe)), 8.0, 8, error, math.inf, False)
    request = Request("duffing", 1e-6, needs, tableaux=("rk4",))
    return Recommendation(request, (), alone, 1, 1, 0.0, lost=lost)


def test_a_small_error_of_a_single_run_is_not_called_larger_than_the_requested_error() -> None:
    text = unreached(missed())
    assert (
        "no method reaches the error 1e-06 in two consecutive runs; the smallest measured error is 2.5e-07"
        in text
    )
    assert "this run is not confirmed, because the next run failed, was not made, or had more" in text
    assert "consecutive" not in unreached(missed(error=2.5e-6))


def test_a_method_that_reaches_the_error_but_loses_a_conserved_quantity_is_the_reason() -> None:
    text = unreached(missed(("symplectic",), ("rk:rk4",)))
    assert (
        "every measured method with symplectic that reaches the error 1e-06 loses a conserved quantity"
        in text
    )
    assert "no method" not in text


def test_needs_that_nothing_meets_exit_1() -> None:
    result = run("free_rigid_body", "--error", "1e-3", "--need", "symplectic", "--tableau", "rk4")
    assert result.exit_code == 1
    assert "no method has the required properties" in result.stdout


def test_a_span_replaces_that_of_the_scene() -> None:
    longer = found(*QUICK, "--span", "0:1")
    assert longer["span"] == [0.0, 1.0]
    assert math.isclose(longer["recommended"]["h"] * longer["recommended"]["steps"], 1.0)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nowhere", "--error", "1e-6"), "unknown scene"),
        (("duffing", "--error", "1e-6", "--need", "fast"), "unknown need 'fast'"),
        (("duffing", "--error", "1e-6", "--need", "explicit,quick"), "unknown need 'quick'"),
        (("duffing", "--error", "0"), "the error 0"),
        (("duffing", "--error", "nan"), "the error nan"),
        (("duffing", "--error", "1e-6", "--span", "1:0"), "the span '1:0'"),
        (("duffing", "--error", "1e-6", "--span", "x"), "the span 'x'"),
        (("duffing", "--error", "1e-6", "--budget", "0"), "the budget 0"),
        (("duffing", "--error", "1e-6", "--tableau", "rk44"), "rk44"),
    ],
)
def test_bad_input_is_one_message(words: tuple[str, ...], said: str) -> None:
    result = run(*words)
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    assert said in result.stderr
    assert "Traceback" not in result.stderr


def test_a_budget_without_time_for_a_measurement_is_no_statement_about_methods():
    ended = Recommendation(Request("circle", 1e-6), (), None, 3, 0, 1.0, complete=False)
    assert unreached(ended) == (
        "circle: no method was measured before the time budget ended; increase --budget"
    )
    assert "no method reaches the error 1e-06" in unreached(replace(ended, complete=True))
