"""From kernel to source text: spelling of expressions for any infix target, one package a target.

A target is a package here whose ``print_module(kernel, interface, recipe)`` returns file names and texts, and
a line in :data:`TARGETS`.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

from codegen.ir.kernel import Kernel
from codegen.printers.interface import Interface
from codegen.printers.recipe import Recipe
from orderconds.errors import UnknownName

TARGETS = {"c": "codegen.printers.c.module", "python": "codegen.printers.python.module"}
"""Target name -> module with its ``print_module``."""

PrintModule = Callable[[Kernel, Interface, Recipe], dict[str, str]]


def target(name: str) -> PrintModule:
    """Return the module printer of a target; an UnknownName names the targets there are."""
    if name not in TARGETS:
        raise UnknownName(f"unknown target {name}", expected=" or ".join(sorted(TARGETS)))
    printer: PrintModule = import_module(TARGETS[name]).print_module
    return printer
