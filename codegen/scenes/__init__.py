"""The gallery: the scenes of this package, with one file for each scene.

The function :func:`load` returns a scene of the gallery, a registered scene, or the scene of a Python file.
"""

from __future__ import annotations

import ast
import re
import runpy
import sys
import traceback
from collections.abc import Sequence
from contextlib import redirect_stdout
from dataclasses import replace
from difflib import get_close_matches
from importlib import import_module
from importlib.util import find_spec
from os import PathLike, fspath
from pathlib import Path

from codegen.errors import SceneError
from codegen.scene.extended_phase_space import extended
from codegen.scene.figure import read_figures
from codegen.scene.problem import Problem
from codegen.scene.run_time import with_runtime
from codegen.scene.stiff_variant import StiffVariant
from codegen.scenes.neighbours import neighbours_of
from orderconds.argument import described
from orderconds.errors import InputError, UnknownName
from orderconds.input_file import read_bytes

GALLERY = (
    "actuated_rigid_body",
    "allen_cahn",
    "body_in_fluid",
    "circle",
    "coupled_rigid_bodies",
    "dipole",
    "driven_spin",
    "duffing",
    "duffing_se2",
    "duffing_sl2",
    "fast_heavy_top",
    "four_level_system",
    "free_rigid_body",
    "free_rigid_body_attitude",
    "free_rigid_body_product",
    "free_rigid_body_quaternion",
    "free_rigid_body_s3",
    "heavy_top",
    "independent_components",
    "inertial_navigation",
    "linear_oscillator",
    "linear_oscillator_sl2",
    "lyapunov_exponents",
    "planar_body_in_fluid",
    "principal_components",
    "satellite",
    "stiff_driven_spin",
    "toda_lattice",
    "torus_gradient_flow",
    "wilson_flow",
)

LATTICES = (
    "body_chain",
    "free_rod",
    "pipe_laying",
    "spin_lattice",
    "swinging_rod",
    "wilson_lattice",
)
"""The scenes of chains and lattices, which do not fix the number of sites."""

SEMILINEAR = ("allen_cahn_periodic", "kuramoto_sivashinsky")
"""The scenes of semilinear equations whose linear operator is given by its Fourier symbol.

These scenes do not fix the number of grid points.
"""

BUILT_IN = frozenset((*GALLERY, *LATTICES, *SEMILINEAR))
"""The names of all scenes of the package."""

EXTENDED = "+u"
"""The suffix in the name of a scene on the extended phase space."""

_REGISTERED: dict[str, tuple[Problem, str]] = {}
"""The registered scenes and their descriptions, by the name of the scene."""


def register(name: str, scene: Problem, about: str = "") -> Problem:
    """Register a copy of the scene with the name ``name`` in this process, and return the copy.

    ``about`` describes the scene in reports. If the name is already registered, the new scene replaces the
    old scene. :class:`SceneError` is raised for an object that is not a scene, for the name of a built-in
    scene, and for a name that is not an identifier.
    """
    if not isinstance(scene, Problem):
        raise SceneError(f"cannot register {scene!r}", where=name, expected="a scene")
    if name in BUILT_IN or not name.isidentifier():
        raise SceneError(f"the name {name!r}", expected="an identifier, but not the name of a built-in scene")
    named = _named(scene, name)
    _REGISTERED[name] = (named, about)
    return named


def unregister(name: str) -> None:
    """Remove a scene that :func:`register` added. If there is no such scene, do nothing."""
    _REGISTERED.pop(name, None)


def names() -> tuple[str, ...]:
    """Return the names of the scenes in GALLERY and of all registered scenes."""
    return (*GALLERY, *_REGISTERED)


def every_name() -> tuple[str, ...]:
    """Return the names of all registered scenes and of all built-in scenes.

    >>> "dipole" in every_name() and "spin_lattice" in every_name()
    True
    """
    return (*names(), *LATTICES, *SEMILINEAR)


def load(name: str) -> Problem:
    """Return the scene with the given name.

    ``name`` is the name of a built-in scene, the name of a registered scene, or the path of a Python file
    that defines the variable ``scene``. ``NAME+u`` is the scene NAME on the extended phase space
    (:mod:`codegen.scene.extended_phase_space`). The scene NAME must then be Hamiltonian or linear, and must
    depend on time. ``NAME[alpha=1/2,eps=3]`` is the scene NAME with the parameter values alpha = 1/2 and
    eps = 3. :class:`SceneError` is raised if the file fails or defines no scene.

    >>> load("driven_spin[nu=3/5]").parameters["nu"].text()
    '3/5'
    """
    base, bracket, values = name.removesuffix("]").partition("[")
    if bracket and name.endswith("]"):
        changed = with_runtime(load(base), values.split(","))
        named = ",".join(f"{parameter}={value}" for parameter, value in changed.fixed)
        return replace(changed, name=f"{changed.name}[{named}]")
    if name.endswith(EXTENDED):
        scene = load(name.removesuffix(EXTENDED))
        return replace(extended(scene), name=scene.name + EXTENDED)
    return _load(name)


def problem_of(scene: Problem | str | PathLike[str]) -> Problem:
    """Return the argument if it is a problem. Otherwise return the scene with the name or path ``scene``.

    >>> problem_of("dipole").name
    'dipole'
    """
    if isinstance(scene, Problem):
        return scene
    if not isinstance(scene, str | PathLike):
        raise SceneError(
            described(scene),
            where="scene",
            expected="a scene, the name of a scene, or the path of a Python file",
        )
    return load(fspath(scene))


