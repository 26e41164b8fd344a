"""Packages that delay the imports of their modules. A module of such a package is imported when an object
from the module is first used (PEP 562)."""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType


class _LazyPackage(ModuleType):
    """A package that imports each of its modules when an exported object of the module is first used."""

    def __getattr__(self, name: str) -> object:
        homes = self.__dict__["_homes"]
        if name not in homes:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        value = self.__dict__[name] = getattr(import_module(homes[name]), name)
        return value

    def __setattr__(self, name: str, value: object) -> None:
        # After the import of a submodule ``package.name``, Python assigns the submodule to the attribute
        # ``name`` of the package. The assignment must not replace an exported object that is called ``name``.
        if not (isinstance(value, ModuleType) and name in self.__dict__["_homes"]):
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *self.__dict__["_homes"]})


def lazy(package: str, **names: tuple[str, ...]) -> None:
    """Delay the import of each module of a package until one of its objects is used.

    ``names`` maps each module to the names of its exported objects. If a module and an exported object have
    the same name, the name denotes the object.

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
        # An imported submodule that is also called ``name`` would hide the exported object ``name``.
        if isinstance(module.__dict__.get(name), ModuleType):
            del module.__dict__[name]
    module.__class__ = _LazyPackage
