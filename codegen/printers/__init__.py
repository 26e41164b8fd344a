"""Printers: a kernel becomes source text, with one package for each target and a common infix notation.

A target is a package of this folder with a module that contains ``print_module(kernel, interface, recipe)``,
which returns texts by file name. It also needs a line in :data:`TARGETS` and a line in
:data:`codegen.loader.LOADERS`.
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
    """Return the module printer of a target; an unknown name raises UnknownName with the known targets."""
    if name not in TARGETS:
        raise UnknownName(f"unknown target {name}", expected=" or ".join(sorted(TARGETS)))
    # Imported by name, so that a target is a line in a table and needs no import here.
    printer: PrintModule = import_module(TARGETS[name]).print_module
    return printer
