"""Registries of groups and actions. A registry finds a class by the name of the class.

A registry contains the built-in groups or the built-in actions of this package, and the classes that
:func:`codegen.groups.register` has added.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Generic, TypeVar

from codegen.errors import SceneError
from orderconds.errors import UnknownName

T = TypeVar("T")


class Registry(Generic[T]):
    """A registry that finds groups or actions by name. ``home`` is the name of the package that contains the
    built-in classes.
    """

    def __init__(self, kind: str, home: str, built_in: Sequence[str]) -> None:
        self.kind, self.home, self.built_in = kind, home, tuple(built_in)
        self._added: dict[str, type[T]] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the built-in classes, followed by the names of the added classes."""
        return (*self.built_in, *self._added)

    def add(self, cls: type[T]) -> None:
        """Add a class under its own name.

        ``cls`` replaces a class of the same name that was added earlier.
        :class:`SceneError` is raised if a built-in class has the name of ``cls``, or if ``cls`` has abstract
        methods.
        """
        name, missing = cls.__name__, sorted(getattr(cls, "__abstractmethods__", ()))
        if missing:
            raise SceneError(
                f"the {self.kind} {name} does not implement {', '.join(missing)}",
                expected="a class that implements all abstract methods of its base classes",
            )
        if name in self.built_in:
            raise SceneError(
                f"a built-in {self.kind} has the name {name}", expected="another name for the class"
            )
        self._added[name] = cls

    def remove(self, cls: type[T]) -> None:
        """Remove an added class. If the added classes do not contain ``cls``, nothing happens."""
        if self._added.get(cls.__name__) is cls:
            del self._added[cls.__name__]

    def get(self, name: str) -> type[T]:
        """Return the class with the given name. If no class has this name,
        :class:`orderconds.errors.UnknownName` is raised.
        """
        if name in self._added:
            return self._added[name]
        if name not in self.built_in:
            raise UnknownName(f"unknown {self.kind} {name!r}", expected=f"one of {', '.join(self.names)}")
        cls: type[T] = getattr(sys.modules[self.home], name)
        return cls

    def listing(self) -> list[dict[str, str]]:
        """Return a dictionary for each class: ``name`` is the name of the class, and ``about`` is the first
        paragraph of the docstring of the class.
        """
        return [{"name": n, "about": _first_paragraph(self.get(n).__doc__ or "")} for n in self.names]


def _first_paragraph(text: str) -> str:
    """Return the first paragraph of a docstring as one line."""
    return " ".join(text.strip().partition("\n\n")[0].split())
