"""The independent conditions of a sub-family of methods.

Formulas such as ``b3 = "1 - b1 - b2"`` in a tableau file restrict a family to a sub-family. Let
l_1 = r_1, l_2 = r_2, ... be the independent conditions of the sub-family. A dependent condition has the form
P(l_1, l_2, ...) = P(r_1, r_2, ...) with a polynomial P, and therefore follows from the independent
conditions.

The polynomials P are computed modulo primes (:mod:`orderconds.proof.dependence`). Each polynomial is verified
in exact arithmetic for one random method (:mod:`orderconds.proof.exact_member`). A wrong polynomial passes
this verification only with negligible probability.
"""

from __future__ import annotations

from orderconds.conditions import OrderCondition
from orderconds.families import Family
from orderconds.proof.dependence import dependences
from orderconds.proof.exact_member import Reading, exact_member, lone_square_root
from orderconds.ring.draws import Draws
from orderconds.tableau.random_member import description
from orderconds.tableau.unknowns import SymbolicCoefficients


def independent_conditions(
    family: Family, symbolic: SymbolicCoefficients, order: int, read: Reading | None = None
) -> tuple[OrderCondition, ...]:
    """Return conditions that imply all conditions up to ``order`` for the methods of the sub-family
    ``symbolic``.

    ``read(method, ring)`` converts a method to a format that ``family`` accepts. The coefficients of the
    method are elements of ``ring``. If ``read`` is None, the method is not converted.

    >>> from orderconds import families
    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["b1/2"], ["b1", "b2/2"]]\\nb = ["b1", "b2"]\\n'
    >>> text += '[numbers]\\nb1 = "0.4~"\\nb2 = "1 - b1"\\n[proof]\\nconditions = "vcg"\\norder = 3'
    >>> symbolic = Tableau.loads(text).proof.symbolic
    >>> [c.tree for c in independent_conditions(families.get("vcg"), symbolic, 3)]
    ['o(o o)']
    """
    candidates = decisive_conditions(family, order)
    everything = tuple(c for of_order in candidates for c in of_order)
    draws = Draws(family.label(), str(order), description(symbolic))
    surd = lone_square_root(symbolic)
    member = exact_member(family, symbolic, everything, draws, surd, read)
    if member is None:
        return everything
    kept = set(everything)
    for dependence in dependences(family, symbolic, candidates, draws, surd, read):
        unverified = {
            c for c, combination in dependence.combinations() if not member.verifies(c, combination)
        }
        kept = unverified.union(dependence.pivots)
        if not unverified:
            break
    return tuple(c for c in everything if c in kept and not member.holds(c))


def decisive_conditions(family: Family, order: int) -> list[tuple[OrderCondition, ...]]:
    """Return a list with one tuple of conditions for each order from 1 to ``order``. If a method of the
    family satisfies all conditions in the list, it satisfies all conditions up to ``order``.

    >>> from orderconds import families
    >>> [len(of_order) for of_order in decisive_conditions(families.get("vcg"), 3)]
    [1, 2, 10]
    """
    return [family.decisive_conditions(n) for n in range(1, order + 1)]
