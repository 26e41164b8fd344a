"""Properties of a tableau, computed from its coefficients.

The value of a property is True or False, or None if the property is undecided. For example, a property is
undecided if the coefficients are balls (intervals) that are too wide.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from orderconds.ring import Balls
from orderconds.ring.protocol import Ring
from orderconds.tableau.method_properties import (
    DEFINITIONS,
    Verdict,
    reads_backwards,
    symmetric_product,
    symplectic_pair,
)
from orderconds.tableau.methods import CommutatorFree, Composition, PartitionedRungeKutta, RungeKutta
from orderconds.tableau.palindromes import symmetric_paths
from orderconds.tableau.products import AdjointComposition, Magnus, Splitting
from orderconds.tableau.record import Tableau
from orderconds.tableau.stability import stability, stability_of_midpoints
from orderconds.tableau.two_registers import Rewriting, two_registers


def properties(tableau: Tableau) -> dict[str, Verdict]:
    """Return a verdict (True, False or None) for each property that is defined for this tableau. The keys of
    the result are the names of the properties, in the order of
    :data:`orderconds.tableau.method_properties.PROPERTIES`.

    >>> from orderconds.tableau import Tableau
    >>> midpoint = Tableau.loads('name = "m"\\nfamily = "rk"\\nA = [["1/2"]]\\nb = ["1"]')
    >>> [name for name, holds in properties(midpoint).items() if holds]
    ['diagonally_implicit', 'symplectic', 'symmetric', 'a_stable']
    """
    ring, method = tableau.ring, tableau.method
    if isinstance(method, CommutatorFree):
        palindrome = symmetric_paths(method, ring)
        return {
            "explicit": all(_commutator_free_explicit(method, ring)),
            "symmetric": _symmetric_for_all_decimals(tableau) if palindrome is None else palindrome,
            "fsal": _ends_at_update(method, ring),
            **_low_storage(tableau),
        }
    if isinstance(method, Composition):
        return _of_composition(method, ring)
    if isinstance(method, PartitionedRungeKutta):
        return {"symplectic": symplectic_pair(method, ring)}
    if isinstance(method, AdjointComposition | Splitting | Magnus):
        verdict = symmetric_product(method, ring)
        return {"symmetric": _symmetric_for_all_decimals(tableau) if verdict is None else verdict}
    return {**_of_tableau(method, ring), **_low_storage(tableau), **stability(method, ring)}


def low_storage(tableau: Tableau) -> Rewriting | None:
    """Rewrite a Runge-Kutta or commutator-free method as a low-storage scheme with two registers (2N). The
    result contains the scheme, or the reason why there is no such scheme. Return None if the method is
    neither a Runge-Kutta method nor a commutator-free method.

    If the file has a table ``[proof]``, the answer can depend on random numbers
    (:mod:`orderconds.tableau.random_member`). The probability of a wrong answer is negligible.

    >>> from orderconds.tableau import find
    >>> low_storage(Tableau.load(find("carpenter_kennedy4"))).holds
    True
    """
    method, ring = tableau.method, tableau.ring
    if not isinstance(method, RungeKutta | CommutatorFree):
        return None
    rewriting = two_registers(method, ring)
    if rewriting.holds is None and tableau.proof is not None:
        from orderconds.tableau.random_member import OUTSIDE, RandomMember

        member = RandomMember(tableau.proof.symbolic)
        try:
            drawn = member.method()
        except OUTSIDE:
            return rewriting
        if isinstance(drawn, RungeKutta | CommutatorFree) and two_registers(drawn, member).holds:
            return replace(rewriting, holds=True)
    return rewriting


def _low_storage(tableau: Tableau) -> dict[str, Verdict]:
    rewriting = low_storage(tableau)
    return {} if rewriting is None else {"low_storage": rewriting.holds}


def undecided(tableau: Tableau, computed: Mapping[str, Verdict]) -> dict[str, str]:
    """Return a map from each undecided property to the reason why it is undecided. ``computed`` is the result
    of :func:`properties`.

    >>> from orderconds.tableau import Tableau
    >>> rounded = Tableau.loads('name = "m"\\nfamily = "rk"\\nA = [["0.5~"]]\\nb = ["1"]')
    >>> undecided(rounded, properties(rounded))["a_stable"]
    'rounded decimals'
    """
    balls = isinstance(tableau.ring, Balls)
    slow = "not computed: the exact computation would take more than a second"
    rounded = "doubles" if tableau.doubles else "rounded decimals"
    reason = rounded if balls else slow
    return {name: reason for name, verdict in computed.items() if verdict is None}


def _symmetric_for_all_decimals(tableau: Tableau) -> Verdict:
    """Replace the rounded decimals by random numbers. Return True if the resulting method is symmetric, and
    None otherwise. The result is never False, because the method with the exact coefficients may still be
    symmetric."""
    if tableau.proof is None:
        return None
    from orderconds.tableau.random_member import OUTSIDE, RandomMember

    ring = RandomMember(tableau.proof.symbolic)
    try:
        method = ring.method()
    except OUTSIDE:
        return None
    if isinstance(method, CommutatorFree):
        return symmetric_paths(method, ring) or None
    assert isinstance(method, AdjointComposition | Splitting | Magnus)
    return symmetric_product(method, ring) or None


def _of_tableau(method: RungeKutta, ring: Ring) -> dict[str, Verdict]:
    return {name: holds(method, ring) for name, holds in DEFINITIONS.items()}


def _of_composition(method: Composition, ring: Ring) -> dict[str, Verdict]:
    """Return the properties of a composition of midpoint rules. Such a composition is always symplectic and
    diagonally implicit."""
    gamma = method.gamma
    verdicts = {
        **_of_tableau(method.as_runge_kutta(ring), ring),
        "low_storage": False,
        **stability_of_midpoints(gamma, ring),
    }
    palindrome = reads_backwards(gamma, ring)
    return {**verdicts, "diagonally_implicit": True, "symplectic": True, "symmetric": palindrome}


def _ends_at_update(method: CommutatorFree, ring: Ring) -> bool:
    """Return True if a method is first-same-as-last: the first stage value is y0, and the last stage value
    is y1."""
    first = [x for row in method.from_start(method.stages[0]) for x in row]
    starts = all(ring.is_zero(x) is True for x in first)
    return method.s > 1 and starts and method.same_update(method.stages[-1], ring)


def _commutator_free_explicit(method: CommutatorFree, ring: Ring) -> Iterable[bool]:
    for i, stage in enumerate(method.stages):
        for row in stage.exponentials:
            yield all(ring.is_zero(x) is True for x in row[i:])
