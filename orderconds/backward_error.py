"""Modified equations of numerical methods.

One step of a method for y' = f(y) is the exact flow of the modified field f~ = f + h f_2 + h^2 f_3 + ..., a
formal series in the step size h. If the method is symplectic and f is Hamiltonian, f~ is the vector field of
a modified Hamiltonian (Hairer, Lubich and Wanner, *Geometric Numerical Integration*, Chapter IX).

On a Lie group, the field y -> f(p).y is called the field frozen at the point p. For a Lie group method, the
fields f_2, f_3, ... are sums of elementary differentials of f and of commutators of elementary differentials.
The derivatives in an elementary differential are taken along frozen fields (Lundervold and Munthe-Kaas,
Contemp. Math. 539 (2011) 295).

The *modifying* field solves the inverse problem: if the method is applied to the modifying field, one step is
the exact flow of f (Chartier, Hairer and Vilmart, Math. Comp. 76 (2007) 1941).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from orderconds import families
from orderconds.errors import InputError
from orderconds.explain import differentials
from orderconds.families.ordered_forests import OrderedForestFamily, lyndon_forests
from orderconds.families.rk import RungeKuttaFamily
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import runge_kutta_series
from orderconds.series.characters import ORDERED, ROOTED, Character
from orderconds.series.modified_equations import VectorField, modified_field, modified_hamiltonian
from orderconds.series.substitution import modifying_field
from orderconds.tableau import RungeKutta, Tableau
from orderconds.trees.levels import Tree, symmetry, text, trees_of
from orderconds.trees.rooted import rooted_trees
from orderconds.words.lie import coordinates_from_values, standard_bracketing
from orderconds.words.shuffle import Word

SERIES = (RungeKuttaFamily, OrderedForestFamily)
"""The classes of the families whose methods have a B-series or a Lie-Butcher series."""


def default_families() -> tuple[str, ...]:
    """Return the names of the default families.

    If no family is given, the first default family that accepts the tableau is used.

    >>> default_families()
    ('rk', 'cf')
    """
    return tuple(name for name in families.names() if families.family_class(name).default_series)


@dataclass(frozen=True)
class Term:
    """One term of a series in the step size h.

    The term is the product of h^(order - 1), ``coefficient`` and a function. The function is an elementary
    differential, a commutator of elementary differentials, or an elementary Hamiltonian.

    - ``name`` is the formula of the function as text.
    - ``tree`` is the tree of the function in bracket notation. For a commutator, ``tree`` is a Lyndon word of
      ordered trees.
    """

    order: int
    tree: str
    name: str
    coefficient: Element


@dataclass(frozen=True)
class ModifiedEquation:
    """The modified field or the modifying field of a method for y' = f(y).

    One step of the method is the exact flow of the modified field. If the method is applied to the modifying
    field, one step is the exact flow of f.

    - ``family`` is the label of the method's family.
    - ``terms`` contains the non-zero terms of the field up to h^(``order`` - 1), where h is the step size.
    - ``hamiltonian`` contains the terms of the Hamiltonian. The value is None if the method has no B-series,
      or if the field is not proved to be Hamiltonian.
    """

    family: str
    order: int
    ring: Ring
    terms: tuple[Term, ...]
    hamiltonian: tuple[Term, ...] | None

    def as_json(self) -> dict[str, object]:
        """Return the modified equation as a dictionary for the JSON output of ``orderconds modified``."""
        hamiltonian = None if self.hamiltonian is None else [self._record(term) for term in self.hamiltonian]
        return {
            "family": self.family,
            "order": self.order,
            "terms": [self._record(term) for term in self.terms],
            "hamiltonian": hamiltonian,
        }

    def _record(self, term: Term) -> dict[str, object]:
        return {
            "order": term.order,
            "tree": term.tree,
            "name": term.name,
            "coefficient": self.ring.text(term.coefficient),
            "approximate": self.ring.approximate(term.coefficient, 17),
        }


def modified_equation(
    tableau: Tableau, order: int, family: str | None = None, *, modifying: bool = False
) -> ModifiedEquation:
    """Return the modified equation of ``tableau``, with the terms up to h^(order - 1).

    ``family`` is the name of a family whose methods have B-series (``rk``) or Lie-Butcher series (``cg``,
    ``cf``, ``rkmk(1)``). By default, the first family of :func:`default_families` that accepts the tableau is
    used.

    If ``modifying`` is true, return the modifying equation of y' = f(y). The method must then have a
    B-series.

    Raises :class:`~orderconds.errors.InputError` for an unsuitable family or tableau, and for an order below
    1.

    >>> from orderconds.checking import read
    >>> for term in modified_equation(read("euler"), 3).terms:
    ...     print(term.order, term.coefficient, term.name)
    1 1 f
    2 -1/2 f'(f)
    3 1/3 f'(f'(f))
    3 1/12 f''(f, f)
    >>> [(str(t.coefficient), t.name) for t in modified_equation(read("midpoint"), 3).hamiltonian]
    [('1', 'H'), ('-1/24', "H''(f, f)")]
    """
    if order < 1:
        raise InputError(f"order {order}", where="modified equation", expected="an order of at least 1")
    name, step = _step(tableau, family)
    field = modifying_field(step) if modifying else modified_field(step)
    rooted = step.algebra is ROOTED
    terms = (term for n in range(1, order + 1) for term in (_rooted if rooted else _ordered)(field, n))
    return ModifiedEquation(
        name,
        order,
        tableau.ring,
        tuple(term for term in terms if tableau.ring.is_zero(term.coefficient) is not True),
        _hamiltonian(field, order) if rooted else None,
    )


def _step(tableau: Tableau, family: str | None) -> tuple[str, Character]:
    """Return the label of the family, and the B-series or Lie-Butcher series of one step of the method."""
    for name in default_families() if family is None else (family,):
        candidate = families.get(name)
        method = tableau.read_as(candidate.formats)
        if method is None:
            continue
        if isinstance(candidate, OrderedForestFamily):
            return candidate.label(), Character(tableau.ring, ORDERED, candidate.series(method, tableau.ring))
        if isinstance(candidate, RungeKuttaFamily) and isinstance(method, RungeKutta):
            series = runge_kutta_series(tableau.ring, method.A, method.b)
            return candidate.label(), Character(tableau.ring, ROOTED, series)
        known = [n for n in families.names() if isinstance(families.get(n), SERIES)]
        raise InputError(
            f"family {name}, which has neither a B-series nor a Lie-Butcher series",
            where="modified equation",
            expected=f"one of {', '.join(known)}",
        )
    raise InputError(
        f"a tableau of format {tableau.family}",
        where=tableau.path or tableau.name,
        expected=f"a tableau that is a method of family {family or ' or '.join(default_families())}",
    )


def _rooted(field: VectorField, order: int) -> Iterator[Term]:
    for tree in rooted_trees(order):
        coefficient = field(tree) * field.ring.rational(1, symmetry(tree))
        yield Term(order, text(tree), differentials.differential(tree), coefficient)


def _ordered(field: VectorField, order: int) -> Iterator[Term]:
    def product(word: Word) -> Element:
        return field(b"".join(reversed(word)))

    words = map(trees_of, lyndon_forests(order))
    for word, coefficient in coordinates_from_values(product, words, _place).items():
        name = differentials.commutator(standard_bracketing(word, _place), differentials.frozen_differential)
        yield Term(order, text(b"".join(word)), name, coefficient)


def _place(tree: Tree) -> tuple[int, bytes]:
    """Return the sort key of an ordered tree. Trees with more vertices come first."""
    return -len(tree), bytes(255 - level for level in tree)


def _hamiltonian(field: VectorField, order: int) -> tuple[Term, ...] | None:
    """Return the terms of the modified Hamiltonian, or None if the field is not proved to be Hamiltonian."""
    try:
        terms = modified_hamiltonian(field, order)
    except InputError:
        return None
    return tuple(Term(len(tree), text(tree), differentials.hamiltonian(tree), x) for tree, x in terms)