def with_one_system(scene: Problem) -> Problem:
    """Return ``scene`` if it has a fixed number of coordinates.

    :class:`SceneError` is raised for a chain or lattice, and for a semilinear scene without a fixed number of
    grid points.

    >>> with_one_system(load("dipole")).name
    'dipole'
    """
    if scene.sites is not None:
        raise SceneError(
            "the scene is a chain or lattice without a fixed number of sites",
            where=scene.name,
            expected="a scene with a fixed number of coordinates",
            hint="emit the scene, and run it for arrays of states with codegen.load_lattice",
        )
    if scene.semilinear is not None:
        raise SceneError(
            "the scene is a semilinear equation without a fixed number of grid points",
            where=scene.name,
            expected="a scene with a fixed number of coordinates",
            hint="emit the scene, and run it for any number of points with codegen.load_spectral",
        )
    return scene


def with_values(name: str, parameters: Sequence[str]) -> str:
    """Return the name of the scene ``name`` with new parameter values.

    Each entry of ``parameters`` is a text ``NAME=VALUE``. :class:`SceneError` is raised for an entry without
    an equals sign.

    >>> with_values("driven_spin", ["nu=3/5"]), with_values("dipole", [])
    ('driven_spin[nu=3/5]', 'dipole')
    """
    for text in parameters:
        if "=" not in text:
            raise SceneError(
                f"the parameter {text!r} has no value",
                where="--parameter",
                expected="NAME=VALUE, such as eps=3/5",
            )
    return f"{name}[{','.join(parameters)}]" if parameters else name


def file_stem(scene: Problem) -> str:
    """Return the name of a scene for use in file names.

    >>> file_stem(load("driven_spin[nu=3/5]")), file_stem(load("linear_oscillator+u"))
    ('driven_spin_nu=3_5', 'linear_oscillator+u')
    """
    return re.sub(r"[^\w+=.-]+", "_", scene.name, flags=re.ASCII).rstrip("_")


def _load(name: str) -> Problem:
    if name in BUILT_IN:
        module = import_module(f"codegen.scenes.{name}")
        scene: Problem = module.scene
        return replace(scene, name=name, figures=read_figures(name, vars(module).get("figures", ())))
    if name in _REGISTERED:
        return _REGISTERED[name][0]
    path = Path(name)
    known = every_name()
    if path.suffix != ".py":
        raise UnknownName(
            f"unknown scene {name!r}",
            expected=f"one of {', '.join(known)}, or the path of a Python file that defines `scene`",
            hint=f"did you mean {close[0]}?" if (close := get_close_matches(name, known, n=1)) else "",
        )
    return _run(name, path)


def stiff_variants(scene: Problem) -> tuple[StiffVariant, ...]:
    """Return the stiff variants of a scene of the gallery.

    For a user's scene the result is empty, even if the scene has the name of a gallery scene.
    """
    if scene.name not in GALLERY:
        return ()
    module = import_module(f"codegen.scenes.{scene.name}")
    own = vars(module).get("stiff_variants")
    return tuple(own()) if own is not None and scene.roots is module.scene.roots else ()


def _run(name: str, path: Path) -> Problem:
    """Return the scene that a Python file defines."""
    # For a very large file, ``read_bytes`` raises a SceneError before the file is executed.
    read_bytes(path, "a Python file that defines `scene`", error=SceneError)
    try:
        # A scene may print messages, but stdout is reserved for the result of the command.
        with redirect_stdout(sys.stderr), neighbours_of(path):
            names = runpy.run_path(str(path))
    except InputError as error:
        at = f"{_line(name, path, error)}: {error.where}"
        raise SceneError(error.found, where=at, expected=error.expected, hint=error.hint) from error
    except KeyboardInterrupt:
        raise
    # A scene may also raise SystemExit or another exception that is not derived from Exception.
    except BaseException as error:
        at = _line(name, path, error)
        raise SceneError(f"the scene raises {type(error).__name__}: {error}", where=at) from error
    scene = names.get("scene")
    if not isinstance(scene, Problem):
        raise SceneError(
            "no scene is defined", where=name, expected="scene = FieldScene(...) or HamiltonianScene(...)"
        )
    scene = replace(scene, figures=read_figures(name, names.get("figures", ())))
    return _named(scene, path.stem, names.get("__doc__") or "")


def _named(scene: Problem, name: str, about: str = "") -> Problem:
    """Return the scene with another name.

    A scene without a title gets the first line of ``about`` as its title, or ``name`` if ``about`` is empty.
    """
    first = next((line.strip() for line in about.splitlines() if line.strip()), "").removesuffix(".")
    return replace(scene, name=name, title=(first or name) if scene.title == scene.name else scene.title)


def _line(name: str, path: Path, error: BaseException) -> str:
    """Return FILE:LINE, the place of an error in the user's file, or FILE if the line is unknown."""
    lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == str(path)]
    if isinstance(error, SyntaxError) and error.lineno is not None:
        lines.append(error.lineno)
    return f"{name}:{lines[-1]}" if lines else name


def about(name: str) -> str:
    """Return the description of a scene: the docstring of its file, or '' if there is no docstring.

    A registered scene has the description that was passed to :func:`register`.
    """
    name = name.removesuffix(EXTENDED)
    if name in _REGISTERED:
        return _REGISTERED[name][1]
    spec = find_spec(f"codegen.scenes.{name}") if name in BUILT_IN else None
    path = Path(spec.origin) if spec is not None and spec.origin else Path(name)
    return ast.get_docstring(ast.parse(read_bytes(path, error=SceneError))) or ""


def listing() -> list[dict[str, str]]:
    """Return the names and titles of all scenes for ``orderconds list scenes``, sorted by name."""
    return [{"name": n, "about": load(n).title} for n in sorted(every_name())]
