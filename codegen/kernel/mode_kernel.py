"""Translates programs for semilinear problems u' = L u + N(u) to steps on Fourier modes.

On one Fourier mode, L is a number lambda. The affine maps u -> exp(t lambda) u + c form a group. The pair
(a, b) denotes the vector field u -> a lambda u + b, an element of the Lie algebra of this group. In a step,
b is a linear combination of values of N. The coefficients of b are functions of z = h lambda
(:mod:`codegen.ir.mode_step`). Three formulas are sufficient:

- The exponential of h (a, b) maps u to exp(a z) u + h phi_1(a z) b, where phi_1(z) = (exp(z) - 1)/z.
- The bracket [(a, b), (c, d)] is (0, lambda (a d - c b)).
- Let a be nonzero, x = h (a, b) and beta = a z/(exp(a z) - 1). Then dexp^{-1}_x (c, d) is the pair
  (c, beta d + (1 - beta) c b/a).

The third formula follows from [x, [x, y]] = a z [x, y], which holds for all pairs y.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from codegen.errors import MethodError
from codegen.groups.bernoulli import bernoulli_over_factorial, last_term
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel
from codegen.ir.mode_step import (
    BERNOULLI,
    EXP,
    ONE,
    PHI,
    POWER,
    STATE,
    Evaluation,
    ModeStep,
    Multiplier,
    Nonlinearity,
    Table,
    Term,
)
from codegen.ir.number import Number
from codegen.ir.operations import (
    Act,
    ActExp,
    Advance,
    Bracket,
    ElementAt,
    Exp,
    InverseDexp,
    InverseDifferential,
    Linear,
    Multiply,
    Zero,
)
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import Field
from codegen.ir.values import Kind, Var
from codegen.kernel.assignments import Assignments, unique_name
from codegen.lower import lower, problem_for
from codegen.method import Method
from codegen.passes import PassReport, optimise
from codegen.scene.problem import TIME, Problem
from codegen.scene.semilinear import Semilinear, model_of

Sum: TypeAlias = dict[int, Multiplier]
"""The coefficients of a linear combination of the old state and of values of the nonlinear term N.

