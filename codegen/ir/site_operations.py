"""Operations on sums over all sites of a lattice.

Inner products and energies of a lattice are sums over its sites. Each site computes its term of a sum, and
:class:`Total` adds the terms of all sites. A system of one site has a single term, which is the sum.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.domain import Domain, Values
from codegen.ir.operations import A, D, Kinds, Operation, Problem, R
from codegen.ir.values import Kind


@dataclass(frozen=True)
class Total(Operation):
    """The sum of a number over all sites."""

    name = "total"
    takes, gives = R, R
    noun = "sum{s} over all sites"

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the argument, because the sum over a single site has only one term."""
        return args


@dataclass(frozen=True)
class InnerProduct(Operation):
    """The inner product of two elements of the algebra or of its dual, in coordinates."""

    first: Kind
    second: Kind
    name = "inner"
    noun = "inner product{s}"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return (self.first, self.second), R

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the inner product."""
        total = domain.rational(0)
        for a, b in zip(*args, strict=True):
            total = total + a * b
        return (total,)


@dataclass(frozen=True)
class Excess(Operation):
    """The number H1 - H0 - p for the arguments p, H0 and H1.

    H0 and H1 are energies, and p is a pairing that predicts their difference.
    """

    name = "excess"
    takes, gives = R + R + R, R

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return H1 - H0 - p."""
        paired, before, after = args
        # This is the error of the linear prediction p for the change H1 - H0.
        return (after - before - paired,)


@dataclass(frozen=True)
class Corrected(Operation):
    """The covector g + (r/s) x for the arguments g, x, r, s. For s = 0 the result is g."""

    name = "corrected"
    takes, gives = D + A + R + R, D

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return g + (r/s) x."""
        g, x, r, s = args
        # ``quotient`` is 0 for s = 0, so this formula needs no branch.
        factor = domain.call("quotient", r, s)
        return (tuple(a + factor * b for a, b in zip(g, x, strict=True)),)


@dataclass(frozen=True)
class Wedge(Operation):
    """The vector (p f - q gamma)/s for the arguments gamma, f, p, q, s. For s = 0 the result is zero."""

    name = "wedge"
    takes, gives = D + A + R + R + R, A

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return (p f - q gamma)/s."""
        gamma, f, p, q, s = args
        # Each scalar is divided once, so a component needs two products only.
        along, across = (domain.call("quotient", x, s) for x in (p, q))
        return (tuple(along * a - across * b for a, b in zip(f, gamma, strict=True)),)
