"""Tableaux of methods: classes, tableau files in TOML, and the library of known methods."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orderconds.lazy import lazy

if TYPE_CHECKING:
    from orderconds.tableau.claims import Claims, OrderClaim
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
    from orderconds.tableau.record import Tableau, load, loads
    from orderconds.tableau.write import dumps

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

lazy(
    __name__,
    claims=("Claims", "OrderClaim"),
    library=("available", "find"),
    methods=(
        "CommutatorFree",
        "Composition",
        "Embedded",
        "EmbeddedUpdate",
        "PartitionedRungeKutta",
        "RungeKutta",
        "Stage",
    ),
    products=("AdjointComposition", "Magnus", "Method", "Splitting"),
    record=("Tableau", "load", "loads"),
    write=("dumps",),
)
