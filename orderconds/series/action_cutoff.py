"""How much of dexpinv VRKMK needs: the order rule, computed from the series.

Uncut, VRKMK is the symplectic partitioned Runge-Kutta method (SPRK) in canonical coordinates, and has its
order p. Cut after the power r it has the same values on all trees with few vertices; the first tree on which
it differs ends the order, for every tableau: the values of either are polynomials in those of SPRK, so that
the difference is a constant once p is high enough. The order is therefore min(p, R + 2), where the
computation gives R = r for r = 0 and odd r, R = r + 1 for even r >= 2: odd Bernoulli numbers from B_3 on
vanish.
Theorem 3.5.3 of Bogfjellmo and Marthinsen, which asks for r >= p - 2, gives even r one order less.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from orderconds.ring.residues import Residues
from orderconds.series.action_lie import MuntheKaasActionSeries
from orderconds.series.action_switching import representatives
from orderconds.series.action_trees import Velocity, transport, velocity

STAGES = 3
SAMPLES = 2


def highest_order(cutoff: int, limit: int = 7) -> int:
    """Return the highest order, up to ``limit``, of VRKMK with dexpinv cut after the power ``cutoff``.

    A tableau of SPRK order p then has order min(p, this). Compared on random tableaux modulo a prime: that an
    order fails is proved, that one holds is so up to chance, about one in 10^9 a tree.

    >>> [highest_order(r, limit=5) for r in (0, 1, 2, 3)]
    [2, 3, 5, 5]
    """
    ring, generator = Residues(samples=SAMPLES), np.random.default_rng(0)
    rows = [[ring.random(generator) for _ in range(STAGES)] for _ in range(STAGES + 1)]
    cut, whole = (MuntheKaasActionSeries(ring, rows[:-1], rows[-1], r) for r in (cutoff, None))
    for order in range(1, limit + 1):
        if any(cut.condition(tree) != whole.condition(tree) for tree in _likeliest_first(order)):
            return order - 1
    return limit


def witness(vertices: int) -> Velocity:
    """Return the tree ``o(o|L(o ... o))``, on which a cut of dexpinv shows first.

    >>> witness(4)
    o(o|L(o o))
    """
    leaf = velocity()
    return velocity((leaf,), (transport((leaf,) * (vertices - 2)),))


def _likeliest_first(vertices: int) -> Iterator[Velocity]:
    """Yield one tree of each class, but before all the witness, so that the rest need not be made."""
    if vertices > 2:
        yield witness(vertices)
    yield from representatives(vertices)
