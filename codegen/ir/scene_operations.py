"""Operations of step programs for the user's problem (the scene).

Examples are the vector field, the derivatives of the Hamiltonian, the energy, and exact flows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from codegen.ir.domain import Domain, Values
from codegen.ir.operations import NONE, A, D, G, Kinds, OfGroup, Operation, P, Problem, R
from codegen.ir.values import Coefficient


@dataclass(frozen=True)
class OfScene(OfGroup):
    """An operation that evaluates formulas of the scene. If ``timed`` is true, the formulas depend on time,
    and the last argument of the operation is the time.
    """

    timed: bool = False

    @property
    def function(self) -> str:
        """The name of the scene's function that evaluates this operation. If ``timed`` is true, the name ends
        in ``t``.
        """
        return f"{self.name}t" if self.timed else self.name

    def at(self, arguments: Kinds) -> Kinds:
        """Return the kinds ``arguments``, followed by the kind of the time if ``timed`` is true.

        The kind of the time is ``Kind.REAL``.
        """
        return arguments + R if self.timed else arguments


@dataclass(frozen=True)
class Field(OfScene):
    """The value of the vector field: f(y), or f(y, t) if ``timed`` is true."""

    name = "field"
    evaluates_scene = True
    noun = "evaluation{s} of the field"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(P), A


@dataclass(frozen=True)
class HamiltonianDerivatives(OfScene):
    """The derivatives xi and n of the Hamiltonian H(q, mu), or H(q, mu, t).

    The vector xi is the derivative with respect to mu. With the basis e_a of the Lie algebra, the components
    of the covector n are n_a = -d/deps H(exp(eps e_a) q, mu) at eps = 0.
    """

    name = "hamilton"
    evaluates_scene = True
    noun = "evaluation{s} of the derivatives of H"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(G + D), A + D


@dataclass(frozen=True)
class BodyVelocity(OfScene):
    """The velocity W(q, P), for a momentum P in the body frame (:mod:`codegen.scene.body_frame`)."""

    # The velocity and the force are separate operations, so compiler passes can remove either of them.
    name = "velocity"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return self.at(G + D), A


@dataclass(frozen=True)
class BodyForce(OfScene):
    """The force N(q, P), for a momentum P in the body frame (:mod:`codegen.scene.body_frame`).

    The force and the velocity W(q, P) use the same derivatives of the Hamiltonian. In the cost of a method,
    only the force counts as an evaluation of the derivatives.
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

    # The momentum is a constant matrix times the velocity.
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
    """The covector dH(y), the differential of the energy H at the point y.

    The pairing of this covector with an element e of the Lie algebra is d/deps H(exp(eps e).y) at eps = 0.
    """

    name = "differential"
    evaluates_scene = True
    takes, gives = P, D
    noun = "differential{s} of the energy"


@dataclass(frozen=True)
class Secant(OfGroup):
    """A discrete differential of the energy, for the arguments g, x, H0 and H1.

    The group element exp(x) moves a point with the energy H0 to a point with the energy H1. The covector g
    approximates the differential of the energy between the two points. The result is a covector c with
    <c, x> = H1 - H0. Among all covectors with this property, c is the closest to g in the Euclidean norm.
    """

    # The arguments are a covector, an element of the Lie algebra, and two energies.
    name = "secant"
    takes, gives = D + A + R + R, D
    noun = "discrete differential{s}"


@dataclass(frozen=True)
class Bivector(OfGroup):
    """The bivector omega_y at the point y, applied to a covector alpha.

    The bivector is a skew-symmetric linear map from the dual of the Lie algebra to the Lie algebra. It maps
    the differential of the energy at y to the vector field f(y) of the problem.
    """

    # The operation is linear in alpha: the result for c alpha is c times the result for alpha.
    name = "bivector"
    linear_in_last = True
    takes, gives = P + D, A
    noun = "bivector{s}"


