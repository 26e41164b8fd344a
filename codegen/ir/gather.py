"""Numbers gathered: 1 + 3/2 (3/2 - 2 x) becomes 13/4 - 3 x, and 3/2 a - 3/2 b becomes 3/2 (a - b).

Exact. Each expression is a combination, with rational coefficients, of others that are none; numbers are
taken out of products and powers. What is flat may share less: the result is taken where it is shorter.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number

Sum = dict[int, tuple[Number, Expr]]
"""A combination: coefficients and expressions by their number, the constant with the expression one."""


def gathered(roots: Sequence[Expr], kept: Iterable[Expr] = ()) -> tuple[Expr, ...]:
    """Return the roots with numbers gathered, or as they are where that takes no fewer operations.

    What is ``kept``, or a number times that, stays as it is where it stands in them.

    >>> from codegen.ir.expr import Space
    >>> space = Space()
    >>> x, half = space.sym("x"), space.const(Number.rational(1, 2))
    >>> (short,) = gathered([half * (half - half * x)])
    >>> sum(node.op == "mul" for node in walk([short]))
    1
    """
    if not roots:
        return ()
    work = _Gathering()
    for node in map(_bare, kept):
        if node.args:
            work.sums[node.id], work.spelled[node.id] = {node.id: (Number.rational(1), node)}, node
    still = set(work.sums)
    found = tuple(work.whole(root) for root in roots)
    return found if _operations(found, still) < _operations(roots, still) else tuple(roots)


def _bare(node: Expr) -> Expr:
    """Return the expression that a node is a number times of: numbers join those before it."""
    while node.op == "neg" or (node.op == "mul" and node.args[0].op == "const"):
        node = node.args[-1]
    return node


def _operations(roots: Sequence[Expr], still: set[int]) -> int:
    nodes = walk(roots, stop=lambda n: n.id in still)
    return sum(node.op not in ("const", "sym", "neg") for node in nodes if node.id not in still)


@dataclass
class _Gathering:
    sums: dict[int, Sum] = field(default_factory=dict)
    spelled: dict[int, Expr] = field(default_factory=dict)

    def whole(self, root: Expr) -> Expr:
        """Return one expression anew."""
        for node in walk([root], stop=lambda n: n.id in self.sums):
            if node.id not in self.sums:
                self.sums[node.id] = self._sum(node)
                self.spelled[node.id] = _spelled(self.sums[node.id], node)
        return self.spelled[root.id]

    def _sum(self, node: Expr) -> Sum:
        space, one = node.space, Number.rational(1)
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
            return {key: pair for key, pair in total.items() if not pair[0].is_zero}
        if node.op == "mul":
            for a, b in (node.args, node.args[::-1]):
                if a.op == "const" and a.payload.is_rational:
                    return _scaled(self.sums[b.id], a.payload)
            (c, x), (d, y) = self._content(node.args[0]), self._content(node.args[1])
            atom = x * y
            return {atom.id: (c * d, atom)}
        if node.op == "pow":
            c, x = self._content(node.args[0])
            atom, power = space.pow(x, node.payload), one
            for _ in range(node.payload):
                power = power * c
            return {atom.id: (power, atom)}
        atom = space._make(node.op, tuple(self.spelled[a.id] for a in node.args), node.payload)
        return {atom.id: (one, atom)}

    def _content(self, node: Expr) -> tuple[Number, Expr]:
        """Return c and x with the node equal to c x, where it is a multiple of one expression."""
        total = self.sums[node.id]
        if len(total) != 1:  # sums are often read more than once
            return Number.rational(1), self.spelled[node.id]
        ((c, atom),) = total.values()
        return c, atom


def _scaled(total: Sum, factor: Number) -> Sum:
    return {key: (c * factor, atom) for key, (c, atom) in total.items()}


def _size(c: Number) -> Number:
    return -c if c.fraction() < 0 else c


def _spelled(total: Sum, node: Expr) -> Expr:
    """Return a combination as an expression: terms with coefficients c or -c are added first."""
    space = node.space
    groups: dict[object, list[tuple[bool, Expr]]] = {}
    sizes: dict[object, Number] = {}
    key: object
    for c, atom in total.values():
        key = "constant" if atom is space.one else _size(c).key
        sizes.setdefault(key, _size(c))
        groups.setdefault(key, []).append((c.fraction() < 0, atom))
    result = space.zero
    for key, terms in groups.items():
        first, part = terms[0][0], terms[0][1]
        for minus, atom in terms[1:]:
            part = part + atom if minus == first else part - atom
        part = space.const(sizes[key]) * part
        result = result - part if first else result + part
    return result
