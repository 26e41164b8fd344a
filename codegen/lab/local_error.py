"""The local error of a step program, exactly: its Taylor coefficients in h, and what the conditions predict.

Run over Q[[h]], a program on a polynomial scene yields the series of its step; the exact flow's follows by
Picard iteration. Their difference starts at h^(p+1), p the order, and there it is the sum of the residuals of
the order conditions times the scene's elementary differentials. So the program that was emitted is compared
with the conditions from which its order was derived.
"""

from __future__ import annotations

from typing import Any

from codegen.certify import family_of
from codegen.errors import SceneError
from codegen.ir.domain import SeriesDomain
from codegen.ir.interpret import interpret
from codegen.ir.program import Program
from codegen.lab.elementary import (
    CanonicalFields,
    FrozenFields,
    Vector,
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

State = tuple[Any, ...]
"""The coordinates of a state in order, power series in h."""


def step(program: Program, scene: Problem, ring: Ring, order: int) -> State:
    """Return the state after one step from the scene's initial state, as series in h up to ``order``.

    ``scene`` is the problem that the program was lowered in. ArithmeticError for a scene whose field is not
    polynomial, or whose initial state is not rational.
    """
    domain = SeriesDomain(ring, order)
    inputs: dict[str, Any] = {"t": _time(scene, domain)}
    first, start = 0, scene.initial(domain)
    for block in scene.state:
        inputs[block.name] = start[first : first + len(block.symbols)]
        first += len(block.symbols)
    result = interpret(program, scene, domain, inputs)
    return tuple(x for block in scene.state for x in result[block.name])


def exact_flow(scene: Problem, ring: Ring, order: int) -> State:
    """Return the exact solution after the time h from the initial state, by Picard iteration."""
    domain = SeriesDomain(ring, order)
    start = scene.initial(domain)
    t = _time(scene, domain) + domain.h
    state = start
    for _ in range(order):
        velocity = scene.velocity(domain, state, t)
        state = tuple(x + _integral(domain.ring, v) for x, v in zip(start, velocity, strict=True))
    return state


def _time(scene: Problem, domain: SeriesDomain) -> Any:
    return domain.rational(scene.span[0].numerator, scene.span[0].denominator)


def _integral(ring: PowerSeries, x: Any) -> Any:
    terms = (c * ring.base.rational(1, k + 1) for k, c in enumerate(x.coefficients))
    return ring.from_coefficients((ring.base.zero, *terms))


def local_error(program: Program, scene: Problem, ring: Ring, order: int) -> State:
    """Return program minus exact flow after one step, series in h up to ``order``."""
    pairs = zip(step(program, scene, ring, order), exact_flow(scene, ring, order), strict=True)
    return tuple(x - y for x, y in pairs)


def valuation(error: State) -> int:
    """Return the lowest power of h in which a local error does not vanish."""
    return min(int(x.ring.valuation(x)) for x in error)


def leading_term(error: State) -> tuple[int, Vector]:
    """Return the lowest power of h in which a local error does not vanish, and its coefficients."""
    power = valuation(error)
    return power, tuple(x.coefficients[power] for x in error)


def predicted(scene: Problem, method: Method, power: int) -> Vector:
    """Return the coefficients of h^power that a method's order conditions predict, all lower ones vanishing.

    ``scene`` is the problem of the method's family; autonomous and polynomial. The family ``sprk`` is
    predicted by its own trees, on the Hamiltonian scene of ``vcg`` on T*R^n.
    """
    if not scene.autonomous:
        raise SceneError("a scene that depends on time", where=scene.name, expected="an autonomous one")
    if method.kind.trees == "directed":
        return _partitioned(scene, method, power)
    if scene.is_hamiltonian:
        return _action(scene, method, power)
    return (_trees if method.kind.trees == "rooted" else _forests)(scene, method, power)


def _residuals(method: Method, power: int) -> list[tuple[Any, Element]]:
    """Return the residual of every condition of one order, with its tree or forest."""
    family = family_of(method)
    conditions = family.all_conditions(power)
    coefficients = family.read(method.tableau)
    assert coefficients is not None
    found = family.residuals(coefficients, method.ring, conditions)
    return [(c.key, x) for c, x in zip(conditions, found, strict=True) if method.ring.is_zero(x) is not True]


def _sum(ring: Ring, terms: list[tuple[Element, Vector]], width: int) -> Vector:
    total = [ring.zero] * width
    for weight, vector in terms:
        total = [a + weight * x for a, x in zip(total, vector, strict=True)]
    return tuple(total)


def _trees(scene: Problem, method: Method, power: int) -> Vector:
    """The B-series: sum over rooted trees of residual/symmetry F(t) (HLW III.1)."""
    fields = FrozenFields(scene, method.ring)
    terms = [
        (x * method.ring.rational(1, levels.symmetry(t)), fields.forest(t))
        for t, x in _residuals(method, power)
    ]
    return _sum(method.ring, terms, len(scene.symbols))


def _forests(scene: Problem, method: Method, power: int) -> Vector:
    """The Lie-Butcher series: sum over ordered forests of (value - exact value) F(w)."""
    fields = FrozenFields(scene, method.ring)
    terms = [(x * method.ring.rational(1, scale(w)), fields.forest(w)) for w, x in _residuals(method, power)]
    return _sum(method.ring, terms, len(scene.symbols))


def _partitioned(scene: Problem, method: Method, power: int) -> Vector:
    """The P-series: sum over trees with directed edges of residual/symmetry (xi, n)(t)."""
    fields = CanonicalFields(scene, method.ring)
    terms = [
        (x * method.ring.rational(1, directed.symmetry(t)), fields.tree(t))
        for t, x in _residuals(method, power)
    ]
    return _sum(method.ring, terms, len(scene.symbols))


def _action(scene: Problem, method: Method, power: int) -> Vector:
    """The action series: the update's words, exact values taken off."""
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
