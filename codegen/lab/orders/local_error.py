"""The exact local error of one step: its Taylor coefficients in the step size h, computed in two ways.

In the first way, the interpreter executes the program of a step with power series in h. The series of the
exact solution, computed by Picard iteration, is subtracted.

In the second way, the coefficient of the lowest power of h is a sum over the order conditions. Each summand
is the residual of a condition times an elementary differential. If the program is correct, both ways give the
same coefficient of this power.
"""

from __future__ import annotations

from codegen.certify import family_of
from codegen.errors import SceneError
from codegen.ir.domain import SeriesDomain
from codegen.ir.interpret import interpret
from codegen.ir.program import Program
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.orders.elementary_differentials import (
    CanonicalFields,
    FrozenFields,
    action_fields,
    element_coordinates,
)
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.families.action_family import ActionFamily
from orderconds.families.ordered_forests import scale
from orderconds.ring import PowerSeries
from orderconds.ring.protocol import Element, Ring
from orderconds.series import action_exact
from orderconds.trees import directed, levels


def step(program: Program, scene: Problem, ring: Ring, order: int) -> Vector:
    """Return the state after one step from the initial state of the scene.

    Each coordinate is a power series in the step size h up to h^``order``, with coefficients in ``ring``.
    ``scene`` is the problem for which the program was generated. Raises ArithmeticError if the coefficients
    cannot be computed exactly, for example if the vector field of the scene contains ``sqrt``.
    """
    domain = SeriesDomain(ring, order)
    inputs: dict[str, Scalar] = {"t": _time(scene, domain)}
    first, start = 0, scene.initial(domain)
    for block in scene.state:
        inputs[block.name] = start[first : first + len(block.symbols)]
        first += len(block.symbols)
    result = interpret(program, scene, domain, inputs)
    return tuple(x for block in scene.state for x in result[block.name])


def exact_flow(scene: Problem, ring: Ring, order: int) -> Vector:
    """Return the exact solution at the time h after the initial time of the scene.

    Each coordinate is a power series in h up to h^``order``.
    """
    domain = SeriesDomain(ring, order)
    start = scene.initial(domain)
    t = _time(scene, domain) + domain.h
    state = start
    for _ in range(order):
        velocity = scene.velocity(domain, state, t)
        state = tuple(x + _integral(domain.ring, v) for x, v in zip(start, velocity, strict=True))
    return state


def _time(scene: Problem, domain: SeriesDomain) -> Scalar:
    return domain.rational(scene.span[0].numerator, scene.span[0].denominator)


def _integral(ring: PowerSeries, x: Scalar) -> Scalar:
    terms = (c * ring.base.rational(1, k + 1) for k, c in enumerate(x.coefficients))
    return ring.from_coefficients((ring.base.zero, *terms))


def local_error(program: Program, scene: Problem, ring: Ring, order: int) -> Vector:
    """Return the local error of a step of size h: the state after the step minus the exact solution.

    Each coordinate is a power series in h up to h^``order``.
    """
    pairs = zip(step(program, scene, ring, order), exact_flow(scene, ring, order), strict=True)
    return tuple(x - y for x, y in pairs)


def valuation(error: Vector) -> int:
    """Return the lowest power of h whose coefficient is not zero in some component of a local error."""
    return min(int(x.ring.valuation(x)) for x in error)


def leading_term(error: Vector) -> tuple[int, Vector]:
    """Return the exponent of the lowest power of h in a local error, and the coefficients of this power.

    There is one coefficient for each component of the local error.
    """
    power = valuation(error)
    return power, tuple(x.coefficients[power] for x in error)


def predicted(scene: Problem, method: Method, power: int) -> Vector:
    """Compute the coefficient of h^``power`` in the local error from the order conditions.

    The result contains one number for each coordinate. The method must satisfy all order conditions of orders
    lower than ``power``. ``scene`` is the problem that :func:`codegen.lower.problem_for` returns for the
    method. The scene must be autonomous and polynomial. For a symplectic partitioned method, the scene must
    also be Hamiltonian on T*R^n.
    """
    if not scene.autonomous:
        raise SceneError("the scene depends on time", where=scene.name, expected="an autonomous scene")
    if scene.coordinates is not None:
        raise SceneError(
            f"the steps are computed in the coordinates {scene.coordinates.name}",
            where=scene.name,
            expected="exponential coordinates, which the order conditions assume",
        )
    if method.kind.trees == "directed":
        return _partitioned(scene, method, power)
    if scene.is_hamiltonian:
        return _action(scene, method, power)
    return (_trees if method.kind.trees == "rooted" else _forests)(scene, method, power)


