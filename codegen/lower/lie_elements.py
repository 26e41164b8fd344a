"""The exponents of methods for y' = A(t).y.

A tableau of format ``magnus`` defines the exponents as combinations of brackets. The innermost arguments of
the brackets are the values h A(t + c_i h) at the nodes c_i.

An element h^p x is stored as the variable x and the power p. The bracket of h^p x and h^q y is stored as
[x, y] and the power p + q.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from codegen.errors import MethodError
from codegen.ir.program import Builder
from codegen.ir.scene_operations import Sandwich
from codegen.ir.values import Coefficient, Kind, Var
from codegen.method import Method
from orderconds.tableau.brackets import Bracket, Combination, Product, Term, spell


@dataclass(frozen=True)
class Scaled:
    """An element of the Lie algebra, given as the product of h^``power`` and the variable ``var``."""

    var: Var
    power: int


@dataclass
class LieElements:
    """Appends statements for the Lie algebra elements of a method to a program.

    The attributes are:

    - ``build``: the builder of the program.
    - ``nodes``: the variables that contain A(t + c_i h) for the nodes c_i.
    - ``elements``: the elements that have a name in the tableau.
    - ``known``: the values that are already computed.
    """

    build: Builder
    method: Method
    nodes: Sequence[Var]
    elements: Mapping[str, Combination]
    known: dict[Term, Scaled] = field(default_factory=dict)

    def exponent(self, target: str, combination: Combination) -> Var:
        """Return a new variable x for ``combination``. The step contains the exponential exp(x).

        The statements that compute x are appended to the program. The name of the variable begins with
        ``target``.
        """
        # The argument 0 means that the sum is not divided by a power of h.
        return self._sum(target, combination, 0).var

    def _sum(self, target: str, combination: Combination, power: int | None = None) -> Scaled:
        """Append a linear combination to the program, and return it as a variable times a power of h.

        If ``power`` is None, the power is the least power of h in the terms.
        """
        terms = [(self.method.number(x), self._value(term)) for term, x in combination]
        # A zero term must not influence the least power of h.
        terms = [(x, value) for x, value in terms if not x.is_zero]
        # A sum without terms is zero, so its power of h is arbitrary.
        least = min((value.power for _, value in terms), default=1) if power is None else power
        # A single term with the coefficient 1 needs no new variable.
        if power is None and len(terms) == 1 and terms[0][0].is_one:
            return terms[0][1]
        # The new variable contains the sum divided by h^least.
        scaled = [(Coefficient(x, value.power - least), value.var) for x, value in terms]
        return Scaled(self.build.lin(target, Kind.ALG, scaled), least)

    def _value(self, term: Term) -> Scaled:
        # A term may occur in several brackets, so its value is stored.
        if term not in self.known:
            self.known[term] = self._new(term)
        return self.known[term]

    def _new(self, term: Term) -> Scaled:
        # A term that is an integer i denotes the product h A(t + c_i h).
        if isinstance(term, int):
            return Scaled(self.nodes[term], 1)
        # A term of type str is the name of an element that the tableau defines.
        if isinstance(term, str):
            return self._sum(term, self.elements[term])
        if isinstance(term, Bracket):
            # The bracket is bilinear, so the powers of h are added: [h^p x, h^q y] = h^(p+q) [x, y].
            x, y = self._value(term.left), self._value(term.right)
            return Scaled(self.build.bracket("bracket", x.var, y.var), x.power + y.power)
        return self._palindrome(term)

    def _palindrome(self, term: Product) -> Scaled:
        """Return a symmetric product such as x y z y x as a variable times a power of h.

        The statements that compute the product are appended to the program. The number of
        factors must be odd. If the group preserves a bilinear form, as SO(n) does, the Lie algebra contains
        these products.
        """
        factors = term.factors
        # Products of even length (x y) or without symmetry (x y z) are in general not in the Lie algebra.
        if len(factors) % 2 == 0 or factors != factors[::-1]:
            raise MethodError(
                f"the product {spell(term)} is in general not an element of the Lie algebra",
                where=self.method.label,
                expected="an odd number of factors in symmetric order, as in 1*2*1",
                hint="define s = x+y in the tableau, and write x*z*y + y*z*x as s*z*s - x*z*x - y*z*y",
            )
        middle = len(factors) // 2
        result = self._value(factors[middle])
        # The product is computed from the middle factor outwards.
        for outer in reversed(factors[:middle]):
            x = self._value(outer)
            var = self.build.add(Sandwich(), "product", x.var, result.var)
            # The factor h^a x multiplies the product h^b r on both sides, which gives h^(2a + b) x r x.
            result = Scaled(var, 2 * x.power + result.power)
        return result
