"""The report section on long runs: a run that stops early is named, and the report does not pass."""

from __future__ import annotations

from dataclasses import replace

import pytest

from codegen.lab.measurements.long_runs import LongRuns
from codegen.lab.subject import QUICK, MethodResults, Subject, subject
from codegen.scenes import load


@pytest.fixture(scope="module")
def planned() -> Subject:
    """The free rigid body with two methods, and runs of 2000 steps."""
    effort = replace(QUICK, steps=2000)
    return subject("free_rigid_body", load("free_rigid_body"), ("cg:cg3", "cf:cf4"), effort=effort)


@pytest.fixture(scope="module")
def result(planned: Subject):
    """The result of the two long runs."""
    return LongRuns().run(planned)


def test_complete_runs_hold(planned: Subject, result) -> None:
    assert LongRuns().holds(result)
    assert list(LongRuns().lines(result, planned)) == []
    verdict = LongRuns().verdict(result, planned)
    assert "over 2\u00a0000 steps" in verdict
    assert "stopped" not in verdict


def test_a_run_that_stops_early_does_not_hold(planned: Subject, result) -> None:
    first, second = result.measured
    early = replace(first, steps=1234, failure="the state is not finite")
    found = MethodResults((early, second))
    assert not LongRuns().holds(found)
    (line,) = LongRuns().lines(found, planned)
    assert line == f"free_rigid_body {first.method}: the long run stopped: the state is not finite"
    growth, stopped = LongRuns().verdict(found, planned).split(".", 1)
    assert first.method not in growth
    assert second.method in growth
    assert stopped == f" Runs that stopped early: {first.method} after 1\u00a0234 steps."


def test_there_is_no_sentence_on_growth_if_all_runs_stop_early(planned: Subject, result) -> None:
    found = MethodResults(tuple(replace(run, steps=7, failure="no reason") for run in result.measured))
    verdict = LongRuns().verdict(found, planned)
    assert verdict.startswith("Runs that stopped early: ")
    assert "Growth" not in verdict


def test_a_failure_on_the_way_back_does_not_hide_the_growth(planned: Subject, result) -> None:
    first, second = result.measured
    found = MethodResults((replace(first, failure="in the run back to the start, no reason"), second))
    assert not LongRuns().holds(found)
    assert first.method in LongRuns().verdict(found, planned)
