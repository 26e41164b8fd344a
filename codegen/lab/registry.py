"""The registered measurements, in the order of the sections of the report.

A new measurement of this package is one file in :mod:`codegen.lab.measurements` and one line here. Others are
added by :func:`register`, or by an entry point of the group ``orderconds.measurements``.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from importlib import metadata
from pkgutil import resolve_name
from typing import Any, TypeAlias

from codegen.lab.measurement import Measurement
from orderconds.errors import InputError, UnknownName

AnyMeasurement: TypeAlias = Measurement[Any]

BUILT_IN = (
    "codegen.lab.measurements.advice:Advice",
    "codegen.lab.measurements.orders:Orders",
    "codegen.lab.measurements.cost:Cost",
    "codegen.lab.measurements.stability:StabilityTests",
    "codegen.lab.measurements.long_runs:LongRuns",
    "codegen.lab.measurements.conditions:Conditions",
    "codegen.lab.measurements.emitted_code:EmittedCode",
)
"""Module and class of the measurements of this package."""

GROUP = "orderconds.measurements"
"""Entry-point group of measurements of other packages."""

_registered: dict[str, type[AnyMeasurement]] = {}


def register(kind: type[AnyMeasurement]) -> type[AnyMeasurement]:
    """Add a measurement after the others; may be used as a class decorator.

    InputError if its name belongs to another class.
    """
    known = {m.name: type(m) for m in measurements()}
    if known.get(kind.name, kind) is not kind:
        raise InputError(f"there is a measurement {kind.name!r} already", expected="another name")
    _registered[kind.name] = kind
    return kind


def unregister(kind: type[AnyMeasurement]) -> None:
    """Remove a measurement that was added by :func:`register`."""
    _registered.pop(kind.name, None)


def measurements() -> tuple[AnyMeasurement, ...]:
    """Return all measurements in the order of the report."""
    kinds = {kind.name: kind for kind in (*_built_in(), *_from_entry_points(), *_registered.values())}
    return tuple(kind() for kind in kinds.values())


@cache
def _built_in() -> tuple[type[AnyMeasurement], ...]:
    return tuple(map(resolve_name, BUILT_IN))


def _from_entry_points() -> Iterable[type[AnyMeasurement]]:
    return [entry.load() for entry in metadata.entry_points(group=GROUP)]


def selected(names: Sequence[str]) -> tuple[AnyMeasurement, ...]:
    """Return the named measurements with their parts, or all if no name is given.

    :class:`UnknownName` for an unknown name.
    """
    every = measurements()
    known = [m.name for m in every]
    for name in names:
        if name not in known:
            raise UnknownName(f"unknown measurement {name!r}", expected=f"one of {', '.join(known)}")
    return tuple(m for m in every if not names or m.name in names or m.part_of in names)


def listing() -> list[dict[str, str]]:
    """Return name and description of every measurement, for ``orderconds list measurements``."""
    return [{"name": m.name, "about": m.about} for m in measurements()]
