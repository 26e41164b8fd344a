"""The report: measure scenes, lay the page out, and put it in place whole."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from pathlib import Path

from codegen import scenes
from codegen.emit import bare, quoted
from codegen.lab.page import render
from codegen.lab.study import Study, Tell, methods_for, study
from orderconds.errors import InputError

PAGE = "index.html"

USUAL = ("dipole", "free_rigid_body")
"""The scenes that are studied where nobody chose: a Hamiltonian and a field, in under a minute."""


def measure(names: Sequence[str], spellings: Sequence[str], tell: Tell) -> tuple[Study, ...]:
    """Study scenes (:data:`USUAL` where none is named), with the methods named or the usual ones.

    Names and spellings are read before anything is measured, so that a mistake shows at once.
    """
    chosen = [(name, scenes.load(name)) for name in (names or USUAL)]
    planned = [(name, scene, methods_for(scene, spellings)) for name, scene in chosen]
    return tuple(study(name, scene, methods, tell) for name, scene, methods in planned)


def report(
    names: Sequence[str], spellings: Sequence[str], directory: str | Path, tell: Tell
) -> tuple[Path, tuple[Study, ...]]:
    """Measure, write the page into a folder, and return its path with the studies.

    :class:`InputError` where the folder cannot be written to; that is found out before the measuring.
    """
    folder = Path(directory)
    place(folder / PAGE, None)
    studies = measure(names, spellings, tell)
    tell("writing the page")
    words = ["orderconds report", *map(bare, names), *(f"-m {quoted(bare(s))}" for s in spellings), "-o DIR"]
    return place(folder / PAGE, render(studies, " ".join(words))), studies


def place(path: Path, text: str | None) -> Path:
    """Write a text under a temporary name and move it into place; None only tries whether that works."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=".report-") as made:
            whole = Path(made) / path.name
            whole.write_text(text or "", encoding="utf-8", newline="\n")
            if text is not None:
                os.replace(whole, path)
    except OSError as error:
        raise InputError(
            f"cannot write there: {error.strerror}",
            where=str(path.parent),
            expected="a folder that can be written to",
        ) from None
    return path
