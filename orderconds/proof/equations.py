"""The decimals in a tableau file approximate a solution of a system of equations. This module returns the
equations.

Without a reduction, the system contains one equation for every independent condition of one family. A
reduction is a theorem that makes some equations unnecessary. The assumptions of a reduction are verified
exactly, from the formulas in the file and not from the decimals:

- ``symmetric``, for a palindromic composition of a symmetric method: the conditions of even order follow
  from conditions of lower order. There is one condition for each Lyndon word in the letters 1, 3, 5, ...
  (Hairer, Lubich and Wanner, *Geometric Numerical Integration*, V.3.1-3.2). If the symmetric method is the
  midpoint rule, one proof is sufficient for two families: on a vector space, the composition is a Runge-Kutta
  method (family ``rk``), and on a group, it is a Crouch-Grossman method (family ``cg``). Both methods have
  the same order (Bogfjellmo and Marthinsen, Lemma 3.5.4).
- ``symmetric``, for a Magnus method on s Gauss nodes: up to order 2s, the conditions for words in the letters
  1, ..., s are sufficient (Iserles and Norsett 1999).
- ``low-storage``, for a scheme with two registers (2N scheme): the conditions for vector spaces are
  sufficient for groups, too (:mod:`orderconds.series.two_registers`).
- ``simplifying``: Butcher's simplifying assumptions B(p), C(q), D(r) imply order min(p, q + r + 1, 2q + 2)
  (Butcher 1964; Hairer, Norsett and Wanner, Theorem II.7.4).
- ``spelling``, for a file that defines coefficients by formulas: because of the formulas, some conditions
  follow from the others (:mod:`orderconds.proof.subfamily`).

For the embedded method of a 2N scheme, all conditions of the family ``rk`` are used
(docs/explanation/two_registers.md).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from orderconds import families
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError, TableauError
from orderconds.families import Family
from orderconds.families.base import expect
from orderconds.proof.krawczyk import NotProved
from orderconds.ring.jets import Jet
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau import CommutatorFree, Magnus, Method, RungeKutta, Tableau
from orderconds.tableau.evaluate import evaluate, rounded_and_exact
from orderconds.tableau.methods import EmbeddedUpdate
from orderconds.tableau.properties import properties
from orderconds.tableau.simplifying import simplifying, simplifying_order
from orderconds.tableau.two_registers import second_exponent
from orderconds.tableau.unknowns import Proof, RootedRing


@dataclass(frozen=True)
class Equations:
    """The equations for the unknowns of ``tableau``. The tableau file contains rounded decimals. The unknowns
    are the exact numbers that these decimals approximate. The decimals in ``proof.pinned`` count as exact
    numbers and not as unknowns.

    ``facts`` contains the orders that the equations imply, as pairs (family, order).
    """

    tableau: Tableau
    proof: Proof
    facts: tuple[tuple[str, int], ...]
    letters: int | None = None
    """If the value is an integer s, only conditions for words in the letters 1, ..., s are used."""
    kept: tuple[OrderCondition, ...] | None = None
    """The conditions of the main method that become equations. If the value is None, there are two cases.
    With a reduction, ``proof.reduction`` and ``letters`` determine the equations. Without a reduction, the
    equations are the conditions in ``family.conditions(n)`` for n = 1, ..., ``proof.order``. Some of these
    conditions may be dependent."""
    lower: tuple[OrderCondition, ...] = ()
    """The conditions of the embedded method of a low-storage (2N) scheme. In the list of equations, these
    conditions are placed after the conditions of the scheme."""
    lower_facts: tuple[tuple[str, int], ...] = ()
    """The orders of the embedded method, as pairs (family, order). The conditions in ``lower`` imply these
    orders."""

    def __call__(
        self, point: Sequence[Element], ring: RootedRing, places: Sequence[int] | None = None
    ) -> list[Element]:
        """Return the left-hand side minus the right-hand side of each equation.

        ``point`` contains the values of the unknowns, as elements of ``ring``. If ``places`` is given, only
        the equations with these indices are evaluated.
        """
        values = {u.name: x for u, x in zip(self.proof.unknowns, point, strict=True)}
        method, embedded = self.proof.over(ring, values)
        if self.proof.reduction == "simplifying":
            every = list(simplifying(expect(method, RungeKutta), ring, self.proof.assumptions))
            return every if places is None else [every[i] for i in places]
        family = families.get(self.proof.conditions)
        if self.proof.reduction == "symmetric":
            family = families.get(self.tableau.family).symmetric_family(method) or family
        read = _read(family, replace(self.tableau, ring=ring, method=method), self.proof)
        conditions = self._conditions(family)
        chosen = range(len(conditions) + len(self.lower)) if places is None else places
        wanted = [conditions[i] for i in chosen if i < len(conditions)]
        residuals = list(family.residuals(read, ring, wanted))
        second = [self.lower[i - len(conditions)] for i in chosen if i >= len(conditions)]
        if second:
            tableau = replace(self.tableau, ring=ring, method=method, embedded=embedded).lower()
            assert tableau is not None
            residuals += family.residuals(_read(family, tableau, self.proof), ring, second)
        return residuals

    def _conditions(self, family: Family) -> tuple[OrderCondition, ...]:
        if self.kept is not None:
            return self.kept
        return _up_to(
            family.label(), self.proof.order, 2 if self.proof.reduction == "symmetric" else 1, self.letters
        )


def _read(family: Family, tableau: Tableau, proof: Proof) -> Method:
    method = family.read(tableau)
    if method is None:
        raise InputError(
            f"conditions = {proof.conditions!r}",
            where=f"{tableau.path or tableau.name}: proof",
            expected=f"a family that accepts tableaux of format {tableau.family}",
        )
    return method


@lru_cache(maxsize=8)
def _up_to(label: str, order: int, step: int, letters: int | None) -> tuple[OrderCondition, ...]:
    family = families.get(label)
    orders = range(1, order + 1, step)
    # ``family.conditions`` omits dependent conditions. The dependence was computed modulo primes. The proof
    # requires that these conditions are also dependent over the rationals Q.
    for n in orders:
        if not family.dependence_holds(n):
            raise NotProved(
                f"family {label}, order {n}: a relation between conditions was computed modulo primes and "
                "does not hold over Q"
            )
    conditions = [c for n in orders for c in family.conditions(n)]
    return tuple(c for c in conditions if letters is None or max(c.key) <= letters)


def equations(tableau: Tableau) -> Equations:
    """Return the equations that the ``[proof]`` table of a tableau file specifies.

    The key ``reduction`` of the table can name a theorem (see the module docstring). Raises
    :class:`NotProved` if the theorem does not apply to the method. Raises :class:`InputError` for an unknown
    family.

    >>> from orderconds.tableau import find
    >>> equations(Tableau.load(find("cg4a"))).facts
    (('cg', 4),)
    """
    proof = tableau.proof
    if proof is None:
        raise NotProved("the file specifies no equations; add a table [proof]")
    if proof.reduction == "simplifying":
        order = simplifying_order(**{key: proof.assumptions.get(key, 0) for key in "BCD"})
        return Equations(tableau, proof, (("rk", _reached(proof, order)),))
    if proof.reduction == "symmetric":
        if properties(tableau).get("symmetric") is not True:
            raise NotProved(
                'reduction = "symmetric": the formulas in the file do not prove that the method is symmetric'
            )
        if proof.order % 2:
            raise NotProved(
                f'reduction = "symmetric": the order of a symmetric method is even, but [proof] states '
                f"order = {proof.order}"
            )
        own, named = families.get(tableau.family), families.get(proof.conditions)
        family = named if own.symmetric_family(tableau.method) is None else own
        return Equations(tableau, proof, family.symmetric_facts(proof.order), _letters(tableau, proof))
    if proof.reduction == "low-storage":
        if not any(place.startswith("low_storage.") for place in proof.symbolic.expressions):
            raise NotProved('reduction = "low-storage": the file has no table [low_storage]')
        implied = families.get(proof.conditions).low_storage
        if not implied:
            raise NotProved('reduction = "low-storage" requires conditions = "rk"')
        facts = tuple((label, proof.order) for label in implied)
        lower = _second_update(tableau, proof)
        order = max((c.order for c in lower), default=0)
        return Equations(
            tableau,
            proof,
            facts,
            kept=_two_registers(proof),
            lower=lower,
            lower_facts=tuple((label, order) for label in implied) if lower else (),
        )
    fact = (families.get(proof.conditions).label(), proof.order)
    kept = _independent(tableau, proof) if proof.reduction == "spelling" else None
    return Equations(tableau, proof, (fact,), kept=kept)


def _two_registers(proof: Proof) -> tuple[OrderCondition, ...]:
    """Return the independent conditions of low-storage (2N) schemes up to the order in ``proof``."""
    from orderconds.series.two_registers import independent_trees

    trees = {tree for n in range(1, proof.order + 1) for tree in independent_trees(n)}
    return tuple(c for c in _up_to(proof.conditions, proof.order, 1, None) if c.key in trees)


def _second_update(tableau: Tableau, proof: Proof) -> tuple[OrderCondition, ...]:
    """Return the conditions of the embedded method of a low-storage (2N) scheme. The embedded update must
    consist of the exponentials of the method and one additional exponential. Otherwise the result is
    empty."""
    method, embedded = tableau.method, tableau.embedded
    if not isinstance(method, CommutatorFree) or not isinstance(embedded, EmbeddedUpdate):
        return ()
    if second_exponent(method, embedded.update, tableau.ring) is None or embedded.order > proof.order:
        return ()
    return _up_to(proof.conditions, embedded.order, 1, None)


def _independent(tableau: Tableau, proof: Proof) -> tuple[OrderCondition, ...]:
    """Return conditions that imply all conditions up to the order in ``proof``.

    The tableau file defines some coefficients by formulas, such as ``b2 = "1 - b1"``. The implication holds
    for methods whose coefficients satisfy these formulas. It may fail for other methods.
    """
    from orderconds.proof.subfamily import decisive_conditions, independent_conditions

    family = families.get(proof.conditions)
    candidates = tuple(c for of_order in decisive_conditions(family, proof.order) for c in of_order)
    if len(candidates) == len(proof.unknowns):
        return candidates

    def read(method: Method, ring: Ring) -> Method:
        return _read(family, replace(tableau, ring=ring, method=method), proof)

    return independent_conditions(family, proof.symbolic, proof.order, read)


def _letters(tableau: Tableau, proof: Proof) -> int | None:
    """Return the number s of nodes of a Magnus method if the nodes are proved to be the Gauss nodes and the
    order in ``proof`` is at most 2s. Otherwise, return None.

    If the result is s, the conditions for words in the letters 1, ..., s imply the conditions for all other
    words up to the order in ``proof``.
    """
    method = tableau.method
    if not isinstance(method, Magnus) or proof.order > 2 * method.s:
        return None
    symbolic = proof.symbolic
    nodes = {place: x for place, x in symbolic.expressions.items() if re.fullmatch(r"c\[\d+\]", place)}
    exact = {name: x for name, x in symbolic.numbers.items() if not any(c.unit for c in rounded_and_exact(x))}
    try:
        ring, values = evaluate(nodes, exact, symbolic.where)
    except TableauError:  # TableauError is raised if a node depends on a rounded decimal.
        return None
    return method.s if gauss_nodes(list(values.values()), ring) else None


def gauss_nodes(nodes: Sequence[Element], ring: Ring) -> bool:
    """Return True if the numbers in ``nodes`` are proved to be the Gauss nodes on [0, 1].

    >>> from orderconds.ring import QQ
    >>> gauss_nodes([QQ.rational(1, 2)], QQ), gauss_nodes([QQ.zero, QQ.one], QQ)
    (True, False)
    """
    polynomial = [ring.one]
    for node in nodes:
        polynomial = [
            x - node * y for x, y in zip([ring.zero, *polynomial], [*polynomial, ring.zero], strict=True)
        ]
    return all(
        ring.is_zero(sum((x * ring.rational(1, j + k + 1) for j, x in enumerate(polynomial)), ring.zero))
        is True
        for k in range(len(nodes))
    )


def _reached(proof: Proof, order: int) -> int:
    if proof.order > order:
        raise NotProved(
            f'reduction = "simplifying": the simplifying assumptions imply only order {order}, but [proof] '
            f"states order = {proof.order}"
        )
    return proof.order


def independent(system: Equations, values: Sequence[Jet]) -> list[int]:
    """Omit the equations that hold for all values of the unknowns. Return the indices of the other equations.

    ``values`` contains one jet for each equation. Each unknown varies in an interval. The jet consists of
    balls. The balls enclose the left-hand side minus the right-hand side of the equation, and the partial
    derivatives of this difference. If all balls of an equation contain zero, the equation is tested in exact
    arithmetic at a random point.

    >>> from flint import arb
    >>> from orderconds.ring.jets import Jets
    >>> from orderconds.tableau import find
    >>> system = equations(Tableau.load(find("cg4a")))
    >>> ring = Jets(len(system.proof.unknowns))
    >>> decimals = [arb(str(float(u.constant.value))) for u in system.proof.unknowns]
    >>> len(independent(system, system([ring.variable(i, x) for i, x in enumerate(decimals)], ring)))
    13
    """
    flat = [i for i, f in enumerate(values) if f.value.contains(0) and all(g.contains(0) for g in f.gradient)]
    if not flat:
        return list(range(len(values)))
    from orderconds.tableau.random_member import OUTSIDE, RandomMember

    R = RandomMember(system.proof.symbolic)
    try:
        exact = system([R.variable(u.constant) for u in system.proof.unknowns], R, flat)
    except OUTSIDE:
        return list(range(len(values)))
    identical = {i for i, x in zip(flat, exact, strict=True) if R.is_zero(x)}
    return [i for i in range(len(values)) if i not in identical]
