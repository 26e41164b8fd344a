"""Certify a solution that was computed in double precision, and write it as a tableau file.

The free parameters of the solution are rounded to short decimals. Lattice reduction tries to find closed
forms of all other coefficients in one number field. If exact arithmetic does not prove the order, interval
arithmetic proves that a solution of the order conditions exists near the decimals in the file.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from flint import arb, arb_mat

from orderconds.checking import check, claimable_families
from orderconds.errors import ZeroWeight
from orderconds.proof.certificate import certify
from orderconds.proof.krawczyk import NotProved, jets
from orderconds.proof.refine import decimal_places
from orderconds.ring import Balls, Ring
from orderconds.ring.jets import Jets
from orderconds.ring.precision import precision
from orderconds.ring.traces import evaluate
from orderconds.solve.ansatz import Ansatz, renamed
from orderconds.solve.closed_form import ClosedForm, closed_forms
from orderconds.solve.least_squares import least_squares
from orderconds.solve.problem import Problem
from orderconds.solve.search import CHEAP, POLISHED
from orderconds.solve.tape import Floats
from orderconds.tableau import CommutatorFree, Method, Stage, Tableau, dumps
from orderconds.tableau.claims import Claims, OrderClaim
from orderconds.tableau.grammar import Constant
from orderconds.tableau.properties import properties
from orderconds.tableau.random_member import radicals
from orderconds.tableau.toml_text import toml_text
from orderconds.tableau.write import without_names

STEPS = (
    Fraction(1, 2),
    Fraction(1, 4),
    Fraction(1, 10),
    Fraction(1, 20),
    Fraction(1, 100),
    Fraction(1, 1000),
)
"""Rounding units, tried in this order. Coefficients that the order conditions do not determine are rounded to
multiples of a unit."""

FINE = (Fraction(1, 10**5), Fraction(1, 10**7))
"""The values that replace :data:`STEPS` if the search minimises the principal error."""

DIGITS = 50
"""A rounded coefficient in the tableau file has at least this number of decimal places."""

BITS = 1400
"""The working precision of Newton's method in bits, high enough for lattice reduction."""

ERROR = Fraction(1, 2**800)
"""A bound on the errors of the coefficients that Newton's method computes."""

WORSE = 1.5
"""Rounding must not increase the largest coefficient or the principal error by more than this factor."""


@dataclass(frozen=True)
class Solution:
    """A method with a proved order.

    - ``text``: the text of the tableau file
    - ``certificate``: ``exact`` if the order is proved in exact arithmetic, ``ball`` if it is proved in
      interval arithmetic
    - ``error``: the principal error, or None if it is not computed
    """

    tableau: Tableau
    text: str
    certificate: str
    error: float | None


def certify_solution(
    problem: Problem, point: Sequence[float], name: str, source: str, *, minimised: bool = False
) -> Solution:
    """Return a solution near ``point``, and prove its order.

    ``point`` contains values of the free coefficients of the ansatz. ``name`` and ``source`` are entries of
    the tableau file. Raises NotProved if the required order cannot be proved, or if a coefficient violates
    the option ``--size`` or ``--positive``.

    >>> from orderconds.solve.spec import Spec
    >>> from orderconds.solve.problem import find_problem
    >>> problem = find_problem("rk", 2, Spec(stages=2, explicit=True), "full")
    >>> solution = certify_solution(problem, [0.27, 0.73, 0.68], "two", "an example")
    >>> solution.certificate, solution.text.splitlines()[2:4]
    ('exact', ['A = [[], ["1"]]', 'b = ["1/2", "1/2"]'])
    """
    rounded, pinned, solved = _rounded_free(problem, np.array(point), FINE if minimised else STEPS)
    sharp = _newton(problem, rounded, pinned, solved)
    _require_bounds(problem, pinned, sharp)
    ansatz = renamed(problem.ansatz, name)
    forms: dict[str, ClosedForm] | None = None
    if not (minimised and pinned and solved):
        forms = closed_forms({problem.ansatz.free[j]: sharp[j] for j in solved}, BITS, _square_roots(problem))
    exact = {problem.ansatz.free[j]: str(x) for j, x in pinned.items()}
    if forms is not None:
        solution = _exact(problem, ansatz.text({**exact, **_texts(forms)}, foot=_roots(forms)), source)
        if solution is not None:
            return solution
    return _proved(problem, ansatz, exact, {problem.ansatz.free[j]: sharp[j] for j in solved}, source)


