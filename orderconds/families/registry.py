"""The registry of families. The registry contains built-in families, families that a program registers, and
families that installed packages provide by entry points."""

from __future__ import annotations

import inspect
import re
from importlib import import_module
from typing import TypeVar

from orderconds.argument import text
from orderconds.errors import InputError, UnknownName
from orderconds.families.base import Family

BUILT_IN = {
    "rk": "orderconds.families.rk",
    "prk": "orderconds.families.prk",
    "prk_same_weights": "orderconds.families.prk_same_weights",
    "symplectic_rk": "orderconds.families.symplectic_rk",
    "sprk": "orderconds.families.sprk",
    "sprk_separable": "orderconds.families.sprk_separable",
    "ambient": "orderconds.families.ambient",
    "cf": "orderconds.families.cf",
    "cg": "orderconds.families.cg",
    "rkmk": "orderconds.families.rkmk",
    "vcg": "orderconds.families.vcg",
    "vcf": "orderconds.families.vcf",
    "vrkmk": "orderconds.families.vrkmk",
    "vrkmk_pade": "orderconds.families.vrkmk_pade",
    "slgi": "orderconds.families.slgi",
    "discrete_gradient": "orderconds.families.discrete_gradient",
    "composition": "orderconds.families.composition",
    "symmetric_composition": "orderconds.families.symmetric_composition",
    "splitting": "orderconds.families.splitting",
    "rkn": "orderconds.families.rkn",
    "magnus": "orderconds.families.magnus",
    "cf_magnus": "orderconds.families.cf_magnus",
    "fer": "orderconds.families.fer",
    "cayley": "orderconds.families.cayley",
    "taylor": "orderconds.families.taylor",
}
"""A map from the name of each built-in family to its module, in the order of ``orderconds list families``."""

ENTRY_POINT_GROUP = "orderconds.families"
"""The entry-point group in which other packages register families. An entry has the form
``name = "module:Class"``."""

_NAME = re.compile(r"[a-z][a-z0-9_]*")
_LABEL = re.compile(r"\s*([a-z][a-z0-9_-]*)\s*(?:\(\s*(\d{1,3})\s*\))?\s*")
_registered: dict[str, type[Family]] = {}

FamilyClass = TypeVar("FamilyClass", bound=type[Family])


def register(family: FamilyClass) -> FamilyClass:
    """Add the class of a family to the registry, and return the class.

    Raises :class:`~orderconds.errors.InputError` if the class has no name, no description or no formats, or
    if another family has the same name. A name consists of lower-case letters, digits and ``_``.

    The family in the example has one condition for each order, the condition of the bushy tree.

    >>> from orderconds import check, derive
    >>> from orderconds.families.rk import RungeKuttaFamily
    >>> @register
    ... class Quadrature(RungeKuttaFamily):
    ...     name, description = "quadrature", "Quadrature rules: bushy trees alone."
    ...
    ...     def conditions(self, order):
    ...         return super().conditions(order)[-1:]
    >>> print(*derive("quadrature", order=3).conditions, sep="; ")
    sum_i b_i = 1; sum_i b_i c_i = 1/2; sum_i b_i c_i^2 = 1/3
    >>> check("gauss2", family="quadrature").orders[0].order
    4
    >>> unregister("quadrature")
    """
    for attribute, value in (
        ("name", family.name),
        ("description", family.description),
        ("formats", family.formats or not family.has_tableau),
    ):
        if not value:
            raise InputError(
                f"no {attribute}",
                where=f"family {family.__name__}",
                expected=f"the class attribute {attribute}",
            )
    if not _NAME.fullmatch(family.name):
        raise InputError(
            f"the name {family.name!r}",
            where=f"family {family.__name__}",
            expected="lower-case letters, digits and _",
        )
    known = _registered.get(family.name)
    home = BUILT_IN.get(family.name, family.__module__)
    same = known is None or (known.__module__, known.__qualname__) == (family.__module__, family.__qualname__)
    if home != family.__module__ or not same:
        raise InputError(
            f"another family has the name {family.name!r}",
            where=f"family {family.__name__}",
            expected="a new name",
        )
    _registered[family.name] = family
    return family


