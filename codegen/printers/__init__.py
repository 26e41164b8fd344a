"""Printers translate a kernel to source text. Each target, for example C, has its own package of printers.

A :class:`Target` contains everything that the other packages need to know about a target.
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
