"""The gallery: one file a scene; and loading a scene by name or from a user's file."""

from __future__ import annotations

import ast
import runpy
import sys
import traceback
from contextlib import redirect_stdout
from dataclasses import replace
from difflib import get_close_matches
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from codegen.errors import SceneError
from codegen.scene.extended_phase_space import extended
from codegen.scene.problem import Problem
from orderconds.errors import InputError, UnknownName
from orderconds.input_file import read_bytes

GALLERY = (
    "actuated_rigid_body",
    "dipole",
    "driven_spin",
    "duffing",
    "duffing_se2",
    "duffing_sl2",
    "fast_heavy_top",
    "free_rigid_body",
    "free_rigid_body_attitude",
    "free_rigid_body_product",
    "free_rigid_body_quaternion",
    "free_rigid_body_s3",
    "heavy_top",
    "linear_oscillator",
    "stiff_driven_spin",
)

EXTENDED = "+u"
"""What asks for the extended scene."""


def load(name: str) -> Problem:
    """Return a scene of the gallery, or the ``scene`` of the Python file at path ``name``.

    ``NAME+u`` is a Hamiltonian scene extended by the time and its momentum
    (:mod:`codegen.scene.extended_phase_space`). A file
    that raises, or defines no scene, is a :class:`SceneError` that names file and line.
    """
    if name.endswith(EXTENDED):
        scene = load(name.removesuffix(EXTENDED))
        return replace(extended(scene), name=scene.name + EXTENDED)
    return _load(name)


def _load(name: str) -> Problem:
    if name in GALLERY:
        scene: Problem = import_module(f"codegen.scenes.{name}").scene
        return replace(scene, name=name)
    path = Path(name)
    if path.suffix != ".py":
        raise UnknownName(
            f"unknown scene {name!r}",
            expected=f"one of {', '.join(GALLERY)}, or the path of a Python file that defines `scene`",
            hint=f"did you mean {close[0]}?" if (close := get_close_matches(name, GALLERY, n=1)) else "",
        )
    read_bytes(path, "a Python file that defines `scene`", error=SceneError)  # regular and of bounded size
    try:
        # What a scene prints is for its author; stdout is for what the command was asked for.
        with redirect_stdout(sys.stderr):
            found = runpy.run_path(str(path)).get("scene")
    except InputError as error:
        at = f"{_line(name, path, error)}: {error.where}"
        raise SceneError(error.found, where=at, expected=error.expected, hint=error.hint) from error
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # also what a scene derives from BaseException, and sys.exit
        at = _line(name, path, error)
        raise SceneError(f"the scene raises {type(error).__name__}: {error}", where=at) from error
    if not isinstance(found, Problem):
        raise SceneError(
            "no scene is defined", where=name, expected="scene = FieldScene(...) or HamiltonianScene(...)"
        )
    return replace(found, name=path.stem)


def _line(name: str, path: Path, error: BaseException) -> str:
    """Return file and line of the user's code where an error arose."""
    lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == str(path)]
    if isinstance(error, SyntaxError) and error.lineno is not None:
        lines.append(error.lineno)
    return f"{name}:{lines[-1]}" if lines else name


def about(name: str) -> str:
    """Return what the file of a scene says of it: its docstring.

    ``name`` is one that :func:`load` takes; a file without a docstring gives ''.
    """
    name = name.removesuffix(EXTENDED)
    spec = find_spec(f"codegen.scenes.{name}") if name in GALLERY else None
    path = Path(spec.origin) if spec is not None and spec.origin else Path(name)
    return ast.get_docstring(ast.parse(read_bytes(path, error=SceneError))) or ""


def listing() -> list[dict[str, str]]:
    """Return name and title of every scene of the gallery, for ``orderconds list scenes``."""
    return [{"name": n, "about": load(n).title} for n in GALLERY]
