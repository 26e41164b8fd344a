"""Finds repeated trees: groups of assignments that occur several times and can become one outlined function.

At first, each assignment is a tree of its own. A tree A can be joined with a tree B if only one assignment
reads the results of A, and B contains this assignment. The pairs of trees that save the most lines of code
are joined first.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field

from codegen.ir.domain import ExprDomain, Value
from codegen.ir.expr import Expr, walk
from codegen.ir.interpret import flatten
from codegen.ir.operations import Advance, Identity, Linear, Zero
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import FLOWS
from codegen.ir.values import Coefficient, Var

NEVER = (Advance, Zero, Identity, *FLOWS)
"""Assignments with these operations are never moved into a function."""

NODES = 3
"""To estimate the length of emitted code, NODES operations are counted as one line.

For the methods of the gallery, a line of emitted code contains NODES operations on average. NODES = 2 and
NODES = 5 give the same files in ``generated/`` as NODES = 3.
"""

Values = tuple[Expr, ...]

Key = Hashable
"""A description of a tree. Trees with equal keys can share one outlined function."""

PairKey = tuple[Key, Key, Key]
"""The keys of two trees, and the key of the joined tree."""


@dataclass(frozen=True)
class Execution:
    """One executed assignment with the values of its arguments and of its results.

    ``place`` is the number of the block that contains the assignment, or -1 outside blocks. If ``joined`` is
    false, no :class:`Tree` contains the assignment. A tree is a group of assignments that can become a
    function.
    """

    assign: Assign
    args: tuple[Values, ...]
    results: tuple[Values, ...]
    place: int
    joined: bool = True

    @property
    def may_join(self) -> bool:
        """True if a :class:`Tree` can contain this assignment."""
        return self.joined and not isinstance(self.assign.operation, NEVER)


@dataclass
class Tree:
    """A group of assignments that an outlined function can execute.

    ``members`` are the indices of the assignments in the order of execution. The last assignment depends on
    all others.
    """

    members: list[int]

    @property
    def root(self) -> int:
        """The index of the last assignment, which computes the results of the tree."""
        return self.members[-1]


@dataclass
class Trees:
    """Collects the assignments of a program, and joins them into groups (:class:`Tree`)."""

    program: Program
    domain: ExprDomain
    executions: list[Execution] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._users: dict[Var, list[int | None]] = {}
        self._lines: dict[str, int] = {}
        self._multiples: dict[Var, tuple[Coefficient, Var, Value]] = {}

    def note(
        self,
        assign: Assign,
        args: Sequence[Value],
        results: Sequence[Value],
        place: int,
        joined: bool = True,
    ) -> None:
        """Record an assignment. ``place`` is the number of the block that contains it, or -1 outside blocks.

        If ``joined`` is false, no :class:`Tree` contains the assignment. A tree is a group of assignments
        that can become a function.
        """
        assign, args = self._from_the_whole(assign, args)
        self.executions.append(
            Execution(
                assign,
                tuple(flatten(v.kind, x) for v, x in zip(assign.args, args, strict=True)),
                tuple(flatten(v.kind, x) for v, x in zip(assign.targets, results, strict=True)),
                place,
                joined,
            )
        )

    def _from_the_whole(self, assign: Assign, args: Sequence[Value]) -> tuple[Assign, Sequence[Value]]:
        """Replace a multiple of a multiple by one product: c (d v) becomes (c d) v.

        Here c and d are coefficients, and v is a variable.
        """
        if not assign.is_multiple:
            return assign, args
        ((c, v),), (target,) = assign.terms, assign.targets
        # ``assign`` computes c v. Suppose that v is the result d w of an earlier assignment, where d is a
        # coefficient and w is a variable. In this case, ``assign`` is replaced by an assignment that computes
        # (c d) w and does not read v.
        if v in self._multiples:
            d, v, value = self._multiples[v]
            c, args = Coefficient(c.value * d.value, c.power + d.power), (value,)
            assign = Assign.of_terms(target, [(c, v)])
        self._multiples[target] = c, v, args[0]
        return assign, args

    def joined(self) -> list[Tree]:
        """Join assignments into trees, as long as this saves lines of emitted code. Return the trees."""
        self._find_users()
        # ``trees[i]`` is the tree whose last assignment has the index i.
        trees = {i: Tree([i]) for i, m in enumerate(self.executions) if m.may_join}
        owner = {i: i for i in trees}
        # Each round except the last joins at least one pair of trees, so the number of trees decreases.
        while True:
            pairs: dict[PairKey, list[tuple[int, int]]] = {}
            # A key is computed only once in a round, because the computation visits the whole tree.
            keys = {i: self.key(t) for i, t in trees.items()}
            count: dict[Key, int] = {}
            for key in keys.values():
                count[key] = count.get(key, 0) + 1
            for i in trees:
                # Tree i can be joined with tree j if the results of i have only one reader, and j contains
                # this reader.
                user = self._only_user(i)
                # ``owner`` does not contain the assignments for which ``may_join`` is false.
                if user is not None and user in owner and owner[user] != i:
                    j = owner[user]
                    # The keys of trees i and j do not say which arguments of tree j are results of tree i.
                    # Therefore the key of a pair also contains the key of the joined tree.
                    joined = self.key(self._join(trees[i], trees[j]))
                    pairs.setdefault((keys[i], keys[j], joined), []).append((i, j))
            # The choice is greedy: the pair that saves the most lines is joined first.
            best, saved = None, 0
            for key, places in pairs.items():
                gain = self._gain(key, places, count)
                # Among pairs with equal gains, the pair that was found first is chosen.
                if gain > saved:
                    best, saved = key, gain
            if best is None:
                return list(trees.values())
            # The pairs were found before trees were joined in this round. After trees i and j are joined,
            # each further pair that contains i or j is no longer valid. Therefore ``used`` contains all trees
            # that were joined in this round.
            used: set[int] = set()
            for i, j in pairs[best]:
                if i in used or j in used:
                    continue
                used |= {i, j}
                # The joined tree keeps the index j, because tree j contains the last assignment.
                trees[j] = self._join(trees[i], trees[j])
                for member in trees.pop(i).members:
                    owner[member] = j

    def _gain(self, key: PairKey, places: list[tuple[int, int]], count: Mapping[Key, int]) -> int:
        """Estimate how many lines of emitted code are saved if all pairs in ``places`` are joined."""
        first, second, _ = key
        k = len(places)
        if k < 2:
            return 0
        i, j = places[0]
        # ``k`` is the number of pairs, and ``count[first]`` is the number of trees with the key ``first``. If
        # ``count[first]`` exceeds ``k``, at least one of these trees is in no pair and is not joined. The
        # lines of code for a tree with this key are then emitted twice: in a function for the trees that are
        # not joined, and in the function for the joined trees. The same is true for ``second``.
        copies = self._size(i) * (count[first] > k) + self._size(j) * (count[second] > k)
        # A function call takes about three lines. Joining the two trees of a pair replaces two calls by one,
        # so each of the ``k`` pairs saves three lines.
        return k * 3 - copies

    def _size(self, i: int) -> int:
        """Estimate the number of lines of code for assignment ``i``."""
        # Assignments with the same operation name get the same estimate.
        name = self.executions[i].assign.operation.name
        if name not in self._lines:
            results = [x for value in self.executions[i].results for x in value]
            # The walk stops at the arguments of the assignment.
            stop = {x.id for value in self.executions[i].args for x in value}
            nodes = sum(1 for n in walk(results, lambda n: n.id in stop) if n.args and n.id not in stop)
            self._lines[name] = 1 + nodes // NODES
        return self._lines[name]

    def _join(self, a: Tree, b: Tree) -> Tree:
        # Indices increase in the order of execution, so sorting gives a valid order.
        return Tree(sorted([*a.members, *b.members]))

    def _find_users(self) -> None:
        for i, m in enumerate(self.executions):
            for v in m.assign.args:
                self._users.setdefault(v, []).append(i)
        for statement in self.program.body:
            if not isinstance(statement, Assign):
                for v in (*statement.starts, *statement.images, *statement.residuals):
                    # None means that implicit equations read the variable ``v``.
                    self._users.setdefault(v, []).append(None)
        for _, v in self.program.outputs:
            # The list ``self._users[v]`` contains the readers of the variable ``v``. Here the entry None
            # shows that ``v`` is an output of the program.
            self._users.setdefault(v, []).append(None)

    def _only_user(self, i: int) -> int | None:
        """Return the index of the only assignment that reads the results of assignment ``i``.

        Return None if no such assignment exists in the same block.
        """
        # The readers form a set, because an operation may read one value twice.
        users = {u for v in self.executions[i].assign.targets for u in self._users.get(v, [])}
        if len(users) != 1:
            return None
        (user,) = users
        # A loop repeats its operations, so these operations are not joined with operations outside the loop.
        return user if user is not None and self.executions[user].place == self.executions[i].place else None

    def wiring(self, tree: Tree) -> tuple[list[Var], list[tuple[int, ...]]]:
        """Return the input variables of a tree, and a tuple of numbers for each assignment of the tree.

        Each number denotes an argument of the assignment. The numbers 0, 1, ... denote the input variables.
        The numbers -1, -2, ... denote the results of the assignments in the order of execution.
        """
        targets: dict[Var, int] = {}
        given: dict[Var, int] = {}
        wires = []
        for i in tree.members:
            places = []
            for v in self.executions[i].assign.args:
                if v in targets:
                    # The variable ``v`` is a result of an earlier assignment in the tree. The results are
                    # counted from 1, and result k is represented by the number -k.
                    places.append(-targets[v])
                else:
                    # Input variables are numbered in the order in which they are first read.
                    places.append(given.setdefault(v, len(given)))
            wires.append(tuple(places))
            for v in self.executions[i].assign.targets:
                # The result with the number k is represented by -k in ``places``. The first result has the
                # number 1, because 0 in ``places`` represents the first input variable.
                targets[v] = 1 + len(targets)
        return list(given), wires

    def key(self, tree: Tree) -> Key:
        """Return the key of a tree. The key does not contain the values of coefficients."""
        _, wires = self.wiring(tree)
        shape = []
        for i, places in zip(tree.members, wires, strict=True):
            assign = self.executions[i].assign
            # Trees that differ only in the values of coefficients can share a function, so they need equal
            # keys. A ``Linear`` operation contains the values of its coefficients, so the key contains None
            # in place of this operation.
            operation = None if isinstance(assign.operation, Linear) else assign.operation
            shape.append((operation, _pattern([c for c, _ in assign.terms]), places, assign.targets[0].kind))
        return tuple(shape)

    def useful(self, tree: Tree) -> bool:
        """Return True if the code for ``tree`` is longer than a function call."""
        results = self.results(tree)
        # The inputs are computed outside the function, so their operations are not counted.
        stop = {x.id for x in self.inputs(tree)}
        nodes = sum(1 for n in walk(results, lambda n: n.id in stop) if n.args and n.id not in stop)
        # A call takes about four lines of code, and a line contains about NODES operations.
        return nodes > 4 * NODES

    def results(self, tree: Tree) -> Values:
        """Return the components of all results of the operation at the root of ``tree``."""
        return tuple(x for value in self.executions[tree.root].results for x in value)

    def inputs(self, tree: Tree) -> list[Expr]:
        """Return the scalar inputs of a tree: the components of its input variables, then the coefficients of
        its sums.

        The step size h is the last input if a coefficient contains a power of h.
        """
        given, _ = self.wiring(tree)
        values: dict[Var, Values] = {}
        for i in tree.members:
            execution = self.executions[i]
            values |= {v: x for v, x in zip(execution.assign.args, execution.args, strict=True) if v in given}
        flat = [x for v in given for x in values[v]]
        # The function has one parameter for each coefficient, in the order of ``scales``.
        scales = [c for i in tree.members for c in distinct(self.executions[i].assign)]
        flat += [self.domain.number(c.value) for c in scales]
        return [*flat, self.domain.h] if any(c.power for c in scales) else flat

    def width(self, tree: Tree, var: Var) -> int:
        """Return the number of components of ``var``, an input variable of ``tree``."""
        for i in tree.members:
            for v, x in zip(self.executions[i].assign.args, self.executions[i].args, strict=True):
                if v == var:
                    return len(x)
        raise AssertionError(var.name)


def _pattern(coefficients: Sequence[Coefficient]) -> tuple[tuple[int, int], ...]:
    """Return a pair (label, k) for each coefficient c h^k.

    The coefficient 1 has the label 0. Equal coefficients have equal labels, and different coefficients have
    different labels.
    """
    seen: dict[Coefficient, int] = {}
    # Equal coefficients of a sum share one argument of the outlined function. The coefficient 1 is not an
    # argument.
    return tuple((0, 0) if c.is_one else (seen.setdefault(c, 1 + len(seen)), c.power) for c in coefficients)


def distinct(assign: Assign) -> list[Coefficient]:
    """Return the distinct coefficients of a sum, except 1, in the order of their first appearance."""

    return list(dict.fromkeys(c for c, _ in assign.terms if not c.is_one))
