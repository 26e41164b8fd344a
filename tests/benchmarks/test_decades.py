"""The table of the fastest methods at each decade: the verdict names every row that is not won."""

from __future__ import annotations

from pathlib import Path

from benchmarks import decades


def row(
    scene: str, error: float, ours: float | None, heyoka: float | None, *, complete: bool = True
) -> dict[str, object]:
    ratio = None if ours is None or heyoka is None else heyoka / ours
    return {
        "scene": scene,
        "error": error,
        "method": "cf:cf4" if ours else "",
        "seconds": ours,
        "heyoka": "heyoka" if heyoka else "",
        "heyoka ratio": ratio,
        "c-dop853": "",
        "c-dop853 ratio": None,
        "complete": complete,
    }


ROWS = [
    row("won", 1e-4, 1.0, 2.0),
    row("alone", 1e-5, 1.0, None),
    row("lost", 1e-8, 1.0, 0.5),
    row("stopped", 1e-8, 1.0, 0.5, complete=False),
    row("missed", 1e-12, None, None),
]


def test_the_verdict_names_the_rows_that_are_not_won() -> None:
    assert decades.verdict(ROWS).split("\n") == [
        "The emitted method is at least as fast as the peers in 2 of 5 cases.",
        "A peer is faster: lost at 1e-08 (all methods of the library were compared); "
        "stopped at 1e-08 (the search ended at its time limit).",
        "No emitted method reaches the error: missed at 1e-12 (all methods of the library were compared).",
    ]
    assert decades.verdict(ROWS[:1]).endswith("in 1 of 1 cases.")


def test_the_table_replaces_the_earlier_table_and_nothing_else(tmp_path: Path) -> None:
    page = tmp_path / "README.md"
    page.write_text(f"before\n\n{decades.MARK}\nearlier\n{decades.END}\n\nafter\n", encoding="utf-8")
    decades.write(ROWS, page)
    first = page.read_text(encoding="utf-8")
    assert first.startswith("before\n")
    assert first.endswith("\n\nafter\n")
    assert "earlier" not in first
    assert "| lost | 1e-08 | cf:cf4 |" in first
    assert "**0.50**" in first
    decades.write(ROWS, page)
    assert page.read_text(encoding="utf-8") == first
