"""Combine the constants in expressions: 1 + 3/2 (3/2 - 2 x) becomes 13/4 - 3 x, and 3/2 a - 3/2 b becomes
3/2 (a - b).

The rewriting is exact. Each expression becomes a linear combination of atoms. An atom is an expression that
is not a linear combination itself. The product c (1/y) with a number c becomes the quotient c/y.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from codegen.ir.expr import Expr, Space, walk
from codegen.ir.number import Number

Sum = dict[int, tuple[Number, Expr]]
"""A linear combination of atoms: a dictionary from the node number of each atom to the pair (coefficient,
atom). For a constant term the atom is the expression 1.
"""


def gathered(roots: Sequence[Expr], kept: Iterable[Expr] = ()) -> tuple[Expr, ...]:
    """Return the expressions ``roots`` with their constants combined.

    If this does not reduce the number of operations, ``roots`` is returned unchanged.

    ``kept`` contains expressions that are needed outside ``roots``, too. Each of these expressions has the
    form c x with a number c, which may be 1. Because x must be computed anyway, x is not rewritten in
    ``roots``: a new form of x would need additional operations. The number c is combined with other constants
    in ``roots``.

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
    # ``bare`` contains each expression in ``kept`` without its numeric factor, for example x for 3 x.
    work = _Gathering(_powers(roots, bare))
    for node in bare:
        if node.args:
            # ``work.whole`` must not rewrite this node. It rewrites only nodes without entries in
            # ``work.sums`` and ``work.written``, so the node gets entries that leave it unchanged.
            work.sums[node.id], work.written[node.id] = {node.id: (Number.rational(1), node)}, node
    # ``still`` contains the ids of expressions that are not rewritten. The function ``_operations`` below
    # does not count the operations in these expressions.
    still = set(work.sums)
    collected = tuple(work.whole(root) for root in roots)
    # A subexpression that occurs several times in ``roots`` may occur in several different forms in
    # ``collected``, and ``collected`` then needs more operations.
    return collected if _operations(collected, still) < _operations(roots, still) else tuple(roots)


def _bare(node: Expr) -> Expr:
    """Return a node without its minus signs and its numeric factors: x for -(3 x)."""
    # In a product with a constant, ``Space.mul`` puts the constant first.
    while node.op == "neg" or (node.op == "mul" and node.args[0].op == "const"):
        node = node.args[-1]
    return node


def _operations(roots: Sequence[Expr], still: set[int]) -> int:
    nodes = [node for node in walk(roots, stop=lambda n: n.id in still) if node.id not in still]
    # A negation usually costs nothing, because a - b replaces a + (-b).
    products = sum(int(node.payload) - 1 for node in nodes if node.op == "pow")
    return products + sum(node.op not in ("const", "sym", "neg", "pow") for node in nodes)


def _powers(roots: Sequence[Expr], kept: Sequence[Expr]) -> dict[int, tuple[int, int]]:
    """Find the powers of y = 1/sqrt x that are rewritten as quotients.

    For example, y^3 is rewritten as 1/(x sqrt x). A power y^n may have a numeric factor c. If y^n is
    rewritten, the result maps the node number of c y^n to the pair (node number of y, n).
    """
    still = {node.id for node in walk(kept)}
    ranks: dict[int, tuple[int, int]] = {}
    # ``used`` contains (argument, parent node) for each argument, and (root, None) for each root.
    used: list[tuple[Expr, Expr | None]] = [(root, None) for root in roots]
    for node in walk(roots):
        used += [(a, node) for a in node.args]
        inside = [ranks[a.id] for a in node.args if a.id in ranks]
        root = _is_inverse(node) and node.args[1].op == "call" and node.args[1].payload == "sqrt"
        if root and node.id not in still:
            # ``ranks`` maps the node number of y^n, where y = 1/sqrt x, to the pair (node number of y, n). In
            # the next line, ``node`` is y = y^1.
            ranks[node.id] = (node.id, 1)
        elif _is_power(node, inside):
            # Exponents are added in a product, and multiplied in a power of a power.
            exponent = sum(n for _, n in inside)
            ranks[node.id] = (inside[0][0], exponent * (node.payload or 1))
    # ``read`` omits powers that are only factors of a higher power. For example, if y^3 in z + y^3 is
    # computed as y^2 y, ``read`` contains the pair (node number of y, 3), but no pairs for y and y^2.
    read = {ranks[x.id] for x, by in used if x.id in ranks and (by is None or by.id not in ranks)}
    # If ``read`` contains y itself or an even power of y, no power of y is rewritten. For example, y and y^3
    # need one division in the form y = 1/sqrt x and y^3 = y y y, but two divisions in the form 1/sqrt x and
    # 1/(x sqrt x).
    bases = {base for base, n in read if n == 1 or n % 2 == 0}
    return {key: pair for key, pair in ranks.items() if pair[0] not in bases}


