"""Load emitted modules as Python objects with one interface, :class:`codegen.integrator.Integrator`.

For each target (C, Python), :attr:`codegen.printers.Target.loader` is the name of the function that loads
modules of this target.
"""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path

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


def load(source: Artifact | str | PathLike[str], module: str = "", target: str = "") -> Integrator:
    """Return the integrator of an artifact, or of a module in a folder with a manifest.

    If the folder contains several modules, ``module`` and ``target`` choose one of them. C code is compiled,
    or a compiled file is read from the cache. Errors: CompilerMissing, CompileError, and InputError for a
    folder without such a module.
    """
    artifact, interface, defaults = _opened(source, module, target)
    if interface.dimension:
        raise InputError(
            f"{artifact.key[0]} is a module for a chain or lattice",
            where="load",
            expected="a module for a single system",
            hint="call codegen.load_lattice",
        )
    if interface.modes:
        raise InputError(
            f"{artifact.key[0]} is a module for a semilinear equation",
            where="load",
            expected="a module for a system of ordinary differential equations",
            hint="call codegen.load_spectral",
        )
    integrator = known_target(artifact.manifest["target"]).load(interface, defaults, artifact.files)
    integrator.artifact = artifact
    return integrator


def load_lattice(source: Artifact | str | PathLike[str], module: str = "", target: str = "") -> Lattice:
    """Return the module of a scene on a chain or lattice (:class:`codegen.scene.SiteScene`) as an object.

    The arguments and errors are those of :func:`load`.
    """
    artifact, interface, defaults = _opened(source, module, target)
    if not interface.dimension:
        raise InputError(
            f"{artifact.key[0]} is a module for a single system",
            where="load_lattice",
            expected="a module for a chain or lattice",
            hint="call codegen.load",
        )
    lattice = known_target(artifact.manifest["target"]).load_lattice(interface, defaults, artifact.files)
    lattice.artifact = artifact
    return lattice


def load_spectral(source: Artifact | str | PathLike[str], module: str = "", target: str = "") -> Spectral:
    """Return the module of a semilinear equation (:class:`codegen.scene.SemilinearScene`) as an object.

    The arguments and errors are those of :func:`load`.
    """
    artifact, interface, defaults = _opened(source, module, target)
    if not interface.modes:
        raise InputError(
            f"{artifact.key[0]} is no module for a semilinear equation",
            where="load_spectral",
            expected="a module for a semilinear equation",
            hint="call codegen.load, or codegen.load_lattice for a lattice",
        )
    spectral = known_target(artifact.manifest["target"]).load_spectral(interface, defaults, artifact.files)
    spectral.artifact = artifact
    return spectral


def _opened(source: object, module: str, target: str) -> tuple[Artifact, Interface, dict[str, float]]:
    """Return an artifact, its interface, and the default values of its parameters."""
    if not isinstance(source, Artifact | str | PathLike):
        raise InputError(
            described(source),
            where="load",
            expected="the result of codegen.emit, or a folder of emitted files",
        )
    artifact = source if isinstance(source, Artifact) else read(Path(source), module, target)
    try:
        interface = Interface.from_json(artifact.manifest["interface"])
        defaults = dict(artifact.manifest["defaults"])
    except (KeyError, TypeError, ValueError, AttributeError):
        raise InputError(
            f"the entry for {artifact.key[0]} in the manifest is not valid: it was changed after it was "
            "written, or another version of the program wrote it",
            hint="emit the module again",
        ) from None
    return artifact, interface, defaults


def load_compiled(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Integrator:
    """Return the integrator of a C module; the module is compiled unless the cache contains it."""
    # These flags let the compiler turn loops over many systems into vector instructions. For this purpose the
    # compiler needs -O3, permission to use all instructions of this machine, and square roots that do not set
    # errno.
    flags = (*FLAGS, *(VECTOR_FLAGS if interface.batch else ()))
    try:
        return CompiledIntegrator(interface, defaults, build(files, flags))
    except (OSError, AttributeError):
        # The digest of the cached file is correct, but the file is not a library, or it lacks functions of
        # the module. Therefore the module is compiled again.
        return CompiledIntegrator(interface, defaults, build(files, flags, again=True))


def load_interpreted(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Integrator:
    """Return the integrator of a Python module."""
    return InterpretedIntegrator(interface, defaults, files[f"{interface.module}.py"])


def load_compiled_lattice(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Lattice:
    """Return a C module for a lattice as a Python object; the module is compiled unless the cache contains
    it."""
    flags = (*FLAGS, *VECTOR_FLAGS)
    try:
        return CompiledLattice(interface, defaults, build(files, flags))
    except (OSError, AttributeError):
        # The cached file has the recorded digest, but it is not the library of this module. The module is
        # built again.
        return CompiledLattice(interface, defaults, build(files, flags, again=True))


def load_compiled_spectral(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Spectral:
    """Return a C module for a semilinear equation as a Python object; the module is compiled unless the
    cache contains it."""
    flags = (*FLAGS, *VECTOR_FLAGS)
    try:
        return CompiledSpectral(interface, defaults, build(files, flags))
    except (OSError, AttributeError):
        # The cached file has the recorded digest, but it is not the library of this module. The module is
        # built again.
        return CompiledSpectral(interface, defaults, build(files, flags, again=True))


def load_interpreted_spectral(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Spectral:
    """Return a Python module for a semilinear equation as a Python object."""
    return InterpretedSpectral(interface, defaults, files[f"{interface.module}.py"])
