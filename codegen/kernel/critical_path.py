"""Shorten the critical path of a step, the longest chain of dependent operations.

For example, let c_1 and c_2 be values of slow trigonometric functions. All other variables are known before
c_1 and c_2. Then

    k (m - g (d + c_1 v + c_2 w)) becomes k (m - g d) - c_1 (k g v) - c_2 (k g w).

The products k (m - g d), k g v and k g w can be computed before c_1 and c_2 are known. The new expression has
more products, so only the longest chains are rewritten.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from codegen.ir.expr import Expr, Space, walk
from codegen.ir.kernel import Kernel, Let

TIMES = {"const": 0, "sym": 0, "neg": 0, "add": 1, "sub": 1, "mul": 1, "pow": 1, "div": 4, "call": 6}
"""Latencies of operations, in multiples of the latency of an addition.

On x86 processors an addition or a product of doubles takes about four cycles, and a division takes about 14
cycles. ``benchmarks/emitted.py`` measures the run times of emitted steps.
"""

ATOMS = frozenset({"call", "div"})
"""Operations with a long latency."""

SLACK = 1
"""A chain of operations is rewritten if its length is at least the maximal length minus ``SLACK``.

The unit is the latency of an addition. The values 0, 2 and 4 of ``SLACK`` would give the same emitted files
as the value 1. An infinite value would change the code of the splitting methods on fast_heavy_top.
"""

Sum = dict[Expr | None, tuple[int, Expr, Expr]]
"""A sum of products s k v c and s k v with the following factors:

- the sign s, which is 1 or -1,
- a factor k that is constant in a run,
- a factor v that may vary in a run, and
- a factor c whose computation needs more successive slow operations (:data:`ATOMS`) than the computation of
  k or v. For example, sin(x/y) needs two successive slow operations: a division, then a call.

