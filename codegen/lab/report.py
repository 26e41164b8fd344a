"""Tests integrators on scenes, and writes a report: an HTML page for each scene, and an overview page.

A file is written completely or not at all. Scenes are measured in parallel, each scene in its own process.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from codegen import scenes
from codegen.artifact import write_text, writing
from codegen.build import find_compiler
from codegen.command_names import bare, quoted
from codegen.lab.default_methods import REPORT_SCENES
from codegen.lab.measurement_cache import FOLDER, MeasurementCache
from codegen.lab.page.documents import OVERVIEW, Summary, page_name, render, render_overview, summary
from codegen.lab.progress import Progress
from codegen.lab.registry import selected
from codegen.lab.scene_results import measure_scene
from codegen.lab.subject import EFFORTS, Subject, subject
from orderconds.errors import InputError
from orderconds.input_file import reason
from orderconds.processes import in_processes


@dataclass(frozen=True)
class Request:
    """The options of the command ``report``. If an option is an empty tuple, its default value is used.

    - ``scenes``: the names of scenes, by default :data:`REPORT_SCENES`.
    - ``methods``: the names of the methods to run with equal steps.
    - ``peers``: the names of other integrators for comparison.
    - ``parts``: the names of the measurements to make, by default all measurements.
    - ``effort``: ``quick``, ``usual`` or ``full``, a key of :data:`EFFORTS`.
    - ``adaptive``: the names of the methods to run with step-size control.
    - ``processes``: the number of scenes measured at the same time, by default the number of processors.
    """

    scenes: tuple[str, ...] = ()
    methods: tuple[str, ...] = ()
    peers: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    effort: str = "usual"
    adaptive: tuple[str, ...] = ()
    processes: int | None = None

    def names(self) -> tuple[str, ...]:
        """Return the names of the scenes, each name once."""
        return tuple(dict.fromkeys(self.scenes or REPORT_SCENES))

    def together(self) -> int:
        """Return the number of scenes that are measured at the same time."""
        return min(len(self.names()), self.processes or os.cpu_count() or 1)

    def subject(self, name: str) -> Subject:
        """Return the input of all measurements on a scene: the scene, and the methods and peers to measure.

        Raises InputError if the name of a scene, method or peer is unknown.
        """
        effort = EFFORTS[self.effort].shared(len(self.names()), self.together())
        scene = scenes.with_one_system(scenes.load(name))
        return subject(name, scene, self.methods, self.peers, effort, self.adaptive)

    def check(self) -> None:
        """Raise InputError if the name of a scene, method, peer or measurement is unknown."""
        selected(self.parts)
        for name in self.names():
            self.subject(name)

    def command(self) -> str:
        """Return the command line that writes this report."""
        words = ["orderconds report", *(quoted(bare(scene)) for scene in self.scenes)]
        words += [f"-m {quoted(bare(m))}" for m in self.methods]
        words += [f"--adaptive {quoted(bare(m))}" for m in self.adaptive]
        words += [f"-a {peer}" for peer in self.peers]
        words += [f"--only {part}" for part in self.parts]
        words += [] if self.effort == "usual" else [f"--{self.effort}"]
        return " ".join([*words, "-o DIR"])


@dataclass(frozen=True)
class ScenePage:
    """The results of one scene as plain data.

    - ``summary``: the results for the overview page.
    - ``lines``: the lines for the terminal.
    - ``json``: the results for the JSON output of the command ``report``.
    - ``held``: True if all measurements succeeded and passed their checks.
    """

    summary: Summary
    lines: tuple[str, ...]
    json: object
    held: bool


def report(request: Request, directory: str | Path, progress: Progress) -> tuple[Path, tuple[ScenePage, ...]]:
    """Measure all scenes and write the pages into a folder.

    Returns the path of the overview page, and the results of each scene. After an interruption, the next call
    reuses the results stored in the folder. If there is only one scene, ``progress`` is called before each
    measurement. If there are several scenes, ``progress`` is called after each scene. Before the first
    measurement, :class:`InputError` is raised if a name is unknown, if there is no C compiler, or if the
    folder cannot be written to.
    """
    folder = Path(directory)
    request.check()
    find_compiler()
    write_file(folder / OVERVIEW, None)
    cache = MeasurementCache(folder / FOLDER)
    names = request.names()
    alone = len(names) == 1
    jobs = [(request, name, str(folder)) for name in names]
    pages: list[ScenePage] = []
    work = partial(_page, progress=progress) if alone else _page
    for name, page in zip(names, in_processes(work, jobs, request.together()), strict=True):
        if not alone:
            progress(name)
        pages.append(page)
    overview = write_file(folder / OVERVIEW, render_overview([p.summary for p in pages], request.command()))
    cache.remove()
    return overview, tuple(pages)


def _page(job: tuple[Request, str, str], progress: Progress = str) -> ScenePage:
    """Measure the scene of a ``job`` (request, name of the scene, path of the folder) and write its page."""
    request, name, folder = job[0], job[1], Path(job[2])
    planned = replace(request.subject(name), cache=MeasurementCache(folder / FOLDER), progress=progress)
    results = measure_scene(planned, selected(request.parts))
    write_file(folder / page_name(results), render(results, request.command()))
    for measured in results.measured:
        for file, text in measured.files().items():
            write_file(folder / file, text)
    lines = tuple(line for measured in results.measured for line in measured.lines())
    return ScenePage(summary(results), lines, results.as_json(), results.held)


def write_file(path: Path, text: str | None) -> Path:
    """Write a file completely or not at all, and return its path.

    If ``text`` is None, the function only tests whether files can be written into the folder of ``path``.
    Raises InputError if the write or the test fails.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if text is None:
            with tempfile.TemporaryFile(dir=path.parent):
                return path
        with writing(path.parent):
            write_text(path, text)
    except OSError as error:
        raise InputError(
            f"cannot write to this path: {reason(error)}",
            where=str(path.parent),
            expected="a folder that can be written to",
        ) from None
    return path


def read_scenes(names: Sequence[str], everything: bool) -> tuple[str, ...]:
    """Return ``names``, or the names of all scenes of the gallery if ``everything`` is True."""
    return scenes.GALLERY if everything else tuple(names)
