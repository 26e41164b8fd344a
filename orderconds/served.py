"""The families that a tableau can serve: those whose order its file should claim.

A Butcher tableau serves ``rk``, ``cg`` and ``rkmk``, and with non-zero weights ``sprk``, ``vcg`` and
``vrkmk`` (any cut-off of ``rkmk`` and ``vrkmk`` is a claim); a commutator-free method serves ``rk``,
``cf`` and, with non-zero weights, ``vcf``. A pair serves ``prk``, and where it is symplectic
``sprk_separable`` instead. Families that say the same of a tableau (``prk`` of an ``rk`` one) are not
demanded.
"""

from __future__ import annotations

from collections.abc import Sequence

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau import (
    AdjointComposition,
    CommutatorFree,
    Composition,
    Magnus,
    PartitionedRungeKutta,
    RungeKutta,
    Splitting,
    Tableau,
)
from orderconds.tableau.properties import reads_backwards, symplectic_pair

ON_GROUPS = ("rk", "cg", "rkmk")
VARIATIONAL = ("sprk", "vcg", "vrkmk")


def served(tableau: Tableau) -> tuple[str, ...]:
    """Return the names of the families that this tableau can serve.

    >>> from orderconds.check import read
    >>> served(read("rk4"))
    ('rk', 'cg', 'rkmk', 'sprk', 'vcg', 'vrkmk')
    >>> served(read("cg4")), served(read("cf3"))
    (('rk', 'cg', 'rkmk'), ('rk', 'cf'))
    """
    method, ring = tableau.method, tableau.ring
    if isinstance(method, Splitting):
        several = f"splitting({len(method.parts)})" if len(method.parts) > 2 else "splitting"
        return (several,) if method.rkn is None else (several, "rkn")
    if isinstance(method, Magnus):
        return ("magnus",) if method.transform == "exp" else ("cayley",)
    if isinstance(method, AdjointComposition):
        return ("composition", "splitting")
    if isinstance(method, PartitionedRungeKutta):
        return ("sprk_separable",) if symplectic_pair(method, ring) else ("prk",)
    if isinstance(method, CommutatorFree):
        return ("rk", "cf", "vcf") if _nonzero(method.as_runge_kutta(ring).b, ring) else ("rk", "cf")
    if isinstance(method, Composition):
        palindrome = reads_backwards(method.gamma, ring)
        own = ("composition", "symmetric_composition") if palindrome else ("composition",)
        return own + ON_GROUPS + (VARIATIONAL if _nonzero(method.gamma, ring) else ())
    assert isinstance(method, RungeKutta)
    return ON_GROUPS + (VARIATIONAL if _nonzero(method.b, ring) else ())


def unclaimed(tableau: Tableau) -> tuple[str, ...]:
    """Return the families that the tableau can serve and its file claims no order in.

    >>> from orderconds.tableau import find
    >>> unclaimed(Tableau.load(find("kutta3")))
    ()
    """
    claimed = {claim.family for claim in tableau.claims.orders} | {c.label for c in tableau.claims.orders}
    return tuple(name for name in served(tableau) if name not in claimed)


def _nonzero(weights: Sequence[Element], ring: Ring) -> bool:
    return all(ring.is_zero(x) is False for x in weights)
