"""Scalars with a common interface: rationals, algebraic numbers, balls, power series, residues, polynomials.

The algorithms of ``orderconds`` use only the interface :class:`Ring`. Outside ``orderconds.ring``, only the
modules under ``ignore_imports`` in pyproject.toml may import python-flint.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orderconds.lazy import lazy
from orderconds.ring.protocol import Element, Ring

if TYPE_CHECKING:
    from orderconds.ring.balls import Ball, Balls
    from orderconds.ring.field import Algebraic, NumberField
    from orderconds.ring.polynomials import Polynomials
    from orderconds.ring.power_series import PowerSeries, Series
    from orderconds.ring.rationals import QQ, Rationals
    from orderconds.ring.residues import Residue, Residues

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

lazy(
    __name__,
    balls=("Ball", "Balls"),
    field=("Algebraic", "NumberField"),
    polynomials=("Polynomials",),
    power_series=("PowerSeries", "Series"),
    rationals=("QQ", "Rationals"),
    residues=("Residue", "Residues"),
)
