"""The compiler: a scene and a method become a step program, and that becomes Python or C.

>>> import codegen
>>> integrator = codegen.load(codegen.emit("free_rigid_body", "cf4", target="python"))
>>> [round(x, 6) for x in integrator.run([0.6, 0.0, 0.8], h=0.1, steps=10)]
[0.511554, -0.443424, 0.735994]
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from codegen.emit import emit as emit
    from codegen.load import load as load

__all__ = ["emit", "load"]

_HOME = {"emit": "codegen.emit", "load": "codegen.load"}


def __getattr__(name: str) -> Any:
    """Load ``emit`` or ``load`` from its module when it is first asked for."""
    if name not in _HOME:
        raise AttributeError(f"module 'codegen' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(_HOME[name]), name)
    return value


def __dir__() -> list[str]:
    """List the public names, loaded or not."""
    return sorted({*globals(), *__all__})


class _Package(ModuleType):
    """The package as its own class, so that the modules emit and load do not hide their functions."""

    def __setattr__(self, name: str, value: Any) -> None:
        # The import system stores every submodule here under its name, after running it.
        if name in _HOME and isinstance(value, ModuleType):
            value = getattr(value, name)
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
