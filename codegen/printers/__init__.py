"""Printers: a kernel becomes source text, with one package for each target and a common infix notation.

A :class:`Target` contains everything that the rest of the compiler and the lab need to know about a target.
:func:`register` adds a target, and :func:`target` returns it by name.
"""

from codegen.printers.registry import (
    DEFAULT,
    listing,
    names,
    observable,
    register,
    target,
    targets,
    unregister,
)
from codegen.printers.target import Target

__all__ = [
    "DEFAULT",
    "Target",
    "listing",
    "names",
    "observable",
    "register",
    "target",
    "targets",
    "unregister",
]
