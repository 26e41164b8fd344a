"""Rows of constant tables in C."""

from __future__ import annotations

from codegen.printers.c.functions import _without_zeros


def test_only_zeros_at_the_end_of_a_row_are_omitted() -> None:
    assert _without_zeros(["1.0", "0.0", "0.05", "0.0", "-0.0f"]) == "1.0, 0.0, 0.05"
    assert _without_zeros(["0.0f", "0.0f"]) == "0.0f"
