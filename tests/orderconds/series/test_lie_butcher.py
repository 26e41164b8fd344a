from fractions import Fraction
from itertools import product
from math import factorial

import pytest

from orderconds import families
from orderconds.ring import QQ, PowerSeries
from orderconds.ring.polynomials import Polynomials
from orderconds.series.characters import ORDERED, Character
from orderconds.series.dexpinv import bernoulli
from orderconds.series.lie_butcher import ExponentialsSeries, exact_value, forest_residuals, forest_values
from orderconds.series.modified_equations import modified_field
from orderconds.tableau import RungeKutta
from orderconds.trees.levels import parse, text, trees_of
from orderconds.trees.ordered import ordered_forests, ordered_trees
from orderconds.words.shuffle import shuffle

# Values of the exact flow on ordered trees, from Owren and Marthinsen 1999.
PRINTED = {
    ".": "1",
    "[.]": "1/2",
    "[..]": "1/6",
    "[[.]]": "1/6",
    "[...]": "1/24",
    "[.[.]]": "1/12",
    "[[.].]": "1/24",
    "[[..]]": "1/24",
    "[[[.]]]": "1/24",
}


def left_grafted(vertices):
    """The n-th derivative of the flow: n times a vertex is put first, or grafted leftmost onto a vertex."""
    forests = {b"": 1}
    for _ in range(vertices):
        grown = {}
        for forest, times in forests.items():
            above = [forest[: v + 1] + bytes((forest[v] + 1,)) + forest[v + 1 :] for v in range(len(forest))]
            for new in (b"\0" + forest, *above):
                grown[new] = grown.get(new, 0) + times
        forests = grown
    return forests


