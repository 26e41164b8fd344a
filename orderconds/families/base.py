"""The base class of all families of integration methods.

A family determines which integration method a tableau defines. The order conditions of the family compare the
series of the method with the series of the exact flow.
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
"""The key of a condition: its tree, forest or word."""

Kind = TypeVar("Kind")


class Family(ABC):
    """A family of integration methods, such as the Crouch-Grossman methods.

    A subclass sets ``name``, ``description`` and ``formats``, and implements :meth:`conditions` and
    :meth:`evaluate`. The options of a family, such as ``cutoff``, are integer parameters of the constructor.
    """

    name: ClassVar[str] = ""
    """The name of the family in commands and claims, in lower case."""
    description: ClassVar[str] = ""
    """A description in one line."""
    formats: ClassVar[tuple[str, ...]] = ()
    """The tableau formats that the family accepts, in order of decreasing preference."""
    has_tableau: ClassVar[bool] = True
    """False if each method of the family is defined by a label such as ``taylor(12)``, not by a tableau."""
    source: ClassVar[str] = ""
    """The publication that defines the methods, if the methods have no tableaux. Otherwise an empty text."""

    # Conditions
    needs_nonzero_weights: ClassVar[bool] = False
    """True if formulas of the family divide by the weights b_i."""
    search_limit: ClassVar[int] = 8
    """The highest order that ``check`` computes for a tableau file without a stated order."""
    order_bound: ClassVar[int | None] = None
    """An upper bound of the order of all methods of the family, or None if no such bound is known."""
    over_rationals: ClassVar[bool] = False
    """True if :mod:`orderconds.ring.nodal` can evaluate the conditions of the family."""
    trees: ClassVar[str | None] = None
    """The kind of trees that index the conditions (a name in :mod:`orderconds.explain.kinds`), or None."""
    illustrates: ClassVar[tuple[str, ...]] = ()
    """Kinds of trees for which ``orderconds trees --explain`` prints the order conditions of this family."""

    symbols: ClassVar[Mapping[str, str]] = {
        "a": r"$a_{ij}$ are the coefficients of the stages",
        "b": r"$b_i$ are the weights",
        "c": r"$c_i = \sum_j a_{ij}$ are the abscissae",
        "ahat": r"$\hat{a}_{ij}$ are the stage coefficients of the second tableau of the pair",
        "bhat": r"$\hat{b}_i$ are the weights of the second tableau of the pair",
        "chat": r"$\hat{c}_i = \sum_j \hat{a}_{ij}$",
    }
    """Maps the names of coefficients in printed conditions to definitions in LaTeX."""

    # Relations to other families
    implies: ClassVar[Mapping[str, str]] = {}
    """If a method has order p in this family, the method has at least order p in each family whose name is a
    key of this map. The value of the key states the reason as text."""
    abelian: ClassVar[str | None] = None
    """The name of the family to which this family reduces on an abelian group, or None."""
    low_order: ClassVar[str | None] = None
    """The name of a family whose conditions of orders 1 and 2 equal those of this family, or None."""
    bounds_others: ClassVar[bool] = False
    """True if ``check`` uses the order that a method has in this family to bound the order that the same
    method has in other families."""
    low_storage: ClassVar[tuple[str, ...]] = ()
    """Names of families. If a low-storage (2N) scheme has order p in this family, the scheme has at least
    order p in each named family."""

    # Properties of the numerical methods
    on_groups: ClassVar[bool] = False
    """True if a step consists of exponentials on a Lie group."""
    fixed_stages: ClassVar[bool] = False
    """True if the stages do not depend on the weights. Then the difference of two updates with different
    weights estimates the error."""
    keeps_manifold: ClassVar[bool] = True
    """True if a step stays on the manifold on which the problem is posed."""
    keeps_energy: ClassVar[bool] = False
    """True if every method of the family preserves the energy exactly."""
    controls_steps: ClassVar[bool] = False
    """True if the methods of the family control the step size without an embedded method."""
    takes_cutoff: ClassVar[bool] = False
    """True if the family has the option ``cutoff``, which truncates the series of dexpinv or dexp."""
    minimal_brackets: ClassVar[int] = 0
    """For methods of at most this order, the compiler can minimise the number of brackets. The compiler does
    so only if ``cutoff`` is None, because a value of ``cutoff`` prescribes the brackets."""
    cutoff: int | None = None
    """The power of ad after which the series of dexpinv or dexp is truncated. None means no truncation."""

    default_series: ClassVar[bool] = False
    """True if ``orderconds modified`` tries this family when the user names no family."""

    # Search
    unknowns: ClassVar[str | None] = None
    """The format of the tableaux that ``orderconds solve`` finds, or None if the command does not accept the
    family."""
    symplectic: ClassVar[bool] = False
    """True if a search considers only symplectic tableaux: b_i a_ij + b_j a_ji = b_i b_j for all i and j."""
    equal_abscissae: ClassVar[bool] = False
    """In each stage i, the position has the abscissa c_i, the forces have the abscissa chat_i, and the
    transport of the momentum has the abscissa m_i (:mod:`orderconds.solve.abscissae`). The attribute is True
    if all methods of this family with positive weights and order three or higher satisfy
    c_i = chat_i = m_i."""
    principal_error_limit: ClassVar[int | None] = None
    """The highest order at which the principal error is computed, or None if there is no limit."""

    def label(self) -> str:
        """Return the name of the family with its options, such as ``rkmk(1)``."""
        return self.name

    @abstractmethod
    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return order conditions of the given order.

        If all conditions of lower order hold, the returned conditions imply all conditions of the given
        order. In most families, the returned conditions are independent.
        """

    @abstractmethod
    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand sides of ``conditions`` for a method with coefficients in ``ring``.

        Raises :class:`~orderconds.errors.ZeroWeight` for a division by a weight b_i = 0.
        """

    def essential_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return conditions of the given order. Together with the conditions of lower order, the returned
        conditions imply all :meth:`conditions` of the given order.

        The base class returns all :meth:`conditions`. A subclass overrides this method in order to omit
        dependent conditions.
        """
        return self.conditions(order)

    def remark(self, order: int) -> str:
        """Return a remark for the user on the conditions up to ``order``, or an empty string."""
        return ""

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent and the dependent conditions of the given order.

        The base class returns the result of :meth:`conditions`. A subclass overrides this method if its
        method :meth:`conditions` omits dependent conditions.
        """
        return self.conditions(order)

    def dependence_holds(self, order: int) -> bool:
        """Return True if :meth:`conditions` omits only dependent conditions of the given order.

        The base class returns True without a test.
        """
        return True

    def decisive_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return conditions that imply all conditions of the given order. By default, return
        :meth:`conditions`."""
        return self.conditions(order)

    def decisive_in_turn(self, order: int) -> Iterator[tuple[Key, Callable[[], OrderCondition]]]:
        """Yield a pair (key, function) for each condition in :meth:`decisive_conditions`. The key
        identifies the condition, and the function constructs it."""
        for condition in self.decisive_conditions(order):
            yield condition.key, partial(_itself, condition)

    def decisive_count(self, order: int) -> int | None:
        """Return the number of conditions in :meth:`decisive_conditions`, or None if no formula gives it."""
        return None

    def residuals(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand side minus the right-hand side of each condition, as elements of ``ring``.

        Raises ZeroDivisionError if a divisor is a ball (interval) that contains zero.

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
            # The precision is set once for all operations, because setting it in each operation is slow.
            with precision(ring.bits):
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
        """Return residuals of order conditions of the given order.

        For a method of order p, the 2-norm of the residuals of order p + 1 measures the local error. The base
        class returns the residuals of ``conditions(order)``. A subclass may return the residuals of another
        set of conditions, for example of all conditions, both independent and dependent. The norm depends on
        this choice.
        """
        return self.residuals(method, ring, self.conditions(order))

    # Tableaux

    def read(self, tableau: Tableau) -> Method | None:
        """Return the method of a tableau if the family accepts the format of the tableau, else None."""
        return tableau.read_as(self.formats)

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` if the family does not accept the method."""
        return

    def converted(self, convert: Callable[[Element], Element]) -> Family:
        """Return a copy of the family in which ``convert`` is applied to all stored coefficients."""
        return self

    def for_method(self, method: Method) -> Family:
        """Return the family in which the order of ``method`` is tested if neither the user nor a claim in the
        tableau file names a family.

        The base class returns ``self``.
        """
        return self

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if :func:`orderconds.check` with ``complete=True`` requires that the file of
        ``tableau`` claims an order in this family, else None.

        If a required claim is missing, the verdict of the check is ``fails``.
        """
        return None

    def claim(self, order: int) -> OrderClaim:
        """Return the claim that a method has the order ``order`` in this family."""
        from orderconds.tableau.claims import OrderClaim

        return OrderClaim(self.label(), None, order)

    def claimed_variants(self) -> tuple[Family, ...]:
        """Return variants of this family, such as ``rkmk(0)`` and ``rkmk(1)``.

        The variant with the cheapest step comes first.
        """
        return (self,)

    def work(self, tableau: Tableau) -> Work | None:
        """Return the numbers of vector field evaluations, exponentials and brackets in one step.

        Return None if the numbers are unknown.
        """
        from orderconds.tableau.work import evaluations

        return evaluations(tableau)

    def degree_of_step(self) -> int:
        """Return the order of a method without tableau, such as 12 for ``taylor(12)``.

        Raises :class:`~orderconds.errors.InputError` for a family with a tableau.
        """
        raise InputError(f"the order of family {self.label()} depends on the tableau", expected="a tableau")

    def stability_coefficients(self) -> tuple[Fraction, ...] | None:
        """Return the coefficients of the stability polynomial, with the constant term first.

        Return None if the polynomial is unknown.
        """
        return None

    def in_stages(self, stages: int, *, explicit: bool = False) -> StageForm:
        """Return the unknown coefficients of a method with ``stages`` stages.

        The base class returns the coefficients of a Runge-Kutta tableau. If the methods of the family have
        another tableau format, the base class raises :class:`~orderconds.errors.InputError`, because
        ``stages`` may not determine the number of coefficients. For example, commutator-free methods with
        equally many stages can have different numbers of exponentials.
        """
        from orderconds.tableau.formats import FORMATS, RungeKuttaFile

        if FORMATS.get(self.formats[0]) is RungeKuttaFile:
            return tableau_form(stages, explicit, self.needs_nonzero_weights)
        raise InputError(
            f"cannot expand the conditions of family {self.label()} for a given number of stages",
            where="stages",
            expected="a family such as rk or splitting",
            hint="omit the number of stages",
        )

    # Theorems

    def implied_order(self, orders: Mapping[str, int]) -> int:
        """Derive a lower bound of the order in this family from orders in other families.

        ``orders`` maps the labels of other families to the orders of the method in these families. The bound
        is 0 if no theorem applies.
        """
        return 0 if self.low_order is None else min(2, orders.get(self.low_order, 0))

    def order_of_tableau(self, method: Method, ring: Ring, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order, derived from properties of the coefficients.

        The bound is 0 if no theorem applies.
        """
        return 0

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if ``method`` is proved to be symmetric. The base class always returns False."""
        return False

    def substitute(self, method: Method, ring: Ring) -> Substitute | None:
        """Return another family whose conditions imply the conditions of this family, or None.

        The implication holds for ``method``, and may fail for other methods. The result also contains
        ``method``, converted to a tableau format that the other family reads. None means that no such family
        is known.
        """
        return None

    def first_unmet(self, order: int) -> OrderCondition | None:
        """Return one condition of order ``order``, or None. The base class returns None.

        In some families, no method has an order above a number p, because one condition of order p + 1
        contradicts the other conditions of orders 1, ..., p + 1. For ``order`` = p + 1, these families return
        the contradicting condition.
        """
        return None

    def unseen_cut(self, method: Method, orders: Mapping[str, int]) -> UnseenCut | None:
        """Return an object that tests whether the truncation of dexpinv changes a condition.

        Return None if no test is known.
        """
        return None

    def reductions(self, method: Method, ring: Ring, orders: Mapping[str, int]) -> Reductions:
        """Return the reductions that apply to a method: theorems that make some conditions superfluous.

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
        """Return a family with conditions for symmetric methods, or None if no such family is known.

        If ``method`` is symmetric, the conditions of the returned family determine the order of ``method``.
        """
        return None

    def symmetric_facts(self, order: int) -> tuple[tuple[str, int], ...]:
        """Return pairs (label, bound) for a symmetric method that has order ``order`` in this family.

        The method has at least the order ``bound`` in the family with the label ``label``.
        """
        return ((self.label(), order),)

    def solved_as(self, nystroem: bool) -> str:
        """Return the label of the family whose conditions ``orderconds solve`` uses.

        By default, return the label of this family. ``nystroem`` is the option ``--rkn`` of the command.
        """
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
    """Raise :class:`~orderconds.errors.ZeroWeight` if a weight is zero or cannot be
    distinguished from zero.

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
