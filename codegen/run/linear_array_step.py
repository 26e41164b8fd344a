"""The emitted functions for a step of a large linear problem y' = A(t) y.

A step multiplies the vector y by exponentials exp(X) of matrices X (:mod:`codegen.ir.linear_array_step`). In
this module, the norm of a matrix is the largest row sum of absolute values. First X is halved s times, until
its norm is small. Then y is multiplied 2^s times by a Taylor polynomial of exp(2^-s X) (A. H. Al-Mohy and
N. J. Higham, SIAM J. Sci. Comput. 33 (2011) 488). The truncation error of the polynomial, relative to y, is
about 2^-10 times the unit roundoff (:mod:`codegen.ir.exponential_action`).

If X contains commutators, an upper bound of its norm is used. The upper bound of a commutator Y Z - Z Y is
twice the product of the upper bounds of Y and Z.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from codegen.ir.exponential_action import degrees, largest_norms
from codegen.ir.expr import Space
from codegen.ir.linear_array_step import Element, LinearArrayStep
from codegen.ir.number import Number
from codegen.ir.precision import Precision
from codegen.run.array_loops import tables
from codegen.run.language import (
    RAISES_STATUS,
    Array,
    Assign,
    Call,
    For,
    Function,
    If,
    Return,
    Statement,
    Table,
    While,
)
from codegen.run.plan import STEP, TIME, Plan
from codegen.run.step import ADVANCE
from codegen.run.stored_matrix import PRODUCT, ROW_SUM, VALUE, StoredMatrix, stored_matrix
from codegen.run.terms import (
    BAD_STEP,
    NOT_FINITE,
    OK,
    STATUS,
    TOO_FAR,
    Kind,
    Term,
    all_finite,
    both,
    code,
    count,
    is_finite,
    negated,
    number,
    own,
    real,
    select,
    value,
    whole,
)

HALVINGS = 16
"""The largest integer s for which exp(X) is computed as the product of 2^s factors exp(X/2^s).

For s = 16, the exponential of a tridiagonal matrix with 1000 rows takes seconds. If a step
needs a larger s, the step fails with the status TOO_FAR.
"""

EXPONENTIAL = "exponential"
"""The name of the function that computes state = exp(X) state.