The key of the old state is :data:`codegen.ir.mode_step.STATE`. The key of a value of N is the index of the
evaluation.
"""

ZERO = Number.rational(0)


@dataclass(frozen=True)
class _Element:
    """The vector field u -> h^m (a lambda u + b), where u is the coefficient of one Fourier mode.

    - The number lambda is the eigenvalue of the linear operator L for this mode.
    - The attribute ``a`` is the number a, and the attribute ``power`` is the exponent m.
    - The term b is a linear combination of values of the nonlinearity N. The attribute ``b`` contains the
      coefficients of this linear combination.
    """

    a: Number
    b: Sum
    power: int

    @property
    def is_zero(self) -> bool:
        return self.a.is_zero and not self.b


@dataclass(frozen=True)
class _Map:
    """The affine map u -> exp(a z) u + h b, where u is the coefficient of one Fourier mode.

    The number z is h times the eigenvalue of the linear operator L for this mode. The term b is a linear
    combination of values of the nonlinearity N. The attribute ``b`` contains the coefficients of this linear
    combination.
    """

    a: Number
    b: Sum


@dataclass(frozen=True)
class ModeMethod:
    """A compiled method for a semilinear scene.

    ``problem`` is the model problem with one mode. ``lowered`` is the program of a step before the compiler
    passes, and ``program`` is the program after them. ``trace`` contains a report of each pass. ``kernel``
    contains the operations of the step on all modes.
    """

    problem: Problem
    lowered: Program
    program: Program
    trace: tuple[PassReport, ...]
    kernel: Kernel


def mode_method(scene: Problem, method: Method) -> ModeMethod:
    """Compile ``method`` for ``scene``.

    MethodError is raised for implicit methods, and for operations that semilinear scenes do not support.
    """
    model = model_of(scene)
    problem, lowered = problem_for(model, method), lower(model, method)
    program, trace = optimise(lowered, problem)
    if any(not isinstance(statement, Assign) for statement in program.body):
        raise _refused(scene, f"the implicit stages of {method.label}")
    assert scene.semilinear is not None
    step = _Execution(scene, scene.semilinear).step(program)
    # The state is a single function of space, so the scene has one state block.
    (block,) = scene.state
    about = "values at the points x = i length/n, i = 0, ..., n - 1"
    state = (StateBlock(block.name, block.symbols, about),)
    known = (TIME, "h", *scene.runtime)
    return ModeMethod(
        problem, lowered, program, trace, Kernel(program.name, state, known, (), (), modes=step)
    )


def _refused(scene: Problem, what: str) -> MethodError:
    """Return the error for a method that needs ``what``, a feature that semilinear scenes do not have."""
    hint = "explicit methods of the families rkmk, cf and cg are possible, for example cf:cf4"
    return MethodError(
        f"semilinear scenes do not support {what}", where=scene.name, expected="an explicit method", hint=hint
    )


def _sum(parts: Iterable[tuple[Multiplier, Sum]]) -> Sum:
    """Return the sum of m x over the pairs (m, x) of a multiplier m and a linear combination x."""
    total: Sum = {}
    for factor, terms in parts:
        for source, multiplier in terms.items():
            total[source] = total.get(source, Multiplier()) + factor * multiplier
    # The keys are sorted, so equal sums give equal code.
    return {source: m for source, m in sorted(total.items()) if m.terms}


def _constant(value: Number) -> Multiplier:
    return Multiplier.constant(value)


@dataclass
class _Execution:
    """Executes the program of a step symbolically on one Fourier mode."""

    scene: Problem
    semilinear: Semilinear
    elements: dict[Var, _Element] = field(default_factory=dict)
    maps: dict[Var, _Map] = field(default_factory=dict)
    points: dict[Var, Sum] = field(default_factory=dict)
    times: dict[Var, Number] = field(default_factory=dict)
    evaluations: list[Evaluation] = field(default_factory=list)
    tables: dict[tuple[object, ...], int] = field(default_factory=dict)
    listed: list[Table] = field(default_factory=list)

    def step(self, program: Program) -> ModeStep:
        """Translate the program of an explicit method to a step on Fourier modes."""
        for var in program.inputs:
            if var.kind is Kind.REAL:
                # Times are in units of h, and the step begins at time 0.
                self.times[var] = ZERO
            else:
                self.points[var] = {STATE: _constant(ONE)}
        for assign in program.assigns():
            self._execute(assign)
        ((_, result),) = program.outputs
        own = self.semilinear
        terms = self._terms(self.points[result])
        return ModeStep(
            *(tuple(self.listed), tuple(self.evaluations), terms),
            Nonlinearity(own.inner, own.outer, self._kernel(own.formulas), own.kept),
            *(own.wave, own.space),
            *(self._kernel(own.symbol), self._kernel((own.length,)), self._kernel((own.initial,))),
        )

    def _kernel(self, formulas: tuple[Expr, ...]) -> Kernel:
        """Return the kernel that computes ``formulas``.

        All parameters except run-time parameters become constants.
        """
        domain = ExprDomain(formulas[0].space)
        symbols = sorted({n.payload for n in walk(formulas) if n.op == "sym"})
        # Run-time parameters stay symbols.
        values = {s: domain.space.sym(s) for s in symbols} | {
            name: domain.number(number)
            for name, number in self.scene.parameters.items()
            if name not in self.scene.runtime
        }
        roots = evaluate(list(formulas), domain, values)
        read = tuple(sorted({n.payload for n in walk(roots) if n.op == "sym"}))
        taken = set(read)

        schedule = Assignments((), roots, {}, lambda base: unique_name(base, taken))
        body = schedule.run()
        return Kernel("formulas", (), read, body, schedule.outputs)

    def _execute(self, assign: Assign) -> None:
        (target,), operation, args = assign.targets, assign.operation, assign.args
        match operation:
            case Zero():
                # The exponent of h (third argument) is arbitrary, because zero times a power of h is zero.
                self.elements[target] = _Element(ZERO, {}, 1)
            case Linear():
                self.elements[target] = self._combination(assign)
            case Advance():
                assert operation.coefficient.power == 1
                self.times[target] = self.times[args[0]] + operation.coefficient.value
            case Field():
                self.elements[target] = self._evaluated(*args)
            case Exp() | ElementAt():
                self.maps[target] = self._exponential(self.elements[args[0]])
            case Multiply():
                self.maps[target] = self._product(self.maps[args[0]], self.maps[args[1]])
            case Act():
                self.points[target] = self._moved(self.maps[args[0]], self.points[args[1]])
            case ActExp():
                moved = self._exponential(self.elements[args[0]])
                self.points[target] = self._moved(moved, self.points[args[1]])
            case Bracket(dual=False):
                x, y = (self.elements[v] for v in args)
                self.elements[target] = self._bracket(x, y)
            case InverseDexp(dual=False):
                x, y = (self.elements[v] for v in args)
                self.elements[target] = self._truncated(x, y, operation.order)
            case InverseDifferential():
                x, y = (self.elements[v] for v in args)
                self.elements[target] = self._exact(x, y)
            case _:
                raise _refused(self.scene, f"the operation {operation.text()}")

    def _combination(self, assign: Assign) -> _Element:
        parts = [(c, self.elements[v]) for c, v in assign.terms]
        # Zero terms have an arbitrary exponent of h, so they are not compared with the other terms.
        parts = [(c, x) for c, x in parts if not x.is_zero]
        powers = {c.power + x.power for c, x in parts}
        if not powers:
            return _Element(ZERO, {}, 1)
        # All nonzero terms of the sum must have the same power of h.
        (power,) = powers
        total = ZERO
        for c, x in parts:
            total = total + c.value * x.a
        return _Element(total, _sum((_constant(c.value), x.b) for c, x in parts), power)

    def _evaluated(self, point: Var, *time: Var) -> _Element:
        """Record an evaluation of the nonlinearity N at ``point`` and ``time``."""
        at = self.times[time[0]] if time else ZERO
        self.evaluations.append(Evaluation(self._terms(self.points[point]), at))
        # Let N_j be the value of N in the evaluation that was just recorded. The result represents the vector
        # field u -> lambda u + N_j. The dictionary maps the index j of the evaluation to 1, the coefficient
        # of N_j.
        return _Element(ONE, {len(self.evaluations) - 1: _constant(ONE)}, 0)

    def _exponential(self, x: _Element) -> _Map:
        assert x.is_zero or x.power == 1
        # The module docstring contains the formula for the exponential.
        return _Map(x.a, _sum([(Multiplier.of(PHI, x.a), x.b)]))

    def _product(self, g: _Map, k: _Map) -> _Map:
        # Let g(u) = exp(a z) u + h b and k(u) = exp(c z) u + h d, where z = h lambda. Then
        # g(k(u)) = exp((a + c) z) u + h (exp(a z) d + b).
        return _Map(g.a + k.a, _sum([(_constant(ONE), g.b), (Multiplier.of(EXP, g.a), k.b)]))

    def _moved(self, g: _Map, point: Sum) -> Sum:
        # The factor h of the vector ``g.b`` is inserted later, by ``_terms``.
        return _sum([(Multiplier.of(EXP, g.a), point), (_constant(ONE), g.b)])

    def _bracket(self, x: _Element, y: _Element) -> _Element:
        # The bracket of (a, b) and (c, d) is (0, lambda (a d - c b)), and lambda is z/h. The factor 1/h
        # decreases the exponent of h, ``power``, by one.
        z = Multiplier.of(POWER, ONE)
        b = _sum([(z.scaled(x.a), y.b), (z.scaled(-y.a), x.b)])
        return _Element(ZERO, b, x.power + y.power - 1)

    def _truncated(self, x: _Element, y: _Element, order: int) -> _Element:
        assert x.is_zero or x.power == 1
        # In the loop, ``power`` is ad_x^k y and ``factor`` is B_k/k!, where B_k is a Bernoulli number.
        total, power = y, y
        for k in range(1, last_term(order) + 1):
            power = self._bracket(x, power)
            factor = bernoulli_over_factorial(k)
            # The Bernoulli numbers B_3, B_5, ... are zero.
            if factor:
                term = _constant(Number.rational(*factor.as_integer_ratio()))
                # A bracket is a pair (0, b), so the addition changes only the component b of ``total``.
                total = replace(total, b=_sum([(_constant(ONE), total.b), (term, power.b)]))
        return total

    def _exact(self, x: _Element, y: _Element) -> _Element:
        if x.is_zero:
            return y
        assert x.power == 1
        if x.a.is_zero:
            # An element x is a pair (x.a, x.b). If x.a is zero, [x, [x, y]] is zero, and therefore
            # dexp^{-1}_x y = y - [x, y]/2.
            half = Multiplier.of(POWER, Number.rational(1, 2)).scaled(y.a)
            return _Element(y.a, _sum([(_constant(ONE), y.b), (half, x.b)]), y.power)
        beta = Multiplier.of(BERNOULLI, x.a)
        # Here x.a is not zero, so the division by x.a is possible.
        rest = (_constant(ONE) + beta.scaled(Number.rational(-1))).scaled(y.a / x.a)
        return _Element(y.a, _sum([(beta, y.b), (rest, x.b)]), y.power)

    def _terms(self, point: Sum) -> tuple[Term, ...]:
        """Return a linear combination as a sequence of terms."""
        # All sources except the old state are multiplied by h.
        return tuple(Term(source, self._table(m, int(source != STATE))) for source, m in point.items())

    def _table(self, multiplier: Multiplier, power: int) -> int | None:
        # A term with the coefficient 1 needs no product and therefore no table.
        if multiplier.is_one and not power:
            return None
        # To save time and memory, equal multipliers share one table.
        key = (multiplier.key, power)
        if key not in self.tables:
            self.tables[key] = len(self.listed)
            self.listed.append(Table(multiplier, power))
        return self.tables[key]
