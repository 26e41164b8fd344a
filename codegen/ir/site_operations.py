"""Operations on sums over all sites of a lattice.

One operation computes the term of each site, and :class:`Total` adds the terms of all sites. A system without
a lattice is treated as a single site.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.domain import Domain, Values
from codegen.ir.operations import A, D, Kinds, Operation, Problem, R
from codegen.ir.values import Kind


@dataclass(frozen=True)
class Total(Operation):
    """The sum over all sites of a number that is computed at each site."""

    name = "total"
    takes, gives = R, R
    noun = "sum{s} over all sites"

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return ``args``. On a lattice with a single site, the sum over all sites is the number itself."""
        return args


@dataclass(frozen=True)
class InnerProduct(Operation):
    """The inner product of two coordinate vectors at one site.

    ``first`` and ``second`` are the kinds of the two vectors: elements of the Lie algebra or of its dual.
    """

    first: Kind
    second: Kind
    name = "inner"
    noun = "inner product{s}"

    def signature(self) -> tuple[Kinds, Kinds]:
        """Return the kinds of the arguments and of the results."""
        return (self.first, self.second), R

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return the inner product of the two vectors in ``args``."""
        total = domain.rational(0)
        for a, b in zip(*args, strict=True):
            total = total + a * b
        return (total,)


@dataclass(frozen=True)
class Excess(Operation):
    """The number H1 - H0 - p for the arguments p, H0 and H1.

    H0 and H1 are the energies before and after a displacement. The number p = <g, x> approximates H1 - H0,
    where g is an approximate gradient of the energy, and x is the displacement.
    """

    name = "excess"
    takes, gives = R + R + R, R

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return H1 - H0 - p, where ``args`` is (p, H0, H1)."""
        paired, before, after = args
        return (after - before - paired,)


@dataclass(frozen=True)
class Corrected(Operation):
    """The covector with the components g_i + (r/s) x_i for a covector g, a vector x and numbers r, s.

    For s = 0 the result is g.
    """

    name = "corrected"
    takes, gives = D + A + R + R, D

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return g + (r/s) x, where ``args`` is (g, x, r, s). For s = 0, return g."""
        g, x, r, s = args
        # For s = 0, the function ``quotient`` returns 0.
        factor = domain.call("quotient", r, s)
        return (tuple(a + factor * b for a, b in zip(g, x, strict=True)),)


@dataclass(frozen=True)
class Wedge(Operation):
    """The vector with the components (p f_i - q gamma_i)/s, for a vector f and a covector gamma.

    Here p, q and s are numbers. For s = 0 the result is zero.

    A covector is identified with the vector that has the same components. The bivector gamma wedge f maps a
    covector alpha to the vector <gamma, alpha> f - <f, alpha> gamma. The module
    :mod:`codegen.kernel.site_sums` sets p = <gamma, alpha>, q = <f, alpha> and s = |gamma|^2. For these
    numbers, the result is the bivector (gamma wedge f)/|gamma|^2 applied to alpha.
    """

    name = "wedge"
    takes, gives = D + A + R + R + R, A

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        """Return (p f - q gamma)/s for ``args`` = (gamma, f, p, q, s)."""
        gamma, f, p, q, s = args
        # The quotients p/s and q/s are the same for all components of the result.
        along, across = (domain.call("quotient", x, s) for x in (p, q))
        return (tuple(along * a - across * b for a, b in zip(f, gamma, strict=True)),)