def _residuals(method: Method, power: int) -> list[tuple[Scalar, Element]]:
    """Return a pair (key, residual) for each violated order condition of order ``power``.

    The key is a tree, a forest or a word.
    """
    family = family_of(method)
    conditions = family.all_conditions(power)
    coefficients = family.read(method.tableau)
    assert coefficients is not None
    residuals = family.residuals(coefficients, method.ring, conditions)
    return [
        (c.key, x) for c, x in zip(conditions, residuals, strict=True) if method.ring.is_zero(x) is not True
    ]


def _sum(ring: Ring, terms: list[tuple[Element, Vector]], width: int) -> Vector:
    total = [ring.zero] * width
    for weight, vector in terms:
        total = [a + weight * x for a, x in zip(total, vector, strict=True)]
    return tuple(total)


def _trees(scene: Problem, method: Method, power: int) -> Vector:
    """Return the coefficient of h^``power`` in the local error, as a sum over rooted trees t (a B-series).

    The summand of t is F(t) r(t) / s(t), where F(t) is the elementary differential of t, r(t) is the residual
    of the order condition of t, and s(t) is the number of automorphisms of t (Hairer, Lubich and Wanner,
    *Geometric Numerical Integration*, III.1).
    """
    fields = FrozenFields(scene, method.ring)
    terms = [
        (x * method.ring.rational(1, levels.symmetry(t)), fields.forest(t))
        for t, x in _residuals(method, power)
    ]
    return _sum(method.ring, terms, len(scene.symbols))


def _forests(scene: Problem, method: Method, power: int) -> Vector:
    """Return the coefficient of h^``power`` in the local error, as a sum over ordered forests w.

    The summand of w is d(w) F(w), where F(w) is the elementary differential of w. The number d(w) is the
    coefficient of w in the Lie-Butcher series of the numerical solution, minus that of the exact solution.
    """
    fields = FrozenFields(scene, method.ring)
    terms = [(x * method.ring.rational(1, scale(w)), fields.forest(w)) for w, x in _residuals(method, power)]
    return _sum(method.ring, terms, len(scene.symbols))


def _partitioned(scene: Problem, method: Method, power: int) -> Vector:
    """Return the coefficient of h^``power`` in the local error, as a sum over trees t with directed edges.

    The summand of t is F(t) r(t) / s(t), where F(t) is the elementary differential of t
    (:meth:`CanonicalFields.tree`), r(t) is the residual of the order condition of t, and s(t) is the number
    of automorphisms of t.
    """
    fields = CanonicalFields(scene, method.ring)
    terms = [
        (x * method.ring.rational(1, directed.symmetry(t)), fields.tree(t))
        for t, x in _residuals(method, power)
    ]
    return _sum(method.ring, terms, len(scene.symbols))


def _action(scene: Problem, method: Method, power: int) -> Vector:
    """Return the coefficient of h^``power`` in the local error of a variational method as a sum over words.

    The summand of a word w (a sequence of trees) is d(w) times a vector that depends only on w and the scene.
    The number d(w) is the coefficient of w in the series of the numerical solution, minus that of the exact
    solution.
    """
    ring = method.ring
    family = family_of(method)
    assert isinstance(family, ActionFamily)
    coefficients = family.read(method.tableau)
    assert coefficients is not None
    series = family.series(coefficients, ring)
    defects = {}
    for word, x in series.update_words(power).items():
        if sum(tree.vertices for tree in word) == power:
            exact = action_exact.update(word)
            defects[word] = x - ring.rational(exact.numerator, exact.denominator)
    point, momentum = action_fields(scene, ring).local_error(defects)
    return (*element_coordinates(scene.group, point), *momentum)
