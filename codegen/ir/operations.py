"""The operations of step programs: one small class each.

An operation knows how it is printed, which kinds of arguments it takes and which kinds of values it returns,
and how it is evaluated in a problem over any domain. ``dual`` operations act on the dual of the Lie algebra.
Conventions: [x, y] = AB - BA, ad*_x and Ad*_g are the plain duals of ad_x and Ad_g.
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

A, D, G, P, R = (Kind.ALG,), (Kind.DUAL,), (Kind.GROUP,), (Kind.POINT,), (Kind.REAL,)
NONE: Kinds = ()
LINEAR = (Kind.ALG, Kind.DUAL)
"""The kinds whose values form a vector space."""


class Problem(Protocol):
    """What a program needs to know of its scene: group, action, field or Hamiltonian, over any domain."""

    def apply(self, domain: Domain, name: str, order: int | None, args: Values) -> Values:
        """Return the results of an operation of the group or the scene, by the name of its function.

        ``order`` is the number of brackets after which dexp^{-1} is cut off, None for all other operations.
        """

    def flow(self, domain: Domain, part: str, tau: Scalar, args: Values) -> Values:
        """Return the state after the exact flow of a part for the time tau."""

    def series(self, domain: Domain, word: Word, dual: bool, x: Value, v: Value) -> Value:
        """Return the product of a word's functions of ad_x, of ad*_x where ``dual``, applied to v."""

    def dimension(self) -> int:
        """Return the dimension of the Lie algebra."""


class Operation(ABC):
    """The right-hand side of an assignment, without its arguments."""

    linear_in_last: ClassVar[bool] = False
    """Whether the result is linear in the last argument."""
    evaluates_scene: ClassVar[bool] = False
    """Whether it counts as one evaluation of the field or of the derivatives of the Hamiltonian."""
    exponentials: ClassVar[int] = 0
    """How many exponentials, or flows, it computes."""

    @property
    @abstractmethod
    def name(self) -> str:
        """The name by which programs count their operations."""

    @abstractmethod
    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""

    @abstractmethod
    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""

    def accepts(self, arguments: Kinds, results: Kinds) -> bool:
        """Whether an assignment of these kinds is well-formed."""
        return (arguments, results) == self.signature()

    def text(self) -> str:
        """Return the name with its parameters, as ``dexpinv(2)``."""
        return self.name

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to arguments."""
        return f"{self.text()}({', '.join(args)})"


@dataclass(frozen=True)
class Zero(Operation):
    """The zero of the Lie algebra or of its dual."""

    kind: Kind
    name = "zero"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return NONE, (self.kind,)

    def accepts(self, arguments: Kinds, results: Kinds) -> bool:
        """Whether an assignment of these kinds is well-formed."""
        return self.kind in LINEAR and super().accepts(arguments, results)

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""
        return ((domain.rational(0),) * problem.dimension(),)


@dataclass(frozen=True)
class Linear(Operation):
    """A linear combination; it has one coefficient an argument."""

    coefficients: tuple[Coefficient, ...]
    name = "lin"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of a combination in the algebra; those in the dual are accepted too."""
        return (Kind.ALG,) * len(self.coefficients), A

    def accepts(self, arguments: Kinds, results: Kinds) -> bool:
        """Whether there is at least one term, and all are of the kind of the result."""
        alike = len(results) == 1 and results[0] in LINEAR and set(arguments) == set(results)
        return alike and len(arguments) == len(self.coefficients)

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to arguments."""
        # The verifier prints wrong programs too: coefficients and arguments may differ in number.
        terms = zip_longest([f"({c.text()})" for c in self.coefficients], args)
        return " + ".join(f"{c or '?'} {a or '?'}" for c, a in terms)

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the sum; terms with equal coefficients are added before they are scaled."""
        groups: dict[Coefficient, list[Value]] = {}
        for c, x in zip(self.coefficients, args, strict=True):
            groups.setdefault(c, []).append(x)
        total: Value = None
        for c, vectors in groups.items():
            part = vectors[0]
            for x in vectors[1:]:
                part = tuple(a + b for a, b in zip(part, x, strict=True))
            if not c.is_one:
                factor = c.evaluate(domain)
                part = tuple(factor * a for a in part)
            total = part if total is None else tuple(a + b for a, b in zip(total, part, strict=True))
        return (total,)


