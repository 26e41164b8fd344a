"""The largest order of VRKMK(r), whose dexpinv is cut after the power r, computed from the action series.

An oracle for the rule min(p, R + 2) that the proofs of orderconds use. Without a cut, VRKMK is the symplectic
partitioned Runge-Kutta method (SPRK) in canonical coordinates, and has its order p. With a cut it has the
same values on all trees with few vertices. The first tree on which the values differ ends the order, for
every tableau: all values are polynomials in those of SPRK, so the difference is a constant once p is high
enough. The computation gives R = r for r = 0 and odd r, and R = r + 1 for even r >= 2, because the odd
Bernoulli numbers from B_3 on vanish. Theorem 3.5.3 of Bogfjellmo and Marthinsen asks for r >= p - 2, which
gives even r one order less.
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
    """Return the tree ``o(o|L(o ... o))``, the first on which a cut of dexpinv changes a value.

    >>> witness(4)
    o(o|L(o o))
    """
    leaf = velocity()
    return velocity((leaf,), (transport((leaf,) * (vertices - 2)),))


def _likeliest_first(vertices: int) -> Iterator[Velocity]:
    """Yield the witness, then one tree of each class, which need not be enumerated if the witness decides."""
    if vertices > 2:
        yield witness(vertices)
    yield from representatives(vertices)
