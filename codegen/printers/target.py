"""Describes a target language of the compiler, and the functions that print and load emitted modules."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pkgutil import resolve_name
from typing import TYPE_CHECKING, TypeAlias, cast

if TYPE_CHECKING:
    from codegen.integrator import Integrator
    from codegen.ir.kernel import Kernel
    from codegen.lattice import Lattice
    from codegen.printers.interface import Interface
    from codegen.printers.recipe import Recipe
    from codegen.spectral import Spectral

Files: TypeAlias = Mapping[str, str]
"""The files of an emitted module: a map from file names to texts."""

PrintModule: TypeAlias = "Callable[[Kernel, Interface, Recipe], dict[str, str]]"
Load: TypeAlias = "Callable[[Interface, Mapping[str, float], Files], Integrator]"
LoadLattice: TypeAlias = "Callable[[Interface, Mapping[str, float], Files], Lattice]"
LoadSpectral: TypeAlias = "Callable[[Interface, Mapping[str, float], Files], Spectral]"
CompileSeconds: TypeAlias = Callable[[Files], float]
Solutions: TypeAlias = "Callable[[Integrator, Sequence[float], float, float], list[list[float]]]"


@dataclass(frozen=True)
class Target:
    """A target language.

    A function is stored as a text ``module:function``, and it is imported when it is used.

    - ``name`` is the name of the target in commands.
    - ``title`` is the name of the target in headings.
    - ``about`` is the description of the target in listings, on one line.
    - ``printer`` is a function (kernel, interface, recipe) -> files.
    - ``loader`` is a function (interface, parameter values, files) -> :class:`codegen.integrator.Integrator`.
    - ``suffix`` is the suffix of the file that contains the step.
    - ``most_steps`` limits the steps in a run of a convergence test. With this limit, a run takes at most
      about one second.

    The other fields are optional:

    - ``compiler`` is a function that compiles the files of a module, without the cache of compiled modules,
      and returns the elapsed time in seconds.
    - ``observer`` is a function (integrator, state, t, h) that makes one step and returns the solved unknowns
      of each substep.
    - ``stack`` is a regular expression that finds the bound on the stack memory in the text of the emitted
      step. The first group matches the number of bytes.
    - ``batches`` is True if a module can have a function that integrates a batch of systems.
    - ``lattice_loader`` loads modules for lattices.
    - ``spectral_loader`` loads modules for semilinear equations.
    """

    name: str
    title: str
    about: str
    printer: str
    loader: str
    suffix: str
    most_steps: int
    compiler: str = ""
    observer: str = ""
    stack: str = ""
    batches: bool = False
    lattice_loader: str = ""
    spectral_loader: str = ""

    @property
    def print_module(self) -> PrintModule:
        """The function that prints a module."""
        # The printer is imported only here, because the command that lists the targets needs no printer.
        return cast("PrintModule", resolve_name(self.printer))

    @property
    def load(self) -> Load:
        """The function that loads the files of a module as an integrator."""
        return cast("Load", resolve_name(self.loader))

    @property
    def load_lattice(self) -> LoadLattice:
        """The function that loads a module for a lattice.

        ValueError is raised if the target has no ``lattice_loader``.
        """
        return cast("LoadLattice", resolve_name(self.lattice_loader))

    @property
    def load_spectral(self) -> LoadSpectral:
        """The function that loads a module for a semilinear equation.

        ValueError is raised if the target has no ``spectral_loader``.
        """
        return cast("LoadSpectral", resolve_name(self.spectral_loader))

    @property
    def compile_seconds(self) -> CompileSeconds | None:
        """The function that measures how long the compilation of a module takes.

        The value is None if modules of this target are not compiled.
        """
        return cast("CompileSeconds", resolve_name(self.compiler)) if self.compiler else None

    @property
    def solutions(self) -> Solutions:
        """The function with the name ``self.observer``. The function makes one step and returns the solutions
        of the implicit equations in each substep.

        ValueError is raised if the target has no ``observer``.
        """
        return cast("Solutions", resolve_name(self.observer))

    def step_file(self, module: str) -> str:
        """Return the name of the file with the step function. ``module`` is the name of the module."""
        # In C, a module consists of a header and a source.
        return f"{module}{self.suffix}"
