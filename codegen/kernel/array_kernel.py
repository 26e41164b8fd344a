"""Translate the program of a step to a kernel whose statements compute with whole matrices.

:mod:`codegen.ir.array_step` defines the statements.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache

from codegen.errors import MethodError
from codegen.groups.actions.rotation import Rotation
from codegen.groups.bernoulli import bernoulli_over_factorial, last_term
from codegen.groups.so3 import SO3
from codegen.ir.array_program import (
    COLUMN,
    ROW,
    Apply,
    ArrayStatement,
    Combination,
    Entry,
    Matrix,
    Multiplication,
    Term,
)
from codegen.ir.array_step import AddUnit, ArrayStep, Move, StepStatement
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate
from codegen.ir.kernel import Estimate, Kernel
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.operations import Act, ActExp, Advance, Bracket, Exp, InverseDexp, Linear, Zero
from codegen.ir.program import EMBEDDED, Assign, Program
from codegen.ir.scene_operations import Field
from codegen.ir.values import Kind, Var
from codegen.lower import lower
from codegen.method import Method
from codegen.passes import PassReport, blocks, optimise
from codegen.scene.field_scene import FieldScene
from codegen.scene.matrix_field import MatrixField
from codegen.scene.problem import TIME, Problem

STATE, NEW, BASIS, GRAM, ERROR = "state", "new state", "basis", "gram", "error"
"""The names of the arrays in a step.