def unregister(name: str) -> None:
    """Remove a family that :func:`register` added.

    Raises :class:`~orderconds.errors.InputError` for a built-in family.

    >>> unregister("rk")
    Traceback (most recent call last):
    orderconds.errors.InputError: family rk is built in; expected the name of a family that register() added
    """
    if name in BUILT_IN:
        raise InputError(f"family {name} is built in", expected="the name of a family that register() added")
    _registered.pop(name, None)


def names() -> tuple[str, ...]:
    """Return the names of the built-in families, followed by the names that :func:`register` added.

    >>> names()[:3]
    ('rk', 'prk', 'prk_same_weights')
    """
    return (*BUILT_IN, *(name for name in _registered if name not in BUILT_IN))


def with_conditions() -> tuple[str, ...]:
    """Return the names of the families with order conditions.

    >>> "rk" in with_conditions(), "taylor" in with_conditions()
    (True, False)
    """
    return tuple(name for name in names() if family_class(name).has_tableau)


def installed_names() -> tuple[str, ...]:
    """Return :func:`names`, followed by the names of all other families that installed packages provide.

    >>> set(names()) <= set(installed_names())
    True
    """
    from importlib import metadata

    offered = {entry.name for entry in metadata.entry_points(group=ENTRY_POINT_GROUP)}
    known = names()
    return (*known, *sorted(offered.difference(known)))


def position(name: str) -> int:
    """Return the index of a family in :func:`names`.

    >>> position("rk")
    0
    """
    return names().index(name)


def family_class(name: str) -> type[Family]:
    """Return the class of the family ``name``. The name may contain ``-`` instead of ``_``. If the name is
    not registered, the function looks for the name in the entry points of installed packages.

    Raises :class:`~orderconds.errors.UnknownName` if no family has this name.

    >>> family_class("vcg").needs_nonzero_weights
    True
    """
    key = name.replace("-", "_")
    if key not in _registered and key in BUILT_IN:
        # The decorator @register in the module registers the family during the import.
        import_module(BUILT_IN[key])
        assert key in _registered, (
            f"{BUILT_IN[key]} has no class with the decorator @register and the name {key!r}"
        )
    kind = _registered.get(key) or _installed(key)
    if kind is None:
        import difflib

        known = installed_names()
        close = difflib.get_close_matches(name, known, n=1)
        raise UnknownName(
            f"unknown family {name!r}",
            expected=f"one of {', '.join(known)}",
            hint=f"did you mean {close[0]!r}?" if close else "",
        )
    return kind


def _installed(name: str) -> type[Family] | None:
    """Find the family ``name`` in the installed packages. Register and return its class, or return None."""
    from importlib import metadata

    for entry in metadata.entry_points(group=ENTRY_POINT_GROUP, name=name):
        where = f"{name} ({entry.value})"
        try:
            loaded = entry.load()
        except (ImportError, AttributeError) as problem:
            raise InputError(f"cannot load the family: {problem}", where=where) from problem
        if not (isinstance(loaded, type) and issubclass(loaded, Family) and loaded.name == name):
            raise InputError(
                f"the entry point loads the object {loaded!r}",
                where=where,
                expected=f"a subclass of Family with the name {name!r}",
            )
        return register(loaded)
    return None


def get(name: str, **options: int | None) -> Family:
    """Return a family by name and options: ``get("rkmk", cutoff=1)`` or ``get("rkmk(1)")``. A name may
    contain ``-`` instead of ``_``.

    Raises :class:`~orderconds.errors.UnknownName` if the name is not registered. Raises
    :class:`~orderconds.errors.InputError` if the family does not have one of the given options.

    >>> get("rkmk(1)").label(), get("vcg").needs_nonzero_weights
    ('rkmk(1)', True)
    """
    label = _LABEL.fullmatch(text(name, "family", "the name of a family, such as rk"))
    base, argument = label.groups() if label else (name, None)
    family = family_class(base)
    accepted = tuple(inspect.signature(family).parameters)
    if argument is not None and not accepted:
        raise InputError(f"family {base} has no options, but {name!r} contains an option", expected=base)
    if argument is not None:
        options = {accepted[0]: int(argument), **options}
    for option in options:
        if option not in accepted:
            raise InputError(
                f"family {base} has no option {option!r}",
                expected=f"one of {', '.join(accepted)}" if accepted else "no options",
            )
    return family(**options)
