"""The picture and the table of the README come from the same rows."""

from __future__ import annotations

from benchmarks import pictures
from codegen.lab.default_methods import README_METHODS
from codegen.lab.efficiency.ranking import Place

PLACES = (
    Place(2, "rkmk:rk4", 4.1e-7, "vcg:midpoint", 5.33e-7),
    Place(4, "heyoka (as printed)", 2e-6),
)
ROWS = [
    "| 1e-2 | rkmk:rk4 | 410 ns | vcg:midpoint | 1.30 |",
    "| 1e-4 | heyoka (as printed) | 2 µs |  |  |",
]
TABLE = "\n".join(pictures.HEAD) + "\n| 1e-2 | old | 1 s | x | 2 |\n"


def test_the_table_has_a_row_for_each_accuracy() -> None:
    assert pictures.table(PLACES) == [*pictures.HEAD, *ROWS]


def test_the_table_after_the_picture_is_replaced_and_nothing_else() -> None:
    text = f"a\n\n{TABLE}\n![b](../pictures/dipole.svg)\n\n{TABLE}\nc\n"
    new = pictures.with_table(text, "dipole", pictures.table(PLACES))
    rows = "\n".join([*pictures.HEAD, *ROWS])
    assert new == f"a\n\n{TABLE}\n![b](../pictures/dipole.svg)\n\n{rows}\n\nc\n"
    assert pictures.with_table(text, "discoveries", pictures.table(PLACES)) == text


def test_the_pages_show_every_picture_and_the_table_of_the_dipole() -> None:
    pages = "".join(page.read_text(encoding="utf-8") for page in pictures.PAGES)
    for name in README_METHODS:
        assert f"(../pictures/{name}.svg)" in pages
        assert (pictures.FOLDER / f"{name}.svg").is_file()
    assert pictures.with_table(pages, "dipole", pictures.table(PLACES)) != pages
