"""The report: survey scenes, lay their pages and the overview out, and put each in place whole."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from codegen import scenes
from codegen.emitter import bare, quoted
from codegen.lab.bench import table
from codegen.lab.page import OVERVIEW, page_name, render, render_overview
from codegen.lab.records import FOLDER, Records
from codegen.lab.study import Tell
from codegen.lab.survey import FULL, PARTS, QUICK, USUAL, Effort, Plan, Survey, plan, survey
from orderconds.errors import InputError

SCENES = ("dipole", "free_rigid_body")
"""The scenes that are surveyed where nobody chose: a Hamiltonian and a field."""

EFFORTS = {"quick": QUICK, "usual": USUAL, "full": FULL}


@dataclass(frozen=True)
class Request:
    """What is to be reported: scenes, methods, peers and parts as spelled, and the name of the effort."""

    scenes: tuple[str, ...] = ()
    methods: tuple[str, ...] = ()
    peers: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    effort: str = "usual"
    adaptive: tuple[str, ...] = ()

    def plans(self) -> tuple[Plan, ...]:
        """Return the plan of each scene; a mistake in any name shows here, before anything is measured."""
        effort: Effort = EFFORTS[self.effort]
        chosen = [(name, scenes.load(name)) for name in dict.fromkeys(self.scenes or SCENES)]
        return tuple(
            plan(name, scene, self.methods, self.peers, effort, self.parts or PARTS, self.adaptive)
            for name, scene in chosen
        )

    def command(self) -> str:
        """Return the command of this report."""
        words = ["orderconds report", *(quoted(bare(scene)) for scene in self.scenes)]
        words += [f"-m {quoted(bare(m))}" for m in self.methods]
        words += [f"--adaptive {quoted(bare(m))}" for m in self.adaptive]
        words += [f"-a {peer}" for peer in self.peers]
        words += [f"--only {part}" for part in self.parts]
        words += [] if self.effort == "usual" else [f"--{self.effort}"]
        return " ".join([*words, "-o DIR"])


def report(request: Request, directory: str | Path, tell: Tell) -> tuple[Path, tuple[Survey, ...]]:
    """Measure, write the pages into a folder, and return the path of the overview with the surveys.

    A scene's page is there as soon as the scene is done. What an interrupted report had measured is kept in
    the folder until the report is whole. :class:`InputError` where the folder cannot be written to; that is
    found out before the measuring.
    """
    folder = Path(directory)
    plans = request.plans()
    place(folder / OVERVIEW, None)
    records = Records(folder / FOLDER)
    surveys: list[Survey] = []
    for planned in plans:
        found = survey(planned, tell, records)
        surveys.append(found)
        place(folder / page_name(found), render(found, request.command()))
        if found.cost:
            place(folder / f"{found.scene.name}.csv", table(found.cost.rows))
    overview = place(folder / OVERVIEW, render_overview(surveys, request.command()))
    records.close()
    return overview, tuple(surveys)


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


def read_scenes(names: Sequence[str], everything: bool) -> tuple[str, ...]:
    """Return the scenes asked for: those named, or the whole gallery."""
    return scenes.GALLERY if everything else tuple(names)
