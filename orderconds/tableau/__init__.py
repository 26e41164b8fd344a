"""Tableaux: the record, the strict TOML format and its coefficient grammar, properties, the library."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from orderconds.tableau.file import load, loads
    from orderconds.tableau.library import available, find
    from orderconds.tableau.methods import (
        CommutatorFree,
        Composition,
        Embedded,
        EmbeddedUpdate,
        PartitionedRungeKutta,
        RungeKutta,
        Stage,
    )
    from orderconds.tableau.products import AdjointComposition, Magnus, Method, Splitting
    from orderconds.tableau.record import Claims, OrderClaim, Tableau
    from orderconds.tableau.write import dumps

_HOME = {
    "AdjointComposition": "products",
    "Claims": "record",
    "CommutatorFree": "methods",
    "Composition": "methods",
    "Embedded": "methods",
    "EmbeddedUpdate": "methods",
    "Magnus": "products",
    "Method": "products",
    "OrderClaim": "record",
    "PartitionedRungeKutta": "methods",
    "RungeKutta": "methods",
    "Splitting": "products",
    "Stage": "methods",
    "Tableau": "record",
    "available": "library",
    "dumps": "write",
    "find": "library",
    "load": "file",
    "loads": "file",
}

__all__ = [
    "AdjointComposition",
    "Claims",
    "CommutatorFree",
    "Composition",
    "Embedded",
    "EmbeddedUpdate",
    "Magnus",
    "Method",
    "OrderClaim",
    "PartitionedRungeKutta",
    "RungeKutta",
    "Splitting",
    "Stage",
    "Tableau",
    "available",
    "dumps",
    "find",
    "load",
    "loads",
]


def __getattr__(name: str) -> Any:
    try:
        home = _HOME[name]
    except KeyError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None
    return getattr(import_module(f"{__name__}.{home}"), name)
