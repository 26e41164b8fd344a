"""The operations of step programs (:mod:`codegen.ir.program`): one small class for each operation.

The kind of an argument or a result is a space such as the Lie algebra or the group. If the attribute ``dual``
of an operation is true, the operation acts on the dual of the Lie algebra.

The bracket is [x, y] = AB - BA, where A and B are the matrices of x and y. The map ad*_x is the transpose of
ad_x, without a minus sign. The map Ad*_g is the transpose of Ad_g, without an inverse.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import ClassVar, Protocol

from codegen.ir.ad_series import UNIT, Factor, Word
from codegen.ir.domain import Domain, Scalar, Value, Values
from codegen.ir.values import Coefficient, Kind

Kinds = tuple[Kind, ...]

# The operator ``+`` concatenates tuples: ``G + A`` means a group element and an element of the Lie algebra.
A, D, G, P, R = (Kind.ALG,), (Kind.DUAL,), (Kind.GROUP,), (Kind.POINT,), (Kind.REAL,)
NONE: Kinds = ()
LINEAR = (Kind.ALG, Kind.DUAL)
"""The kinds whose values form a vector space."""


class Problem(Protocol):
    """The differential equation to solve: the Lie group, its action, and the vector field or Hamiltonian.

    A scene is the user's definition of a problem. Scalars are for example doubles, power series or
    expressions. The argument ``domain`` of the functions in this class determines the type of the scalars.
    """

    def apply(self, domain: Domain, name: str, order: int | None, args: Values) -> Values:
        """Return the results of the function ``name`` for the arguments ``args``.

        For dexp^{-1} and its derivative, ``order`` is the order at which the series is truncated. For a
        Taylor polynomial, ``order`` is the degree. For all other functions, ``order`` is None.
        """

    def flow(self, domain: Domain, part: str, tau: Scalar, args: Values) -> Values:
        """Return the state after the exact flow of one term of the vector field.

        ``part`` is the name of the term, and ``tau`` is the duration of the flow.
        """

    def series(self, domain: Domain, word: Word, dual: bool, x: Value, v: Value) -> Value:
        """Return f_1(ad_x) ... f_k(ad_x) v, where the functions f_1, ..., f_k are the factors in ``word``. If
        ``dual`` is true, ad*_x replaces ad_x.
        """

    def dimension(self) -> int:
        """Return the dimension of the Lie algebra."""


class Operation(ABC):
    """The operation on the right-hand side of an assignment. The object contains the parameters of the
    operation, but not its arguments.
    """

    takes: ClassVar[Kinds] = NONE
    gives: ClassVar[Kinds] = NONE
    """The kinds of the results. The attribute ``takes`` contains the kinds of the arguments. Classes whose
    kinds depend on parameters override :meth:`signature`.
    """
    # Compiler passes use linearity to simplify programs, for example ad_x(c v + w) = c ad_x v + ad_x w.
    linear_in_last: ClassVar[bool] = False
    """True if the result is linear in the last argument."""
    # The reported cost has two parts: the exponentials, and the evaluations of the vector field.
    evaluates_scene: ClassVar[bool] = False
    """True if the reported cost counts the operation as one evaluation. Examples are the vector field and the
    derivatives of a Hamiltonian.
    """
    exponentials: ClassVar[int] = 0
    """The number of exponentials in the reported cost. A coordinate map or an exact flow counts as one."""

    noun: ClassVar[str] = ""
    """The name of the operation in reports of the cost, for example ``bracket{s}``.

    Reports print the letter s in place of ``{s}`` for the plural, and nothing for the singular. If the
    operation costs nothing, the name is ''.
    """

    @property
    @abstractmethod
    def name(self) -> str:
        """The name of the operation in printed programs and in counts of operations."""

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return two tuples: the kinds of the arguments, and the kinds of the results."""
        return self.takes, self.gives

    @abstractmethod
    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results of the operation for ``args``. The scalars in ``args`` belong to ``domain``."""

    def accepts(self, arguments: Kinds, results: Kinds) -> bool:
        """Return True if the operation can have arguments of the kinds ``arguments`` and results of the kinds
        ``results``.
        """
        return (arguments, results) == self.signature()

    def text(self) -> str:
        """Return the name with its parameters, for example ``dexpinv(2)``."""
        return self.name

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to the arguments with the names ``args``."""
        return f"{self.text()}({', '.join(args)})"