@dataclass(frozen=True)
class Advance(Operation):
    """t + coefficient: the time of a stage."""

    coefficient: Coefficient
    name = "advance"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return R, R

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to arguments."""
        return super().applied([*args, self.coefficient.text()])

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""
        return (args[0] + self.coefficient.evaluate(domain),)


class OfGroup(Operation):
    """An operation that the group, its action or the scene evaluates, under the operation's own name."""

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""
        return problem.apply(domain, self.name, None, args)


@dataclass(frozen=True)
class Identity(OfGroup):
    """The neutral element."""

    name = "identity"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return NONE, G


@dataclass(frozen=True)
class Exp(OfGroup):
    """exp(x)."""

    name = "exp"
    exponentials = 1

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return A, G


@dataclass(frozen=True)
class Multiply(OfGroup):
    """g k; the right factor acts first."""

    name = "mul"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return G + G, G


@dataclass(frozen=True)
class MultiplyExp(OfGroup):
    """g exp(x), each row of its matrix computed separately."""

    name = "mulexp"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return G + A, G


@dataclass(frozen=True)
class Act(OfGroup):
    """g.y."""

    name = "act"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return G + P, P


@dataclass(frozen=True)
class ActExp(OfGroup):
    """exp(x).y without forming exp(x)."""

    name = "actexp"
    exponentials = 1

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return A + P, P


@dataclass(frozen=True)
class Adjoint(OfGroup):
    """Ad_g x, or Ad*_g mu; of g^-1 in place of g where ``inverse``."""

    dual: bool = False
    inverse: bool = False
    linear_in_last = True

    @property
    def name(self) -> str:
        """The name by which programs count their operations."""
        return f"Ad{'t' if self.dual else ''}{'inv' if self.inverse else ''}"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        own = D if self.dual else A
        return G + own, own

    def opposite(self) -> Adjoint:
        """Return the operation that undoes this one."""
        return Adjoint(self.dual, not self.inverse)


@dataclass(frozen=True)
class Bracket(OfGroup):
    """[x, y], or ad*_x mu."""

    dual: bool = False
    linear_in_last = True

    @property
    def name(self) -> str:
        """The name by which programs count their operations."""
        return "adt" if self.dual else "ad"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        own = D if self.dual else A
        return A + own, own


@dataclass(frozen=True)
class InverseDexp(Operation):
    """sum over k <= order of B_k/k! ad_x^k y, or of B_k/k! (ad*_x)^k mu: dexp^{-1} cut off."""

    order: int
    dual: bool = False
    linear_in_last = True

    @property
    def name(self) -> str:
        """The name by which programs count their operations."""
        return "dexpinvt" if self.dual else "dexpinv"

    @property
    def word(self) -> Word:
        """The operation as a function of ad."""
        return (Factor("dexpinv", UNIT, self.order),)

    def text(self) -> str:
        """Return the name with the order."""
        return f"{self.name}({self.order})"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        own = D if self.dual else A
        return A + own, own

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""
        return problem.apply(domain, self.name, self.order, args)


@dataclass(frozen=True)
class InverseDexpSlope(Operation):
    """P*_(order)(x, y) mu: its pairing with z is that of mu with the derivative of dexpinv_x y along z.

    It belongs to the dexp^{-1} of :class:`InverseDexp` with the same order.
    """

    order: int
    linear_in_last = True
    name = "P"

    def text(self) -> str:
        """Return the name with the order."""
        return f"{self.name}({self.order})"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return A + A + D, D

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""
        return problem.apply(domain, self.name, self.order, args)


@dataclass(frozen=True)
class DualDexp(OfGroup):
    """dexp*_x mu."""

    linear_in_last = True
    name = "dexpt"

    @property
    def word(self) -> Word:
        """The operation as a function of ad."""
        return (Factor("dexp", UNIT),)

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return A + D, D


