"""The operations of step programs that evaluate a scene: field, Hamiltonian, energy and exact flows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from codegen.ir.domain import Domain, Values
from codegen.ir.operations import NONE, A, D, G, Kinds, OfGroup, Operation, P, Problem, R
from codegen.ir.values import Coefficient


@dataclass(frozen=True)
class OfScene(OfGroup):
    """An operation that evaluates formulas of the scene. If ``timed`` is true, the last argument is the
    time.
    """

    timed: bool = False

    @property
    def function(self) -> str:
        """The name of the function of the scene that evaluates this operation."""
        # The name of a function that depends on time ends in t.
        return f"{self.name}t" if self.timed else self.name

    def at(self, arguments: Kinds) -> Kinds:
        """Return the kinds of the arguments. The time is the last argument if ``timed`` is true."""
        return arguments + R if self.timed else arguments


@dataclass(frozen=True)
class Field(OfScene):
    """The vector field f(y), or f(y, t) if ``timed`` is true."""

    name = "field"
    evaluates_scene = True
    noun = "evaluation{s} of the field"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(P), A


@dataclass(frozen=True)
class HamiltonianDerivatives(OfScene):
    """The derivatives xi = D_2 H and n = -(D_1 H).q^-1 of the Hamiltonian at (q, mu), or at (q, mu, t)."""

    name = "hamilton"
    evaluates_scene = True
    noun = "evaluation{s} of the derivatives of H"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(G + D), A + D


@dataclass(frozen=True)
class BodyVelocity(OfScene):
    """The velocity W(q, P) in the body frame, where P = Ad*_q mu (:mod:`codegen.scene.body_frame`)."""

    # Velocity and force are separate operations, so that compiler passes can remove one of them.
    name = "velocity"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(G + D), A


@dataclass(frozen=True)
class BodyForce(OfScene):
    """The force N(q, P) in the body frame, where P = Ad*_q mu.

    A force together with a :class:`BodyVelocity` counts as one evaluation.
    """

    name = "force"
    evaluates_scene = True
    noun = "evaluation{s} of the derivatives of H"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(G + D), D


@dataclass(frozen=True)
class Legendre(OfGroup):
    """The momentum P as a function of the velocity W, both in the body frame."""

    # This operation only multiplies a vector by a constant matrix, so it does not count as an evaluation.
    name = "legendre"
    takes, gives = A, D
    noun = "Legendre transform{s}"


@dataclass(frozen=True)
class Energy(OfGroup):
    """The energy H(y) at the point y."""

    name = "energy"
    takes, gives = P, R
    noun = "evaluation{s} of the energy"


@dataclass(frozen=True)
class Differential(OfGroup):
    """The differential R*_y dH of the energy at y.

    Its pairing with an element e of the Lie algebra is d/deps H(exp(eps e).y) at eps = 0.
    """

    name = "differential"
    evaluates_scene = True
    takes, gives = P, D
    noun = "differential{s} of the energy"


# The result is g + r x with the number r = (H1 - H0 - <g, x>)/<x, x>.
@dataclass(frozen=True)
class Secant(OfGroup):
    """A discrete gradient for the arguments g, x, H0, H1.

    The result is the covector nearest to g whose pairing with x is H1 - H0. For x = 0 the result is g.
    """

    # This is one operation, because its formula contains a quotient that is 0/0 at x = 0.
    name = "secant"
    takes, gives = D + A + R + R, D
    noun = "discrete differential{s}"


@dataclass(frozen=True)
class Bivector(OfGroup):
    """The bivector omega at the point y, applied to a covector alpha: omega_y(alpha, .).

    If alpha is the differential of H at y, the result is the field f(y).
    """

    # Compiler passes may move a factor of alpha out of the operation.
    name = "bivector"
    linear_in_last = True
    takes, gives = P + D, A
    noun = "bivector{s}"


@dataclass(frozen=True)
class TaylorStep(Operation):
    """The Taylor polynomial of the solution that begins at y, evaluated after the time h.

    If ``timed`` is true, the arguments are y and t.
    """

    degree: int
    timed: bool = False
    evaluates_scene = True
    name = "taylor_polynomial"
    noun = "Taylor polynomial{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by the degree."""
        return f"{self.name}({self.degree})"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return P + R if self.timed else P, P

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the value of the polynomial, which the scene computes."""
        # The degree is passed in place of the order of a truncated series.
        return problem.apply(domain, self.name, self.degree, args)


@dataclass(frozen=True)
class CayleyElement(OfGroup):
    """The Cayley transform cay(x) = (1 - x/2)^-1 (1 + x/2) of an element x of the Lie algebra."""

    name = "cay"
    exponentials = 1
    takes, gives = A, G
    noun = "Cayley map{s}"


# For skew matrices x and y, (x y x)^T = -x y x, so the product is skew, too.
@dataclass(frozen=True)
class Sandwich(OfGroup):
    """The product x y x of matrices or of quaternions.

    If the group is defined by a quadratic equation such as g^T g = 1, the product is in the Lie algebra.
    """

    linear_in_last = True
    name = "sandwich"
    takes, gives = A + A, A
    noun = "product{s} in the algebra"


@dataclass(frozen=True)
class ToOrbit(OfGroup):
    """The first argument, projected onto the manifold that contains the second argument."""

    name = "to_orbit"
    takes, gives = P + P, P
    noun = "projection{s} onto the manifold"


@dataclass(frozen=True)
class FlowOf(Operation):
    """The exact flow of a part of the Hamiltonian for a fixed duration.

    If ``timed`` is true, the last argument is the time, which is constant during the flow.
    """

    part: str
    duration: Coefficient
    timed: bool = False
    # A flow costs about as much as an exponential: an angle, its sine and cosine, and a product.
    exponentials = 1
    name = "flow"
    noun = "flow{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by the part in brackets."""
        return f"{self.name}[{self.part}]"

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to the arguments with the names ``args``."""
        return super().applied([*args, self.duration.text()])

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return G + D + (R if self.timed else NONE), G + D

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the state after the flow."""
        return problem.flow(domain, self.part, self.duration.evaluate(domain), args)


# Interpreters evaluate a program at one site. They cannot evaluate this operation.
@dataclass(frozen=True)
class SiteFlowOf(Operation):
    """The exact flow of a part of a lattice for a fixed duration.

    The flow moves all sites, so it has no value for a single site.
    """

    part: str
    duration: Coefficient
    exponentials = 1
    name = "flow"
    noun = "flow{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by the part in brackets."""
        return f"{self.name}[{self.part}]"

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to the arguments with the names ``args``."""
        return super().applied([*args, self.duration.text()])

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return P, P

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Raise ArithmeticError, because the flow cannot be evaluated for a single site."""
        raise ArithmeticError("the flow of a lattice moves all sites and cannot be evaluated for one site")


# In :class:`FlowOf` the duration is a fixed multiple of h. Here the duration is a value of the program.
@dataclass(frozen=True)
class FlowFor(Operation):
    """The exact flow of a part of the Hamiltonian. The last argument is the duration of the flow.

    If ``timed`` is true, the argument before the duration is the time.
    """

    part: str
    timed: bool = False
    exponentials = 1
    name = "flow_for"
    noun = "flow{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by the part in brackets."""
        return f"{self.name}[{self.part}]"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return G + D + (R if self.timed else NONE) + R, G + D

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the state after the flow."""
        # The time, if any, comes before the duration.
        return problem.flow(domain, self.part, args[-1], args[:-1])


# Flows with equal fixed durations are equal operations, so compiler passes can recognise them.
FLOWS = (FlowOf, FlowFor)
