"""LaTeX output is compiled in a two-column article, without errors and without lines that are too wide."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from orderconds import Tableau, derive
from orderconds.tableau.library import available

PREAMBLE = (
    "\\documentclass[twocolumn]{article}\n\\usepackage{amsmath,tikz}\n\\usetikzlibrary{shapes.geometric}\n"
)


def texts() -> dict[str, str]:
    families = {"rk": 4, "cf": 3, "vcg": 3, "sprk": 3, "splitting": 3, "magnus": 4, "rkn": 4, "rkmk(1)": 3}
    conditions = {family: derive(family, order).latex() for family, order in families.items()}
    return conditions | {name: rf"{Tableau.load(name)._repr_latex_()}\clearpage" for name in available()}


@pytest.mark.slow
def test_conditions_and_every_tableau_of_the_library_fit_in_two_columns(tmp_path: Path) -> None:
    if shutil.which("pdflatex") is None:
        pytest.skip("no LaTeX")
    body = "\n\n".join(texts().values())
    (tmp_path / "all.tex").write_text(f"{PREAMBLE}\\begin{{document}}\n{body}\n\\end{{document}}\n")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "all.tex"]
    for _ in range(2):  # the second run knows the labels
        result = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=60)
    printed = result.stdout.decode(errors="replace")
    assert re.findall(r"^(?:!|Overfull|LaTeX Warning: Ref).*", printed, re.MULTILINE) == []
    assert result.returncode == 0
