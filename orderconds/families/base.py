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
"""The key of a condition: a tree, a forest or a word in the encoding of the family."""

Kind = TypeVar("Kind")


class Family(ABC):
    """A family of methods.

    A subclass sets ``name``, ``description`` and ``formats``, and implements :meth:`conditions` and
    :meth:`evaluate`. All other attributes and methods have defaults. The function
    :func:`orderconds.families.register` makes the family available to every command. The options of a family,
    such as ``cutoff`` of RKMK, are integer parameters of the constructor.
    """

    name: ClassVar[str] = ""
    """The name of the family in commands and claims, in lower case."""
    description: ClassVar[str] = ""
    """The description of the family in ``orderconds list families``, one line."""
    formats: ClassVar[tuple[str, ...]] = ()
    """The tableau formats that the family accepts, in order of decreasing preference."""
    has_tableau: ClassVar[bool] = True
    """True if the methods of the family are given by tableaux. If False, the label of the family, such as
    ``taylor(12)``, determines the method."""
    source: ClassVar[str] = ""
    """The publication of a family without tableau."""

    # Conditions
    needs_nonzero_weights: ClassVar[bool] = False
    """True if formulas of the family divide by the weights b_i, which must then be non-zero."""
    search_limit: ClassVar[int] = 8
    """The highest order that ``check`` evaluates for a file without a claim. For a file with a claim,
    ``check`` evaluates at least one order beyond the claim."""
    order_bound: ClassVar[int | None] = None
    """The highest order that any member of the family can have, by a theorem; None if no such theorem is
    known."""
    over_rationals: ClassVar[bool] = False
    """True if conditions can be evaluated with rational numbers (:mod:`orderconds.ring.nodal`), without
    arithmetic in the field of the coefficients."""
    trees: ClassVar[str | None] = None
    """The kind of trees that index the conditions (:mod:`orderconds.explain.kinds`); None if words index
    them."""
    illustrates: ClassVar[tuple[str, ...]] = ()
    """The kinds of trees that ``orderconds trees --explain`` shows together with the conditions of this
    family."""

    symbols: ClassVar[Mapping[str, str]] = {
        "a": r"$a_{ij}$ are the coefficients of the stages",
        "b": r"$b_i$ are the weights",
        "c": r"$c_i = \sum_j a_{ij}$ are the abscissae",
        "ahat": r"$\hat{a}_{ij}$ are the coefficients of the stages of the second part",
        "bhat": r"$\hat{b}_i$ are the weights of the second part",
        "chat": r"$\hat{c}_i = \sum_j \hat{a}_{ij}$",
    }
    """A map from the names of the coefficients that occur in printed conditions to their definitions in
    LaTeX."""

    # Relations to other families
    implies: ClassVar[Mapping[str, str]] = {}
    """A map from the names of other families to theorems. By the theorem, the conditions of the other family
    are a subset of the conditions of this family. Therefore the order of a method in the other family is at
    least its order in this family."""
    abelian: ClassVar[str | None] = None
    """The family to which this family reduces on an abelian group, where all brackets are zero; None if no
    such family accepts all tableaux of this family."""
    low_order: ClassVar[str | None] = None
    """The name of another family whose conditions of orders 1 and 2 are the same, because these conditions
    contain neither brackets nor momenta."""
    bounds_others: ClassVar[bool] = False
    """True if ``check`` computes the order in this family to obtain bounds of the orders in other
    families."""
    low_storage: ClassVar[tuple[str, ...]] = ()
    """The names of other families in which every 2N (low-storage) scheme has the same order as in this
    family."""

    # Methods
    on_groups: ClassVar[bool] = False
    """True if a step consists of exponentials on a Lie group."""
    fixed_stages: ClassVar[bool] = False
    """True if the stages do not depend on the weights. Then a second row of weights can estimate the
    error."""
    keeps_manifold: ClassVar[bool] = True
    """True if a step stays on the manifold on which the problem is posed."""
    keeps_energy: ClassVar[bool] = False
    """True if every method of the family preserves the energy exactly."""
    controls_steps: ClassVar[bool] = False
    """True if step-size control estimates the error from coefficients that a step computes. Such a family
    needs no embedded method."""
    takes_cutoff: ClassVar[bool] = False
    """True if the family has the option ``cutoff``, the number of brackets after which dexpinv or dexp is
    truncated."""
    minimal_brackets: ClassVar[int] = 0
    """The highest order for which the compiler can reduce the number of brackets to the minimum. The
    compiler reduces the number only for methods without ``cutoff``."""
    cutoff: int | None = None
    """The number of brackets after which dexpinv is truncated; None: dexpinv is not truncated."""

    default_series: ClassVar[bool] = False
    """True if ``orderconds modified`` may choose this family when the user specifies no family."""

    # Search
    unknowns: ClassVar[str | None] = None
    """The tableau format for which ``orderconds solve`` computes coefficients; None: the family has no
    search."""
    symplectic: ClassVar[bool] = False
    """True if a search considers only symplectic tableaux, b_i a_ij + b_j a_ji = b_i b_j."""
    equal_abscissae: ClassVar[bool] = False
    """True if the conditions of order three force the three abscissae of each stage to be equal. These are
    c_i for the position, chat_i for the forces and m_i for the transport
    (:mod:`orderconds.solve.abscissae`)."""
    principal_error_limit: ClassVar[int | None] = None
    """The highest order at which the principal error is computed; None: no limit."""

    def label(self) -> str:
        """Return the name of the family with its options, such as ``rkmk(1)``."""
        return self.name

    @abstractmethod
    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return conditions of exactly this order that imply all conditions of this order. In most families
        these conditions are independent of each other; see :meth:`essential_conditions`."""

    @abstractmethod
    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand sides of ``conditions`` for a method with coefficients in ``ring``.

        Raises :class:`~orderconds.errors.ZeroWeight` if the formulas of the family divide by a weight that is
        zero.
        """

    def essential_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return a subset of :meth:`conditions` in which no condition follows from the other conditions or
        from conditions of lower order.

        By default the subset is all of :meth:`conditions`. A family overrides this method if
        :meth:`conditions` returns conditions that are not independent, and explains the difference in
        :meth:`remark`.
        """
        return self.conditions(order)

    def remark(self, order: int) -> str:
        """Return a remark for the reader on the conditions up to ``order``, or an empty text."""
        return ""

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of every tree or word of this order. By default the result is
        :meth:`conditions`."""
        return self.conditions(order)

    def dependence_holds(self, order: int) -> bool:
        """Return True if the conditions in :meth:`conditions` are proved to imply all conditions of this
        order. The proof does not use ranks modulo primes.

        By default the result is True without a computation, because a theorem about trees or words proves
        the implication.
        """
        return True

    def decisive_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return conditions that imply all conditions of this order. The selection of these conditions must
        not need the rank of a matrix.

        By default the result is :meth:`conditions`.
        """
        return self.conditions(order)

    def decisive_in_turn(self, order: int) -> Iterator[tuple[Key, Callable[[], OrderCondition]]]:
        """Yield the keys of :meth:`decisive_conditions`, each with a function that returns the condition.

        A family with a large number of trees generates the trees one at a time.
        """
        for condition in self.decisive_conditions(order):
            yield condition.key, partial(_itself, condition)

    def decisive_count(self, order: int) -> int | None:
        """Return the number of conditions in :meth:`decisive_conditions`, or None if no formula gives this
        number."""
        return None

    def residuals(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand side minus the right-hand side of each condition, as elements of ``ring``.

        Raises ZeroDivisionError if the evaluation divides by a ball that contains zero.

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
            with precision(ring.bits):  # set once, because setting the precision in each operation is slow
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
        """Return the residuals of this order that determine the principal error. The 2-norm of the residuals
        measures the error of the method.

        By default these are the residuals of :meth:`conditions`.
        """
        return self.residuals(method, ring, self.conditions(order))

    # Tableaux

    def read(self, tableau: Tableau) -> Method | None:
        """Return the method of a tableau if the family accepts the format of the tableau, else None."""
        return tableau.read_as(self.formats)

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` if the method does not belong to the family."""
        return

    def converted(self, convert: Callable[[Element], Element]) -> Family:
        """Return a copy of the family in which ``convert`` is applied to all stored coefficients. Most
        families store no coefficients and return themselves."""
        return self

    def for_method(self, method: Method) -> Family:
        """Return the family in which ``check`` evaluates ``method`` if the file of the method claims no
        order. ``check`` calls this function for the family that has the same name as the format of the
        file."""
        return self

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family with its options if a file with this tableau should claim an order in this
        family; otherwise return None.

        By default the result is None. Then a tableau file counts as complete without a claim in this family.
        """
        return None

    def claim(self, order: int) -> OrderClaim:
        """Return the claim of this order as an entry of a tableau file."""
        from orderconds.tableau.claims import OrderClaim

        return OrderClaim(self.label(), None, order)

    def claimed_variants(self) -> tuple[Family, ...]:
        """Return the variants of this family in which a complete file claims an order. The cheapest variant
        comes first."""
        return (self,)

    def work(self, tableau: Tableau) -> Work | None:
        """Return the numbers of field evaluations, exponentials and brackets in one step, or None if they are
        not known.

        By default the function counts only the field evaluations; the numbers of exponentials and brackets
        are None.
        """
        from orderconds.tableau.work import evaluations

        return evaluations(tableau)

    def degree_of_step(self) -> int:
        """Return the order of the method of a family without tableau. The label of the family, such as
        ``taylor(12)``, determines this order.

        Raises :class:`~orderconds.errors.InputError` for a family with a tableau.
        """
        raise InputError(f"the order of family {self.label()} depends on the tableau", expected="a tableau")

    def stability_coefficients(self) -> tuple[Fraction, ...] | None:
        """Return the ascending coefficients of the stability function of a family without tableau."""
        return None

    def in_stages(self, stages: int, *, explicit: bool = False) -> StageForm:
        """Return the unknowns of a search: the coefficients of the methods with ``stages`` stages. If
        ``explicit`` is true, the search is limited to explicit methods.

        Raises :class:`~orderconds.errors.InputError` if the number of stages does not determine the
        coefficients of the family.
        """
        from orderconds.tableau.formats import FORMATS, RungeKuttaFile

        if FORMATS.get(self.formats[0]) is RungeKuttaFile:
            return tableau_form(stages, explicit, self.needs_nonzero_weights)
        raise InputError(
            f"the number of stages does not determine the coefficients of family {self.label()}",
            where="stages",
            expected="a family whose coefficients follow from the number of stages, such as rk or splitting",
            hint="omit the number of stages",
        )

    # Theorems

    def implied_order(self, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order of a method in this family, or 0 if no bound is known. The bound
        follows from the orders of the method in other families.

        ``orders`` maps the labels of the other families to these orders. Bounds that
        follow from :attr:`implies` are derived elsewhere.
        """
        return 0 if self.low_order is None else min(2, orders.get(self.low_order, 0))

    def order_of_tableau(self, method: Method, ring: Ring, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order of a method in this family, or 0 if no bound is known. The bound
        follows from a theorem about the coefficients; no order condition is evaluated."""
        return 0

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if a step of the method in this family is proved to be symmetric."""
        return False

    def substitute(self, method: Method, ring: Ring) -> Substitute | None:
        """Return another family with fewer conditions, and the method in a format of that family.

        For this method, the conditions of that family imply the conditions of this family. Return None if
        there is no such family.
        """
        return None

    def first_unmet(self, order: int) -> OrderCondition | None:
        """If no method of the family has this order, return the first condition that every method violates;
        else return None."""
        return None

    def unseen_cut(self, method: Method, orders: Mapping[str, int]) -> UnseenCut | None:
        """Return a description of the conditions that the truncation of dexpinv does not change. By default
        return None, because most families do not contain dexpinv."""
        return None

    def reductions(self, method: Method, ring: Ring, orders: Mapping[str, int]) -> Reductions:
        """Return the reductions for a method: the theorems that make some conditions superfluous.

        ``orders`` maps the labels of other families to the proved orders of the method in these families.

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
        """Return a family with fewer conditions, or None. If ``method`` is symmetric, the conditions of the
        result imply all conditions of this family.

        If the result is None, the caller uses the family with the name of the method's format.
        """
        return None

    def symmetric_facts(self, order: int) -> tuple[tuple[str, int], ...]:
        """Return pairs (label of a family, order). A symmetric method that satisfies the conditions of this
        family up to ``order`` has at least these orders."""
        return ((self.label(), order),)

    def solved_as(self, nystroem: bool) -> str:
        """Return the label of the family whose conditions a search solves when the user chooses this family.
        ``nystroem`` is true if the option --rkn is set."""
        return self.label()


def _itself(condition: OrderCondition) -> OrderCondition:
    return condition


def _unwrapped(method: Method, ring: Ring) -> tuple[Method, Enclosures]:
    assert isinstance(ring, Balls)
    return method.map(lambda x: x.value), Enclosures(ring.bits)


_UNWRAPPED = Memo(_unwrapped)


def expect(method: Method, kind: type[Kind]) -> Kind:
    """Return ``method`` unchanged if it is of type ``kind``; otherwise raise TypeError.

    >>> from orderconds.tableau import Composition, RungeKutta
    >>> expect(Composition("symmetric-2", (1,)), RungeKutta)
    Traceback (most recent call last):
    TypeError: found a method of type Composition; expected RungeKutta
    """
    if not isinstance(method, kind):
        raise TypeError(f"found a method of type {type(method).__name__}; expected {kind.__name__}")
    return method


def in_ring(ring: Ring, q: Fraction) -> Element:
    """Return a rational number as an element of ``ring``.

    >>> from orderconds.ring import QQ
    >>> in_ring(QQ, Fraction(1, 3))
    1/3
    """
    return ring.rational(q.numerator, q.denominator)


def all_nonzero(weights: Sequence[Element], ring: Ring) -> bool:
    """Return True if all weights are proved to be non-zero.

    >>> from orderconds.ring import QQ
    >>> all_nonzero([QQ.one, QQ.zero], QQ)
    False
    """
    return all(ring.is_zero(x) is False for x in weights)


def require_nonzero_weights(label: str, ring: Ring, b: Sequence[Element]) -> None:
    """Raise :class:`~orderconds.errors.ZeroWeight` if one of the weights is or may be zero.

    >>> from orderconds.ring import QQ
    >>> require_nonzero_weights("vcg", QQ, [QQ.one])
    """
    for i, weight in enumerate(b, start=1):
        vanishes = ring.is_zero(weight)
        if vanishes is None or vanishes:
            raise ZeroWeight(
                f"b_{i} = {ring.text(weight)}" + (", which may be zero" if vanishes is None else ""),
                where=f"family {label}",
                expected="all weights b_i to be non-zero, because the formulas of the family divide by b_i",
                hint="choose another family, or a tableau without zero weights",
            )