def _rounded_free(
    problem: Problem, point: Floats, steps: Sequence[Fraction]
) -> tuple[Floats, dict[int, Fraction], list[int]]:
    """Round the coefficients that the equations do not determine. Return a triple (x, values, solved). The
    vector x is the solution after the rounding. The map ``values`` maps the index of each rounded coefficient
    to the rounded value. The list ``solved`` contains the indices of the coefficients that are not rounded.
    Raises NotProved if no rounding unit in ``steps`` gives an acceptable solution (see :data:`WORSE`)."""
    _, slopes = problem.tape.jacobians(point[None])
    solved = determined(slopes[0])
    loose = [j for j in range(len(point)) if j not in solved]
    if not loose:
        return point, {}, solved
    before = _quality(problem, point)
    for step in steps:
        values = {j: round(Fraction(float(point[j])) / step) * step for j in loose}
        start = point.copy()
        start[loose] = [float(values[j]) for j in loose]
        tried, norm = _solved_for(problem, start, solved)
        good = norm < POLISHED and all(
            x < WORSE * y for x, y in zip(_quality(problem, tried), before, strict=True)
        )
        if good and _regular(problem, tried, solved):
            return tried, values, solved
    raise NotProved("rounding the undetermined coefficients gives no acceptable solution")


def _solved_for(problem: Problem, start: Floats, solved: Sequence[int]) -> tuple[Floats, float]:
    """Solve the equations of the problem for the coefficients with the indices ``solved``. Return the
    solution and the norm of the residual."""

    def restricted(points: Floats) -> tuple[Floats, Floats]:
        whole = np.repeat(start[None], len(points), axis=0)
        whole[:, solved] = points
        residuals, slopes = problem.system(whole)
        return residuals, slopes[:, :, solved]

    moved, norms = least_squares(restricted, start[None, solved])
    result = start.copy()
    result[solved] = moved[0]
    return result, float(norms[0])


def _quality(problem: Problem, point: Floats) -> tuple[float, ...]:
    """Return the largest absolute value of the coefficients of the method. If the required order is at most
    :data:`CHEAP`, also return the principal error."""
    size = float(np.abs(problem.coefficients.values(point[None])).max())
    if problem.order > CHEAP:
        return (size,)
    return size, float(np.linalg.norm(problem.error.values(point[None])[0]))


def _regular(problem: Problem, point: Floats, solved: Sequence[int]) -> bool:
    if not solved:
        return True
    _, slopes = problem.tape.jacobians(point[None])
    sizes = np.linalg.svd(slopes[0][:, solved], compute_uv=False)
    return bool(sizes[min(len(solved), len(sizes)) - 1] > 1e-5)


def determined(slopes: Floats) -> list[int]:
    """Return the indices of the pivot columns of the Jacobian ``slopes``, in ascending order. The pivots are
    chosen by Gaussian elimination with complete pivoting. The equations can be solved for the unknowns of the
    pivot columns.

    >>> determined(np.array([[0.0, 2.0, 1.0], [0.0, 4.0, 2.0]]))
    [1]
    """
    rows, chosen = slopes.copy(), list[int]()
    rows /= np.maximum(np.linalg.norm(rows, axis=1), 1e-300)[:, None]
    for _ in range(min(rows.shape)):
        free = [j for j in range(rows.shape[1]) if j not in chosen]
        place = np.abs(rows[:, free])
        i, k = np.unravel_index(int(place.argmax()), place.shape)
        if place[i, k] < 1e-7:
            break
        j = free[int(k)]
        chosen.append(j)
        rows = rows - np.outer(rows[:, j] / rows[i, j], rows[i])
        rows[i] = 0.0
    return sorted(chosen)