@dataclass(frozen=True)
class Zero(Operation):
    """The zero vector of the Lie algebra or of its dual."""

    kind: Kind
    name = "zero"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return NONE, (self.kind,)

    def accepts(self, arguments: Kinds, results: Kinds) -> bool:
        """Return True if there are no arguments, and the only result has the kind ``kind``.

        If ``kind`` is neither the Lie algebra nor its dual, return False.
        """
        # Groups and manifolds have no zero vector, so ``kind`` must be the algebra or its dual.
        return self.kind in LINEAR and super().accepts(arguments, results)

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the zero vector."""
        # ``domain.rational(0)`` has the type of the scalars of the domain.
        return ((domain.rational(0),) * problem.dimension(),)


# Compiler passes may replace a linear combination of linear combinations by one linear combination.
@dataclass(frozen=True)
class Linear(Operation):
    """A linear combination of vectors, with one coefficient for each argument."""

    coefficients: tuple[Coefficient, ...]
    name = "lin"
    noun = "sum{s}"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the result for vectors in the Lie algebra.

        The method :meth:`accepts` also allows vectors in the dual of the Lie algebra.
        """
        return (Kind.ALG,) * len(self.coefficients), A

    def accepts(self, arguments: Kinds, results: Kinds) -> bool:
        """Return True if three conditions hold:
        - There is one argument for each coefficient.
        - There is exactly one result.
        - The arguments and the result all belong to the Lie algebra, or all belong to its dual.
        """
        # A sum without terms is not accepted: its kind would be unknown.
        alike = len(results) == 1 and results[0] in LINEAR and set(arguments) == set(results)
        return alike and len(arguments) == len(self.coefficients)

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to the arguments with the names ``args``."""
        # In an invalid program, the numbers of coefficients and arguments may differ. The verifier also
        # prints invalid programs.
        terms = zip_longest([f"({c.text()})" for c in self.coefficients], args)
        return " + ".join(f"{c or '?'} {a or '?'}" for c, a in terms)

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the linear combination. Vectors with the same coefficient are added before the
        multiplication by this coefficient.
        """
        groups: dict[Coefficient, list[Value]] = {}
        for c, x in zip(self.coefficients, args, strict=True):
            groups.setdefault(c, []).append(x)
        total: Value = None
        for c, vectors in groups.items():
            # The entries of ``groups`` are in the order of insertion, so the vectors are always added in the
            # same order.
            part = vectors[0]
            for x in vectors[1:]:
                part = tuple(a + b for a, b in zip(part, x, strict=True))
            if not c.is_one:
                # The multiplication by 1 is omitted, because the multiplication of power series is slow.
                factor = c.evaluate(domain)
                part = tuple(factor * a for a in part)
            total = part if total is None else tuple(a + b for a, b in zip(total, part, strict=True))
        return (total,)


@dataclass(frozen=True)
class Advance(Operation):
    """The time t + c h of a stage with node c. The argument is t, and ``coefficient`` is c h."""

    coefficient: Coefficient
    name = "advance"
    takes, gives = R, R
    noun = "stage time{s}"

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to the arguments with the names ``args``."""
        return super().applied([*args, self.coefficient.text()])

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the time of the stage."""
        return (args[0] + self.coefficient.evaluate(domain),)


