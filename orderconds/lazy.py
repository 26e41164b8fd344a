"""Packages whose names load when they are first asked for: to import them costs nothing (PEP 562)."""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import Any


class _LazyPackage(ModuleType):
    """A package as its own class, so that a submodule does not hide the name that it is the home of."""

    def __getattr__(self, name: str) -> Any:
        homes = self.__dict__["_homes"]
        if name not in homes:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        found = self.__dict__[name] = getattr(import_module(homes[name]), name)
        return found

    def __setattr__(self, name: str, value: Any) -> None:
        # The import system stores every submodule here under its name, after running it.
        if name in self.__dict__["_homes"] and isinstance(value, ModuleType):
            value = getattr(value, name)
        super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *self.__dict__["_homes"]})


def lazy(package: str, **names: tuple[str, ...]) -> None:
    """Let the names of an imported package load from their modules on first use; ``dir`` lists them unloaded.

    ``names`` gives those of each of its modules. A name that is also a module's, as ``orderconds.check``, is
    the object and never the module.

    >>> import orderconds
    >>> callable(orderconds.check), "derive" in dir(orderconds)
    (True, True)
    >>> orderconds.nothing
    Traceback (most recent call last):
    AttributeError: module 'orderconds' has no attribute 'nothing'
    """
    module = sys.modules[package]
    module.__dict__["_homes"] = {n: f"{package}.{home}" for home, own in names.items() for n in own}
    module.__class__ = _LazyPackage
