"""Measure the work-precision diagrams of docs/, and write the pictures and the table from the same runs.

    python benchmarks/pictures.py [PICTURE...]

The methods of each picture are listed in ``codegen/lab/default_methods.py``. Each picture is written to
docs/pictures. If a table follows the picture in docs/reference, its rows are replaced. Measure on a quiet
machine.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from pathlib import Path

from codegen.lab.default_methods import README_METHODS, REPORT_ADAPTIVE
from codegen.lab.efficiency.bench import Result, bench, picture
from codegen.lab.efficiency.ranking import Place
from codegen.lab.page.formatting import duration
from codegen.printers import DEFAULT

DOCS = Path(__file__).resolve().parents[1] / "docs"
FOLDER = DOCS / "pictures"
PAGES = sorted((DOCS / "reference").glob("*.md"))
BUDGET = 0.05
HEAD = ("| error | fastest | CPU time | next | times slower |", "|---|---|---|---|---|")


PEERS = {"dipole": ("heyoka", "c-dop853")}


def measure(name: str) -> Result:
    """Return the measured rows of a picture."""
    methods = README_METHODS[name]
    fixed, adaptive = ([m for m in methods if (m in REPORT_ADAPTIVE) is kind] for kind in (False, True))
    planned = bench("dipole", fixed, [DEFAULT], PEERS.get(name, ()), BUDGET, None, str, adaptive)
    return planned.run(lambda row: print(f"{row.method}: {row.control:g}", flush=True))


def table(places: Sequence[Place]) -> list[str]:
    """Return the table below a picture: the fastest candidate for each error."""
    rows = [
        f"| 1e-{p.decade} | {p.winner} | {duration(p.seconds)} | {p.second} "
        f"| {'' if p.behind is None else format(p.behind / p.seconds, '.2f')} |"
        for p in places
    ]
    return [*HEAD, *rows]


def with_table(text: str, name: str, lines: Sequence[str]) -> str:
    """Return ``text`` with ``lines`` in place of the table that follows the picture ``name``.

    The text is unchanged if there is no table with the same head directly after the picture.
    """
    pattern = rf"(/pictures/{name}\.svg\)\n\n){re.escape(HEAD[0])}\n(?:\|.*\n)*"
    rows = "".join(f"{line}\n" for line in lines)
    return re.sub(pattern, lambda match: match[1] + rows, text)


def main() -> None:
    """Measure the named pictures, by default all, and write them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pictures", nargs="*", default=[*README_METHODS], metavar="PICTURE")
    for name in parser.parse_args().pictures:
        result = measure(name)
        (FOLDER / f"{name}.svg").write_text(picture(result), encoding="utf-8")
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            page.write_text(with_table(text, name, table(result.places)), encoding="utf-8")


if __name__ == "__main__":
    main()
