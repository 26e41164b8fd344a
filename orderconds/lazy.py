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

    def __setattr__(self, name: str, value: object) -> None:
        # The import system stores an imported module in its package. A function of the interface that has the
        # name of a module stays; statements "from package.module import name" do not need the attribute.
        if not (isinstance(value, ModuleType) and name in self.__dict__["_homes"]):
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *self.__dict__["_homes"]})


def lazy(package: str, **names: tuple[str, ...]) -> None:
    """Make the names of an imported package load from their modules on first use; ``dir`` loads no module.

    ``names`` maps each module of the package to the names that load from it. If a module or package inside
    the package has one of these names, the attribute of the package is nevertheless the object, not the
    module.

    >>> import orderconds
    >>> callable(orderconds.check), "derive" in dir(orderconds)
    (True, True)
    >>> orderconds.nothing
    Traceback (most recent call last):
    AttributeError: module 'orderconds' has no attribute 'nothing'
    """
    module = sys.modules[package]
    homes = {n: f"{package}.{home}" for home, own in names.items() for n in own}
    module.__dict__["_homes"] = homes
    for name in homes:
        if isinstance(module.__dict__.get(name), ModuleType):  # imported before this call
            del module.__dict__[name]
    module.__class__ = _LazyPackage