class OfGroup(Operation):
    """An operation that is evaluated by the group, by the action of the group, or by the scene."""

    @property
    def function(self) -> str:
        """The name of the function that evaluates this operation."""
        return self.name

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results of the operation for the arguments ``args``."""
        # The third argument of ``apply`` is the order at which a series is truncated. This operation
        # truncates no series, so the third argument is None.
        return problem.apply(domain, self.function, None, args)


@dataclass(frozen=True)
class Identity(OfGroup):
    """The neutral element of the group."""

    name = "identity"
    takes, gives = NONE, G


@dataclass(frozen=True)
class Exp(OfGroup):
    """The group element exp(x) for an element x of the Lie algebra."""

    name = "exp"
    exponentials = 1
    takes, gives = A, G
    noun = "exponential{s}"


@dataclass(frozen=True)
class ElementAt(OfGroup):
    """The group element tau(x) for an element x of the Lie algebra. The scene defines the coordinate map
    tau, for example the Cayley map (:mod:`codegen.groups.coordinate_maps`).
    """

    name = "element_at"
    exponentials = 1
    takes, gives = A, G
    noun = "coordinate map{s}"


@dataclass(frozen=True)
class InverseDifferential(OfGroup):
    """The element dtau^{-1}_x y of the Lie algebra, where the coordinate map tau is defined in the scene.

    Let x(t) be a curve with x' = dtau^{-1}_x y. Then the curve g(t) = tau(x(t)) in the group satisfies
    g' = y.g. For matrices, y.g is the matrix product.
    """

    # The linear map dtau^{-1}_x depends nonlinearly on x but is linear in y.
    linear_in_last = True
    name = "inverse_differential"
    takes, gives = A + A, A
    noun = "inverse differential{s}"


@dataclass(frozen=True)
class Multiply(OfGroup):
    """The product g k of the group elements g and k. The action satisfies (g k).y = g.(k.y)."""

    name = "mul"
    takes, gives = G + G, G
    noun = "product{s}"


@dataclass(frozen=True)
class MultiplyExp(OfGroup):
    """The group element g exp(x). Row i of the result depends only on x and on row i of the matrix g."""

    name = "mulexp"
    takes, gives = G + A, G
    noun = "product{s}"


@dataclass(frozen=True)
class Act(OfGroup):
    """The point g.y: the group element g acts on the point y."""

    name = "act"
    takes, gives = G + P, P
    noun = "action{s}"


# For a matrix A and a vector y, exp(A) y is often cheaper than the matrix exp(A).
@dataclass(frozen=True)
class ActExp(OfGroup):
    """The point exp(x).y, computed without the group element exp(x)."""

    name = "actexp"
    exponentials = 1
    takes, gives = A + P, P
    noun = "action{s}"


@dataclass(frozen=True)
class Adjoint(OfGroup):
    """The vector Ad_g x for the arguments g and x. If ``dual`` is true, the vector is Ad*_g mu for the
    arguments g and mu. If ``inverse`` is true, g^-1 replaces g.
    """

    dual: bool = False
    inverse: bool = False
    linear_in_last = True
    noun = "adjoint map{s}"

    @property
    def name(self) -> str:
        """The name of the operation in printed programs and in counts of operations."""
        return f"Ad{'*' if self.dual else ''}{'^-1' if self.inverse else ''}"

    @property
    def function(self) -> str:
        """The name of a method of the group's Python class. This method evaluates the operation."""
        # ``Adt`` means Ad*, the transpose of Ad.
        return f"Ad{'t' if self.dual else ''}{'inv' if self.inverse else ''}"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        own = D if self.dual else A
        # The last argument and the result have the same kind.
        return G + own, own

    def opposite(self) -> Adjoint:
        """Return the inverse operation. Both operations use the same group element g."""
        # The inverse of Ad_g is Ad_{g^-1}, and the inverse of Ad*_g is Ad*_{g^-1}.
        return Adjoint(self.dual, not self.inverse)


@dataclass(frozen=True)
class Bracket(OfGroup):
    """The bracket [x, y] for the arguments x and y. If ``dual`` is true, the arguments are x and mu, and the
    result is ad*_x mu.
    """

    dual: bool = False
    linear_in_last = True
    noun = "bracket{s}"

    @property
    def name(self) -> str:
        """The name of the operation in printed programs and in counts of operations."""
        return "ad*" if self.dual else "ad"

    @property
    def function(self) -> str:
        """The name of a method of the group's Python class. This method evaluates the operation."""
        return "adt" if self.dual else "ad"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        own = D if self.dual else A
        return A + own, own


