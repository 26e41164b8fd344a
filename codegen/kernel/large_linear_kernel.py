"""Translates programs for large linear problems y' = A(t) y to kernels (:mod:`codegen.ir.linear_array_step`).

Let t_i be the stage times. Each exponent in such a program is a linear combination of matrices h A(t_i) and
of their commutators.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cache

from codegen.errors import MethodError
from codegen.groups.actions import Linear as LinearMaps
from codegen.groups.bernoulli import bernoulli_over_factorial, last_term
from codegen.groups.gl import GL
from codegen.ir.array_program import COLUMN, ROW, ConstantMatrix, Entry, Matrix
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel
from codegen.ir.linear_array_step import Element, Letter, LinearArrayStep, TimeMatrix
from codegen.ir.number import Number
from codegen.ir.operations import ActExp, Advance, Bracket, InverseDexp, Linear, Zero
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import Field
from codegen.ir.values import Coefficient, Kind, Var
from codegen.kernel.array_kernel import STATE, ArrayMethod, compiled
from codegen.method import Method
from codegen.scene.linear_field import LinearField
from codegen.scene.linear_scene import LinearScene
from codegen.scene.problem import TIME, Problem

LARGE_SUM = 1e-6
"""A sum of coefficients counts as zero if the absolute value of the sum is below this limit.

