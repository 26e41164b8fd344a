"""Packages whose names load on first use, so that their import is fast (PEP 562)."""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType


class _LazyPackage(ModuleType):
    """A package whose names load from their modules on first use."""

    def __getattr__(self, name: str) -> object:
        homes = self.__dict__["_homes"]
        if name not in homes:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        value = self.__dict__[name] = getattr(import_module(homes[name]), name)
        return value

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *self.__dict__["_homes"]})


def lazy(package: str, **names: tuple[str, ...]) -> None:
    """Make the names of an imported package load from their modules on first use; ``dir`` loads no module.

    ``names`` maps each module of the package to the names that load from it. No module may have one of these
    names, because the import system would replace the object with this name by the module.

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