@dataclass(frozen=True)
class TaylorStep(Operation):
    """The Taylor polynomial of the solution about the time t, evaluated at t + h.

    The arguments are the state y at the time t and, if ``timed`` is true, t. The result contains the
    coordinates of :class:`codegen.scene.evolution.Evolution`, which may differ from the coordinates of y. For
    example, y may contain the momentum in the space frame, and the result the momentum in the body frame.
    """

    degree: int
    timed: bool = False
    evaluates_scene = True
    name = "taylor_polynomial"
    noun = "Taylor polynomial{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by ``degree`` in parentheses."""
        return f"{self.name}({self.degree})"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return P + R if self.timed else P, P

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the value of the Taylor polynomial at t + h."""
        # The argument ``order`` of ``apply`` is the degree of the Taylor polynomial.
        return problem.apply(domain, self.name, self.degree, args)


@dataclass(frozen=True)
class CayleyElement(OfGroup):
    """The Cayley transform cay(x) = (1 - x/2)^-1 (1 + x/2) of an element x of the Lie algebra."""

    name = "cay"
    exponentials = 1
    takes, gives = A, G
    noun = "Cayley map{s}"


# If x and y are skew-symmetric matrices, x y x is skew-symmetric, because (x y x)^T = -x y x.
@dataclass(frozen=True)
class Sandwich(OfGroup):
    """The product x y x of two elements x and y of the Lie algebra.

    The elements are matrices or quaternions. The product is in the Lie algebra if the group is defined by a
    quadratic equation such as g^T g = 1.
    """

    # The product x y x is linear in y but quadratic in x.
    linear_in_last = True
    name = "sandwich"
    takes, gives = A + A, A
    noun = "product{s} in the algebra"


@dataclass(frozen=True)
class ToOrbit(OfGroup):
    """The result y of a :class:`TaylorStep`, projected approximately onto the manifold.

    The arguments are y and the state z at the beginning of the step. The manifold is the orbit of z under the
    group action.
    """

    name = "to_orbit"
    takes, gives = P + P, P
    noun = "projection{s} onto the manifold"


@dataclass(frozen=True)
class FlowOf(Operation):
    """The state after the exact flow of one term of the Hamiltonian, for a fixed duration.

    ``part`` is the name of the term. If ``timed`` is true, the term depends on time, and the last argument is
    the time t at which the term is evaluated.
    """

    part: str
    duration: Coefficient
    timed: bool = False
    # In the cost of a method, each flow is counted as one exponential.
    exponentials = 1
    name = "flow"
    noun = "flow{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by ``part`` in square brackets."""
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


@dataclass(frozen=True)
class SiteFlowOf(Operation):
    """The state of a lattice after the exact flow of one part of the vector field, for a fixed duration.

    ``part`` is the name of this part. The flow changes all lattice sites together.
    """

    part: str
    duration: Coefficient
    exponentials = 1
    name = "flow"
    noun = "flow{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by ``part`` in square brackets."""
        return f"{self.name}[{self.part}]"

    def applied(self, args: Sequence[str]) -> str:
        """Return the text of the operation applied to the arguments with the names ``args``."""
        return super().applied([*args, self.duration.text()])

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return P, P

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Raise ArithmeticError, because the flow is not defined for a single lattice site."""
        raise ArithmeticError("the flow of a lattice changes all sites and is not defined for a single site")


# The duration is an argument here, whereas the duration of :class:`FlowOf` is a fixed multiple of h.
@dataclass(frozen=True)
class FlowFor(Operation):
    """The state after the exact flow of one term of the Hamiltonian.

    ``part`` is the name of the term. The last argument is the duration. If ``timed`` is true, the argument
    before the duration is the time.
    """

    part: str
    timed: bool = False
    exponentials = 1
    name = "flow_for"
    noun = "flow{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by ``part`` in square brackets."""
        return f"{self.name}[{self.part}]"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return G + D + (R if self.timed else NONE) + R, G + D

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the state after the flow."""
        # The last argument is the duration.
        return problem.flow(domain, self.part, args[-1], args[:-1])


FLOWS = (FlowOf, FlowFor)
"""The operations that compute exact flows of terms of a Hamiltonian."""
