"""Methods on which the laws are tried: published ones, and random ones with rational coefficients."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from orderconds.ring import QQ
from orderconds.tableau import CommutatorFree, RungeKutta, Stage

Numbers = list[str]


def rational(written: str) -> object:
    p, _, q = written.partition("/")
    return QQ.rational(int(p), int(q or 1))


def runge_kutta(rows: list[Numbers], b: Numbers) -> RungeKutta:
    filled = [row + ["0"] * (len(b) - len(row)) for row in rows]
    return RungeKutta(tuple(tuple(map(rational, row)) for row in filled), tuple(map(rational, b)))


def exponentials(rows: list[Numbers], stages: int, start: int | None = None) -> Stage:
    filled = [row + ["0"] * (stages - len(row)) for row in rows]
    return Stage(start, tuple(tuple(map(rational, row)) for row in filled))


@pytest.fixture(scope="session")
def tableaux() -> dict[str, RungeKutta]:
    """Published Runge-Kutta tableaux with rational coefficients (HLW II.1 and Table IV.8.1)."""
    return {
        "euler": runge_kutta([[]], ["1"]),
        "midpoint": runge_kutta([["1/2"]], ["1"]),
        "heun": runge_kutta([[], ["1"]], ["1/2", "1/2"]),
        "kutta3": runge_kutta([[], ["1/2"], ["-1", "2"]], ["1/6", "2/3", "1/6"]),
        "rk4": runge_kutta([[], ["1/2"], ["0", "1/2"], ["0", "0", "1"]], ["1/6", "1/3", "1/3", "1/6"]),
        "cg3": runge_kutta([[], ["3/4"], ["119/216", "17/108"]], ["13/51", "-2/3", "24/17"]),
        "cg3b": runge_kutta([[], ["-1/24"], ["161/24", "-6"]], ["1", "-2/3", "2/3"]),
        "cg3 with its third row exchanged": runge_kutta(
            [[], ["3/4"], ["17/108", "119/216"]], ["13/51", "-2/3", "24/17"]
        ),
        "cg3 with b reversed": runge_kutta([[], ["3/4"], ["119/216", "17/108"]], ["24/17", "-2/3", "13/51"]),
    }


@pytest.fixture(scope="session")
def commutator_free() -> dict[str, CommutatorFree]:
    """CF3 and CF4 of Celledoni, Marthinsen and Owren, and CF4 with the factors of its update swapped."""
    cf3 = CommutatorFree(
        (exponentials([], 3), exponentials([["1/3"]], 3), exponentials([["0", "2/3"]], 3)),
        exponentials([["1/3"], ["-1/12", "0", "3/4"]], 3),
    )
    stages = (
        exponentials([], 4),
        exponentials([["1/2"]], 4),
        exponentials([["0", "1/2"]], 4),
        exponentials([["-1/2", "0", "1"]], 4, start=1),
    )
    rows = [["1/4", "1/6", "1/6", "-1/12"], ["-1/12", "1/6", "1/6", "1/4"]]
    return {
        "cf3": cf3,
        "cf4": CommutatorFree(stages, exponentials(rows, 4)),
        "cf4 with its factors swapped": CommutatorFree(stages, exponentials(rows[::-1], 4)),
    }


@pytest.fixture
def random_rational() -> Callable[[], object]:
    """Random small rationals, never zero."""
    numbers = random.Random(20240611)
    return lambda: QQ.rational(numbers.choice([-5, -4, -3, -2, -1, 1, 2, 3, 4, 5]), numbers.randint(1, 4))


@pytest.fixture
def random_tableau(random_rational: Callable[[], object]) -> Callable[[int], RungeKutta]:
    """Full (implicit) tableaux with random rational coefficients."""

    def make(stages: int) -> RungeKutta:
        rows = [tuple(random_rational() for _ in range(stages)) for _ in range(stages + 1)]
        return RungeKutta(tuple(rows[:-1]), rows[-1])

    return make


@pytest.fixture
def random_commutator_free(random_rational: Callable[[], object]) -> CommutatorFree:
    """Implicit stages of one, two and two exponentials, the last starting from the first; two at the end."""

    def row() -> tuple[object, ...]:
        return tuple(random_rational() for _ in range(3))

    stages = (Stage(None, (row(),)), Stage(None, (row(), row())), Stage(0, (row(), row())))
    return CommutatorFree(stages, Stage(None, (row(), row())))