def is_group_like(series, order):
    """Values multiply over shuffles."""
    for total in range(2, order + 1):
        for size in range(1, total // 2 + 1):
            for u, v in product(ordered_forests(size), ordered_forests(total - size)):
                words = shuffle(trees_of(u), trees_of(v))
                shuffled = sum(
                    (times * series(b"".join(word)) for word, times in words.items()), 0 * series(u)
                )
                if shuffled != series(u) * series(v):
                    return False
    return True


def test_exact_values_are_the_printed_ones():
    found = {text(tree): str(exact_value(tree)) for n in range(1, 5) for tree in ordered_trees(n)}
    assert found == PRINTED


@pytest.mark.parametrize("vertices", range(1, 8))
def test_exact_values_count_left_graftings(vertices):
    counts = left_grafted(vertices)
    assert set(counts) == set(ordered_forests(vertices))
    for forest, times in counts.items():
        assert exact_value(forest) == Fraction(times, factorial(vertices))


def test_exact_values_are_not_those_of_forests_without_order():
    assert exact_value(parse("[.[.]]")) != exact_value(parse("[[.].]"))


def test_the_exact_flow_is_group_like():
    assert is_group_like(exact_value, 6)


def test_steps_of_lie_group_methods_are_group_like(random_tableau, random_commutator_free):
    method = random_tableau(2)
    for name in ("cg", "rkmk(0)", "rkmk(1)", "rkmk(2)", "rkmk"):
        assert is_group_like(families.get(name).series(method, QQ), 5)
    assert is_group_like(families.get("cf").series(random_commutator_free, QQ), 5)


def test_a_sum_of_exponentials_is_not_group_like(random_tableau):
    series = families.get("cg").series(random_tableau(2), QQ)
    assert not is_group_like(lambda forest: series(forest) + exact_value_in_qq(forest), 3)


def exact_value_in_qq(forest):
    value = exact_value(forest)
    return QQ.rational(value.numerator, value.denominator)


def test_commutator_free_methods_with_one_stage_an_exponential_are_crouch_grossman(random_tableau):
    method = random_tableau(3)
    read = method.as_crouch_grossman(QQ)
    one, other = families.get("cg").series(method, QQ), families.get("cf").series(read, QQ)
    for n in range(1, 6):
        assert forest_values(one, n) == forest_values(other, n)


def test_products_that_begin_alike_have_the_same_values_as_if_they_did_not(random_tableau):
    A, b = random_tableau(3).A, random_tableau(3).b
    # Composed midpoints: each stage begins as the update does.
    shared = [[((j, b[j]),) for j in range(i)] + [((i, A[i][i]),)] for i in range(3)]
    apart = [[((j, x + QQ.zero),) for ((j, x),) in rows] for rows in shared]
    update = [((j, b[j]),) for j in range(3)]
    one, other = ExponentialsSeries(QQ, shared, update), ExponentialsSeries(QQ, apart, update)
    assert len(one._places) < len(other._places)
    for n in range(1, 5):
        assert forest_values(one, n) == forest_values(other, n)
        for forest in ordered_forests(n):
            assert [one.stage(i, forest) for i in range(3)] == [other.stage(i, forest) for i in range(3)]


def test_series_over_power_series_start_with_the_series_over_the_base(random_tableau, random_rational):
    ring, method = PowerSeries(QQ, 2), random_tableau(2)
    # Coefficients x + y h: the values' constant terms belong to the coefficients x.
    moved = RungeKutta(
        tuple(tuple(ring.constant(x) + ring.h * 3 for x in row) for row in method.A),
        tuple(ring.constant(x) - ring.h for x in method.b),
    )
    for name in ("cg", "rkmk(2)"):
        family = families.get(name)
        over, under = family.series(moved, ring), family.series(method, QQ)
        for n in range(1, 5):
            for forest in ordered_forests(n):
                assert over(forest).coefficients[0] == under(forest)


# A concrete problem over Q[[h]], stepped without any tree: y' = f(y) y in the plane, f quadratic, in gl(2).


class Plane:
    """f(y) = M0 + y1 M1 + y2 M2 + y1 y2 N and y0, with numbers in ``ring``."""

    def __init__(self, ring, order):
        self.ring, self.order = ring, order
        entries = {"M0": (1, -2, 3, 1), "M1": (0, 1, 1, -1), "M2": (2, 0, -1, 1), "N": (1, 1, 0, -2)}
        self.matrices = {name: tuple(ring.rational(p, 3) for p in values) for name, values in entries.items()}
        self.y0 = (ring.rational(1), ring.rational(-1, 2))

    def add(self, *scaled):
        return tuple(sum((x * m[k] for x, m in scaled), self.ring.zero) for k in range(len(scaled[0][1])))

    def mul(self, a, b):
        if len(b) == 2:
            return (a[0] * b[0] + a[1] * b[1], a[2] * b[0] + a[3] * b[1])
        return (
            *(a[0] * b[k] + a[1] * b[k + 2] for k in (0, 1)),
            *(a[2] * b[k] + a[3] * b[k + 2] for k in (0, 1)),
        )

    def field(self, y):
        m = self.matrices
        return self.add((self.ring.one, m["M0"]), (y[0], m["M1"]), (y[1], m["M2"]), (y[0] * y[1], m["N"]))

    def act(self, x, y):
        """exp(x) y; x has a factor h."""
        result, term = y, y
        for n in range(1, self.order + 1):
            term = self.add((self.ring.rational(1, n), self.mul(x, term)))
            result = self.add((self.ring.one, result), (self.ring.one, term))
        return result

    def combination(self, row, k):
        return self.add(
            *((self.ring.h * self.ring.constant(x), value) for x, value in zip(row, k, strict=False))
        )

    def crouch_grossman(self, method):
        k = []
        for row in (*method.A, method.b):
            y = self.y0
            for j, value in enumerate(k):
                y = self.act(self.add((self.ring.h * self.ring.constant(row[j]), value)), y)
            k.append(self.field(y))
        return y

    def commutator_free(self, method):
        k, points = [], []
        for stage in (*method.stages, method.update):
            y = self.y0 if stage.start is None else points[stage.start]
            for row in stage.exponentials:
                y = self.act(self.combination(row, k), y)
            points.append(y)
            k.append(self.field(y))
        return points[-1]

    def munthe_kaas(self, method, cutoff):
        zero = (self.ring.zero,) * 4
        pulled = []
        for row in (*method.A, method.b):
            u = self.combination(row, pulled) if pulled else zero
            y = self.act(u, self.y0)
            term = value = self.field(y)
            for n in range(1, cutoff + 1):
                term = self.add(
                    (self.ring.one, self.mul(u, term)), (self.ring.rational(-1), self.mul(term, u))
                )
                b = bernoulli(n) / factorial(n)
                value = self.add(
                    (self.ring.one, value), (self.ring.rational(b.numerator, b.denominator), term)
                )
            pulled.append(value)
        return y

    def flow(self):
        """Picard iteration: one more power of h is right each time."""
        y = self.y0
        for _ in range(self.order):
            slope = self.mul(self.field(y), y)
            y = tuple(start + self.integral(x) for start, x in zip(self.y0, slope, strict=True))
        return y

    def integral(self, x):
        shifted = [self.ring.base.zero]
        shifted += [c * self.ring.base.rational(1, n) for n, c in enumerate(x.coefficients[:-1], start=1)]
        return self.ring.from_coefficients(tuple(shifted))


class Elementary:
    """Elementary differentials F(t) in gl(2) of the plane problem, by nilpotent increments."""

    def __init__(self, plane=None):
        self.plane = plane or Plane(QQ, 0)

    def of_tree(self, tree):
        below = [self.of_tree(child) for child in trees_of(tree[1:].translate(bytes([0, *range(255)])))]
        moved = {}
        for chosen in product((0, 1), repeat=len(below)):
            y = self.plane.y0
            for value, used in zip(below, chosen, strict=True):
                y = self.plane.mul(value, y) if used else y
            moved[chosen] = y
        everything, nothing = (1,) * len(below), (0,) * len(below)
        m, y = self.plane.matrices, moved[everything]
        crossed = sum(
            (moved[part][0] * moved[tuple(1 - x for x in part)][1] for part in moved), self.plane.ring.zero
        )
        constant = self.plane.ring.one if everything == nothing else self.plane.ring.zero
        return self.plane.add((constant, m["M0"]), (y[0], m["M1"]), (y[1], m["M2"]), (crossed, m["N"]))

    def of_forest(self, forest):
        y = self.plane.y0
        for tree in trees_of(forest):
            y = self.plane.mul(self.of_tree(tree), y)
        return y

    def predicted(self, values):
        """sum_w a(w) F(t_k) ... F(t_1) y0."""
        return tuple(
            sum((value * self.of_forest(forest)[k] for forest, value in values.items()), self.plane.ring.zero)
            for k in (0, 1)
        )


ORDER = 5


def taylor(y, n):
    return tuple(x.coefficients[n] for x in y)


def test_exact_values_predict_the_flow_of_a_concrete_problem():
    y, elementary = Plane(PowerSeries(QQ, ORDER), ORDER).flow(), Elementary()
    for n in range(ORDER + 1):
        values = {forest: exact_value_in_qq(forest) for forest in ordered_forests(n)}
        assert elementary.predicted(values) == taylor(y, n)


@pytest.mark.parametrize("name", ["kutta3", "cg3", "rk4"])
@pytest.mark.parametrize("family", ["cg", "rkmk(0)", "rkmk(1)", "rkmk(2)"])
def test_series_predict_steps_on_a_concrete_problem(tableaux, name, family):
    plane, method = Plane(PowerSeries(QQ, ORDER), ORDER), tableaux[name]
    y = plane.crouch_grossman(method) if family == "cg" else plane.munthe_kaas(method, int(family[5]))
    series, elementary = families.get(family).series(method, QQ), Elementary()
    for n in range(ORDER + 1):
        assert elementary.predicted(forest_values(series, n)) == taylor(y, n)


@pytest.mark.parametrize("name", ["cf3", "cf4", "cf4 with its factors swapped"])
def test_series_predict_commutator_free_steps_on_a_concrete_problem(commutator_free, name):
    plane, method = Plane(PowerSeries(QQ, ORDER), ORDER), commutator_free[name]
    y, series, elementary = plane.commutator_free(method), families.get("cf").series(method, QQ), Elementary()
    for n in range(ORDER + 1):
        assert elementary.predicted(forest_values(series, n)) == taylor(y, n)


def test_residuals_predict_the_local_error_of_cf4(commutator_free):
    plane = Plane(PowerSeries(QQ, ORDER), ORDER)
    step, flow = plane.commutator_free(commutator_free["cf4"]), plane.flow()
    series = families.get("cf").series(commutator_free["cf4"], QQ)
    assert all(taylor(step, n) == taylor(flow, n) for n in range(5))
    error = tuple(a - b for a, b in zip(taylor(step, 5), taylor(flow, 5), strict=True))
    assert any(error)
    assert Elementary().predicted(forest_residuals(series, QQ, 5)) == error


@pytest.mark.parametrize("name", ["cf3", "cf4 with its factors swapped"])
def test_the_flow_of_the_modified_equation_is_the_step_on_a_concrete_problem(commutator_free, name):
    # Time on the unit interval is the variable x of the coefficients, Q[x][[h]]; four Picard sweeps.
    order, time = 4, Polynomials(("x",))
    step = Plane(PowerSeries(QQ, order), order).commutator_free(commutator_free[name])
    series = families.get("cf").series(commutator_free[name], QQ)
    field, plane = modified_field(Character(QQ, ORDERED, series)), Plane(PowerSeries(time, order), order)
    start, powers = plane.y0, [plane.ring.one]
    for _ in range(order):
        powers.append(powers[-1] * plane.ring.h)
    words = [(n, word) for n in range(1, order + 1) for word in ordered_forests(n)]
    terms = {word: powers[n] * plane.ring.constant(time.one * field(word)) for n, word in words}
    for _ in range(order):
        slope = Elementary(plane).predicted(terms)
        moved = [plane.ring.from_coefficients(tuple(c.integral(0) for c in x.coefficients)) for x in slope]
        plane.y0 = tuple(a + b for a, b in zip(start, moved, strict=True))
    final = [[c.compose(time.one) if c.degrees() else c for c in x.coefficients] for x in plane.y0]
    assert final == [list(x.coefficients) for x in step]
