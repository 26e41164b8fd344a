"""Collect constants: 1 + 3/2 (3/2 - 2 x) becomes 13/4 - 3 x, and 3/2 a - 3/2 b becomes 3/2 (a - b).

The rewriting is exact. Each expression becomes a linear combination of atoms. An atom is an expression that
is not a linear combination itself. Numbers are taken out of products and powers, and are put into numerators.
For example, 3/2 (1/sqrt x)^3 becomes (3/2)/(x sqrt x). The result is used only if it has fewer operations.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from codegen.ir.expr import Expr, Space, walk
from codegen.ir.number import Number

Sum = dict[int, tuple[Number, Expr]]
"""A linear combination: a table that maps the node number of each expression to the pair (coefficient,
expression). A constant term has the expression 1.
"""


def gathered(roots: Sequence[Expr], kept: Iterable[Expr] = ()) -> tuple[Expr, ...]:
    """Return the roots with their constants collected.

    If the collected form does not save operations, the given roots are returned. The expressions in ``kept``
    and their multiples are not expanded.

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
    # ``bare`` contains the nodes of ``kept`` without their numeric factors, so that these factors can be
    # combined with other numbers.
    work = _Gathering(_powers(roots, bare))
    for node in bare:
        if node.args:
            # A node in ``kept`` is not expanded: its linear combination is 1 times the node itself.
            work.sums[node.id], work.written[node.id] = {node.id: (Number.rational(1), node)}, node
    # The nodes in ``kept`` are recorded before whole() adds other nodes to ``sums``. The nodes in ``kept``
    # are not counted as operations.
    still = set(work.sums)
    collected = tuple(work.whole(root) for root in roots)
    # Expanding sums may leave fewer shared subexpressions. If both forms cost the same, the given form is
    # used, because earlier passes have chosen it.
    return collected if _operations(collected, still) < _operations(roots, still) else tuple(roots)


def _bare(node: Expr) -> Expr:
    """Return a node without its minus signs and its numeric factors: x for -(3 x)."""
    # A constant is always the first factor of a product (Space.mul).
    while node.op == "neg" or (node.op == "mul" and node.args[0].op == "const"):
        node = node.args[-1]
    return node


def _operations(roots: Sequence[Expr], still: set[int]) -> int:
    nodes = [node for node in walk(roots, stop=lambda n: n.id in still) if node.id not in still]
    # A change of sign costs nothing, because the sum that contains the node becomes a difference.
    products = sum(int(node.payload) - 1 for node in nodes if node.op == "pow")
    return products + sum(node.op not in ("const", "sym", "neg", "pow") for node in nodes)


def _powers(roots: Sequence[Expr], kept: Sequence[Expr]) -> dict[int, tuple[int, int]]:
    """Return the powers (1/sqrt x)^n that are rewritten as quotients.

    The powers of 1/sqrt x are rewritten only if all used powers have odd exponents n >= 3. The result maps
    the node number of a power to the pair (node number of 1/sqrt x, n). Subexpressions of ``kept`` are
    skipped.
    """
    still = {node.id for node in walk(kept)}
    ranks: dict[int, tuple[int, int]] = {}
    # Pairs of a node and its user. The user is an expression that contains the node, or None for a root.
    used: list[tuple[Expr, Expr | None]] = [(root, None) for root in roots]
    for node in walk(roots):
        used += [(a, node) for a in node.args]
        inside = [ranks[a.id] for a in node.args if a.id in ranks]
        root = _is_inverse(node) and node.args[1].op == "call" and node.args[1].payload == "sqrt"
        if root and node.id not in still:
            # With y = 1/sqrt(x) each node that equals c y^n gets the pair (y, n).
            ranks[node.id] = (node.id, 1)
        elif _is_power(node, inside):
            exponent = sum(n for _, n in inside)
            ranks[node.id] = (inside[0][0], exponent * (node.payload or 1))
    # A power of y counts only if it is used outside powers of y: y^2 inside y^3 is an intermediate value.
    read = {ranks[x.id] for x, by in used if x.id in ranks and (by is None or by.id not in ranks)}
    # The powers of y = 1/sqrt(x) are not rewritten if y itself or an even power of y is used.
    bases = {base for base, n in read if n == 1 or n % 2 == 0}
    return {key: pair for key, pair in ranks.items() if pair[0] not in bases}


def _is_power(node: Expr, inside: Sequence[tuple[int, int]]) -> bool:
    """Return True if a node is a product of numbers and powers of one inverse root.

    ``inside`` contains a pair (root, exponent) for each argument of the node that is a power of an inverse
    root.
    """
    whole = len(inside) == len(node.args) or node.args[0].op == "const"
    return node.op in ("neg", "pow", "mul") and whole and len({base for base, _ in inside}) == 1


def _is_inverse(node: Expr) -> bool:
    # Equal expressions are the same object, so the operator ``is`` compares them.
    return node.op == "div" and node.args[0] is node.space.one


