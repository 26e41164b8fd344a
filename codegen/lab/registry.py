"""The list of registered measurements, in the order of the sections in the report.

To add a measurement to this package, write a file in :mod:`codegen.lab.measurements` and add a line to
:data:`BUILT_IN`. To add a measurement from another package, call :func:`register`, or declare an entry point
in the group ``orderconds.measurements``.
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
    "codegen.lab.measurements.figures:Figures",
    "codegen.lab.measurements.orders:Orders",
    "codegen.lab.measurements.cost:Cost",
    "codegen.lab.measurements.stability:StabilityTests",
    "codegen.lab.measurements.long_runs:LongRuns",
    "codegen.lab.measurements.conditions:Conditions",
    "codegen.lab.measurements.emitted_code:EmittedCode",
)
"""The measurements of this package in the form ``module:class``."""

GROUP = "orderconds.measurements"
"""The entry-point group in which other packages declare measurements."""

_registered: dict[str, type[AnyMeasurement]] = {}


def register(kind: type[AnyMeasurement]) -> type[AnyMeasurement]:
    """Add the class of a measurement at the end of the list of measurements, and return the class.

    Raises InputError if another measurement already has the name of the new one.
    """
    known = {m.name: type(m) for m in measurements()}
    if known.get(kind.name, kind) is not kind:
        raise InputError(
            f"a measurement with the name {kind.name!r} is already registered", expected="a new name"
        )
    _registered[kind.name] = kind
    return kind


def unregister(kind: type[AnyMeasurement]) -> None:
    """Remove a measurement that :func:`register` added."""
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
    """Return the measurements whose name or whose attribute ``part_of`` is in ``names``.

    If ``names`` is empty, all measurements are returned. Raises :class:`UnknownName` for an unknown name.
    """
    every = measurements()
    known = [m.name for m in every]
    for name in names:
        if name not in known:
            raise UnknownName(f"unknown measurement {name!r}", expected=f"one of {', '.join(known)}")
    return tuple(m for m in every if not names or m.name in names or m.part_of in names)


def listing() -> list[dict[str, str]]:
    """Return the name and the description of every measurement.

    The command ``orderconds list measurements`` prints this list.
    """
    return [{"name": m.name, "about": m.about} for m in measurements()]