def _is_power(node: Expr, inside: Sequence[tuple[int, int]]) -> bool:
    """Return True if ``node`` has the form c y^n with a number c, a node y = 1/sqrt x and an integer n > 0.

    The operation of ``node`` must be a product, a power or a negation. For each argument of ``node`` that has
    the form c y^n, ``inside`` contains the pair (node number of y, n). Different arguments may have different
    nodes y.
    """
    # The first argument may be a number.
    whole = len(inside) == len(node.args) or node.args[0].op == "const"
    return node.op in ("neg", "pow", "mul") and whole and len({base for base, _ in inside}) == 1


def _is_inverse(node: Expr) -> bool:
    # A :class:`Space` contains only one node for the constant 1, so a comparison with ``is`` is sufficient.
    return node.op == "div" and node.args[0] is node.space.one


@dataclass
class _Gathering:
    powers: dict[int, tuple[int, int]]
    sums: dict[int, Sum] = field(default_factory=dict)
    written: dict[int, Expr] = field(default_factory=dict)
    numerators: dict[int, Number] = field(default_factory=dict)

    def whole(self, root: Expr) -> Expr:
        """Return the expression ``root`` with its constants combined."""
        # ``walk`` yields the arguments of a node before the node.
        for node in walk([root], stop=lambda n: n.id in self.sums):
            if node.id not in self.sums:
                # Each node is converted once, even if several roots contain it.
                self.sums[node.id] = self._sum(node)
        return self._spell(root)

    def _spell(self, node: Expr) -> Expr:
        """Convert the linear combination ``self.sums[node.id]`` to an expression."""
        if node.id not in self.written:
            # A node may occur in several expressions.
            total = [self._inverse(c, atom) for c, atom in self.sums[node.id].values()]
            self.written[node.id] = _expression(total, node.space)
        return self.written[node.id]

    def _inverse(self, c: Number, atom: Expr) -> tuple[Number, Expr]:
        """Return the term c times ``atom`` as a pair (number, expression).

        If ``atom`` is not a quotient 1/y, the pair is (c, ``atom``). For a quotient 1/y, the pair is
        (c/e, e/y) with a positive number e. The first call for 1/y sets e = |c|. Later calls for the same 1/y
        use the same number e.
        """
        if not _is_inverse(atom):
            return c, atom
        # If ``numerator`` is |c|, the quotient c / ``numerator`` is 1 or -1 and needs no multiplication.
        numerator = self.numerators.setdefault(atom.id, _size(c))
        return c / numerator, atom.space.const(numerator) / atom.args[1]

    def _sum(self, node: Expr) -> Sum:
        space, one = node.space, Number.rational(1)
        # Irrational constants are not combined, because constants of different number fields cannot be added.
        if node.op == "const" and node.payload.is_rational:
            return {} if node.payload.is_zero else {space.one.id: (node.payload, space.one)}
        if node.op == "neg":
            return _scaled(self.sums[node.args[0].id], Number.rational(-1))
        if node.op in ("add", "sub"):
            # The copy protects the stored linear combination of the first argument from changes.
            total = dict(self.sums[node.args[0].id])
            other = self.sums[node.args[1].id]
            for key, (c, atom) in (
                other if node.op == "add" else _scaled(other, Number.rational(-1))
            ).items():
                total[key] = (total[key][0] + c if key in total else c, atom)
            # If terms cancel, their sum has the coefficient zero.
            return {key: pair for key, pair in total.items() if not pair[0].is_zero}
        if node.op in ("mul", "pow") and node.id in self.powers and node.args[0].op != "const":
            return self._power(node)
        # The product of two sums is not expanded, because the number of terms would grow exponentially in
        # nested products.
        if node.op == "mul":
            for a, b in (node.args, node.args[::-1]):
                if a.op == "const" and a.payload.is_rational:
                    return _scaled(self.sums[b.id], a.payload)
            # With numbers c and d, (c x)(d y) has the coefficient c d and the atom x y.
            (c, x), (d, y) = self._content(node.args[0]), self._content(node.args[1])
            atom = x * y
            return {atom.id: (c * d, atom)}
        if node.op == "pow":
            c, x = self._content(node.args[0])
            atom, power = space.pow(x, node.payload), one
            for _ in range(node.payload):
                power = power * c
            return {atom.id: (power, atom)}
        # The method ``_make`` does not simplify the new node.
        atom = space._make(node.op, tuple(map(self._spell, node.args)), node.payload)
        return {atom.id: (one, atom)}

    def _power(self, node: Expr) -> Sum:
        """Return the product c y^n as a linear combination with one term.

        Here c is a number, and y is 1/sqrt x. The term is c/x^m for n = 2 m, and c/(x^m sqrt x) for
        n = 2 m + 1.
        """
        base, exponent = self.powers[node.id]
        ((_, inverse),) = self.sums[base].values()
        # The number c is the product of the numeric factors of the arguments.
        c = Number.rational(1)
        # A power x^n counts as a product of n equal factors x.
        for arg in node.args * (node.payload or 1):
            ((factor, _),) = self.sums[arg.id].values()
            c = c * factor
        root = inverse.args[1]
        # For an odd exponent 2 m + 1, the denominator is x^m sqrt x and not (sqrt x)^(2 m + 1), because a
        # processor can compute x^m and sqrt x at the same time.
        under = root.space.pow(root.args[0], exponent // 2)
        atom = root.space.one / (under * root if exponent % 2 else under)
        return {atom.id: (c, atom)}

    def _content(self, node: Expr) -> tuple[Number, Expr]:
        """Return a number c and an expression x such that the node equals c x."""
        total = self.sums[node.id]
        # A sum is not divided by a common factor, because other expressions may contain the same sum.
        if len(total) != 1:
            return Number.rational(1), self._spell(node)
        ((c, atom),) = total.values()
        return self._inverse(c, atom)


def _scaled(total: Sum, factor: Number) -> Sum:
    return {key: (c * factor, atom) for key, (c, atom) in total.items()}


def _size(c: Number) -> Number:
    return -c if c.fraction() < 0 else c


def _expression(total: Sequence[tuple[Number, Expr]], space: Space) -> Expr:
    """Return the sum of c times x over the pairs (c, x) in ``total``."""
    # Terms with the same |c| form a group, which needs only one product.
    groups: dict[object, list[tuple[bool, Expr]]] = {}
    sizes: dict[object, Number] = {}
    key: object
    for c, atom in total:
        # 3 + 3 x is not changed to 3 (1 + x), because this saves no multiplication.
        key = "constant" if atom is space.one else _size(c).key
        sizes.setdefault(key, _size(c))
        groups.setdefault(key, []).append((c.fraction() < 0, atom))
    result = space.zero
    for key, terms in groups.items():
        first, part = terms[0][0], terms[0][1]
        for minus, atom in terms[1:]:
            # The sign of the first term is factored out: -a + b becomes -(a - b).
            part = part + atom if minus == first else part - atom
        part = space.const(sizes[key]) * part
        # A minus sign that was factored out above becomes a subtraction.
        result = result - part if first else result + part
    return result
