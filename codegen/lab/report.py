"""The report: measure scenes, then write a page for each scene and an overview page. Each file is written
atomically.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from codegen import scenes
from codegen.artifact import write_text, writing
from codegen.build import find_compiler
from codegen.command_names import bare, quoted
from codegen.lab.default_methods import REPORT_SCENES
from codegen.lab.measurement_cache import FOLDER, MeasurementCache
from codegen.lab.page.documents import OVERVIEW, page_name, render, render_overview
from codegen.lab.progress import Progress
from codegen.lab.registry import selected
from codegen.lab.scene_results import SceneResults, measure_scene
from codegen.lab.subject import EFFORTS, Subject, subject
from orderconds.errors import InputError
from orderconds.input_file import reason


@dataclass(frozen=True)
class Request:
    """A report as the user requests it: names of scenes, methods, peers, measurements and effort."""

    scenes: tuple[str, ...] = ()
    methods: tuple[str, ...] = ()
    peers: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    effort: str = "usual"
    adaptive: tuple[str, ...] = ()

    def subjects(self) -> tuple[Subject, ...]:
        """Return the subject of each page. An unknown name raises InputError before the first measurement."""
        names = dict.fromkeys(self.scenes or REPORT_SCENES)
        chosen = [(name, scenes.with_one_system(scenes.load(name))) for name in names]
        selected(self.parts)
        effort = EFFORTS[self.effort].shared(len(chosen))
        return tuple(
            subject(name, scene, self.methods, self.peers, effort, self.adaptive) for name, scene in chosen
        )

    def command(self) -> str:
        """Return the command line that writes this report."""
        words = ["orderconds report", *(quoted(bare(scene)) for scene in self.scenes)]
        words += [f"-m {quoted(bare(m))}" for m in self.methods]
        words += [f"--adaptive {quoted(bare(m))}" for m in self.adaptive]
        words += [f"-a {peer}" for peer in self.peers]
        words += [f"--only {part}" for part in self.parts]
        words += [] if self.effort == "usual" else [f"--{self.effort}"]
        return " ".join([*words, "-o DIR"])


def report(
    request: Request, directory: str | Path, progress: Progress
) -> tuple[Path, tuple[SceneResults, ...]]:
    """Measure all scenes, write the pages into a folder, and return the path of the overview and the results.

    The page of a scene is written as soon as it is complete. A hidden folder stores the results until the
    report is complete, so that an interrupted report can continue. :class:`InputError` is raised before the
    first measurement if a name is unknown, if there is no C compiler, or if the folder cannot be written to.
    """
    folder = Path(directory)
    subjects = request.subjects()
    find_compiler()
    write_file(folder / OVERVIEW, None)
    cache = MeasurementCache(folder / FOLDER)
    results: list[SceneResults] = []
    for planned in subjects:
        page = measure_scene(replace(planned, cache=cache, progress=progress), selected(request.parts))
        results.append(page)
        write_file(folder / page_name(page), render(page, request.command()))
        for measured in page.measured:
            for name, text in measured.files().items():
                write_file(folder / name, text)
    overview = write_file(folder / OVERVIEW, render_overview(results, request.command()))
    cache.remove()
    return overview, tuple(results)


def write_file(path: Path, text: str | None) -> Path:
    """Write a file atomically and return its path. If ``text`` is None, only test that the folder can be
    written to.
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
    """Return the named scenes, or the whole gallery."""
    return scenes.GALLERY if everything else tuple(names)
