"""Normal forms: expressions as polynomials in symbols, function calls and inverses, reduced by relations.

Two different expressions may have equal values wherever the coordinates satisfy the equations of a group,
such as g^T g = 1. This module rewrites an expression by such equations, called relations. The expression is
expanded as a polynomial. Each relation states that a product equals a sum, and the sum replaces the product.
For example, |g y|^2 becomes |y|^2. The result is not canonical, and it may be longer than the given
expression.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from codegen.ir.expr import Expr, Space, walk
from codegen.ir.number import Number

Monomial = tuple[tuple[int, int], ...]
"""A product of powers, as sorted pairs (index of a node in the expression space, exponent)."""

Polynomial = dict[Monomial, Number]

Relation = tuple[tuple[str, str], Sequence[tuple[Number, tuple[str, ...]]]]
"""Two symbols, and a sum that equals their product. Each term of the sum is a pair (factor, symbols)."""

ONE = Number.rational(1)
MOST_TERMS = 400
"""A polynomial with more terms than this number is not expanded further.

The limit bounds the compile time. The limits 200 and 800 give the same emitted files (``orderconds regenerate
--check``).
"""


class TooLong(ArithmeticError):
    """The error for an expression whose expansion has too many terms."""


class NormalForms:
    """Brings expressions of one space to normal form.

    Each relation replaces a product of two symbols by an equal sum. Repeated replacement must end, so the
    relations must not undo one another. The expressions in ``whole`` are not expanded.
    """

    def __init__(self, space: Space, relations: Sequence[Relation] = (), whole: Sequence[Expr] = ()) -> None:
        self.space = space
        # Monomials contain node numbers, because these are sorted and hashed fast. This table contains the
        # nodes.
        self.atoms: dict[int, Expr] = {}
        # An expression in ``whole`` becomes a variable of the polynomials, so it is not expanded.
        self.known: dict[int, Polynomial] = {x.id: {((self._atom(x), 1),): ONE} for x in whole}
        self.rules: dict[tuple[int, int], Polynomial] = {}
        for (a, b), terms in relations:
            # The keys of the rules are sorted like monomials, so that they can be found in monomials.
            i, j = sorted((self._atom(space.sym(a)), self._atom(space.sym(b))))
            right: Polynomial = {}
            for factor, symbols in terms:
                monomial: Polynomial = {(): factor}
                for s in symbols:
                    monomial = self._times(monomial, self._variable(space.sym(s)))
                right = _plus(right, monomial)
            # The sum ``right`` is not reduced here, because ``_reduced`` also reduces the terms that it
            # inserts.
            self.rules[i, j] = right

    def __call__(self, root: Expr) -> Expr:
        """Return an expression that equals ``root`` wherever the relations hold.

        If the expansion is too long, ``root`` itself is returned.
        """
        try:
            return self.expression(self.polynomial(root))
        except TooLong:
            return root

    def polynomial(self, root: Expr) -> Polynomial:
        """Return ``root`` as a reduced polynomial. :class:`TooLong` is raised if the polynomial has too many
        terms.
        """
        known_forms = self.known
        for node in walk([root], lambda n: n.id in known_forms):
            if node.id in known_forms:
                continue
            args = [known_forms[a.id] for a in node.args]
            value: Polynomial
            match node.op:
                case "const":
                    value = {(): node.payload} if not node.payload.is_zero else {}
                case "sym":
                    value = self._variable(node)
                case "add":
                    value = _plus(args[0], args[1])
                case "sub":
                    value = _plus(args[0], _scaled(args[1], -ONE))
                case "neg":
                    value = _scaled(args[0], -ONE)
                case "mul":
                    # Only products are reduced, because sums of reduced polynomials are already reduced.
                    value = self._reduced(self._times(args[0], args[1]))
                case "pow":
                    value = args[0]
                    for _ in range(node.payload - 1):
                        # The value is reduced after each factor, so that the intermediate polynomials stay
                        # short.
                        value = self._reduced(self._times(value, args[0]))
                case "div":
                    # The inverse of a divisor becomes a variable, so that quotients are polynomials.
                    divisor = self.space.one / self.expression(args[1])
                    value = self._times(args[0], self._variable(divisor))
                case _:
                    inner = [self.expression(a) for a in args]
                    value = self._variable(self.space.call(node.payload, *inner))
            known_forms[node.id] = value
        return known_forms[root.id]

    def expression(self, polynomial: Mapping[Monomial, Number]) -> Expr:
        """Return a polynomial as an expression. The most frequent factor is taken out first."""
        terms = dict(polynomial)
        count: dict[int, int] = {}
        for monomial in terms:
            for atom, _ in monomial:
                count[atom] = count.get(atom, 0) + 1
        # This is Horner's rule in several variables. Ties are broken by the node number.
        best = max(sorted(count), key=lambda a: count[a], default=-1)
        # A factor that occurs in only one term is not taken out, because this would save no product.
        if best < 0 or count[best] < 2:
            return self._sum(terms)
        inside: Polynomial = {}
        outside: Polynomial = {}
        for monomial, c in terms.items():
            powers = dict(monomial)
            if best not in powers:
                outside[monomial] = c
                continue
            powers[best] -= 1
            inside[tuple(sorted((a, n) for a, n in powers.items() if n))] = c
        # Each call removes a factor from a term, so the recursion ends.
        product = self.atoms[best] * self.expression(inside)
        return self.expression(outside) + product if outside else product

    def _sum(self, terms: Mapping[Monomial, Number]) -> Expr:
        total = self.space.zero
        for monomial, c in sorted(terms.items()):
            product = self.space.const(c)
            for atom, n in monomial:
                product = product * self.space.pow(self.atoms[atom], n)
            total = total + product
        return total

    def _atom(self, node: Expr) -> int:
        self.atoms[node.id] = node
        return node.id

    def _variable(self, node: Expr) -> Polynomial:
        if node.op == "const":
            return {(): node.payload}
        return {((self._atom(node), 1),): ONE}

    def _times(self, a: Polynomial, b: Polynomial) -> Polynomial:
        # The number of pairs of terms bounds the work of a product. The limit is large, because a product
        # often has far fewer terms than pairs of terms.
        if len(a) * len(b) > MOST_TERMS**2:
            raise TooLong
        total: Polynomial = {}
        for m, x in a.items():
            for n, y in b.items():
                total = _add(total, _product(m, n), x * y)
        # Without a limit of the number of terms an expansion could fill the memory, because the length of
        # nested products of sums grows exponentially.
        if len(total) > MOST_TERMS:
            raise TooLong
        return total

    def _reduced(self, polynomial: Polynomial) -> Polynomial:
        """Return an equal polynomial in which no term contains the product that a relation replaces."""
        done: Polynomial = {}
        # ``popitem`` removes the latest entry, so the result does not depend on hashes.
        waiting = dict(polynomial)
        while waiting:
            monomial, c = waiting.popitem()
            powers = dict(monomial)
            for (i, j), right in self.rules.items():
                # If i = j, the relation replaces a square, so the exponent must be at least 2.
                if powers.get(i, 0) >= 1 + (i == j) and powers.get(j, 0) >= 1:
                    powers[i] -= 1
                    powers[j] -= 1
                    rest = {tuple(sorted((a, n) for a, n in powers.items() if n)): c}
                    waiting = _plus(waiting, self._times(rest, right))
                    # Relations may also replace products in the new terms, so the loop continues.
                    break
            else:
                done = _add(done, monomial, c)
            if len(done) + len(waiting) > MOST_TERMS:
                raise TooLong
        return done


def _product(m: Monomial, n: Monomial) -> Monomial:
    """Return the product of two monomials."""
    if not m or not n:
        return m or n
    # If all nodes of one monomial precede all nodes of the other monomial, the concatenation is already
    # sorted.
    if m[-1][0] < n[0][0]:
        return m + n
    if n[-1][0] < m[0][0]:
        return n + m
    powers = dict(m)
    for atom, k in n:
        powers[atom] = powers.get(atom, 0) + k
    return tuple(sorted(powers.items()))


def _add(polynomial: Polynomial, monomial: Monomial, c: Number) -> Polynomial:
    old = polynomial.get(monomial)
    value = c if old is None else old + c
    # Terms with coefficient zero are removed, so that equal polynomials are equal dictionaries.
    if value.is_zero:
        polynomial.pop(monomial, None)
    else:
        polynomial[monomial] = value
    return polynomial


def _plus(a: Polynomial, b: Polynomial) -> Polynomial:
    total = dict(a)
    for monomial, c in b.items():
        total = _add(total, monomial, c)
    return total


def _scaled(a: Polynomial, c: Number) -> Polynomial:
    return {monomial: c * x for monomial, x in a.items()}
