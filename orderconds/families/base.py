"""The base class of families, with every attribute and method that the rest of the program uses.

A family defines the series of a tableau. Its conditions compare this series with the series of the exact
flow. Facts about a family are attributes and methods of its class, with defaults in the base class. No other
module has a table of family names.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, ClassVar, TypeVar

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError, ZeroWeight
from orderconds.families.memo import Memo
from orderconds.families.reductions import Reductions, Substitute, UnseenCut
from orderconds.families.stage_form import StageForm, tableau_form
from orderconds.ring.balls import Balls, Enclosures
from orderconds.ring.precision import precision
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.products import Method

if TYPE_CHECKING:
    from typing import Self

    from orderconds.tableau.claims import OrderClaim
    from orderconds.tableau.record import Tableau
    from orderconds.tableau.work import Work

Key = Hashable
"""A family's own encoding of a tree, a forest or a word: the ``key`` of a condition."""

Kind = TypeVar("Kind")


class Family(ABC):
    """A family of methods.

    A subclass sets ``name``, ``description`` and ``formats`` and implements :meth:`conditions` and
    :meth:`evaluate`; all other attributes and methods have defaults. :func:`orderconds.families.register`
    makes it known to every command. The options of a family, such as ``cutoff`` of RKMK, are parameters of
    its class; they are integers.
    """

    name: ClassVar[str] = ""
    """The name of the family in commands and claims; lower case."""
    description: ClassVar[str] = ""
    """One line for ``orderconds list families``."""
    formats: ClassVar[tuple[str, ...]] = ()
    """The tableau formats that the family reads, the preferred one first."""
    has_tableau: ClassVar[bool] = True
    """Whether a tableau determines a method; without one the label of the family does, as ``taylor(12)``."""
    source: ClassVar[str] = ""
    """The publication of a family without tableau."""

    # Conditions
    needs_nonzero_weights: ClassVar[bool] = False
    """Whether the family divides by the weights b_i."""
    search_limit: ClassVar[int] = 8
    """The order up to which ``check`` searches without a claim. With a claim, it searches at least one order
    beyond the claim."""
    order_bound: ClassVar[int | None] = None
    """The highest order of any member, by a theorem; None without such a bound."""
    over_rationals: ClassVar[bool] = False
    """Whether conditions are evaluated by :mod:`orderconds.ring.nodal`, without field arithmetic."""
    trees: ClassVar[str | None] = None
    """The kind of the trees that index the conditions (:mod:`orderconds.explain.kinds`); None for words."""
    illustrates: ClassVar[tuple[str, ...]] = ()
    """The kinds of trees that ``orderconds trees --explain`` shows with the conditions of this family."""

    # Other families
    implies: ClassVar[Mapping[str, str]] = {}
    """Names of families whose conditions are a subset of this family's at every order, each with the
    theorem."""
    abelian: ClassVar[str | None] = None
    """The family of the same method on an abelian group, where brackets vanish; None if no family reads all
    tableaux."""
    low_order: ClassVar[str | None] = None
    """A family with the same conditions up to order 2, which involve no bracket and no momentum."""
    bounds_others: ClassVar[bool] = False
    """Whether ``check`` computes the order in this family to bound the orders in other families."""
    low_storage: ClassVar[tuple[str, ...]] = ()
    """Families in which the order of a 2N scheme is equal to its order in this family."""

    # Methods
    on_groups: ClassVar[bool] = False
    """Whether a step consists of exponentials on a Lie group."""
    fixed_stages: ClassVar[bool] = False
    """Whether the stages are independent of the weights, so that a second row of weights can estimate the
    error."""
    keeps_manifold: ClassVar[bool] = True
    """Whether a step stays on the manifold on which the problem is posed."""
    keeps_energy: ClassVar[bool] = False
    """Whether every member keeps the energy exactly."""
    controls_steps: ClassVar[bool] = False
    """Whether step sizes follow from the coefficients of a step, without an embedded method."""
    takes_cutoff: ClassVar[bool] = False
    """Whether dexpinv, or dexp, is cut after ``cutoff`` brackets."""
    minimal_brackets: ClassVar[int] = 0
    """The highest order at which members without a cut-off are compiled with the fewest brackets."""
    cutoff: int | None = None
    """The number of brackets after which dexpinv is cut; None: no cut."""

    default_series: ClassVar[bool] = False
    """Whether ``orderconds modified`` may read a tableau in this family if the user names none."""

    # Search
    unknowns: ClassVar[str | None] = None
    """The tableau format whose coefficients ``orderconds solve`` looks for; None: no search."""
    equal_abscissae: ClassVar[bool] = False
    """Whether conditions of order three make the abscissae of a stage equal
    (:mod:`orderconds.solve.abscissae`)."""
    principal_error_limit: ClassVar[int | None] = None
    """The highest order of which the principal error is computed; None: no limit."""

    def label(self) -> str:
        """Return the name with its options, as ``rkmk(1)``."""
        return self.name

    @abstractmethod
    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of exactly this order."""

    @abstractmethod
    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand sides of ``conditions`` for a method with coefficients in ``ring``.

        Raises :class:`~orderconds.errors.ZeroWeight` where the family divides by a weight that is zero.
        """

    def essential_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return a subset of :meth:`conditions` in which none follows from the others or from lower orders.

        By default the subset is all of :meth:`conditions`. A family overrides the method if its conditions
        generate all others but are not independent, and explains the difference in :meth:`remark`.
        """
        return self.conditions(order)

    def remark(self, order: int) -> str:
        """Return a remark for the reader on the conditions up to ``order``, or an empty text."""
        return ""

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of every tree or word of this order; by default the independent ones."""
        return self.conditions(order)

    def decisive_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return conditions that imply all conditions of this order and cost less than an independent set.

        By default these are the independent set.
        """
        return self.conditions(order)

    def decisive_in_turn(self, order: int) -> Iterator[tuple[Key, Callable[[], OrderCondition]]]:
        """Yield the keys of the decisive conditions, each with a function that returns the condition.

        A family with very many trees yields them as they are enumerated.
        """
        for condition in self.decisive_conditions(order):
            yield condition.key, partial(_itself, condition)

    def decisive_count(self, order: int) -> int | None:
        """Return the number of decisive conditions if a formula gives it, else None."""
        return None

    def residuals(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return left-hand side minus right-hand side of each condition, elements of ``ring``.

        Raises ZeroDivisionError where a quotient of balls is not defined.

        >>> from orderconds.families import get
        >>> from orderconds.tableau import Tableau, find
        >>> euler = Tableau.load(find("euler"))
        >>> rk = get("rk")
        >>> rk.residuals(euler.method, euler.ring, rk.conditions(2))
        (-1/2,)
        """
        if not conditions:
            return ()
        if isinstance(ring, Balls):
            with precision(ring.bits):  # set the precision once, not in each operation
                differences = self._residuals(*_UNWRAPPED(method, ring), conditions)
            if not all(x.is_finite() for x in differences):
                raise ZeroDivisionError("division by a ball that contains zero")
            return tuple(map(ring.enclose, differences))
        return self._residuals(method, ring, conditions)

    def _residuals(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        values = self.evaluate(method, ring, conditions)
        return tuple(value - in_ring(ring, c.rhs) for value, c in zip(values, conditions, strict=True))

    def principal_residuals(self, method: Method, ring: Ring, order: int) -> tuple[Element, ...]:
        """Return the residuals of one order whose 2-norm measures a method's error.

        By default these are the
        residuals of the independent conditions.
        """
        return self.residuals(method, ring, self.conditions(order))

    # Tableaux

    def read(self, tableau: Tableau) -> Method | None:
        """Return the method of a tableau in a format of this family, or None."""
        return tableau.read_as(self.formats)

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` for a method that is not a member of the family."""
        return

    def for_method(self, method: Method) -> Family:
        """Return the family in which a file without claims is checked, if its format has the name of this
        family."""
        return self

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return the family with the options in which a file of this tableau should claim an order, or None.

        By default it returns None: a file may claim an order, but need not.
        """
        return None

    def claim(self, order: int) -> OrderClaim:
        """Return the claim of this order in a tableau file."""
        from orderconds.tableau.claims import OrderClaim

        return OrderClaim(self.label(), None, order)

    def claimed_variants(self) -> tuple[Family, ...]:
        """Return the variants of this family in which a complete file claims an order, by rising cost."""
        return (self,)

    def work(self, tableau: Tableau) -> Work | None:
        """Return the field evaluations, exponentials and brackets of a step, or None if they are not counted.

        By default only the evaluations are counted.
        """
        from orderconds.tableau.work import evaluations

        return evaluations(tableau)

    def degree_of_step(self) -> int:
        """Return the order of a family without tableau, which its label determines.

        Raises :class:`~orderconds.errors.InputError` for a family with a tableau.
        """
        raise InputError(f"the order of family {self.label()} depends on the tableau", expected="a tableau")

    def stability_coefficients(self) -> tuple[Fraction, ...] | None:
        """Return the ascending coefficients of the stability function of a family without tableau."""
        return None

    def in_stages(self, stages: int, *, explicit: bool = False) -> StageForm:
        """Return the coefficients of the methods with ``stages`` stages.

        Raises :class:`~orderconds.errors.InputError` for a family whose coefficients are not numbered by
        stages alone.
        """
        from orderconds.tableau.formats import FORMATS, RungeKuttaFile

        if FORMATS.get(self.formats[0]) is RungeKuttaFile:
            return tableau_form(stages, explicit, self.needs_nonzero_weights)
        raise InputError(
            f"family {self.label()} is not determined by the number of stages",
            where="--stages",
            expected="a family whose coefficients are numbered by stages, as rk, sprk, cg, vcg or splitting",
            hint="leave --stages out",
        )

    # Theorems

    def implied_order(self, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order that theorems derive from ``orders`` in other families, by label;
        or 0.

        Families that name this one in :attr:`implies` need not be considered here.
        """
        return 0 if self.low_order is None else min(2, orders.get(self.low_order, 0))

    def order_of_tableau(self, method: Method, ring: Ring, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order by a theorem about the coefficients, without trees; or 0."""
        return 0

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Whether the step of this family is proved to be symmetric."""
        return False

    def substitute(self, method: Method, ring: Ring) -> Substitute | None:
        """Return a family with fewer conditions that imply the conditions of this family for this method, or
        None."""
        return None

    def first_unmet(self, order: int) -> OrderCondition | None:
        """Return the first condition that all members violate if no member of the family has this order, else
        None."""
        return None

    def unseen_cut(self, method: Method, orders: Mapping[str, int]) -> UnseenCut | None:
        """Return the trees on which the cut of dexpinv has no effect; None for a family without a cut."""
        return None

    def reductions(self, method: Method, ring: Ring, orders: Mapping[str, int]) -> Reductions:
        """Return the reductions for a method; ``orders`` are its proved orders in other families, by label.

        >>> from orderconds.families import get
        >>> from orderconds.ring import QQ
        >>> from orderconds.tableau import Tableau, find
        >>> rk4 = Tableau.load(find("rk4")).method
        >>> reductions = get("vrkmk(2)").reductions(rk4, QQ, {"sprk": 4})
        >>> reductions.cut.order, reductions.cut.longest
        (4, 4)
        """
        cut = self.unseen_cut(method, orders)
        if isinstance(ring, Balls):
            return Reductions(ring, cut=cut)
        return Reductions(ring, self.is_symmetric(method, ring), self.substitute(method, ring), cut)

    def symmetric_family(self, method: Method) -> Family | None:
        """Return a family whose conditions suffice for a symmetric ``method``, or None.

        If the result is None, the caller uses the family with the name of the format.
        """
        return None

    def symmetric_facts(self, order: int) -> tuple[tuple[str, int], ...]:
        """Return the orders, by label, of a symmetric method that satisfies the conditions up to
        ``order``."""
        return ((self.label(), order),)

    def solved_as(self, nystroem: bool) -> str:
        """Return the label of the family whose conditions a search solves; ``nystroem`` is option --rkn."""
        return self.label()


def _itself(condition: OrderCondition) -> OrderCondition:
    return condition


def _unwrapped(method: Method, ring: Ring) -> tuple[Method, Enclosures]:
    assert isinstance(ring, Balls)
    return method.map(lambda x: x.value), Enclosures(ring.bits)


_UNWRAPPED = Memo(_unwrapped)


def expect(method: Method, kind: type[Kind]) -> Kind:
    """Return ``method`` if it is of type ``kind``; otherwise raise TypeError.

    >>> from orderconds.tableau import Composition, RungeKutta
    >>> expect(Composition("symmetric-2", (1,)), RungeKutta)
    Traceback (most recent call last):
    TypeError: a method of type Composition where RungeKutta is expected
    """
    if not isinstance(method, kind):
        raise TypeError(f"a method of type {type(method).__name__} where {kind.__name__} is expected")
    return method


def in_ring(ring: Ring, q: Fraction) -> Element:
    """Return a rational number as an element of ``ring``.

    >>> from orderconds.ring import QQ
    >>> in_ring(QQ, Fraction(1, 3))
    1/3
    """
    return ring.rational(q.numerator, q.denominator)


def all_nonzero(weights: Sequence[Element], ring: Ring) -> bool:
    """Whether every weight is proved to be non-zero.

    >>> from orderconds.ring import QQ
    >>> all_nonzero([QQ.one, QQ.zero], QQ)
    False
    """
    return all(ring.is_zero(x) is False for x in weights)


def require_nonzero_weights(label: str, ring: Ring, b: Sequence[Element]) -> None:
    """Raise :class:`~orderconds.errors.ZeroWeight` unless every weight is known to be non-zero.

    >>> from orderconds.ring import QQ
    >>> require_nonzero_weights("vcg", QQ, [QQ.one])
    """
    for i, weight in enumerate(b, start=1):
        vanishes = ring.is_zero(weight)
        if vanishes is None or vanishes:
            raise ZeroWeight(
                f"b_{i} = {ring.text(weight)}" + (", which may be zero" if vanishes is None else ""),
                where=f"family {label}",
                expected="every weight b_i to be non-zero, since the family divides by it",
                hint="choose another family, or a tableau without zero weights",
            )
