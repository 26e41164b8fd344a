"""The cost of a step: field evaluations, exponentials and brackets.

A field evaluation is counted for each stage on which the update depends. The counts of an implicit method are
those of one iteration.

Equal exponents count as one exponential. A Munthe-Kaas method needs the brackets of dexpinv at each stage on
which the update depends. A stage that is equal to the start value needs no brackets. For a Magnus method, the
brackets are the commutators in the exponents, and equal commutators are counted once. A Cayley transform
counts as an exponential.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.brackets import Bracket, Product, Term, spell
from orderconds.tableau.methods import CommutatorFree, PartitionedRungeKutta, RungeKutta
from orderconds.tableau.products import Magnus
from orderconds.tableau.record import Tableau


@dataclass(frozen=True)
class Work:
    """Numbers of vector field evaluations, exponentials and brackets in one step. A number is None
    if the operation is not counted. For a classical Runge-Kutta method, for example, exponentials are not
    counted."""

    evaluations: int
    exponentials: int | None = None
    brackets: int | None = None

    def as_json(self) -> dict[str, int | None]:
        """Return the numbers of evaluations, exponentials and brackets as a dictionary for JSON."""
        return asdict(self)


def evaluations(tableau: Tableau) -> Work | None:
    """Return a :class:`Work` object that contains only the number of field evaluations of a step. Return None
    for splittings and other methods that have no field evaluations.

    >>> from orderconds.tableau import find
    >>> evaluations(Tableau.load(find("rk4")))
    Work(evaluations=4, exponentials=None, brackets=None)
    """
    method, ring = tableau.read_as(("rk", "cf", "prk")), tableau.ring
    if isinstance(method, RungeKutta):
        return Work(_stages_evaluated(method, ring))
    if isinstance(method, CommutatorFree):
        return Work(len(_used(_rows(method, ring), ring)))
    return Work(method.s) if isinstance(method, PartitionedRungeKutta) else None


def commutator_free_work(tableau: Tableau) -> Work | None:
    """Return the cost of a step of a commutator-free method. A Butcher tableau is interpreted as a
    Crouch-Grossman method. For a partitioned method, only field evaluations are counted. Return None for
    splittings and Magnus methods.

    >>> heun = Tableau.loads('name = "t"\\nfamily = "rk"\\nA = [[], [1]]\\nb = ["1/2", "1/2"]')
    >>> commutator_free_work(heun)
    Work(evaluations=2, exponentials=3, brackets=0)
    """
    method, ring = tableau.read_as(("cf", "rk")), tableau.ring
    counted = evaluations(tableau)
    if counted is None:
        return None
    if isinstance(method, RungeKutta):
        method = method.as_crouch_grossman(ring)
    if not isinstance(method, CommutatorFree):
        return counted
    return Work(counted.evaluations, _distinct(_rows(method, ring), ring), 0)


def crouch_grossman_work(tableau: Tableau) -> Work | None:
    """Return the cost of a step of a Crouch-Grossman method. For a method without a Butcher tableau, only
    field evaluations are counted (:func:`evaluations`).

    >>> from orderconds.tableau import find
    >>> crouch_grossman_work(Tableau.load(find("cg3")))
    Work(evaluations=3, exponentials=6, brackets=0)
    """
    if isinstance(tableau.method, CommutatorFree):
        return evaluations(tableau)
    return commutator_free_work(tableau)


def munthe_kaas_work(tableau: Tableau, cutoff: int | None) -> Work | None:
    """Return the cost of a step of a Runge-Kutta-Munthe-Kaas method. The series of dexpinv is truncated after
    the term with ``cutoff`` brackets. If ``cutoff`` is None, brackets are not counted. For a method without a
    Butcher tableau, only field evaluations are counted (:func:`evaluations`).

    >>> heun = Tableau.loads('name = "t"\\nfamily = "rk"\\nA = [[], [1]]\\nb = ["1/2", "1/2"]')
    >>> munthe_kaas_work(heun, 1)
    Work(evaluations=2, exponentials=2, brackets=1)
    """
    method, ring = tableau.read_as(("rk",)), tableau.ring
    if not isinstance(method, RungeKutta):
        return evaluations(tableau)
    needed = _needed(method, ring)
    moved = [method.A[i] for i in needed if any(ring.is_zero(x) is not True for x in method.A[i])]
    count = len(moved) * _nested(cutoff)
    return Work(_stages_evaluated(method, ring), _distinct(moved, ring) + 1, count)


def magnus_work(tableau: Tableau) -> Work | None:
    """Return the cost of a step of a Magnus method: the numbers of nodes, distinct exponents and distinct
    commutators. Return None for all other methods.

    >>> from orderconds.tableau import find
    >>> magnus_work(Tableau.load(find("magnus4")))
    Work(evaluations=2, exponentials=1, brackets=1)
    """
    if not isinstance(tableau.method, Magnus):
        return None
    return _linear(tableau.method, tableau.ring)


def _stages_evaluated(method: RungeKutta, ring: Ring) -> int:
    # The last stage of an explicit first-same-as-last method is not counted: the update does not depend on
    # this stage.
    return len(_needed(method, ring))


def _needed(method: RungeKutta, ring: Ring) -> list[int]:
    """Return the indices of the stages on which the update depends, in ascending order."""
    needed = _used([method.b], ring)
    waiting = sorted(needed)
    while waiting:
        further = _used([method.A[waiting.pop()]], ring) - needed
        needed |= further
        waiting += sorted(further)
    return sorted(needed)


def _rows(method: CommutatorFree, ring: Ring) -> list[tuple[Element, ...]]:
    """Return the arguments of all exponentials that are needed for a step: the exponentials in the update,
    and those in each stage on which the update depends."""
    rows: list[tuple[Element, ...]] = []
    reached: set[int] = set()
    waiting = [method.update]
    while waiting:
        stage = waiting.pop()
        rows += stage.exponentials
        # ``stage`` depends on the stages in its exponents and on ``stage.start``.
        further = _used(stage.exponentials, ring) | ({stage.start} if stage.start is not None else set())
        waiting += [method.stages[j] for j in sorted(further - reached)]
        reached |= further
    return rows


def _used(rows: Iterable[Sequence[Element]], ring: Ring) -> set[int]:
    """Return the indices of the columns in which at least one row has a non-zero entry."""
    return {j for row in rows for j, x in enumerate(row) if ring.is_zero(x) is not True}


def _linear(method: Magnus, ring: Ring) -> Work:
    """Count the nodes, the distinct exponents and the distinct brackets of a Magnus method."""
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
    """Return the number of brackets in one evaluation of dexpinv_u, where the series sum_k (B_k / k!) ad_u^k
    ends at k = ``cutoff``. The result is the largest k <= ``cutoff`` for which the Bernoulli number B_k is
    not zero. If ``cutoff`` is None, brackets are not counted, and the result is 0."""
    if cutoff is None or cutoff < 2:
        return cutoff or 0
    return cutoff - cutoff % 2


def _distinct(rows: Sequence[Sequence[Element]], ring: Ring) -> int:
    """Return the number of distinct rows that are not zero."""
    moving = [row for row in rows if any(ring.is_zero(x) is not True for x in row)]
    return len({tuple(ring.key(x) for x in row) for row in moving})
