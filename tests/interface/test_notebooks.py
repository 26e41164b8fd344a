"""The notebooks of the examples run, and show conditions, tableaux, trees and verdicts as a paper would."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
PAPER = ROOT / "examples" / "paper.ipynb"


def outputs(notebook: dict[str, Any]) -> list[dict[str, str]]:
    """The shown objects, each as texts by media type; a printed text has the type ``stream``."""
    shown = []
    for cell in notebook["cells"]:
        for output in cell.get("outputs", ()):
            assert output["output_type"] != "error"
            texts = output.get("data", {"stream": output.get("text", "")})
            shown.append({kind: "".join(text) for kind, text in texts.items()})
    return shown


def stored() -> list[dict[str, str]]:
    return outputs(json.loads(PAPER.read_text(encoding="utf-8")))


def test_the_notebook_shows_conditions_tableaux_trees_and_a_verdict() -> None:
    shown = stored()
    assert any(r"\sum_{i} b_{i} c_{i}" in x.get("text/latex", "") and "text/html" not in x for x in shown)
    assert any(r"\begin{array}{c|cc}" in x.get("text/latex", "") for x in shown)
    assert any(x.get("image/svg+xml", "").count("<circle") == 9 * 5 for x in shown)
    assert any("<b>classical</b>: holds" in x.get("text/html", "") for x in shown)
    assert any("<b>wrong</b>: fails" in x.get("text/html", "") for x in shown)


@pytest.mark.filterwarnings("ignore")  # of the packages that run notebooks
def test_running_the_notebook_gives_the_stored_outputs() -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(PAPER, as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(ROOT)}}).execute()
    assert outputs(notebook) == stored()
