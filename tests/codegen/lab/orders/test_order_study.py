"""Executors are compared after a number of steps that can be run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from codegen.lab.orders.order_study import COMPARED, largest_difference
from codegen.lab.runner import RunFailed


@dataclass
class Runner:
    """An executor that needs a number of steps, and is off by a little."""

    least: int
    off: float = 0.0

    def final(self, steps: int) -> tuple[Any, ...]:
        if steps < self.least:
            raise RunFailed("step 1: the equations did not converge")
        return (1.0 + self.off, float(steps))


def test_the_first_run_of_the_ladder_that_is_long_enough_is_taken() -> None:
    runners: Any = (Runner(80), Runner(80, 0.25), Runner(80, -0.5))
    assert COMPARED < 80
    assert largest_difference(runners, (5, 80, 160)) == 0.5
    assert largest_difference(runners[:1] * 3, (160,)) == 0


def test_where_nothing_ran_there_is_nothing_to_compare() -> None:
    runners: Any = (Runner(80),) * 3
    assert largest_difference(runners, ()) is None
    assert largest_difference(runners, (COMPARED - 1,)) is None


def test_steps_that_one_executor_cannot_make_are_halved() -> None:
    runners: Any = (Runner(80), Runner(300, 0.25))
    assert largest_difference(runners, (80, 160, 320, 640)) == 0.25
    assert largest_difference(runners, (80, 160)) is None