@dataclass(frozen=True)
class InverseDexp(Operation):
    """The truncated series of dexp^{-1}_x y: the sum of B_k/k! ad_x^k y over k = 0, ..., ``order``.

    Here B_k are the Bernoulli numbers, with B_1 = -1/2. If ``dual`` is true, ad*_x replaces ad_x, and y is an
    element of the dual of the Lie algebra.
    """

    order: int
    dual: bool = False
    linear_in_last = True
    noun = "evaluation{s} of dexpinv"

    @property
    def name(self) -> str:
        """The name of the operation in printed programs and in counts of operations."""
        return "dexpinv*" if self.dual else "dexpinv"

    @property
    def word(self) -> Word:
        """The operation as a product of functions of ad_x, or of ad*_x if ``dual`` is true.

        The only factor is the truncated series of dexp^{-1}.
        """
        # If two functions of the same ad_x are applied one after the other, a compiler pass replaces the two
        # operations by one :class:`AdSeries`.
        return (Factor("dexpinv", UNIT, self.order),)

    def text(self) -> str:
        """Return the name and the order, for example ``dexpinv(2)``."""
        return f"{self.name}({self.order})"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        own = D if self.dual else A
        return A + own, own

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the value of the truncated series."""
        return problem.apply(domain, "dexpinvt" if self.dual else "dexpinv", self.order, args)


@dataclass(frozen=True)
class InverseDexpSlope(Operation):
    """The vector P* mu, where P is the derivative of dexpinv_x y with respect to x, and P* is its transpose.

    The arguments are x and y in the Lie algebra and mu in its dual. Here dexpinv is the series of dexp^{-1},
    truncated at the order ``order``. For each z in the Lie algebra, <P* mu, z> = <mu, P z>.
    """

    order: int
    # The transpose P* is a linear map and acts on mu, the last argument.
    linear_in_last = True
    name = "P*"
    takes, gives = A + A + D, D
    noun = "derivative{s} of dexpinv"

    def text(self) -> str:
        """Return the name of the operation, followed by ``order`` in parentheses."""
        return f"{self.name}({self.order})"

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return P* mu for ``args`` = (x, y, mu).

        P is the derivative of dexpinv_x y with respect to x, and P* is the transpose of P.
        """
        return problem.apply(domain, "P", self.order, args)


@dataclass(frozen=True)
class DualDexp(OfGroup):
    """The vector dexp*_x mu, where dexp*_x is the transpose of the linear map dexp_x."""

    linear_in_last = True
    name = "dexp*"
    function = "dexpt"
    takes, gives = A + D, D
    noun = "evaluation{s} of dexp*"

    @property
    def word(self) -> Word:
        """The operator dexp*_x as a product of functions of ad*_x, the transpose of ad_x.

        The only factor is the function f(t) = (e^t - 1)/t, because dexp*_x = f(ad*_x).
        """
        return (Factor("dexp", UNIT),)


@dataclass(frozen=True)
class AdSeries(Operation):
    """A product of operators f(ad_x), applied to a vector v. The arguments are x and v.

    ``word`` lists the functions f. If ``dual`` is true, ad*_x replaces ad_x.
    """

    word: Word
    dual: bool = False
    linear_in_last = True
    noun = "function{s} of ad"

    @property
    def name(self) -> str:
        """The name of the operation in printed programs and in counts of operations."""
        return "series*" if self.dual else "series"

    def text(self) -> str:
        """Return the text ``name[f g ...]`` with the functions f, g, ... in ``word``."""
        return f"{self.name}[{' '.join(factor.text() for factor in self.word)}]"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        own = D if self.dual else A
        return A + own, own

    def accepts(self, arguments: Kinds, results: Kinds) -> bool:
        """Return True if the kinds of the arguments and of the results are those of :meth:`signature`.

        If the list of functions ``self.word`` is empty, return False.
        """
        # An empty product is the identity map, which needs no operation.
        return bool(self.word) and super().accepts(arguments, results)

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return f_1(L) ... f_n(L) y for ``args`` = (x, y). Here f_1, ..., f_n are the functions in
        ``self.word``, and L is ad_x, or ad*_x if ``self.dual`` is true."""
        # The operators f_1(L), ..., f_n(L) commute, so the order in which they are applied does not matter.
        return (problem.series(domain, self.word, self.dual, *args),)
