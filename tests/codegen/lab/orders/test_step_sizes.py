"""Verdicts on error sequences whose order is known, by construction."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from codegen.lab.orders.step_sizes import FIRST, Places, Refinement, Run, refine, rounding


def errors(order: float, bend: float = 0.0, size: float = 1.0, count: int = 12) -> Refinement:
    """Error size h^order (1 + bend h) for h = 1/5, 1/10, ..."""
    steps = [FIRST * 2**k for k in range(count)]
    return Refinement(tuple(Run(n, 1 / n, size * n**-order * (1 + bend / n)) for n in steps))


@given(order=st.integers(1, 8), bend=st.floats(-3, 10), size=st.floats(1e-3, 1e3), stated=st.integers(1, 9))
def test_a_settled_ladder_holds_exactly_when_the_order_is_the_stated_one(
    order: int, bend: float, size: float, stated: int
) -> None:
    def run(n: int) -> Run:
        return Run(n, 1 / n, abs(size * n**-order * (1 + bend / n)))

    refinement = refine(run, 10**5)
    assert refinement.settled
    assert refinement.verdict(stated) == ("holds" if order == stated else "fails")


@pytest.mark.parametrize("order", [1.5, 2.5, 3.5])
def test_an_order_halfway_between_two_integers_holds_for_neither(order: float) -> None:
    refinement = errors(order)
    assert refinement.verdict(math.floor(order)) == refinement.verdict(math.ceil(order)) == "fails"


def test_slopes_divide_by_the_true_step_ratio() -> None:
    steps = [10, 13, 29, 100]
    refinement = Refinement(tuple(Run(n, 2 / n, 7 * (2 / n) ** 3) for n in steps))
    assert refinement.slopes == pytest.approx((3, 3, 3), abs=1e-12)
    assert refinement.verdict(3) == "holds"


def test_what_is_missing_is_judged_by_the_step_ratio() -> None:
    # Steps in the ratio 1.1: slopes change by 0.03 a run, yet they are still 0.3 and more from the order 2.
    steps = [round(1000 * 1.1**k) for k in range(5)]
    runs: list[Run] = []
    error = 1.0
    for n, slope in zip(steps, (0, 1.60, 1.63, 1.66, 1.69), strict=True):
        error = runs[-1].error * (runs[-1].steps / n) ** slope if runs else error
        runs.append(Run(n, 1 / n, error))
    assert Refinement(tuple(runs)).verdict(2) == "undecided"


def test_rungs_inside_rounding_do_not_count() -> None:
    runs = (*errors(4, count=4).runs, *(Run(5 * 2**k, 0.2 / 2**k, 1e-14, "rounding") for k in (4, 5)))
    assert Refinement(runs).observed == pytest.approx(4)
    assert [r.steps for r in Refinement(runs).clean] == [5, 10, 20, 40]


def test_a_rung_that_failed_parts_its_neighbours() -> None:
    runs = list(errors(2, count=8).runs)
    runs[2] = Run(20, 0.05, math.inf, "no run")
    assert [r.steps for r in Refinement(tuple(runs)).clean] == [40, 80, 160, 320, 640]


def test_slopes_that_still_move_are_undecided_not_wrong() -> None:
    # the dipole under VRKMK3 (Kutta): slopes 5.37, 3.11, 2.01, 2.67
    values = [4.282e-4, 1.032e-5, 1.191e-6, 2.948e-7, 4.63e-8]
    refinement = Refinement(tuple(Run(5 * 2**k, 0.1 / 2**k, e) for k, e in enumerate(values)))
    assert refinement.verdict(3) == refinement.verdict(2) == "undecided"


def test_fewer_than_four_runs_decide_nothing() -> None:
    assert errors(2, count=3).verdict(2) == "undecided"
    assert errors(2, count=0).observed is None


def test_a_climb_stops_where_rounding_begins_and_where_patience_ends() -> None:
    def run(n: int) -> Run:
        error = n**-6.0 * (1 + 4 / n)
        return Run(n, 1 / n, error, "rounding" if error < 100 * rounding(n, 2.0**-52, 1) else "")

    assert refine(run, 10**6).runs[-1].steps <= 160
    assert [r.steps for r in refine(lambda n: Run(n, 1 / n, math.exp(-n)), 50).runs] == [5, 10, 20, 40]


@pytest.mark.parametrize(("order", "size"), [(6, 5e-4), (8, 1e-2), (10, 1.0)])
def test_a_high_order_that_meets_rounding_soon_is_decided_by_runs_in_between(order: int, size: float) -> None:
    def run(n: int) -> Run:
        error = size * n**-order * (1 - 1 / n**2)
        return Run(n, 1 / n, error, "rounding" if error < 100 * rounding(n, 2.0**-52, 1) else "")

    doubled = Refinement(tuple(run(FIRST * 2**k) for k in range(4)))
    assert doubled.verdict(order) == "undecided"
    refinement = refine(run, 10**6, to_rounding=True)
    assert refinement.verdict(order) == "holds"
    assert refinement.verdict(order - 1) == refinement.verdict(order + 1) == "fails"
    assert [r.steps for r in refinement.runs] == sorted({r.steps for r in refinement.runs})


def test_a_run_that_failed_does_not_end_the_climb() -> None:
    def run(n: int) -> Run:
        failed = 10 <= n < 40
        return Run(n, 1 / n, math.inf if failed else float(n) ** -2, "no run" if failed else "")

    refinement = refine(run, 10**4)
    assert [r.steps for r in refinement.clean] == [40, 80, 160, 320]
    assert refinement.verdict(2) == "holds"


SPAN = (Fraction(1), Fraction(5, 2))


@pytest.mark.parametrize(
    ("kinks", "times", "stated", "expected"),
    [
        ((), (), 4, Places()),
        ((2, 2), (1.5, 2.0), 4, Places(3)),
        ((2, 0), (1.5, 1.75), 2, Places(6)),
        ((2,), (1 + 2**-0.5,), 4, Places(known=False)),  # no small multiple ends at an irrational time
        ((2, 2), (1 + 1.5 / 7, 1 + 1.5 / 11), 4, Places(known=False)),  # the unit would be 77
        ((2,), (1.5,), 5, Places(known=False)),  # steps that end at the point hide the reduction of the order
        ((-1,), (1.5,), 1, Places(known=False)),  # rounding of the time decides the side of a jump
        ((2,), (), 4, Places(known=False)),
    ],
)
def test_steps_end_at_points_that_keep_the_order(
    kinks: tuple[int, ...], times: tuple[float, ...], stated: int, expected: Places
) -> None:
    assert Places.of(kinks, times, SPAN, stated) == expected


def test_runs_keep_the_positions_of_the_points_in_their_steps() -> None:
    def run(n: int) -> Run:
        return Run(n, 1 / n, float(n) ** -(9 if n < 40 else 4), "rounding" if n > 40 else "")

    assert all(r.steps % 3 == 0 for r in refine(run, 10**4, places=Places(3)).runs)
    assert [r.steps for r in refine(run, 10**4, places=Places(known=False)).runs] == [5, 10, 20, 40, 80]
    assert len(refine(run, 10**4).runs) > 5