``BASIS`` is the basis B (:class:`_Builder`), and ``GRAM`` is its Gram matrix B^T B.
"""


def refused(scene: Problem, what: str, expected: str) -> MethodError:
    """Return the error for a method that cannot be compiled for large matrices.

    ``what`` is the reason, and ``expected`` says what is accepted instead.
    """
    hint = "use an explicit method of the family rkmk, cf or cg, for example rkmk:rk4"
    return MethodError(what, where=scene.name, expected=expected, hint=hint)


@dataclass(frozen=True)
class ArrayMethod:
    """A compiled method for a scene (problem) with large matrices.

    ``lowered`` is the program of a step before the compiler passes, and ``program`` is the program after the
    passes. ``trace`` contains a report of each pass. ``kernel`` contains the statements of the step.
    """

    lowered: Program
    program: Program
    trace: tuple[PassReport, ...]
    kernel: Kernel


def array_method(scene: Problem, method: Method) -> ArrayMethod:
    """Compile ``method`` for ``scene``.

    MethodError is raised if the method has implicit stages, or if one of its operations is not available for
    large matrices.
    """
    return compiled(scene, method, _model(not scene.autonomous), array_kernel, refused)


def compiled(
    scene: Problem,
    method: Method,
    model: Problem,
    kernel: Callable[[Program, Problem], Kernel],
    refusal: Callable[[Problem, str, str], MethodError],
) -> ArrayMethod:
    """Compile ``method`` for ``scene``. The small problem ``model`` is used to verify each compiler pass.

    The function ``refusal`` returns the error that is raised for a method with implicit stages.
    """
    lowered = lower(model, method)
    # ``blocks.run`` replaces explicit stages by assignments, so all other statements are implicit stages.
    if any(not isinstance(statement, Assign) for statement in blocks.run(lowered).body):
        expected = "an explicit method for a scene with large matrices"
        raise refusal(scene, f"{method.label} has implicit stages", expected)
    program, trace = optimise(lowered, model)
    return ArrayMethod(lowered, program, trace, kernel(program, scene))


@cache
def _model(timed: bool) -> Problem:
    """Return the small problem on the sphere that is used to verify the compiler passes."""
    from sympy import Matrix as Column
    from sympy import Rational, Symbol, symbols

    x, y, z = point = symbols("x y z", real=True)
    t = Symbol(TIME) if timed else Rational(1, 3)
    # The field has no symmetry, because a symmetric field might hide an error of a compiler pass.
    field_on_sphere = Column([y * z + t / 2, x - z * Rational(1, 3), x * y + Rational(1, 5)])
    start = Column([1, 0, 0])
    return FieldScene(group=SO3(), action=Rotation(), y=point, f=field_on_sphere, y0=start, span=(0, 1))


def array_kernel(program: Program, scene: Problem) -> Kernel:
    """Return the kernel of ``program`` on ``scene``. The field of the scene must be given by matrix formulas.

    MethodError is raised if the program has implicit stages, or if one of its operations is not available for
    large matrices.
    """
    assert scene.matrices is not None
    step = _Builder(program, scene, scene.matrices).step()
    (block,) = scene.state
    n, k = scene.matrices.rows, scene.matrices.columns
    about = f"point of the manifold: a {n} x {k} matrix with orthonormal columns, stored row by row"
    state = (StateBlock(block.name, block.symbols, about),)
    # The statements of the step compute the error estimate as an array, so ``Estimate`` contains no scalar
    # expressions. The caller replaces the order 0 by the order of the estimate.
    estimate = None if step.error is None else Estimate((), 0)
    return Kernel(program.name, state, (TIME, "h", *scene.runtime), (), (), estimate=estimate, arrays=step)


@dataclass
class _Builder:
    """Collects the statements of one step.

    The matrix B is called the basis of the step (:mod:`codegen.ir.array_step`). An element of the algebra has
    the form B S B^T, where the matrix S is called its core. A point has the form X_0 + B D with the old state
    X_0 and the displacement D. If S or D has only m rows, B denotes the first m columns of the basis.
    """

    program: Program
    scene: Problem
    matrices: MatrixField
    domain: ExprDomain = field(default_factory=ExprDomain)
    body: list[StepStatement] = field(default_factory=list)
    cores: dict[Var, Matrix] = field(default_factory=dict)
    points: dict[Var, Matrix | None] = field(default_factory=dict)
    times: dict[Var, Expr] = field(default_factory=dict)
    blocks: int = 1

    def __post_init__(self) -> None:
        count = sum(isinstance(a.operation, Field) for a in self.program.assigns())
        n, k = self.matrices.rows, self.matrices.columns
        # The basis has k columns for the old state, and k columns for each evaluation of the field.
        self.k, width = k, k * (1 + count)
        self.argument = Matrix(STATE, n, k)
        self.basis, self.gram = Matrix(BASIS, n, width), Matrix(GRAM, width, width)
        self.one = self.domain.space.one

    def step(self) -> ArrayStep:
        """Return the step of the program as a sequence of statements whose operands are arrays."""
        # The first block of the basis is the old state X_0, and its Gram matrix is X_0^T X_0.
        first = self.basis.part(0, 0, self.matrices.rows, self.k)
        self.sum(first, (self.one, self.argument))
        self.body.append(Multiplication(self.gram.part(0, 0, self.k, self.k), first, first, True))
        # The inputs of the program are the state, and the time t if the field depends on t.
        for var in self.program.inputs:
            if var.kind is Kind.REAL:
                self.times[var] = self.domain.space.sym(var.name)
            else:
                # The displacement of the old state X_0 is zero, which is stored as None.
                self.points[var] = None
        for statement in self.program.body:
            if not isinstance(statement, Assign):
                raise refused(
                    self.scene, f"the method has implicit equations ({statement.label})", "an explicit method"
                )
            self.run(statement)
        outputs = dict(self.program.outputs)
        embedded = outputs.pop(EMBEDDED, None)
        # After the embedded solution is removed, the only output is the new state, a single matrix.
        (end,) = outputs.values()
        n, new = self.matrices.rows, self.points[end]
        result = Matrix(NEW, n, self.k)
        self.displaced(result, new)
        body = tuple(self.body)
        lower = None if embedded is None else self.points[embedded]
        # Without an embedded solution, the step has no error estimate.
        if new is None or lower is None:
            return ArrayStep(self.argument, body, result)
        # The formula B (D_1 - D_2) has smaller rounding errors than the difference of X_0 + B D_1 and
        # X_0 + B D_2.
        rows = max(new.rows, lower.rows)
        difference, error = Matrix("difference", rows, self.k), Matrix(ERROR, n, self.k)
        terms = (Term(self.one, new), Term(-self.one, lower))
        product = Multiplication(error, self.basis.part(0, 0, n, rows), difference)
        return ArrayStep(self.argument, body, result, (Combination(difference, terms), product), error)

    def run(self, assign: Assign) -> None:
        """Append the matrix statements that execute one assignment of the program."""
        operation, args = assign.operation, assign.args
        (target,) = assign.targets
        match operation:
            case Field():
                self.cores[target] = self.evaluated(target, args[0], *args[1:])
            case Linear():
                terms = [(c.evaluate(self.domain), self.cores[a]) for c, a in assign.terms]
                self.cores[target] = self.combination(target.name, terms)
            case Zero():
                self.cores[target] = self.combination(target.name, [])
            case Bracket(dual=False):
                self.cores[target] = self.bracket(target.name, self.cores[args[0]], self.cores[args[1]])
            case InverseDexp(dual=False, order=order):
                self.cores[target] = self.inverse(
                    target.name, self.cores[args[0]], self.cores[args[1]], order
                )
            # The statement ``Move`` computes the exponential, so only its argument is stored here.
            case Exp():
                self.cores[target] = self.cores[args[0]]
            case Act() | ActExp():
                self.points[target] = self.moved(target.name, self.cores[args[0]], self.points[args[1]])
            case Advance(coefficient=c):
                self.times[target] = self.times[args[0]] + c.evaluate(self.domain)
            case _:
                what = f"the operation {operation.name} is not available for large matrices"
                raise refused(self.scene, what, "another method")

    def sum(self, target: Matrix, *terms: tuple[Expr, Matrix]) -> Matrix:
        """Append an assignment to ``target``, and return ``target``.

        For the pairs (c_1, M_1), (c_2, M_2), ... in ``terms``, the value is c_1 M_1 + c_2 M_2 + ....
        """
        self.body.append(Combination(target, tuple(Term(c, m) for c, m in terms)))
        return target

    def displaced(self, target: Matrix, displacement: Matrix | None) -> None:
        """Append the assignment ``target`` = X_0 + B D, where X_0 is the state at the beginning of the step.

        D is the matrix ``displacement``, or zero if ``displacement`` is None. If D has m rows, B consists of
        the first m columns of the matrix ``self.basis``.
        """
        self.sum(target, (self.one, self.argument))
        if displacement is not None:
            columns = self.basis.part(0, 0, self.matrices.rows, displacement.rows)
            self.body.append(Multiplication(target, columns, displacement, added=True))

    def evaluated(self, target: Var, point: Var, *time: Var) -> Matrix:
        """Append statements that compute a matrix S, and return S.

        Let B be the matrix ``self.basis``. The vector field has the value B S B^T at ``point``.
        """
        n, k, name = self.matrices.rows, self.k, target.name
        displacement, x = self.points[point], self.argument
        if displacement is not None:
            x = Matrix(f"{name} point", n, k)
            self.displaced(x, displacement)
        # The statements of ``matrices.program`` write the value of the field to ``w``.
        first = k * self.blocks
        w = self.basis.part(0, first, n, k)
        # If the field does not depend on time, the program has no time variable, and t is set to 0.
        t = self.times[time[0]] if time else self.domain.rational(0)
        self.body += [self.at_time(s, t, name) for s in self.matrices.program.moved(x, w, name)]
        # Let V be the value of the vector field at the point X. The matrix ``products`` is X^T V.
        products, halved = Matrix(f"{name} gram", k, k), Matrix(f"{name} correction", k, k)
        self.body.append(Multiplication(products, x, w, True))
        # Let V be the value of the vector field at the point X. The next two statements compute the matrix
        # W = V - X (X^T V)/2. Since X^T X is the unit matrix and X^T V is skew-symmetric, the matrix
        # W X^T - X W^T maps X to V.
        self.sum(halved, (self.domain.rational(-1, 2), products))
        self.body.append(Multiplication(w, x, halved, added=True))
        self.blocks += 1
        # The next statement computes the new block column B^T W of the Gram matrix B^T B.
        known = self.basis.part(0, 0, n, first + k)
        self.body.append(Multiplication(self.gram.part(0, first, first + k, k), known, w, True))
        # The Gram matrix is symmetric, so the new block row is the transpose of the new block column.
        above = Term(self.one, self.gram.part(0, first, first, k), True)
        self.body.append(Combination(self.gram.part(first, 0, k, first), (above,)))
        return self.core(name, displacement, first)

    def core(self, name: str, displacement: Matrix | None, first: int) -> Matrix:
        """Append statements that compute the matrix S defined below, and return S.

        - B consists of the first n columns of the matrix ``self.basis``, where n = ``first`` + k and
          k = ``self.k``. The first k columns of B are the state X_0 at the beginning of the step.
        - W consists of the last k columns of B.
        - D is the matrix ``displacement``, or zero if ``displacement`` is None. If D has fewer than n rows,
          the missing rows are zero.
        - X is the matrix X_0 + B D.
        - S is a matrix with n rows and n columns, and B S B^T = W X^T - X W^T.
        """
        k = self.k
        # ``self.sum`` without terms sets all entries of the matrix ``core`` to zero.
        core = self.sum(Matrix(name, first + k, first + k))
        # If ``displacement`` is None, ``below`` and ``right`` are the only nonzero blocks of ``core``.
        below, right = core.part(first, 0, k, k), core.part(0, first, k, k)
        if displacement is not None:
            m = displacement.rows
            # D contributes two separate blocks: D^T in the last k rows, and -D in the last k columns.
            turned = Term(self.one, displacement, True)
            self.body.append(Combination(core.part(first, 0, k, m), (turned,)))
            self.sum(core.part(0, first, m, k), (-self.one, displacement))
        # The unit matrix is added to ``below`` and subtracted from ``right``.
        self.body += [AddUnit(below, 1), AddUnit(right, -1)]
        return core

    def at_time(self, statement: ArrayStatement, t: Expr, name: str) -> ArrayStatement:
        """Return ``statement`` at the time ``t``. The values of the fixed parameters are inserted, too."""
        values = {**self.scene.scalars(self.domain, t)}
        # ROW and COLUMN must remain symbols, because the emitted loops use these variables.
        values |= {index: self.domain.space.sym(index) for index in (ROW, COLUMN)}

        def now(root: Expr) -> Expr:
            (value,) = evaluate([root], self.domain, values)
            assert isinstance(value, Expr)
            return value

        match statement:
            case Combination(terms=terms):
                moved = tuple(replace(term, coefficient=now(term.coefficient)) for term in terms)
                return replace(statement, terms=moved)
            case Apply(constant=constant):

                def entry(given: Entry) -> Entry:
                    return given if isinstance(given, tuple) else now(given)

                diagonals = tuple(replace(d, entry=entry(d.entry)) for d in constant.diagonals)
                return replace(
                    statement, constant=replace(constant, diagonals=diagonals, full=entry(constant.full))
                )
            case _:
                return statement

    def combination(self, name: str, terms: list[tuple[Expr, Matrix]]) -> Matrix:
        """Append the computation of a linear combination of the matrices in ``terms``, and return the result.

        Smaller matrices are extended by zeros to the size of the largest matrix.
        """
        # A matrix S with m rows represents B S B^T, where B consists of the first m columns of the basis. If
        # m is less than ``size``, ``self.sum`` extends S by zeros. The zeros are coefficients of the other
        # columns of the basis, so the represented matrix does not change.
        size = max([m.rows for _, m in terms], default=self.k)
        return self.sum(Matrix(name, size, size), *terms)

    def bracket(self, name: str, x: Matrix, y: Matrix) -> Matrix:
        """Append statements that compute a matrix S, and return S.

        Let B be the matrix ``self.basis``. The matrices x and y are skew-symmetric, and S is N - N^T, where
        N = x B^T B y. The matrix B S B^T is the bracket of the matrices B x B^T and B y B^T.
        """
        right, product = Matrix(f"{name} right", x.rows, y.rows), Matrix(f"{name} product", x.rows, y.rows)
        # The sizes of x, G and y do not depend on the number of rows of the state, so x G y is cheap.
        self.body.append(Multiplication(right, self.gram.part(0, 0, x.rows, y.rows), y))
        self.body.append(Multiplication(product, x, right))
        size = max(x.rows, y.rows)
        # The Gram matrix G is symmetric, and the matrices x and y are skew-symmetric. Therefore the transpose
        # of x G y is y G x.
        terms = (Term(self.one, product), Term(-self.one, product, True))
        core = Matrix(name, size, size)
        self.body.append(Combination(core, terms))
        return core

    def inverse(self, name: str, x: Matrix, y: Matrix, order: int) -> Matrix:
        """Append statements that compute dexp^{-1}_x y by its series, and return the result.

        The series is truncated after the term with ``order`` nested brackets. Let B be the matrix
        ``self.basis``. The element B x B^T of the Lie algebra is represented by the matrix x. In the same
        way, the matrix y and the returned matrix represent elements of the Lie algebra.
        """
        terms, power = [(self.one, y)], y
        # With the Bernoulli numbers B_k, dexp^{-1}_x y is y + B_1/1! [x, y] + B_2/2! [x, [x, y]] + ....
        for k in range(1, last_term(order) + 1):
            power = self.bracket(f"{name} bracket {k}", x, power)
            b = bernoulli_over_factorial(k)
            # The Bernoulli numbers B_3, B_5, ... are zero, so their terms are omitted.
            if b:
                terms.append((self.domain.rational(b.numerator, b.denominator), power))
        return self.combination(name, terms)

    def moved(self, name: str, core: Matrix, start: Matrix | None) -> Matrix:
        """Append a statement that computes the matrix D' with exp(B S B^T) X = X_0 + B D', and return D'.

        Here X_0 is the state at the beginning of the step, B is the matrix ``self.basis``, and S is ``core``.
        ``start`` is the matrix D with X = X_0 + B D, or None if X = X_0.
        """
        rows = core.rows if start is None else max(core.rows, start.rows)
        target = Matrix(name, rows, self.k)
        self.body.append(Move(target, core, self.gram, start))
        return target