def _newton(
    problem: Problem, point: Floats, pinned: dict[int, Fraction], solved: Sequence[int]
) -> dict[int, arb]:
    """Use Newton's method to compute the coefficients with the indices ``solved``. The working precision is
    :data:`BITS`. Raises NotProved if the Jacobian is singular or if Newton's method does not converge."""
    trace = problem.trace()
    operations = trace[0].ring.operations if trace else []
    places = [x.placed() for x in trace]
    _, slopes = problem.tape.jacobians(point[None])
    rows = determined(slopes[0][:, list(solved)].T) if solved else []
    if len(rows) < len(solved):
        raise NotProved("Newton's method failed: the Jacobian is singular")
    with precision(BITS):
        values = {j: arb(float(point[j])) for j in solved}
        previous: float | None = None
        for _ in range(60 if solved else 0):

            def system(unknowns: Sequence[object], ring: Jets) -> list[object]:
                inputs: list[object] = [None] * len(point)
                for j, q in pinned.items():
                    inputs[j] = ring.rational(q.numerator, q.denominator)
                for j, x in zip(solved, unknowns, strict=True):
                    inputs[j] = x
                values = evaluate(operations, inputs, ring)
                return [values[places[k]] for k in rows]

            at = jets(system, [values[j] for j in solved])  # type: ignore[arg-type]
            jacobian = arb_mat(len(rows), len(solved), [g for f in at for g in f.gradient]).mid()
            try:
                step = jacobian.solve(arb_mat(len(rows), 1, [f.value.mid() for f in at]))
            except ZeroDivisionError:
                raise NotProved("Newton's method failed: the Jacobian is singular") from None
            for k, j in enumerate(solved):
                values[j] = (values[j] - step[k, 0]).mid()
            size = max(float(abs(step[k, 0]).mid()) for k in range(len(rows)))
            if size < 1e-280 or (previous == 0.0 and size == 0.0):
                return values
            previous = size
        if solved:
            raise NotProved("Newton's method does not converge")
    return values


def _require_bounds(problem: Problem, pinned: dict[int, Fraction], sharp: dict[int, arb]) -> None:
    """Raise NotProved if a coefficient violates the option ``--size`` or ``--positive``."""
    bound = problem.spec.size
    if bound is None and not problem.positive:
        return
    ring = Balls(BITS)
    free = [
        ring.enclose(sharp[j]) if j in sharp else ring.constant(pinned[j])
        for j in range(len(problem.ansatz.free))
    ]
    names, cells = problem.ansatz.cells, problem.ansatz.coefficients(free, ring)
    if bound is not None:
        # If a coefficient is equal to the bound, its computed value may exceed the bound by a rounding error.
        # ERROR allows for this error.
        limit = ring.constant(bound + ERROR)
        for name, x in zip(names, cells, strict=True):
            if 1 in (ring.sign(x - limit), ring.sign(-x - limit)):
                raise NotProved(f"{name} exceeds the bound {bound} of --size")
    weights = problem.weights(free, ring)
    names = (*names, *(f"b{i}" for i in range(1, len(weights) + 1)))
    values = [*cells, *weights]
    for place in problem.positive:
        if ring.sign(values[place] - ring.constant(ERROR)) != 1:
            raise NotProved(f"{names[place]} is not positive, contrary to --positive")


def _square_roots(problem: Problem) -> dict[str, arb]:
    """Return a map from the square roots of rational numbers in the ansatz, such as ``sqrt(2)``, to their
    values."""
    roots = {}
    with precision(BITS):
        for radical in radicals(problem.ansatz.symbolic()):
            inside = radical.base
            if isinstance(inside, Constant) and abs(radical.exponent) == Fraction(1, 2):
                p, q = inside.value.as_integer_ratio()
                roots[f"sqrt({inside.value})"] = (arb(p) / q).sqrt()
    return roots


def _texts(forms: dict[str, ClosedForm]) -> dict[str, str]:
    return {name: x.text for name, x in forms.items()}


def _roots(forms: dict[str, ClosedForm]) -> list[str]:
    return next((["", *x.root] for x in forms.values() if x.root), [])


def _exact(problem: Problem, text: str, source: str) -> Solution | None:
    """Return the solution that the tableau file ``text`` describes, or None if exact arithmetic does not
    prove the required order."""
    tableau = Tableau.loads(text)
    label = problem.measured.label()
    try:
        report = check(tableau, label, problem.order)
    except ZeroWeight:  # The formulas of the family divide by a weight that is zero.
        return None
    if report.verdict != "holds" or report.orders[0].certificate != "exact":
        return None
    method = _without_zeros(tableau.method, tableau.ring)
    return _claimed(problem, replace(tableau, method=method, source=source, claims=Claims()), exact=True)


def _without_zeros(method: Method, ring: Ring) -> Method:
    """Remove the exponentials exp(0) from a commutator-free method."""
    if not isinstance(method, CommutatorFree):
        return method

    def kept(stage: Stage) -> Stage:
        rows = stage.exponentials
        return Stage(stage.start, tuple(r for r in rows if not all(ring.is_zero(x) is True for x in r)))

    shorter = CommutatorFree(tuple(map(kept, method.stages)), kept(method.update))
    return method if shorter == method else shorter


