"""Checks of declared invariants whose formulas contain selections.

A selection is an operation with several cases. For example, abs(x) is x or -x. If the argument of a selection
is constant along solutions, the case of the selection never changes. If the case may change, two conditions
are checked:

- The invariant is continuous where the case changes.
- If every selection in the invariant and in the field is replaced by one of its cases, for example abs(x) by
  -x, the invariant is constant along the solutions. All possible combinations of cases are checked.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.normal_form import Monomial, NormalForms, TooLong
from codegen.ir.rounding_domain import Sized
from codegen.ir.selection import SELECTING
from codegen.ir.smoothness import MOST_CASES, argument_text, combinations, on_sides, selections
from codegen.ir.table import PiecewisePolynomial
from codegen.scene.orbit import Orbit
from codegen.scene.problem import TIME, Problem

if TYPE_CHECKING:
    import mpmath

NEWTON_STEPS = 60
"""The largest number of Newton steps to a zero. A simple zero takes about ten steps for 40 digits."""

BESIDE = Fraction(1, 10**26)
"""The distance between a test point and a zero of x, where x is the argument of an operation with two cases,
for example abs(x). One test point is on each side of the zero. If an invariant has a jump at the zero, the
values of the invariant at the two test points are different.

The distance is much larger than the rounding errors of arithmetic with 40 digits. Between the two points, a
continuous function usually changes by much less than :data:`codegen.scene.orbit.TOLERANCE`.
"""


def check_cases(orbit: Orbit, problem: Problem) -> None:
    """Raise :class:`SceneError` if a declared invariant changes along a solution.

    Only invariants whose formulas contain abs(x) or another operation with several cases are checked here. A
    Hamiltonian is not checked, because the field is derived from the Hamiltonian.
    """
    for name, declared in problem.invariants.items():
        if declared is problem.hamiltonian or not selections([declared]):
            continue
        domain = ExprDomain()
        state = tuple(domain.space.sym(s) for s in problem.symbols)
        time = domain.space.sym(TIME)
        check = _Check(orbit, name, problem.velocity(domain, state, time))
        check.run(problem.invariant(domain, name, state, time))


class _Check:
    """The check of one invariant. ``velocity`` are the time derivatives of the coordinates."""

    def __init__(self, orbit: Orbit, name: str, velocity: Sequence[Expr]) -> None:
        self.orbit, self.name, self.velocity = orbit, name, tuple(velocity)
        self.symbols = (*orbit.symbols, TIME)

    def run(self, root: Expr) -> None:
        # Only selections whose arguments have a nonzero derivative along solutions are tested. For example,
        # the argument of abs in abs(choose(y, 1, -1)) is 1 or -1, and jumps only at y = 0. There the
        # selection choose(y, 1, -1) is tested, so abs needs no test.
        changing = [n for n in selections([root]) if not self.constant(n.args[0], self.velocity)]
        if not changing:
            return
        for node in changing:
            self.check_continuous(root, node)
        nodes = selections((*self.velocity, root))
        cases = combinations(nodes)
        if cases is None:
            raise self.error(f"has more than {MOST_CASES} combinations of cases")
        for sides in cases:
            formulas, margins = on_sides((*self.velocity, root), nodes, sides)
            if _contradictory(margins):
                continue  # No state has this combination of cases.
            if not self.constant(formulas[-1], formulas[:-1]):
                raise self.error("changes along solutions in one of its cases")

    def constant(self, root: Expr, velocity: Sequence[Expr]) -> bool:
        """Return True if the derivative of ``root`` along the solutions is zero at all sample points."""
        slopes = gradient(root, self.symbols)
        for point in self.orbit.points:
            values = self.orbit.values((*slopes, *velocity), point)
            if values is None:
                continue
            rates = (*values[len(slopes) :], self.orbit.domain.rational(1))
            terms = [a * b for a, b in zip(values, rates, strict=False)]
            if not self.orbit.sized(sum(terms[1:], terms[0]), terms):
                return False
        return True

    def check_continuous(self, root: Expr, node: Expr) -> None:
        """Raise SceneError if ``root`` is discontinuous where ``node`` switches from one case to another.

        ``node`` is abs(x) or another operation with several cases.
        """
        x = node.args[0]
        table = node.payload
        if isinstance(table, PiecewisePolynomial):
            if not all(_joined(table, k) for k in range(len(table.knots))):
                raise self.error("contains a table with jumps")
            return
        # A constant never changes its sign, so constants are omitted. At least one formula is not constant,
        # because ``run`` calls this method only if ``x`` changes along solutions.
        formulas = [f for f in _formulas(x) if f.op != "const"]
        compared = False
        usual = [v[0] for point in self.orbit.points if (v := self.orbit.values((root,), point)) is not None]
        for point, formula in product(self.orbit.points, formulas):
            sides = self.beside(formula, point)
            values = [self.orbit.values((root, x), place) for place in sides]
            pairs = [v for v in values if v is not None]
            # ``node`` switches where its argument ``x`` changes its sign. The two points in ``sides`` are on
            # the two sides of a zero of ``formula``. If ``x`` has the same sign at the two points, the points
            # are skipped. For example, let x = choose(y, f, g), and let ``formula`` be f. Where y <= 0, x
            # equals g, and g usually has the same sign at the two points.
            if len(pairs) < 2 or (formula is not x and (pairs[0][1].value > 0) == (pairs[1][1].value > 0)):
                continue
            compared = True
            # The two points are not equal, so the values differ slightly even if there is no jump. The
            # difference is small compared with the usual values of the invariant.
            if not self.orbit.sized(pairs[0][0] - pairs[1][0], (pairs[0][0], pairs[1][0], *usual)):
                raise self.error(f"jumps where {argument_text(node)} = 0")
        if not compared:
            raise self.error(f"cannot be tested for a jump where {argument_text(node)} = 0")

    def beside(self, x: Expr, start: dict[str, Sized]) -> list[dict[str, Sized]]:
        """Return two points on the two sides of a zero of ``x``, or nothing if Newton's method fails."""
        point, formulas = dict(start), (x, *gradient(x, self.symbols))
        distance = self.orbit.domain.rational(*BESIDE.as_integer_ratio()).value
        for _ in range(NEWTON_STEPS):
            numbers = self.orbit.values(formulas, point)
            value, *slopes = [n.value for n in numbers or (self.orbit.domain.rational(0),)]
            size = sum(s * s for s in slopes)
            if not size > 0:
                return []
            if abs(value) < distance * size**0.5 / 1000:
                steps = [distance * s / size**0.5 for s in slopes]
                return [self.moved(point, [sign * s for s in steps]) for sign in (1, -1)]
            point = self.moved(point, [-value * s / size for s in slopes])
        return []

    def moved(self, point: dict[str, Sized], steps: Sequence[mpmath.mpf]) -> dict[str, Sized]:
        return point | {s: point[s] + d for s, d in zip(self.symbols, steps, strict=True)}

    def error(self, what: str) -> SceneError:
        return SceneError(
            f"the invariant {self.name} {what}",
            where=self.orbit.name,
            expected="a function that is constant along the solutions",
            hint=f"correct the formula of {self.name}, or remove {self.name} from the invariants",
        )


