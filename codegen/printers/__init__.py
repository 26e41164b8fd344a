"""From kernel to source text: one package for each target, and the infix notation that targets share.

A target is a package of this folder with a module in which ``print_module(kernel, interface, recipe)``
returns texts by file name, and a line in :data:`TARGETS`; :data:`codegen.loader.LOADERS` has the other line.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

from codegen.ir.kernel import Kernel
from codegen.printers.interface import Interface
from codegen.printers.recipe import Recipe
from orderconds.errors import UnknownName

TARGETS = {"c": "codegen.printers.c.module", "python": "codegen.printers.python.module"}
"""Target name -> module that contains ``print_module``."""

PrintModule = Callable[[Kernel, Interface, Recipe], dict[str, str]]


def target(name: str) -> PrintModule:
    """Return the module printer of a target; an UnknownName lists the known targets."""
    if name not in TARGETS:
        raise UnknownName(f"unknown target {name}", expected=" or ".join(sorted(TARGETS)))
    printer: PrintModule = import_module(TARGETS[name]).print_module
    return printer
