"""Printers translate a kernel to source text.

Each target language, for example C, has its own package of printers.
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