def _formulas(x: Expr) -> list[Expr]:
    """Return the formulas between which ``x`` switches, for example b and c if ``x`` is choose(a, b, c).

    If ``x`` is no selection, the list is [``x``].

    >>> from codegen.ir.expr import Space
    >>> a, b, c = map(Space().sym, "abc")
    >>> [str(f) for f in _formulas(a.space.call("choose", a, b, a.space.call("fabs", c)))]
    ['b', 'c']
    """
    if x.op != "call" or x.payload not in SELECTING:
        return [x]
    # For choose(a, b, c), ``args[1:]`` is (b, c). For fabs(c), ``args[1:]`` is empty, so ``args`` = (c,) is
    # used. The value of fabs(c) is c or -c, but c is sufficient, because c and -c have the same zeros.
    return [f for arg in (x.args[1:] or x.args) for f in _formulas(arg)]


def _contradictory(margins: Sequence[Expr]) -> bool:
    """Return True if one of two tests proves that no state exists at which all margins are positive.

    - Is one margin a negative constant?
    - Are there two margins p and q, and a number c > 0, such that p + c*q is a constant <= 0? For example,
      p = x - 2 and q = 1 - x have the sum -1.

    If the result is False, a state at which all margins are positive may exist.
    """
    known: list[tuple[dict[Monomial, Fraction], Fraction]] = []
    for margin in margins:
        try:
            form = NormalForms(margin.space).polynomial(margin)
        except TooLong:
            continue
        if all(c.is_rational for c in form.values()):
            terms = {m: c.fraction() for m, c in form.items()}
            known.append(({m: c for m, c in terms.items() if m}, terms.get((), Fraction(0))))
    for k, (a, first) in enumerate(known):
        if not a and first < 0:
            return True
        for b, second in known[:k]:
            if a and a.keys() == b.keys():
                c = -a[next(iter(a))] / b[next(iter(a))]
                if c > 0 and all(a[m] == -c * b[m] for m in a) and first + c * second <= 0:
                    return True
    return False


def _joined(table: PiecewisePolynomial, k: int) -> bool:
    """Return True if the polynomials on both sides of the knot ``k`` have the same value there."""
    left, right = (
        sum((c * (table.knots[k] - table.bases[i]) ** j for j, c in enumerate(table.rows[i])), Fraction(0))
        for i in (k, k + 1)
    )
    return left == right