For the linear combination c_1 h A(t_1) + ... + c_m h A(t_m), the sum of coefficients is c_1 + ... + c_m.
"""


def refused(scene: Problem, what: str, expected: str) -> MethodError:
    """Return the error for a method that cannot be compiled for large matrices.

    ``what`` contains the reason, and ``expected`` describes what is accepted.
    """
    hint = "use a method of the family magnus, cf_magnus or fer, for example cf_magnus4"
    return MethodError(what, where=scene.name, expected=expected, hint=hint)


def large_linear_method(scene: Problem, method: Method) -> ArrayMethod:
    """Compile ``method`` for ``scene``.

    MethodError is raised for step control, implicit stages, and operations other than exponentials, linear
    combinations and brackets.
    """
    if method.adaptive:
        expected = "a run with constant steps"
        raise refused(scene, "step control is not available for linear scenes with large matrices", expected)
    return compiled(scene, method, _model(not scene.autonomous), large_linear_kernel, refused)


@cache
def _model(timed: bool) -> Problem:
    """Return a small linear problem for tests of each compiler pass. Its matrix depends on t if ``timed`` is
    true."""
    from sympy import Matrix as SquareMatrix
    from sympy import Rational, Symbol

    t = Symbol(TIME) if timed else Rational(1, 3)
    # For different times s and t, the matrices A(s) and A(t) should not commute. Otherwise, all commutators
    # would be zero.
    A = SquareMatrix(3, 3, lambda i, j: Rational(i + 1, j + 2) * t + Rational(i * j - 1, 3) + (i - j) * t**2)
    return LinearScene(group=GL(3), action=LinearMaps(), A=A, y0=[1, 0, 0], span=(0, 1))


def large_linear_kernel(program: Program, scene: Problem) -> Kernel:
    """Return the kernel of a program on a large linear problem.

    MethodError is raised for implicit stages, and for operations other than exponentials, linear combinations
    and brackets.
    """
    assert isinstance(scene.matrices, LinearField)
    step = _Builder(program, scene, scene.matrices).step()
    (block,) = scene.state
    n, k = scene.matrices.rows, scene.matrices.columns
    about = f"vector of {n} numbers" if k == 1 else f"{n} x {k} matrix, row by row"
    state = (StateBlock(block.name, block.symbols, about),)
    return Kernel(program.name, state, (TIME, "h", *scene.runtime), (), (), arrays=step)


@dataclass(frozen=True)
class _Value:
    """A value x/h^p. Here x is a linear combination of matrices h A(t_i) and of their commutators.

    ``power`` is the exponent p. ``nodes`` maps i to the coefficient of h A(t_i). ``commutators`` maps the
    index of a commutator to the coefficient of this commutator.
    """

    power: int
    nodes: dict[int, Number] = field(default_factory=dict)
    commutators: dict[int, Number] = field(default_factory=dict)

    @property
    def is_zero(self) -> bool:
        return not self.nodes and not self.commutators


@dataclass
class _Builder:
    """Collects the nodes, letters and commutators of one step.

    A node is a time t_i at which A is evaluated. A letter is a linear combination of the matrices h A(t_i).
    """

    program: Program
    scene: Problem
    given: LinearField
    domain: ExprDomain = field(default_factory=ExprDomain)
    times: list[Expr] = field(default_factory=list)
    letters: dict[Letter, int] = field(default_factory=dict)
    commutators: list[tuple[Element, Element]] = field(default_factory=list)
    values: dict[Var, _Value] = field(default_factory=dict)
    moments: dict[Var, Expr] = field(default_factory=dict)

    def step(self) -> LinearArrayStep:
        """Return the program as a step that applies exponentials of matrices to the state."""
        statements: dict[Var, Assign] = {}
        for statement in self.program.body:
            if not isinstance(statement, Assign):
                raise refused(
                    self.scene, f"the method has implicit equations ({statement.label})", "an explicit method"
                )
            statements |= dict.fromkeys(statement.targets, statement)
        for var in self.program.inputs:
            if var.kind is Kind.REAL:
                self.moments[var] = self.domain.space.sym(var.name)
        # Without step control, the new state is the only output of the program.
        ((_, end),) = self.program.outputs
        exponents: list[Element] = []
        # The matrix A in the equation y' = A(t) y depends only on the time, so no stage points are computed.
        for x in self.chain(end, statements):
            for var in _needed(x, statements):
                self.run(statements[var])
            value = self.values[x]
            if value.power:
                raise AssertionError(value.power)
            if not value.is_zero:
                exponents.append(self.element(value))
        argument = Matrix(STATE, self.given.rows, self.given.columns)
        return LinearArrayStep(
            argument,
            self.matrix(),
            tuple(self.times),
            tuple(self.letters),
            tuple(self.commutators),
            tuple(exponents),
        )

    def chain(self, end: Var, statements: dict[Var, Assign]) -> list[Var]:
        """Return the exponents x in the order in which their exponentials exp(x) are applied.

        The product of the exponentials maps the old state to the point ``end``.
        """
        result: list[Var] = []
        while end in statements:
            assign = statements[end]
            if not isinstance(assign.operation, ActExp):
                what = f"the operation {assign.operation.name} is not available for large matrices"
                raise refused(self.scene, what, "a method that composes exponentials of Lie algebra elements")
            x, end = assign.args
            # The loop finds the last exponential first, so each new exponent is inserted at the front.
            result.insert(0, x)
        return result

    def run(self, assign: Assign) -> None:
        """Compute and store the result of an assignment."""
        operation, args = assign.operation, assign.args
        (target,) = assign.targets
        # A variable that several exponents contain is computed only once.
        if target in self.values or target in self.moments:
            return
        match operation:
            # A :class:`_Value` is x/h^p, where x is a combination of matrices h A(t_i). The value of the
            # field is A(t) = (h A(t))/h, so p is 1.
            case Field():
                # An autonomous matrix A is constant, so any time gives the same value.
                time = self.moments[args[1]] if len(args) > 1 else self.domain.rational(0)
                self.values[target] = _Value(1, {self.node(time): Number.rational(1)})
            case Linear():
                self.values[target] = self.sum((c, self.values[a]) for c, a in assign.terms)
            case Zero():
                self.values[target] = _Value(0)
            case Bracket(dual=False):
                self.values[target] = self.bracket(self.values[args[0]], self.values[args[1]])
            case InverseDexp(dual=False, order=order):
                self.values[target] = self.inverse(self.values[args[0]], self.values[args[1]], order)
            case Advance(coefficient=c):
                self.moments[target] = self.moments[args[0]] + c.evaluate(self.domain)
            case _:
                what = f"the operation {operation.name} is not available for large matrices"
                raise refused(
                    self.scene,
                    what,
                    "only linear combinations and commutators of matrices A(t)",
                )

    def node(self, time: Expr) -> int:
        """Return the index of the node ``time``, a time at which A is evaluated.

        Evaluations of A at equal times share a node.
        """
        if time not in self.times:
            self.times.append(time)
        return self.times.index(time)

    def sum(self, terms: Iterable[tuple[Coefficient, _Value]]) -> _Value:
        """Return the sum of c x over the pairs (c, x) in ``terms``.

        All terms must have the same power of h.
        """
        given = [(c, x) for c, x in terms if not x.is_zero]
        # The value ``x`` has the denominator h^p with p = ``x.power``. The coefficient ``c`` has the factor
        # h^q with q = ``c.power``. Therefore the product of ``c`` and ``x`` has the denominator h^(p - q).
        powers = {x.power - c.power for c, x in given}
        if len(powers) > 1:
            raise AssertionError(powers)
        # A sum without terms is zero, so its power of h does not matter.
        total = _Value(next(iter(powers), 0))
        for c, x in given:
            for own, more in ((total.nodes, x.nodes), (total.commutators, x.commutators)):
                for key, weight in more.items():
                    own[key] = own[key] + c.value * weight if key in own else c.value * weight
                    # A term with the coefficient zero would cost a matrix product.
                    if own[key].is_zero:
                        del own[key]
        return total

    def bracket(self, x: _Value, y: _Value) -> _Value:
        """Return [x, y]."""
        if not x.commutators and not y.commutators:
            # ``_difference`` may replace x by x - c y with a number c. For small step sizes, the norm of
            # x - c y is usually smaller than that of x. Emitted code multiplies the norms of both matrices in
            # [x, y] to bound the norm of [x, y]. With a smaller bound, an exponential needs fewer operations.
            x, y = _difference(x, y)
        # For matrices a and b, the bracket of a/h^p and b/h^q is [a, b]/h^(p + q). The attribute ``power`` is
        # the exponent of 1/h.
        power = x.power + y.power
        if x.is_zero or y.is_zero:
            return _Value(power)
        pair = self.element(x), self.element(y)
        # Equal commutators have the same index, so emitted code computes them only once.
        if pair not in self.commutators:
            self.commutators.append(pair)
        return _Value(power, {}, {self.commutators.index(pair): Number.rational(1)})

    def inverse(self, x: _Value, y: _Value, order: int) -> _Value:
        """Return dexp^{-1}_x y as a series with at most ``order`` nested brackets in each term."""
        terms, power = [(Coefficient(Number.rational(1)), y)], y
        for k in range(1, last_term(order) + 1):
            power = self.bracket(x, power)
            b = bernoulli_over_factorial(k)
            if b:
                terms.append((Coefficient(Number.rational(b.numerator, b.denominator)), power))
        return self.sum(terms)

    def element(self, value: _Value) -> Element:
        """Convert ``value`` to an :class:`Element`."""
        letter = None
        if value.nodes:
            # The pairs are sorted by node, so equal linear combinations have equal keys.
            key = tuple(sorted(value.nodes.items(), key=lambda item: item[0]))
            letter = self.letters.setdefault(key, len(self.letters))
        return Element(letter, tuple((c, number) for number, c in value.commutators.items()))

    def matrix(self) -> TimeMatrix:
        """Return A(t). Parameters that are fixed at compile time are replaced by their values."""
        space = self.domain.space
        values = {**self.scene.scalars(self.domain, space.sym(TIME))}
        values |= {index: space.sym(index) for index in (ROW, COLUMN)}

        def now(entry: Entry) -> Entry:
            if isinstance(entry, tuple):
                return entry
            (root,) = evaluate([entry], self.domain, values)
            assert isinstance(root, Expr)
            return root

        def fixed(c: ConstantMatrix) -> ConstantMatrix:
            diagonals = tuple(replace(d, entry=now(d.entry)) for d in c.diagonals)
            return replace(c, diagonals=diagonals, full=now(c.full))

        terms: list[tuple[Expr, ConstantMatrix]] = []
        for coefficient, c in self.given.matrix.terms:
            factor = now(coefficient)
            assert isinstance(factor, Expr)
            terms.append((factor, fixed(c)))
        return TimeMatrix(tuple(terms))


def _needed(var: Var, statements: dict[Var, Assign]) -> list[Var]:
    """Return ``var`` and all variables from which ``var`` is computed, in the order of their computation."""
    order: list[Var] = []

    def visit(v: Var) -> None:
        # No statement computes an input of the program, so the inputs are not added to ``order``.
        if v not in statements or v in order:
            return
        for arg in statements[v].args:
            # A(t) does not depend on the state, so the stage points are not computed.
            if arg.kind is not Kind.POINT:
                visit(arg)
        order.append(v)

    visit(var)
    return order


def _difference(x: _Value, y: _Value) -> tuple[_Value, _Value]:
    totals = [_total(x), _total(y)]
    # ``totals`` are the sums of the coefficients of x and of y. If both sums are at least LARGE_SUM in
    # absolute value, a multiple of y is subtracted from x. Otherwise x and y are returned unchanged.
    if min(abs(float(s)) for s in totals) < LARGE_SUM:
        return x, y
    # Because [y, y] = 0, the brackets [x - c y, y] and [x, y] are equal.
    ratio = totals[0] / totals[1]
    nodes = dict(x.nodes)
    for node, c in y.nodes.items():
        less = -(ratio * c)
        nodes[node] = nodes[node] + less if node in nodes else less
    return replace(x, nodes={node: c for node, c in nodes.items() if not c.is_zero}), y


def _total(x: _Value) -> Number:
    total = Number.rational(0)
    for c in x.nodes.values():
        total = total + c
    return total
