"""Simplification of expressions by the equations of a group, for example g^T g = 1 for orthogonal g.

A relation is an equation between a product of two symbols and a sum. The expression is expanded as a
polynomial. The variables of the polynomial are symbols, function calls and inverses. In the polynomial, the
product in each relation is replaced by the sum in the same relation.

The result is the normal form of the expression. The form is not canonical: equal expressions may have
different normal forms.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from codegen.ir.expr import Expr, Space, walk
from codegen.ir.number import Number

Monomial = tuple[tuple[int, int], ...]
"""A product of powers of expressions, as sorted pairs (node number, exponent). The node number is the ``id``
of the expression.
"""

Polynomial = dict[Monomial, Number]

Relation = tuple[tuple[str, str], Sequence[tuple[Number, tuple[str, ...]]]]
"""A pair ((a, b), terms) for the equation a b = sum of the terms, where a and b are symbols. A term (number,
symbols) is the product of the number and the symbols.
"""

ONE = Number.rational(1)
MOST_TERMS = 400
"""If a product in the expansion of an expression has more terms than this, the expression is not simplified.

The value is not critical: the limits 200 and 800 lead to the same emitted files.
"""


class TooLong(ArithmeticError):
    """Raised if a product of polynomials is too long (:data:`MOST_TERMS`)."""


class NormalForms:
    """Simplifies the expressions of ``space``.

    Each relation in ``relations`` replaces a product of two symbols by a sum (:data:`Relation`). Repeated
    replacement must terminate. Each expression in ``whole`` is treated as one variable.
    """

    def __init__(self, space: Space, relations: Sequence[Relation] = (), whole: Sequence[Expr] = ()) -> None:
        self.space = space
        # Monomials contain node numbers, because integers are faster to sort and hash than expressions.
        self.atoms: dict[int, Expr] = {}
        # An expression in ``whole`` is not expanded: it becomes a variable of the polynomials.
        self.known: dict[int, Polynomial] = {x.id: {((self._atom(x), 1),): ONE} for x in whole}
        self.rules: dict[tuple[int, int], Polynomial] = {}
        for (a, b), terms in relations:
            # The node numbers are sorted, so the key does not depend on the order of the two factors a and b.
            i, j = sorted((self._atom(space.sym(a)), self._atom(space.sym(b))))
            right: Polynomial = {}
            for factor, symbols in terms:
                monomial: Polynomial = {(): factor}
                for s in symbols:
                    monomial = self._times(monomial, self._variable(space.sym(s)))
                right = _plus(right, monomial)
            # The sum ``right`` may contain further products to replace.
            self.rules[i, j] = right

    def __call__(self, root: Expr) -> Expr:
        """Return the simplified form of ``root``.

        If a product in the expansion has too many terms, ``root`` itself is returned.
        """
        try:
            return self.expression(self.polynomial(root))
        except TooLong:
            # The expanded polynomial has too many terms, so ``root`` is returned without simplification.
            return root

    def polynomial(self, root: Expr) -> Polynomial:
        """Return ``root`` as an expanded polynomial, simplified by the ``relations`` of the constructor.

        :class:`TooLong` is raised if a product in the expansion has too many terms.
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
                    # Only a multiplication can create a product of two symbols, so sums need no reduction.
                    value = self._reduced(self._times(args[0], args[1]))
                case "pow":
                    value = args[0]
                    for _ in range(node.payload - 1):
                        # Reduction after each multiplication keeps the polynomials short.
                        value = self._reduced(self._times(value, args[0]))
                case "div":
                    # The quotient a/b becomes the product of a and the new variable 1/b.
                    divisor = self.space.one / self.expression(args[1])
                    value = self._times(args[0], self._variable(divisor))
                case _:
                    inner = [self.expression(a) for a in args]
                    value = self._variable(self.space.call(node.payload, *inner))
            known_forms[node.id] = value
        return known_forms[root.id]

    def expression(self, polynomial: Mapping[Monomial, Number]) -> Expr:
        """Return a polynomial as an expression. To save multiplications, the variable that occurs in most
        terms is factored out first.
        """
        terms = dict(polynomial)
        count: dict[int, int] = {}
        for monomial in terms:
            for atom, _ in monomial:
                count[atom] = count.get(atom, 0) + 1
        # The variable that occurs in the most terms is factored out (Horner's rule in several variables).
        best = max(sorted(count), key=lambda a: count[a], default=-1)
        # If no variable occurs in two terms, factoring out saves no multiplication.
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
        # The recursion ends: each monomial of ``inside`` has a lower degree than before, and ``outside`` has
        # fewer terms.
        product = self.atoms[best] * self.expression(inside)
        return self.expression(outside) + product if outside else product

    def _sum(self, terms: Mapping[Monomial, Number]) -> Expr:
        total = self.space.zero
        # Equal polynomials must give the same expression, so the terms are sorted.
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
        # A constant is a coefficient and not a variable.
        if node.op == "const":
            return {(): node.payload}
        return {((self._atom(node), 1),): ONE}

    def _times(self, a: Polynomial, b: Polynomial) -> Polynomial:
        # Different pairs of terms may have equal products. Equal products form one term.
        if len(a) * len(b) > MOST_TERMS**2:
            raise TooLong
        total: Polynomial = {}
        for m, x in a.items():
            for n, y in b.items():
                total = _add(total, _product(m, n), x * y)
        # If products of sums are nested, the number of terms grows exponentially.
        if len(total) > MOST_TERMS:
            raise TooLong
        return total

    def _reduced(self, polynomial: Polynomial) -> Polynomial:
        """Apply the relations to the products in a polynomial until no relation applies."""
        done: Polynomial = {}
        # ``popitem`` removes the newest entry, so the order of the terms is reproducible.
        waiting = dict(polynomial)
        while waiting:
            monomial, c = waiting.popitem()
            powers = dict(monomial)
            for (i, j), right in self.rules.items():
                # The relation applies if the product of variable i and variable j divides the monomial.
                if powers.get(i, 0) >= 1 + (i == j) and powers.get(j, 0) >= 1:
                    powers[i] -= 1
                    powers[j] -= 1
                    rest = {tuple(sorted((a, n) for a, n in powers.items() if n)): c}
                    waiting = _plus(waiting, self._times(rest, right))
                    # The new terms are added to ``waiting``, because relations may also apply to these terms.
                    break
            else:
                done = _add(done, monomial, c)
            if len(done) + len(waiting) > MOST_TERMS:
                raise TooLong
        return done


def _product(m: Monomial, n: Monomial) -> Monomial:
    """Return the product of two monomials."""
    # The empty monomial is the constant 1.
    if not m or not n:
        return m or n
    # If each node number in m is smaller than each node number in n, the tuple m + n is sorted.
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
    # Equal polynomials must be equal dictionaries, so terms with coefficient zero are removed.
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