@dataclass(frozen=True)
class AdSeries(Operation):
    """The product of a word's functions of ad_x, or of ad*_x, applied to the last argument."""

    word: Word
    dual: bool = False
    linear_in_last = True

    @property
    def name(self) -> str:
        """The name by which programs count their operations."""
        return "seriest" if self.dual else "series"

    def text(self) -> str:
        """Return the name with the word."""
        return f"{self.name}[{' '.join(factor.text() for factor in self.word)}]"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        own = D if self.dual else A
        return A + own, own

    def accepts(self, arguments: Kinds, results: Kinds) -> bool:
        """Whether an assignment of these kinds is well-formed; the empty word is no operation."""
        return bool(self.word) and super().accepts(arguments, results)

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""
        return (problem.series(domain, self.word, self.dual, *args),)


@dataclass(frozen=True)
class OfScene(OfGroup):
    """An operation that evaluates the scene's formulas, at a time where ``timed``: the last argument."""

    timed: bool = False
    stem: ClassVar[str] = ""

    @property
    def name(self) -> str:
        """The name by which programs count their operations."""
        return f"{self.stem}{'t' if self.timed else ''}"

    def at(self, arguments: Kinds) -> Kinds:
        """Return the kinds of the arguments with that of the time."""
        return arguments + R if self.timed else arguments


@dataclass(frozen=True)
class Field(OfScene):
    """f(y), or f(y, t)."""

    stem = "field"
    evaluates_scene = True

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(P), A


@dataclass(frozen=True)
class HamiltonianDerivatives(OfScene):
    """xi = D_2 H and n = -(D_1 H).q^-1 at (q, mu), or at (q, mu, t)."""

    stem = "hamilton"
    evaluates_scene = True

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(G + D), A + D


@dataclass(frozen=True)
class BodyVelocity(OfScene):
    """W(q, P), the velocity in the body frame, where P = Ad*_q mu (:mod:`codegen.scene.body_frame`)."""

    stem = "velocity"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(G + D), A


@dataclass(frozen=True)
class BodyForce(OfScene):
    """N(q, P), the force in the body frame; with :class:`BodyVelocity` it is one evaluation of the scene."""

    stem = "force"
    evaluates_scene = True

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(G + D), D


@dataclass(frozen=True)
class Legendre(OfGroup):
    """The momentum P in the body frame from the velocity W."""

    name = "legendre"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return A, D


@dataclass(frozen=True)
class Energy(OfGroup):
    """H(y)."""

    name = "energy"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return P, R


@dataclass(frozen=True)
class Differential(OfGroup):
    """R*_y dH: its pairing with e is d/deps H(exp(eps e).y) at eps = 0."""

    name = "differential"
    evaluates_scene = True

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return P, D


@dataclass(frozen=True)
class Secant(OfGroup):
    """The covector nearest to g whose pairing with x is H1 - H0; arguments g, x, H0, H1."""

    name = "secant"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return D + A + R + R, D


@dataclass(frozen=True)
class Bivector(OfGroup):
    """omega_y(alpha, .); it is f(y) where alpha is the differential of H."""

    name = "bivector"
    linear_in_last = True

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return P + D, A


@dataclass(frozen=True)
class FlowOf(Operation):
    """The exact flow of a part of the Hamiltonian for a fixed duration.

    ``timed`` is for a part that depends on t: the time is the last argument, and constant during the flow.
    """

    part: str
    duration: Coefficient
    timed: bool = False
    exponentials = 1

    @property
    def name(self) -> str:
        """The name by which programs count their operations."""
        return "flowt" if self.timed else "flow"

    def text(self) -> str:
        """Return the name with the part."""
        return f"{self.name}[{self.part}]"

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to arguments."""
        return super().applied([*args, self.duration.text()])

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return G + D + (R if self.timed else NONE), G + D

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""
        return problem.flow(domain, self.part, self.duration.evaluate(domain), args)


@dataclass(frozen=True)
class FlowFor(Operation):
    """The exact flow of a part for a duration that is a value: the last argument."""

    part: str
    timed: bool = False
    exponentials = 1

    @property
    def name(self) -> str:
        """The name by which programs count their operations."""
        return "flowtfor" if self.timed else "flowfor"

    def text(self) -> str:
        """Return the name with the part."""
        return f"{self.name}[{self.part}]"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return G + D + (R if self.timed else NONE) + R, G + D

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the results for arguments of a domain."""
        return problem.flow(domain, self.part, args[-1], args[:-1])


FLOWS = (FlowOf, FlowFor)