The dictionary maps c to (s, k, v). For the product s k v, the key is None.
"""


def chain(kernel: Kernel) -> int:
    """Return the length of the critical path. The unit is the latency of an addition."""
    # A symbol is ready when its assigned value is ready.
    ready: dict[int, int] = {}
    for let in kernel.lets():
        ready[let.value.space.sym(let.name).id] = _measured(let.value, ready)
    return max(_measured(root, ready) for root in kernel.outputs)


def ordered(lets: Sequence[Let]) -> tuple[Let, ...]:
    """Return assignments sorted by the time at which their values are ready.

    The times are rounded down to multiples of the latency of a call. Assignments with equal rounded
    times keep their order.
    """
    ready: dict[int, int] = {}
    times = []
    for let in lets:
        times.append(_measured(let.value, ready))
        ready[let.value.space.sym(let.name).id] = times[-1]
    # The sorted order is valid, because no value is ready before its arguments.
    return tuple(lets[k] for k in sorted(range(len(lets)), key=lambda k: (times[k] // TIMES["call"], k)))


def _measured(root: Expr, ready: dict[int, int]) -> int:
    if root.id in ready:
        return ready[root.id]
    # ``walk`` also yields nodes with known times, but not the arguments of these nodes.
    for node in walk([root], lambda n: n.id in ready):
        if node.id not in ready:
            ready[node.id] = max((ready[a.id] for a in node.args), default=0) + TIMES[node.op]
    return ready[root.id]


def run(roots: Sequence[Expr], invariant: frozenset[str], spread: bool = True) -> tuple[Expr, ...]:
    """Shorten the longest chains of operations in ``roots``, and return the new expressions.

    ``invariant`` names the symbols that are constant in a run. Products of these symbols are formed first. If
    ``spread`` is true, the longest chains are also rewritten as sums of products.
    """
    return _Chains(tuple(roots), invariant, spread).rewritten()


@dataclass
class _Chains:
    """Shortens chains of operations in the expressions ``roots``.

    For each node, ``ready`` contains the time at which the value of the node is known. ``follow`` contains
    the duration of the longest chain of operations after the node.
    """

    roots: tuple[Expr, ...]
    invariant: frozenset[str]
    spread: bool = True
    nodes: list[Expr] = field(init=False)
    level: dict[int, int] = field(default_factory=dict)
    ready: dict[int, int] = field(default_factory=dict)
    follow: dict[int, int] = field(default_factory=dict)
    fixed: dict[int, bool] = field(default_factory=dict)
    new: dict[int, Expr] = field(default_factory=dict)
    sums: dict[tuple[int, int, int], Sum] = field(default_factory=dict)

    def __post_init__(self) -> None:
        # ``walk`` yields the arguments of a node before the node.
        self.nodes = list(walk(self.roots))
        for node in self.nodes:
            self._measure(node)
        for node in reversed(self.nodes):
            # If no operation reads a node, its entry in ``follow`` is 0.
            after = self.follow.setdefault(node.id, 0) + TIMES[node.op]
            for arg in node.args:
                self.follow[arg.id] = max(self.follow.get(arg.id, 0), after)
        # At the time ``longest``, all values of ``roots`` are ready.
        self.longest = max(self.ready[r.id] for r in self.roots)

    def _measure(self, node: Expr) -> None:
        # The level of a node is the largest number of slow operations (:data:`ATOMS`) in a chain that ends at
        # the node.
        self.level[node.id] = max((self.level[a.id] for a in node.args), default=0) + (node.op in ATOMS)
        self.ready[node.id] = max((self.ready[a.id] for a in node.args), default=0) + TIMES[node.op]
        # A value is fixed if it is constant in a run.
        own = node.op == "const" or (node.op == "sym" and node.payload in self.invariant)
        self.fixed[node.id] = all(self.fixed[a.id] for a in node.args) if node.args else own

    def rewritten(self) -> tuple[Expr, ...]:
        """Return ``roots`` with shortened chains of operations."""
        # If ``spread`` is false, no node is expanded to a sum of products.
        ends = self._ends() if self.spread else frozenset()
        for node in self.nodes:
            args = [self.new[a.id] for a in node.args]
            # ``_make`` is used in place of operators such as +, because an operator could simplify the
            # expression and so change its rounding errors.
            plain = node.space._make(node.op, tuple(args), node.payload) if args else node
            plain = self._combined(self._known(plain))
            self.new[node.id] = plain
            # Only sums, differences and products can be expanded to sums of products.
            if node.id in ends and node.op in ("add", "sub", "mul"):
                short = self._expression(self._sum(node, self.level[node.id]), node.space)
                # The expanded expression ``short`` is used only if it is ready earlier than ``plain``.
                if self.ready[short.id] < self.ready[plain.id]:
                    self.new[node.id] = short
        return tuple(self.new[r.id] for r in self.roots)

    def _ends(self) -> frozenset[int]:
        """Return the ids of the nodes (subexpressions) at which long chains of linear operations end.

        These nodes may be expanded to sums of products.
        """
        ends = set()
        for node in self.nodes:
            for arg in node.args:
                # A chain is not rewritten if it is much shorter than the longest chain.
                if self.longest - self.ready[arg.id] - TIMES[node.op] - self.follow[node.id] > SLACK:
                    continue
                # For a square ``arg * arg``, ``others`` is empty.
                others = [a for a in node.args if a is not arg]
                late = self.level[arg.id]
                # ``linear`` is true if ``node`` is a sum, a difference, a negative, or a product a * ``arg``
                # with a factor a that needs fewer successive slow operations (:data:`ATOMS`) than ``arg``. If
                # ``arg`` is b + c, such a product can be expanded to a b + a c.
                linear = node.op in ("add", "sub", "neg") or (
                    node.op == "mul" and len(others) == 1 and self.level[others[0].id] < late
                )
                if late and not (linear and self.level[node.id] == late):
                    ends.add(arg.id)
        return frozenset(ends)

    def _sum(self, node: Expr, level: int) -> Sum:
        # The key contains the id of ``self.new[node.id]``, the expression that replaces ``node``, because the
        # stored sum may contain this expression. If another expression replaces ``node`` later, the key is
        # different, and a new sum is computed.
        key = node.id, level, self.new[node.id].id
        if key not in self.sums:
            self.sums[key] = self._expanded(node, level)
        return self.sums[key]

    def _expanded(self, node: Expr, level: int) -> Sum:
        one = node.space.one
        if self.level[node.id] < level:
            return {None: (1, one, self.new[node.id])}
        if node.op == "neg":
            return _scaled(self._sum(node.args[0], level), -1, one, one)
        if node.op in ("add", "sub"):
            # Changes in ``total`` must not change the stored result of ``_sum``.
            total = dict(self._sum(node.args[0], level))
            sign = 1 if node.op == "add" else -1
            for atom, term in _scaled(self._sum(node.args[1], level), sign, one, one).items():
                # Products with the same key c are combined: c x + c y = c (x + y).
                total[atom] = self._joined(total[atom], term) if atom in total else term
            return total
        if node.op == "mul":
            a, b = node.args
            # ``self.level`` contains, for each node, the number of successive slow operations that the node
            # needs. The factor of ``node`` with the smaller level becomes ``a``, and the other factor ``b``.
            # If the level of ``a`` is less than the parameter ``level``, ``a`` is known early. Then ``b`` is
            # replaced by a sum of products, and each of these products is multiplied by ``a``.
            if self.level[b.id] < self.level[a.id]:
                a, b = b, a
            if self.level[a.id] < level:
                # Factors that are constant in a run are collected separately (:data:`Sum`).
                factor = self.new[a.id]
                return _scaled(
                    self._sum(b, level), 1, *((factor, one) if self.fixed[a.id] else (one, factor))
                )
        # ``node`` is not expanded, so the resulting sum has one term: the expression that replaces ``node``.
        # The sign and the two other factors of this term are 1.
        return {self.new[node.id]: (1, one, one)}

    def _joined(self, a: tuple[int, Expr, Expr], b: tuple[int, Expr, Expr]) -> tuple[int, Expr, Expr]:
        x, y = self._product(*a[1:]), self._product(*b[1:])
        # The signs ``a[0]`` and ``b[0]`` are 1 or -1.
        return a[0], x.space.one, self._known(x + y if a[0] == b[0] else x - y)

    def _product(self, steps: Expr, rest: Expr) -> Expr:
        return self._known(self._known(steps) * rest)

    def _expression(self, total: Sum, space: Space) -> Expr:
        """Return the sum of products ``total`` as an expression."""
        terms: list[tuple[int, Expr]] = []
        for atom, (sign, steps, rest) in total.items():
            product = self._product(steps, rest)
            terms.append((sign, product if atom is None else self._known(atom * product)))
        while len(terms) > 1:
            # As in Huffman coding, the two terms that are ready first are added first.
            terms.sort(key=lambda term: self.ready[term[1].id])
            (p, x), (q, y), *others = terms
            # If the signs differ, the negative term is subtracted from the positive term.
            both = x + y if p == q else x - y if p > 0 else y - x
            terms = [(p if p == q else 1, self._known(both)), *others]
        sign, value = terms[0]
        return value if sign > 0 else self._known(-value)

    def _combined(self, node: Expr) -> Expr:
        """Change the order of the multiplications in a product, so that constant factors are multiplied
        first.

        Suppose that c1 and c2 are constant in a run, and x is not. If ``node`` is c1 (c2 x), return
        (c1 c2) x. Otherwise return ``node``.
        """
        if node.op != "mul":
            return node
        # For fixed c1 and c2, c1 (c2 x) becomes (c1 c2) x.
        for a, b in (node.args, node.args[::-1]):
            if self.fixed[a.id] and b.op == "mul":
                for c, d in (b.args, b.args[::-1]):
                    # ``node`` is ``a * (c * d)``, and ``a`` is constant in a run. If ``c`` is also constant
                    # and ``d`` varies, ``node`` is replaced by ``(a * c) * d``. If all three factors are
                    # constant, another order of the multiplications saves nothing, so ``node`` is kept.
                    if self.fixed[c.id] and not self.fixed[d.id]:
                        return self._product(a * c, d)
        return node

    def _known(self, node: Expr) -> Expr:
        """Call :meth:`_measure` for all unmeasured subexpressions of ``node``, and return ``node``."""
        if node.id in self.ready:
            return node
        for part in walk([node], lambda n: n.id in self.ready):
            if part.id not in self.ready:
                self._measure(part)
        return node


def _scaled(total: Sum, sign: int, steps: Expr, rest: Expr) -> Sum:
    return {atom: (sign * p, s * steps, r * rest) for atom, (p, s, r) in total.items()}
