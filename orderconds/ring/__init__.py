"""Scalars behind one protocol: rationals, algebraic numbers, balls, power series, residues, polynomials.

The algorithms use only :class:`Ring` and run over all of them. Other packages import
python-flint only where the import contract in pyproject.toml allows it. The names below load on first use
(PEP 562), so that a rational tableau loads nothing else.
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
