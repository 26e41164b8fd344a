"""What a step costs: field evaluations, exponentials and brackets, on the tableau as a family reads it.

Evaluations are those of a step after another: stages that enter the update, an explicit first-same-as-last
stage not counted again. Of an implicit method they are those of one sweep of its iteration. Equal exponents
are one exponential, applied where it is needed; brackets are those of dexpinv applied stage by stage, without
simplification (dexpinv of the zero argument needs none). Of a Magnus method they are the commutators that it
spells, each once, and an exponential may be a Cayley transform.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.brackets import Bracket, Product, Term, spell
from orderconds.tableau.methods import CommutatorFree, PartitionedRungeKutta, RungeKutta
from orderconds.tableau.products import Magnus
from orderconds.tableau.properties import explicit, fsal
from orderconds.tableau.record import Tableau

SINGLE = ("cg", "vcg")
"""One stage in each exponential."""
FREE = ("cf", "vcf")
WITH_BRACKETS = ("rkmk", "vrkmk")


@dataclass(frozen=True)
class Work:
    """Field evaluations, exponentials and brackets of one step; the latter two are None off a group."""

    evaluations: int
    exponentials: int | None = None
    brackets: int | None = None

    def as_json(self) -> dict[str, int | None]:
        """Return the JSON object of the counts."""
        return asdict(self)


def work(tableau: Tableau, family: str, cutoff: int | None = None) -> Work | None:
    """Return what a step of ``tableau`` read as ``family`` costs, or None for a format that is not counted.

    >>> from orderconds.tableau import Tableau, find
    >>> heun = Tableau.loads('name = "t"\\nfamily = "rk"\\nA = [[], [1]]\\nb = ["1/2", "1/2"]')
    >>> work(heun, "cg"), work(heun, "rkmk", 1)
    (Work(evaluations=2, exponentials=3, brackets=0), Work(evaluations=2, exponentials=2, brackets=1))
    """
    ring = tableau.ring
    if isinstance(tableau.method, Magnus):
        return _linear(tableau.method, ring)
    method = tableau.read_as(("cf", "rk", "prk") if family in FREE else ("rk", "cf", "prk"))
    if isinstance(method, CommutatorFree):
        rows = [row for stage in (*method.stages, method.update) for row in stage.exponentials]
        used = sum(any(ring.is_zero(row[j]) is not True for row in rows) for j in range(len(method.stages)))
        return Work(used, _distinct(rows, ring), 0) if family in FREE else Work(used)
    if isinstance(method, PartitionedRungeKutta):
        return Work(method.s)
    if not isinstance(method, RungeKutta):
        return None
    evaluations = method.s - (1 if explicit(method, ring) and fsal(method, ring) else 0)
    if family in SINGLE or family in FREE:
        free = method.as_crouch_grossman(ring)
        rows = [row for stage in (*free.stages, free.update) for row in stage.exponentials]
        return Work(evaluations, _distinct(rows, ring), 0)
    if family in WITH_BRACKETS:
        moved = [any(ring.is_zero(x) is not True for x in row) for row in method.A]
        exponentials = _distinct([row for row, moves in zip(method.A, moved, strict=True) if moves], ring)
        return Work(evaluations, exponentials + 1, sum(moved) * _nested(cutoff))
    return Work(evaluations)


def _linear(method: Magnus, ring: Ring) -> Work:
    """Count what the exponents of a Magnus method use: nodes, different exponents, brackets spelled."""
    elements = dict(method.elements)
    used: dict[Term, None] = {}

    def use(term: Term) -> None:
        if term in used:
            return
        used[term] = None
        if isinstance(term, str):
            inner = [t for t, x in elements[term] if ring.is_zero(x) is not True]
        elif isinstance(term, Product):
            inner = list(term.factors)
        else:
            inner = [term.left, term.right] if isinstance(term, Bracket) else []
        for t in inner:
            use(t)

    exponents = set()
    for combination in method.exponents:
        kept = [(term, x) for term, x in combination if ring.is_zero(x) is not True]
        exponents.add(tuple((spell(term), ring.key(x)) for term, x in kept))
        for term, _ in kept:
            use(term)
    nodes, brackets = (sum(isinstance(term, kind) for term in used) for kind in (int, Bracket))
    return Work(nodes, len(exponents), brackets)


def _nested(cutoff: int | None) -> int:
    """Return how many brackets dexpinv cut after this power takes: up to the last B_k that is not zero."""
    if cutoff is None or cutoff < 2:
        return cutoff or 0
    return cutoff - cutoff % 2


def _distinct(rows: Sequence[Sequence[Element]], ring: Ring) -> int:
    """Return how many different exponents there are, the zero one not counted."""
    moving = [row for row in rows if any(ring.is_zero(x) is not True for x in row)]
    return len({tuple(ring.key(x) for x in row) for row in moving})