@dataclass
class _Gathering:
    powers: dict[int, tuple[int, int]]
    sums: dict[int, Sum] = field(default_factory=dict)
    written: dict[int, Expr] = field(default_factory=dict)
    numerators: dict[int, Number] = field(default_factory=dict)

    def whole(self, root: Expr) -> Expr:
        """Return one expression with its constants collected."""
        # Arguments come first, so their combinations are known when a node is visited.
        for node in walk([root], stop=lambda n: n.id in self.sums):
            if node.id not in self.sums:
                # Each node is expanded only once, and all expressions that contain the node use the same
                # combination.
                self.sums[node.id] = self._sum(node)
        return self._spell(root)

    def _spell(self, node: Expr) -> Expr:
        """Return the linear combination of a node as an expression.

        An inverse 1/y is replaced by e/y. The number e is the absolute value of the coefficient in the first
        term with 1/y.
        """
        if node.id not in self.written:
            # The expression is built once and then reused, so that it stays a shared subexpression.
            total = [self._inverse(c, atom) for c, atom in self.sums[node.id].values()]
            self.written[node.id] = _expression(total, node.space)
        return self.written[node.id]

    def _inverse(self, c: Number, atom: Expr) -> tuple[Number, Expr]:
        """Return the term c (1/y) as the pair (d, e/y) with d = c/e. Return any other term unchanged.

        e is the value of |c| in the first term that contains 1/y.
        """
        if not _is_inverse(atom):
            return c, atom
        # The division e/y costs no more than 1/y, and the first term that contains 1/y then needs no product.
        numerator = self.numerators.setdefault(atom.id, _size(c))
        return c / numerator, atom.space.const(numerator) / atom.args[1]

    def _sum(self, node: Expr) -> Sum:
        space, one = node.space, Number.rational(1)
        # Irrational constants are not combined with other numbers, for two reasons. Constants of two
        # different fields cannot be added. Each operation would make a constant that is a ball less accurate.
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
            # Terms that cancel are removed.
            return {key: pair for key, pair in total.items() if not pair[0].is_zero}
        if node.op in ("mul", "pow") and node.id in self.powers and node.args[0].op != "const":
            return self._power(node)
        # A number is multiplied into a sum. Two sums are not multiplied out, because the number of terms
        # would grow exponentially.
        if node.op == "mul":
            for a, b in (node.args, node.args[::-1]):
                if a.op == "const" and a.payload.is_rational:
                    return _scaled(self.sums[b.id], a.payload)
            # (c x)(d y) = (c d)(x y): both numbers are taken out of the product and multiplied into the
            # coefficient of the product x y.
            (c, x), (d, y) = self._content(node.args[0]), self._content(node.args[1])
            atom = x * y
            return {atom.id: (c * d, atom)}
        if node.op == "pow":
            c, x = self._content(node.args[0])
            atom, power = space.pow(x, node.payload), one
            for _ in range(node.payload):
                power = power * c
            return {atom.id: (power, atom)}
        # The node is created directly, because methods such as Space.div might simplify it to a linear
        # combination.
        atom = space._make(node.op, tuple(map(self._spell, node.args)), node.payload)
        return {atom.id: (one, atom)}

    def _power(self, node: Expr) -> Sum:
        """Return (1/sqrt x)^n as 1/x^m for n = 2 m, or as 1/(x^m sqrt x) for n = 2 m + 1."""
        base, exponent = self.powers[node.id]
        ((_, inverse),) = self.sums[base].values()
        # Let y = 1/sqrt x. The variable c collects the numeric factors of y^n, so the remaining power has no
        # numeric factor.
        c = Number.rational(1)
        for arg in node.args * (node.payload or 1):
            ((factor, _),) = self.sums[arg.id].values()
            c = c * factor
        root = inverse.args[1]
        # y^(2m+1) = 1/(x^m sqrt x). The power x^m can be computed in parallel with the root, and the division
        # comes last.
        under = root.space.pow(root.args[0], exponent // 2)
        atom = root.space.one / (under * root if exponent % 2 else under)
        return {atom.id: (c, atom)}

    def _content(self, node: Expr) -> tuple[Number, Expr]:
        """Return (c, x) such that the node equals c x with a number c.

        If the linear combination of the node does not have exactly one term, c is 1.
        """
        total = self.sums[node.id]
        # A common factor of a sum is not taken out, because other expressions may also contain the sum.
        if len(total) != 1:
            return Number.rational(1), self._spell(node)
        ((c, atom),) = total.values()
        return self._inverse(c, atom)


def _scaled(total: Sum, factor: Number) -> Sum:
    return {key: (c * factor, atom) for key, (c, atom) in total.items()}


def _size(c: Number) -> Number:
    return -c if c.fraction() < 0 else c


def _expression(total: Sequence[tuple[Number, Expr]], space: Space) -> Expr:
    """Return a combination as an expression.

    Terms whose coefficients differ only in sign are added before they are multiplied.
    """
    # Terms are grouped by |c|, so that 3/2 a - 3/2 b needs one product. Dictionaries keep the order of
    # insertion, so the result depends on the input alone.
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
        # If the first term of a group is negative, the whole group is subtracted, so that no coefficient
        # occurs with both signs.
        result = result - part if first else result + part
    return result