def _proved(
    problem: Problem, ansatz: Ansatz, exact: dict[str, str], sharp: dict[str, arb], source: str
) -> Solution:
    digits: dict[str, str] = {}
    with precision(BITS):
        for name, x in sharp.items():
            # In a tableau file, decimals with the same absolute value belong to the same unknown u: if
            # ``0.5~`` denotes u, ``-0.5~`` denotes -u. Therefore the decimals of two unknowns must have
            # different absolute values.
            places = DIGITS
            while (decimal := _signed(x, places)).lstrip("-") in {y.lstrip("-") for y in digits.values()}:
                places += 1
            digits[name] = decimal
    proof = [
        "",
        "[proof]",
        f'conditions = "{problem.ansatz.family}"',
        f"order = {problem.order}",
        f'reduction = "{problem.ansatz.reduction}"',
    ]
    text = ansatz.text({**exact, **digits}, head=[f'source = "{source}"'], foot=proof)
    return _claimed(problem, Tableau.loads(text), exact=False)


def _signed(x: arb, places: int) -> str:
    """Return x as a decimal with ``places`` decimal places, followed by ``~``. In tableau files, ``~`` marks
    rounded numbers."""
    return ("-" if x < 0 else "") + decimal_places(abs(x), places) + "~"


def _claimed(problem: Problem, tableau: Tableau, *, exact: bool) -> Solution:
    """Add the proved orders and properties to the tableau, and return the solution. Raises NotProved if the
    required order is not proved."""
    if not exact:
        certify(tableau)
    claims: list[OrderClaim] = []
    certificate, holds = "", False
    wanted_family = problem.measured.label()
    for family in claimable_families(tableau):
        reached = 0
        for variant in family.claimed_variants():
            label = variant.label()
            order = check(tableau, label).orders[0]
            if order.certificate == "decimal" or order.order <= reached:
                break
            reached = order.order
            claims.append(variant.claim(order.order))
            if wanted_family in (family.label(), label):
                certificate, holds = order.certificate, order.order >= problem.order
    if not certificate:
        order = check(tableau, wanted_family).orders[0]
        certificate, holds = order.certificate, order.order >= problem.order
    if not holds or certificate == "decimal":
        raise NotProved(f"order {problem.order} is not proved")
    wanted = ("explicit", "diagonally_implicit", "symmetric", "fsal", "symplectic", "low_storage")
    held = {key: True for key, value in properties(tableau).items() if value is True and key in wanted}
    claimed = replace(tableau, claims=Claims(tuple(claims), held))
    written = dumps(claimed)
    if exact:
        # Use names for repeated numbers only if the text becomes shorter.
        written = min(toml_text(without_names(claimed)), written, key=len)
    error = principal_error(claimed, wanted_family, problem.order + 1)
    return Solution(Tableau.loads(written), written, certificate, error)


def principal_error(tableau: Tableau, family: str, order: int) -> float | None:
    """Return the 2-norm of the residuals of the conditions of order ``order``. Return None if ``order``
    exceeds the limit ``principal_error_limit`` of the family, or if the family does not accept the tableau.

    >>> from orderconds.checking import read
    >>> round(principal_error(read("suzuki4"), "vcg", 5), 6)
    0.054372
    """
    from orderconds import families
    from orderconds.ring.traces import Traces
    from orderconds.solve.tape import Tape

    chosen = families.get(family)
    if chosen.principal_error_limit is not None and order > chosen.principal_error_limit:
        return None
    proved = certify(tableau).tableau if tableau.proof is not None else tableau
    numbers: list[float] = []
    width = 0

    def count(x: object) -> object:
        nonlocal width
        width += 1
        return x

    proved.method.map(count)
    ring = Traces(width)
    inputs = iter(ring.inputs)

    def traced(x: object) -> object:
        if proved.ring.is_zero(x) is True:
            next(inputs)
            numbers.append(0.0)
            return ring.zero
        numbers.append(float(proved.ring.approximate(x, 20)))
        return next(inputs)

    method = proved.method.map(traced)
    read = replace(proved, ring=ring, method=method).read_as(chosen.formats)
    if read is None:
        return None
    tape = Tape(chosen.principal_residuals(read, ring, order), width)
    return float(np.linalg.norm(tape.values(np.array([numbers]))[0]))
