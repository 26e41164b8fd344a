"""The targets (languages) of the compiler.

The tuple :data:`BUILT_IN` lists the built-in targets. A package outside orderconds adds a target with
:func:`register` or with an entry point in the group ``orderconds.targets``.
"""

from __future__ import annotations

from functools import cache
from importlib import metadata
from pkgutil import resolve_name

from codegen.printers.target import Target
from orderconds.errors import InputError, UnknownName

BUILT_IN = ("codegen.printers.c.target:TARGET", "codegen.printers.python.target:TARGET")
"""The built-in targets. Each text has the form ``module:variable``."""

DEFAULT = "c"
"""The name of the default target."""

GROUP = "orderconds.targets"
"""The entry-point group in which other packages declare targets."""

_registered: dict[str, Target] = {}


def register(new: Target) -> Target:
    """Make the target ``new`` available in commands, and return ``new``.

    InputError is raised if another target has this name.
    """
    # ``targets()`` contains built-in targets, targets from entry points and registered targets.
    known = {each.name: each for each in targets()}
    # A second registration of the same target is no error.
    if known.get(new.name, new) != new:
        raise InputError(f"a target {new.name!r} already exists", expected="a new name")
    _registered[new.name] = new
    return new


def unregister(name: str) -> None:
    """Remove a target that was added by :func:`register`. If there is no such target, nothing happens."""
    _registered.pop(name, None)


def targets() -> tuple[Target, ...]:
    """Return all targets. The built-in targets come first."""
    every = (*_built_in(), *_from_entry_points(), *_registered.values())
    # The dictionary has one entry for each name, so a target that is both declared and
    # registered is returned once.
    return tuple({each.name: each for each in every}.values())


@cache
def _built_in() -> tuple[Target, ...]:
    # The result is cached, so the targets are imported only once.
    return tuple(map(resolve_name, BUILT_IN))


@cache
def _from_entry_points() -> tuple[Target, ...]:
    # The result is cached, because reading the metadata of all packages takes milliseconds.
    return tuple(entry.load() for entry in metadata.entry_points(group=GROUP))


def names() -> tuple[str, ...]:
    """Return the names of all targets.

    >>> names()[:2]
    ('c', 'python')
    """
    return tuple(each.name for each in targets())


def target(name: str) -> Target:
    """Return the target with the name ``name``.

    If there is no such target, UnknownName is raised.

    >>> target("python").title
    'Python'
    """
    for each in targets():
        if each.name == name:
            return each
    raise UnknownName(f"unknown target {name}", expected=" or ".join(sorted(names())))


def observable() -> Target:
    """Return the first target of :func:`targets` that has an ``observer``."""
    # The target Python has an ``observer``, so ``next`` always finds a target.
    return next(each for each in targets() if each.observer)


def listing() -> list[dict[str, str]]:
    """Return the name and the description of every target, for ``orderconds list targets``."""
    return [{"name": each.name, "about": each.about} for each in targets()]
