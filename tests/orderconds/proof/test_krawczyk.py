"""Krawczyk's operator proves one zero in a box, and nothing where there is none, or two, or a flat one."""

from __future__ import annotations

import pytest
from flint import arb

from orderconds.proof.krawczyk import NotProved, enclose
from orderconds.ring.precision import precision


def circle_and_line(x, ring):  # type: ignore[no-untyped-def]
    return [x[0] * x[0] + x[1] * x[1] - 1, x[0] - x[1]]


def test_the_zero_of_a_regular_system_is_enclosed_to_the_working_precision() -> None:
    for x in enclose(circle_and_line, [arb(0.7071, 1e-3), arb(0.7071, 1e-3)], 300):
        with precision(300):
            assert (x * x * 2 - 1).contains(0)
            assert x.rad() < arb(10) ** -80


def test_a_box_beside_the_zero_gives_no_proof() -> None:
    with pytest.raises(NotProved, match="does not map the box into itself"):
        enclose(circle_and_line, [arb(0.70, 1e-3), arb(0.70, 1e-3)], 300)


def test_a_box_with_two_zeros_gives_no_proof() -> None:
    with pytest.raises(NotProved):
        enclose(lambda x, ring: [x[0] * x[0] - 2], [arb(0.1, 2)], 128)


def test_a_double_zero_gives_no_proof() -> None:
    with pytest.raises(NotProved):
        enclose(lambda x, ring: [x[0] * x[0]], [arb(0, 1e-3)], 128)


def test_more_equations_than_unknowns_give_no_proof() -> None:
    with pytest.raises(NotProved, match="2 equations for 1 unknowns"):
        enclose(lambda x, ring: [x[0] - 1, x[0] - 1], [arb(1, 1e-3)], 128)
