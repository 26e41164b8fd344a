"""Combine the constants in expressions: 1 + 3/2 (3/2 - 2 x) becomes 13/4 - 3 x, and 3/2 a - 3/2 b becomes
3/2 (a - b).

The rewriting is exact. Each expression becomes a linear combination of atoms. An atom is an expression that
is not a linear combination itself. Numeric factors of products and powers become coefficients of the linear
combination. The coefficient of an inverse becomes its numerator. For example, 3/2 (1/sqrt x)^3 becomes
(3/2)/(x sqrt x). The rewritten expressions are used if they have fewer operations than the given expressions.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from codegen.ir.expr import Expr, Space, walk
from codegen.ir.number import Number

Sum = dict[int, tuple[Number, Expr]]
"""A linear combination of atoms. The dictionary maps the node number of each atom to the pair (coefficient,
atom). For a constant term the atom is the expression 1.
"""


def gathered(roots: Sequence[Expr], kept: Iterable[Expr] = ()) -> tuple[Expr, ...]:
    """Return the expressions ``roots`` with their constants combined.

    If the combined expressions do not have fewer operations, ``roots`` is returned unchanged. The expressions
    in ``kept`` are not expanded. Only their numeric factors may be combined with other numbers.

    >>> from codegen.ir.expr import Space
    >>> space = Space()
    >>> x, half = space.sym("x"), space.const(Number.rational(1, 2))
    >>> (short,) = gathered([half * (half - half * x)])
    >>> sum(node.op == "mul" for node in walk([short]))
    1
    """
    if not roots:
        return ()
    bare = [_bare(node) for node in kept]
    # ``bare`` contains the expressions in ``kept`` without their numeric factors. For example, it contains x
    # if ``kept`` contains 3 x. The factor 3 may be combined with other numbers.
    work = _Gathering(_powers(roots, bare))
    for node in bare:
        if node.args:
            # A node in ``bare`` is not expanded: its linear combination is 1 times the node itself.
            work.sums[node.id], work.written[node.id] = {node.id: (Number.rational(1), node)}, node
    # At this point the keys of ``sums`` are the nodes that are not expanded. The operations in these nodes
    # are not counted.
    still = set(work.sums)
    collected = tuple(work.whole(root) for root in roots)
    # ``collected`` may need more operations than ``roots``, because it may have fewer shared subexpressions.
    # If both need the same number of operations, ``roots`` is returned.
    return collected if _operations(collected, still) < _operations(roots, still) else tuple(roots)


def _bare(node: Expr) -> Expr:
    """Return a node without its minus signs and its numeric factors: x for -(3 x)."""
    # ``Space.mul`` makes a constant the first factor of a product.
    while node.op == "neg" or (node.op == "mul" and node.args[0].op == "const"):
        node = node.args[-1]
    return node


def _operations(roots: Sequence[Expr], still: set[int]) -> int:
    nodes = [node for node in walk(roots, stop=lambda n: n.id in still) if node.id not in still]
    # A negation is not counted, because the sum that contains the negated node becomes a difference. A power
    # x^n is counted as n - 1 products.
    products = sum(int(node.payload) - 1 for node in nodes if node.op == "pow")
    return products + sum(node.op not in ("const", "sym", "neg", "pow") for node in nodes)


def _powers(roots: Sequence[Expr], kept: Sequence[Expr]) -> dict[int, tuple[int, int]]:
    """Return the powers y^n of inverse roots y = 1/sqrt x that should be rewritten as quotients.

    For example, y^3 becomes 1/(x sqrt x). A power of y is called an intermediate value if it occurs only as a
    factor of other powers of y. The powers of y are rewritten if all powers that are not intermediate values
    have odd exponents n >= 3.

    The result maps the node number of a power to the pair (node number of y, n). Subexpressions of ``kept``
    are skipped.
    """
    still = {node.id for node in walk(kept)}
    ranks: dict[int, tuple[int, int]] = {}
    # The list contains pairs (node, user). The user is a node with the argument ``node``, or None for a root.
    used: list[tuple[Expr, Expr | None]] = [(root, None) for root in roots]
    for node in walk(roots):
        used += [(a, node) for a in node.args]
        inside = [ranks[a.id] for a in node.args if a.id in ranks]
        root = _is_inverse(node) and node.args[1].op == "call" and node.args[1].payload == "sqrt"
        if root and node.id not in still:
            # Let y = 1/sqrt(x). Each node that equals c y^n with a number c gets the pair (node number of y,
            # n).
            ranks[node.id] = (node.id, 1)
        elif _is_power(node, inside):
            exponent = sum(n for _, n in inside)
            ranks[node.id] = (inside[0][0], exponent * (node.payload or 1))
    # ``read`` contains the pair (node number of y, n) for each power y^n that is not an intermediate value.
    # For example, y^2 is an intermediate value if it occurs only as a factor of y^3.
    read = {ranks[x.id] for x, by in used if x.id in ranks and (by is None or by.id not in ranks)}
    # If ``read`` contains a pair of y with n = 1 or with an even n, no power of this y is rewritten.
    bases = {base for base, n in read if n == 1 or n % 2 == 0}
    return {key: pair for key, pair in ranks.items() if pair[0] not in bases}


def _is_power(node: Expr, inside: Sequence[tuple[int, int]]) -> bool:
    """Return True if a node equals c y^n, where c is a number and y = 1/sqrt(x).

    ``inside`` contains a pair (node number of y, exponent n) for each argument of the node that equals c y^n.
    The pairs may belong to different y.
    """
    whole = len(inside) == len(node.args) or node.args[0].op == "const"
    return node.op in ("neg", "pow", "mul") and whole and len({base for base, _ in inside}) == 1


def _is_inverse(node: Expr) -> bool:
    # A node is an inverse if it is a quotient with the numerator 1. Equal expressions are the same object,
    # so ``is`` compares them.
    return node.op == "div" and node.args[0] is node.space.one


@dataclass
class _Gathering:
    powers: dict[int, tuple[int, int]]
    sums: dict[int, Sum] = field(default_factory=dict)
    written: dict[int, Expr] = field(default_factory=dict)
    numerators: dict[int, Number] = field(default_factory=dict)

    def whole(self, root: Expr) -> Expr:
        """Return the expression ``root`` with its constants combined."""
        # ``walk`` yields the arguments of a node before the node. Hence ``sums`` already contains the linear
        # combinations of the arguments.
        for node in walk([root], stop=lambda n: n.id in self.sums):
            if node.id not in self.sums:
                # The linear combination is stored, so that it is computed only once for each node.
                self.sums[node.id] = self._sum(node)
        return self._spell(root)

    def _spell(self, node: Expr) -> Expr:
        """Return the linear combination of a node as an expression.

        A term c (1/y) is written as (c/e) (e/y), where e is a positive number. The first term with a given y
        determines e = |c|. Later terms with the same y use the same e.
        """
        if node.id not in self.written:
            # The expression is built only once, so that it stays a shared subexpression.
            total = [self._inverse(c, atom) for c, atom in self.sums[node.id].values()]
            self.written[node.id] = _expression(total, node.space)
        return self.written[node.id]

    def _inverse(self, c: Number, atom: Expr) -> tuple[Number, Expr]:
        """Return the term c times ``atom`` as a pair (number, expression).

        If ``atom`` is an inverse 1/y, the pair is (c/e, e/y) with a positive number e. The first call for
        this atom determines e = |c|, and all later calls for this atom use the same e. For all other atoms
        the pair is (c, ``atom``).
        """
        if not _is_inverse(atom):
            return c, atom
        # ``numerator`` is e, and ``atom`` is 1/y. The term c (1/y) becomes (c/e) (e/y). In the first call for
        # this atom, c/e is 1 or -1, so the term needs no product. The division e/y is not slower than 1/y.
        numerator = self.numerators.setdefault(atom.id, _size(c))
        return c / numerator, atom.space.const(numerator) / atom.args[1]

    def _sum(self, node: Expr) -> Sum:
        space, one = node.space, Number.rational(1)
        # Irrational constants are not combined with other numbers, for two reasons. Constants of two
        # different fields cannot be added. A constant that is known only by an interval (ball) would become
        # less accurate.
        if node.op == "const" and node.payload.is_rational:
            return {} if node.payload.is_zero else {space.one.id: (node.payload, space.one)}
        if node.op == "neg":
            return _scaled(self.sums[node.args[0].id], Number.rational(-1))
        if node.op in ("add", "sub"):
            total = dict(self.sums[node.args[0].id])
            other = self.sums[node.args[1].id]
            for key, (c, atom) in (
                other if node.op == "add" else _scaled(other, Number.rational(-1))
            ).items():
                total[key] = (total[key][0] + c if key in total else c, atom)
            # If terms cancel, their coefficient is zero. Such terms are removed.
            return {key: pair for key, pair in total.items() if not pair[0].is_zero}
        if node.op in ("mul", "pow") and node.id in self.powers and node.args[0].op != "const":
            return self._power(node)
        # The product of a number and a sum is expanded. The product of two sums is not expanded, because the
        # number of terms would grow exponentially in nested products.
        if node.op == "mul":
            for a, b in (node.args, node.args[::-1]):
                if a.op == "const" and a.payload.is_rational:
                    return _scaled(self.sums[b.id], a.payload)
            # The product (c x)(d y) with numbers c and d becomes c d times the atom x y.
            (c, x), (d, y) = self._content(node.args[0]), self._content(node.args[1])
            atom = x * y
            return {atom.id: (c * d, atom)}
        if node.op == "pow":
            c, x = self._content(node.args[0])
            atom, power = space.pow(x, node.payload), one
            for _ in range(node.payload):
                power = power * c
            return {atom.id: (power, atom)}
        # An atom must not be a linear combination. ``Space.div`` and similar methods may simplify an
        # expression to a linear combination. ``Space._make`` creates the atom without simplification.
        atom = space._make(node.op, tuple(map(self._spell, node.args)), node.payload)
        return {atom.id: (one, atom)}

    def _power(self, node: Expr) -> Sum:
        """Return the linear combination of a node that equals c y^n, where c is a number and y = 1/sqrt x.

        The power y^n is written as 1/x^m for n = 2 m, and as 1/(x^m sqrt x) for n = 2 m + 1.
        """
        base, exponent = self.powers[node.id]
        ((_, inverse),) = self.sums[base].values()
        # The number c is the product of the numeric factors of the arguments.
        c = Number.rational(1)
        for arg in node.args * (node.payload or 1):
            ((factor, _),) = self.sums[arg.id].values()
            c = c * factor
        root = inverse.args[1]
        # In 1/(x^m sqrt x), the processor can compute x^m in parallel with the root. Only the division must
        # wait for both.
        under = root.space.pow(root.args[0], exponent // 2)
        atom = root.space.one / (under * root if exponent % 2 else under)
        return {atom.id: (c, atom)}

    def _content(self, node: Expr) -> tuple[Number, Expr]:
        """Return a number c and an expression x such that the node equals c x.

        If the linear combination of the node does not have exactly one term, c is 1.
        """
        total = self.sums[node.id]
        # A sum of several terms stays as it is, even if its coefficients have a common factor. Other
        # expressions may contain the same sum.
        if len(total) != 1:
            return Number.rational(1), self._spell(node)
        ((c, atom),) = total.values()
        return self._inverse(c, atom)


def _scaled(total: Sum, factor: Number) -> Sum:
    return {key: (c * factor, atom) for key, (c, atom) in total.items()}


def _size(c: Number) -> Number:
    return -c if c.fraction() < 0 else c


def _expression(total: Sequence[tuple[Number, Expr]], space: Space) -> Expr:
    """Return the linear combination with the terms ``total`` as an expression.

    Terms whose coefficients have the same absolute value share one product. For example, 3/2 a - 3/2 b
    becomes 3/2 (a - b).
    """
    # Terms with the same |c| form a group. For example, 3/2 a - 3/2 b is one group and needs one product. A
    # dictionary keeps the order of insertion, so the order of the sum depends only on the given terms.
    groups: dict[object, list[tuple[bool, Expr]]] = {}
    sizes: dict[object, Number] = {}
    key: object
    for c, atom in total:
        key = "constant" if atom is space.one else _size(c).key
        sizes.setdefault(key, _size(c))
        groups.setdefault(key, []).append((c.fraction() < 0, atom))
    result = space.zero
    for key, terms in groups.items():
        first, part = terms[0][0], terms[0][1]
        for minus, atom in terms[1:]:
            part = part + atom if minus == first else part - atom
        part = space.const(sizes[key]) * part
        # A group whose first term is negative is subtracted. The constant factor of every group is therefore
        # positive. Emitted code then does not need both c and -c as constants.
        result = result - part if first else result + part
    return result
