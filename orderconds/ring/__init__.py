"""Scalars behind one protocol: rationals, algebraic numbers, balls, power series, residues, polynomials.

Every engine is written once against :class:`Ring` and runs over any of them. python-flint lives behind this
package only. The names below load on first use (PEP 562), so that a rational tableau costs nothing else.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from orderconds.ring.protocol import Element, Ring

if TYPE_CHECKING:
    from orderconds.ring.balls import Ball, Balls
    from orderconds.ring.field import Algebraic, NumberField
    from orderconds.ring.polynomials import Polynomials
    from orderconds.ring.power_series import PowerSeries, Series
    from orderconds.ring.rationals import QQ, Rationals
    from orderconds.ring.residues import Residue, Residues

_HOME = {
    "Algebraic": "field",
    "Ball": "balls",
    "Balls": "balls",
    "NumberField": "field",
    "Polynomials": "polynomials",
    "PowerSeries": "power_series",
    "QQ": "rationals",
    "Rationals": "rationals",
    "Residue": "residues",
    "Residues": "residues",
    "Series": "power_series",
}

__all__ = [
    "QQ",
    "Algebraic",
    "Ball",
    "Balls",
    "Element",
    "NumberField",
    "Polynomials",
    "PowerSeries",
    "Rationals",
    "Residue",
    "Residues",
    "Ring",
    "Series",
]


def __getattr__(name: str) -> Any:
    try:
        home = _HOME[name]
    except KeyError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None
    return getattr(import_module(f"{__name__}.{home}"), name)