The matrix X is a linear combination of the matrices h A(t_i), where t_i are times in the step.
"""

_PLACE, _PART = count("place"), count("part")


def linear_array_functions(plan: Plan, step: LinearArrayStep) -> tuple[Function, ...]:
    """Return the emitted functions for a step. Each function comes after the functions that it calls."""
    return _Step(plan, step).functions()


def linear_array_tables(step: LinearArrayStep, precision: Precision) -> tuple[Table, ...]:
    """Return the emitted tables that contain the constant matrices of a step."""
    return tuple(tables(step.matrix.constants(), precision))


@dataclass
class _Step:
    """Builds the emitted functions of one step.

    A letter is a linear combination of matrices h A(t_i). The times t_i are in the step. An element is a
    linear combination of letters and of commutators [X, Y], where X and Y are elements.
    """

    plan: Plan
    step: LinearArrayStep

    def __post_init__(self) -> None:
        step = self.step
        self.size = step.argument.size
        self.stored: StoredMatrix = stored_matrix(step.matrix, step.argument.columns, len(step.times))
        # An element that contains commutators has its own function.
        self.elements: list[Element] = []
        for pair in step.commutators:
            self.elements += [e for e in pair if e.commutators and e not in self.elements]
        self.exponents: list[Element] = []
        for e in step.exponents:
            if e.commutators and e not in self.exponents:
                self.exponents.append(e)

    def functions(self) -> tuple[Function, ...]:
        """Return all functions of the step. Each function comes after the functions that it calls."""
        listed = self.stored.functions(self.plan.moment(), self.plan.parameters)
        done: set[int] = set()
        # The function for a commutator [X, Y] calls the functions for X and Y, so these come first.
        for number_of, pair in enumerate(self.step.commutators):
            listed += [self.element(e, done) for e in pair if e.commutators and id(e) not in done]
            listed.append(self.commutator(number_of))
        listed += [self.element(e, done) for e in self.exponents if e not in self.elements]
        if any(not e.commutators for e in self.step.exponents):
            # An exponent without commutators is stored as one matrix. The function EXPONENTIAL has the matrix
            # as an argument, so EXPONENTIAL is enough for all exponents without commutators.
            listed.append(self.exponential(Element(0), EXPONENTIAL))
        # Each ``e`` in ``self.exponents`` contains commutators. The matrix ``e`` is not stored, so it cannot
        # be an argument of the function EXPONENTIAL. Therefore each ``e`` has a separate function.
        for k, e in enumerate(self.exponents, 1):
            listed.append(self.exponential(e, f"{EXPONENTIAL}_{k}"))
        # If several functions have the same name, ``_unique`` keeps only the first one.
        return (*_unique(listed), self.advance())

    def letter(self, number_of: int) -> Term:
        """Return the emitted array that contains the matrix ``step.letters[number_of]``.

        This matrix is a linear combination of the matrices h A(t_i). It is called a letter.
        """
        return real(f"letter_{number_of + 1}", self.stored.letter_size)

    def letters(self, element: Element) -> tuple[Term, ...]:
        """Return the array of each letter in ``element``, in the order of ``step.letters``.

        Letters in commutators are included.
        """
        return tuple(map(self.letter, sorted(self._letters(element))))

    def _letters(self, element: Element) -> set[int]:
        # A commutator may contain other commutators, so its letters are collected recursively.
        numbers = set() if element.letter is None else {element.letter}
        for _, number_of in element.commutators:
            for part in self.step.commutators[number_of]:
                numbers |= self._letters(part)
        return numbers

    def name(self, element: Element) -> str:
        """Return the name of the function that multiplies a vector by ``element``."""
        # The functions are numbered in the order in which they are emitted.
        known = [*self.elements, *(e for e in self.exponents if e not in self.elements)]
        return f"element_{1 + known.index(element)}"

    def applied(self, element: Element, x: Term, y: Term) -> Call:
        """Return the statement that computes y = X x, where the matrix X is ``element``."""
        if element.commutators:
            return Call(self.name(element), (*self.letters(element), x, y))
        assert element.letter is not None
        return Call(PRODUCT, (self.letter(element.letter), x, y))

    def element(self, element: Element, done: set[int]) -> Function:
        """Return the function that computes result = X x, where the matrix X is ``element``.

        If the function of an element e exists, ``done`` contains ``id(e)``. ``id(element)`` is added to
        ``done``.
        """
        done.add(id(element))
        x, y, work = (self.stored.vector(name) for name in ("x", "result", "work"))
        body: list[Statement] = [Array(work)]
        # The first term of the sum is assigned to the result, and later terms are added to the result.
        first = element.letter is None
        if element.letter is not None:
            body.append(Call(PRODUCT, (self.letter(element.letter), x, y)))
        for c, number_of in element.commutators:
            letters = self.letters(Element(None, ((c, number_of),)))
            body.append(Call(_commutator(number_of), (*letters, x, work)))
            # No multiplication is emitted for the coefficient 1.
            term = work[_PLACE] if c.is_one else _constant(c) * work[_PLACE]
            body.append(self.over(y, term if first else y[_PLACE] + term))
            first = False
        about = f"result = X x for X = {self.text(element)}."
        return Function(self.name(element), about, (*self.letters(element), x, y), tuple(body))

    def commutator(self, number_of: int) -> Function:
        """Return the function that multiplies a vector x by a commutator: result = X (Y x) - Y (X x).

        The pair (X, Y) is ``step.commutators[number_of]``.
        """
        left, right = self.step.commutators[number_of]
        # The emitted function needs each letter (a matrix) that occurs in X or Y. These are the letters of
        # the commutator [X, Y], which is an ``Element`` with one term and the coefficient 1.
        own_letters = self.letters(Element(None, ((Number.rational(1), number_of),)))
        x, y, first, second = (self.stored.vector(name) for name in ("x", "result", "first", "second"))
        body: tuple[Statement, ...] = (
            *map(Array, (first, second)),
            # A product cannot overwrite the vector that it reads, so the work array ``first`` is needed.
            self.applied(right, x, first),
            self.applied(left, first, y),
            self.applied(left, x, first),
            self.applied(right, first, second),
            self.over(y, y[_PLACE] - second[_PLACE]),
        )
        about = f"result = [X, Y] x for X = {self.text(left)} and Y = {self.text(right)}."
        return Function(_commutator(number_of), about, (*own_letters, x, y), body)

    def text(self, element: Element) -> str:
        """Return an element as text for comments in the emitted code."""
        parts = [] if element.letter is None else [f"letter_{element.letter + 1}"]
        # The text is only a comment, so six digits of a coefficient are enough.
        parts += [f"{float(c):.6g} {_commutator(k)}" for c, k in element.commutators]
        return " + ".join(parts)

    def over(self, y: Term, entry: Term) -> For:
        """Return the loop over the index ``_PLACE`` that assigns ``entry`` to ``y[_PLACE]``."""
        return For(_PLACE, whole(self.size), (Assign(y[_PLACE], entry),))

    def exponential(self, element: Element, name: str) -> Function:
        """Return the function that computes state = exp(X) state, where the matrix X is ``element``."""
        state, p, work = (self.stored.vector(n) for n in ("state", "p", "work"))
        matrix = real("a", self.stored.letter_size)
        given = self.letters(element) if element.commutators else (matrix,)
        norm, scale, weight = real("norm"), real("scale"), real("weight")
        parts, degree, factor = count("parts"), real("degree"), real("factor")
        precision = self.plan.format
        sizes, bounds = degrees(precision.bits), largest_norms(precision.bits)
        # If the norm is at most ``bounds[k]``, a Taylor polynomial of degree ``sizes[k]`` is accurate enough.
        chosen = number(float(sizes[-1]))
        for m, bound in reversed(list(zip(sizes[:-1], bounds[:-1], strict=True))):
            chosen = select(norm > bound, chosen, number(float(m)))
        applied = self.applied(element, p, work) if element.commutators else Call(PRODUCT, (matrix, p, work))
        # The rounding errors of the coefficients 1/j! would accumulate over many steps. Therefore the Taylor
        # polynomial is multiplied by the factorial of its degree, so all coefficients are exact integers.
        horner = (
            Assign(weight, weight * factor),
            Assign(factor, factor - 1.0),
            applied,
            self.over(p, scale * work[_PLACE] + weight * state[_PLACE]),
        )
        part = (
            Assign(p, state),
            Assign(weight, number(1.0)),
            Assign(factor, degree),
            While(factor > 1.0, horner),
            # After the loop, ``weight`` is the factorial of ``degree``.
            self.over(p, p[_PLACE] / weight),
            applied,
            self.over(state, state[_PLACE] + scale * work[_PLACE]),
        )
        norms = self.norms(element) if element.commutators else (Call(ROW_SUM, (matrix,), (norm,)),)
        halved = (Assign(scale, number(0.5) * scale), Assign(parts, parts * 2))
        body: tuple[Statement, ...] = (
            *map(Array, (p, work)),
            *norms,
            # Halving X cannot make an infinite norm finite.
            If(negated(is_finite(norm)), (Return(code(NOT_FINITE)),)),
            # The ``While`` loop computes the integer ``parts``. The ``For`` loop has ``parts`` iterations,
            # and each iteration multiplies the state by exp(X/``parts``). The number ``scale`` is
            # 1/``parts``.
            Assign(scale, number(1.0)),
            Assign(parts, whole(1)),
            While(both(norm * scale > bounds[-1], parts < 2**HALVINGS), halved),
            Assign(norm, norm * scale),
            If(norm > bounds[-1], (Return(code(TOO_FAR)),)),
            Assign(degree, chosen),
            For(_PART, parts, part),
            Return(code(OK)),
        )
        what = self.text(element) if element.commutators else "a"
        about = (
            f"Multiply the state by exp(X) for X = {what}. The integer 'parts' is chosen such that the norm "
            "of X/parts is small. Then the state is multiplied 'parts' times by a Taylor polynomial of "
            "exp(X/parts)."
        )
        return Function(name, about, (*given, state), body, Kind.STATUS)

    def norms(self, element: Element) -> tuple[Statement, ...]:
        """Return the statements that compute ``norm``.

        ``norm`` is an upper bound of the largest row sum of absolute values in the matrix ``element``.
        """
        body: list[Statement] = []
        bounds: dict[int, Term] = {}
        # Sorting gives the emitted statements a fixed order.
        for k in sorted(self._letters(element)):
            body.append(Call(ROW_SUM, (self.letter(k),), (real(f"norm_{k + 1}"),)))

        def bound(e: Element) -> Term:
            total = None if e.letter is None else real(f"norm_{e.letter + 1}")
            for c, k in e.commutators:
                term = commutator(k) if c.is_one else abs(float(c)) * commutator(k)
                total = term if total is None else total + term
            assert total is not None
            return total

        def commutator(k: int) -> Term:
            # A commutator may occur several times, but its bound is computed only once.
            if k not in bounds:
                x, y = map(bound, self.step.commutators[k])
                bounds[k] = real(f"bound_{k + 1}")
                # The norm of X Y - Y X is at most twice the product of the norms of X and Y.
                body.append(Assign(bounds[k], 2.0 * x * y))
            return bounds[k]

        total = bound(element)
        return (*body, Assign(real("norm"), total))

    def advance(self) -> Function:
        """Return the function that makes one step."""
        plan, step, state = self.plan, self.step, self.plan.state()
        new = self.stored.vector("new")
        nodes = [real(f"node_{k + 1}", self.stored.node_size) for k in range(len(step.times))]
        letters = [self.letter(k) for k in range(len(step.letters))]
        body: list[Statement] = [
            If(negated(is_finite(STEP)), (Return(code(BAD_STEP)),)),
            # In the array of a banded matrix, unused entries must be zero, because the row sums read these
            # entries.
            *(Array(node, zero=True) for node in nodes),
            *map(Array, (*letters, new)),
        ]
        for k, (time, node) in enumerate(zip(step.times, nodes, strict=True)):
            # Names in the kernel contain no spaces, so the space in this name prevents a conflict.
            at = own(f"time {k + 1}")
            # If the matrix does not depend on t, the time t_i is not computed.
            body += [Assign(at, value(time))] if plan.time else []
            # The matrix is evaluated at t_i, so t_i replaces t in the arguments of VALUE.
            moment = tuple(at if x.text == TIME.text else x for x in plan.moment())
            arguments = (*(x for x in moment if self.takes(x)), *plan.parameters, node)
            body.append(Call(VALUE, arguments))
        for target, letter in zip(letters, step.letters, strict=True):
            body += self.stored.letter(target, nodes, letter)
        # The exponentials multiply a copy of the state, so a failure leaves the state unchanged.
        body.append(Assign(new, state))
        for e in step.exponents:
            body += [self.moved(e, new), If(STATUS.differs(code(OK)), (Return(STATUS),))]
        body += [
            If(negated(all_finite(new)), (Return(code(NOT_FINITE)),)),
            Assign(state, new),
            Return(code(OK)),
        ]
        parameters = (state, *plan.moment(), *plan.parameters)
        return Function(ADVANCE, "One step.", parameters, tuple(body), Kind.STATUS, RAISES_STATUS, often=True)

    def takes(self, x: Term) -> bool:
        """Return True if the function that evaluates the matrix A(t) has the argument ``x``.

        ``x`` is the time t or the step size h.
        """
        # The function for a full matrix does not have the argument h.
        return x is not STEP or self.step.matrix.is_banded

    def moved(self, element: Element, state: Term) -> Call:
        """Return the statement that computes state = exp(X) state, where the matrix X is ``element``."""
        if not element.commutators:
            assert element.letter is not None
            return Call(EXPONENTIAL, (self.letter(element.letter), state), (STATUS,))
        name = f"{EXPONENTIAL}_{1 + self.exponents.index(element)}"
        return Call(name, (*self.letters(element), state), (STATUS,))


def _commutator(number_of: int) -> str:
    return f"commutator_{number_of + 1}"


def _constant(c: Number) -> Term:
    return value(Space().const(c))


def _unique(functions: Sequence[Function]) -> Iterator[Function]:
    """Yield the functions in order, but only the first of several functions with the same name."""
    seen: set[str] = set()
    for function in functions:
        if function.name not in seen:
            seen.add(function.name)
            yield function
