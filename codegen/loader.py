"""Loads emitted modules as Python objects, for example as :class:`codegen.integrator.Integrator`.

For each target (for example C), :attr:`codegen.printers.Target.loader` names the function that loads the
modules.
"""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import TypeVar

from codegen.artifact import Artifact, read
from codegen.build import build
from codegen.compiled_integrator import CompiledIntegrator
from codegen.integrator import Integrator
from codegen.interpreted_integrator import InterpretedIntegrator
from codegen.lattice import CompiledLattice, Lattice
from codegen.printers import target as known_target
from codegen.printers.c.module import FLAGS, VECTOR_FLAGS
from codegen.printers.interface import Interface
from codegen.spectral import CompiledSpectral, InterpretedSpectral, Spectral
from orderconds.argument import described
from orderconds.errors import InputError

# In VECTOR_FLAGS, -fno-math-errno and -fno-trapping-math are safe, because an emitted module reads neither
# errno nor the flags of floating-point exceptions.
LOOP_FLAGS = (*FLAGS, *VECTOR_FLAGS)
"""The compiler flags for modules that loop over lattice sites, Fourier modes or a batch of systems."""


def load(source: Artifact | str | PathLike[str], module: str = "", target: str = "") -> Integrator:
    """Load an emitted module as an integrator.

    ``source`` is the result of :func:`codegen.emit`, or a folder of emitted files with a manifest. If the
    folder contains several modules, ``module`` and ``target`` choose one module. A C
    module is compiled if it is not in the cache.

    CompilerMissing is raised if there is no C compiler, and CompileError if the compiler fails. InputError is
    raised if the folder does not contain the module, or if the module is for a lattice (:func:`load_lattice`)
    or a semilinear equation (:func:`load_spectral`).
    """
    artifact, interface, defaults = _opened(source, module, target, "load")
    integrator = known_target(artifact.manifest["target"]).load(interface, defaults, artifact.files)
    integrator.artifact = artifact
    return integrator


def load_lattice(source: Artifact | str | PathLike[str], module: str = "", target: str = "") -> Lattice:
    """Load an emitted module for a chain or lattice (:class:`codegen.scene.SiteScene`) as an object.

    The arguments and the errors are those of :func:`load`, but InputError is raised if the module is not for
    a lattice.
    """
    artifact, interface, defaults = _opened(source, module, target, "load_lattice")
    lattice = known_target(artifact.manifest["target"]).load_lattice(interface, defaults, artifact.files)
    lattice.artifact = artifact
    return lattice


def load_spectral(source: Artifact | str | PathLike[str], module: str = "", target: str = "") -> Spectral:
    """Load an emitted module for a semilinear equation (:class:`codegen.scene.SemilinearScene`) as an object.

    For the arguments and the errors see :func:`load`. InputError is raised if the module is not for a
    semilinear equation.
    """
    artifact, interface, defaults = _opened(source, module, target, "load_spectral")
    spectral = known_target(artifact.manifest["target"]).load_spectral(interface, defaults, artifact.files)
    spectral.artifact = artifact
    return spectral


_PROBLEMS = {
    "load": "a system of ordinary differential equations",
    "load_lattice": "a chain or lattice",
    "load_spectral": "a semilinear equation",
}
"""Maps the name of a loading function to the kind of problem that the loaded modules solve."""


def _opened(
    source: object, module: str, target: str, where: str
) -> tuple[Artifact, Interface, dict[str, float]]:
    """Return the artifact of a module, its interface, and the default values of its parameters.

    ``where`` is the name of the calling function, for example "load". InputError is raised if the module
    needs another loading function.
    """
    if not isinstance(source, Artifact | str | PathLike):
        raise InputError(
            described(source),
            where=where,
            expected="the result of codegen.emit, or a folder of emitted files",
        )
    artifact = source if isinstance(source, Artifact) else read(Path(source), module, target)
    try:
        interface = Interface.from_json(artifact.manifest["interface"])
        defaults = dict(artifact.manifest["defaults"])
    except (KeyError, TypeError, ValueError, AttributeError):
        raise InputError(
            f"the entry for {artifact.key[0]} in the manifest is not valid: the entry was edited, or "
            "another version of the compiler wrote it",
            hint="emit the module again",
        ) from None
    loader = "load_lattice" if interface.dimension else "load_spectral" if interface.modes else "load"
    if loader != where:
        raise InputError(
            f"{artifact.key[0]} is a module for {_PROBLEMS[loader]}",
            where=where,
            expected=f"a module for {_PROBLEMS[where]}",
            hint=f"call codegen.{loader}",
        )
    return artifact, interface, defaults


C = TypeVar("C", CompiledIntegrator, CompiledLattice, CompiledSpectral)


def _compiled(
    kind: type[C],
    interface: Interface,
    defaults: Mapping[str, float],
    files: Mapping[str, str],
    flags: tuple[str, ...],
) -> C:
    """Return a C module as an object of ``kind``. The module is compiled if it is not in the cache."""
    try:
        return kind(interface, defaults, build(files, flags))
    except (OSError, AttributeError):
        # The file in the cache is not a library, or it lacks functions.
        return kind(interface, defaults, build(files, flags, again=True))


def load_compiled(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Integrator:
    """Return the integrator of a C module. The module is compiled if it is not in the cache."""
    return _compiled(CompiledIntegrator, interface, defaults, files, LOOP_FLAGS if interface.batch else FLAGS)


def load_interpreted(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Integrator:
    """Return the integrator of an emitted Python module."""
    return InterpretedIntegrator(interface, defaults, files[f"{interface.module}.py"])


def load_compiled_lattice(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Lattice:
    """Return the :class:`Lattice` object of a C module.

    The module is compiled if it is not in the cache.
    """
    return _compiled(CompiledLattice, interface, defaults, files, LOOP_FLAGS)


def load_compiled_spectral(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Spectral:
    """Return a C module for a semilinear equation as a :class:`Spectral`.

    The module is compiled if it is not in the cache.
    """
    return _compiled(CompiledSpectral, interface, defaults, files, LOOP_FLAGS)


def load_interpreted_spectral(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Spectral:
    """Return an emitted Python module for a semilinear equation as a :class:`Spectral`."""
    return InterpretedSpectral(interface, defaults, files[f"{interface.module}.py"])
