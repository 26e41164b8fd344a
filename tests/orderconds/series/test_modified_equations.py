"""Backward error analysis: modified fields and Hamiltonians, on series and on concrete flows."""

from fractions import Fraction
from itertools import product

import pytest

from orderconds import families
from orderconds.errors import InputError
from orderconds.ring import QQ, PowerSeries
from orderconds.ring.polynomials import Polynomials
from orderconds.series.b_series import runge_kutta_series
from orderconds.series.characters import ORDERED, ROOTED, Character, exact_flow
from orderconds.series.modified_equations import VectorField, modified_field, modified_hamiltonian
from orderconds.trees.levels import children, parse, symmetry, trees_of
from orderconds.trees.ordered import ordered_forests
from orderconds.trees.rooted import rooted_trees
from orderconds.words.shuffle import shuffle

ORDER = 6


MEMBERS = {ROOTED: rooted_trees, ORDERED: ordered_forests}


def b_series(method):
    return Character(QQ, ROOTED, runge_kutta_series(QQ, method.A, method.b))


def lie_butcher(method, name="cf"):
    return Character(QQ, ORDERED, families.get(name).series(method, QQ))


def agree(one, other, order=ORDER):
    members = MEMBERS[one.algebra]
    return all(one(t) == other(t) for n in range(1, order + 1) for t in members(n))


@pytest.mark.parametrize("algebra", [ROOTED, ORDERED])
def test_the_flow_of_f_alone_is_the_exact_flow(algebra):
    f = VectorField(QQ, algebra, lambda forest: QQ.rational(len(forest) == 1))
    assert agree(f.flow(), exact_flow(QQ, algebra))
    assert agree(modified_field(exact_flow(QQ, algebra)), f)


@pytest.mark.parametrize("algebra", [ROOTED, ORDERED])
def test_twice_the_modified_field_flows_two_steps(algebra, random_tableau):
    method = random_tableau(2)
    step = b_series(method) if algebra is ROOTED else lie_butcher(method, "cg")
    field = modified_field(step)
    double = VectorField(QQ, algebra, lambda forest: 2 * field(forest))
    assert agree(double.flow(), step.then(step), 5)


def test_modified_fields_of_lie_group_methods_are_lie_series(random_commutator_free):
    field = modified_field(lie_butcher(random_commutator_free))
    for u, v in product(ordered_forests(2), ordered_forests(3)):
        words = shuffle(trees_of(u), trees_of(v))
        assert sum((n * field(b"".join(word)) for word, n in words.items()), QQ.zero) == 0


def test_the_modified_equation_of_a_method_of_order_four_starts_at_h_to_the_four(commutator_free, tableaux):
    fields = (modified_field(lie_butcher(commutator_free["cf4"])), modified_field(b_series(tableaux["rk4"])))
    for field in fields:
        members = MEMBERS[field.algebra]
        assert all(field(t) == (len(t) == 1) for n in range(1, 5) for t in members(n))
        assert any(field(t) != 0 for t in members(5))


def test_only_symplectic_methods_have_a_modified_hamiltonian(tableaux):
    with pytest.raises(InputError, match="is not 0"):
        modified_hamiltonian(modified_field(b_series(tableaux["rk4"])), 5)
    with pytest.raises(InputError, match="a B-series"):
        modified_hamiltonian(modified_field(exact_flow(QQ, ORDERED)), 2)


H_ORDER = 5


class PolynomialHamiltonian:
    """H(q, p) with y' = (H_p, -H_q), and what trees stand for, by derivatives of polynomials."""

    def __init__(self):
        self.ring = Polynomials(("q", "p"))
        q, p = self.ring.generators
        self.H = p * p * q + q * q * q * q / 2 + p * p * p / 3 + q * p
        self.known = {}

    def directional(self, function, directions):
        """The derivative of a function along frozen fields."""
        if not directions:
            return function
        result = self.ring.zero
        for choice in product((0, 1), repeat=len(directions)):
            term = function
            for variable in choice:
                term = term.derivative(variable)
            for variable, direction in zip(choice, directions, strict=True):
                term = term * direction[variable]
            result = result + term
        return result

    def differential(self, tree):
        if tree not in self.known:
            below = [self.differential(child) for child in children(tree)]
            f = (self.H.derivative(1), -self.H.derivative(0))
            self.known[tree] = tuple(self.directional(component, below) for component in f)
        return self.known[tree]

    def hamiltonian(self, tree):
        return self.directional(self.H, [self.differential(child) for child in children(tree)])


def at(polynomial, point, ring):
    """The value of a polynomial at a point over a power series ring."""
    result = ring.zero
    for exponents, scale in zip(polynomial.monoms(), polynomial.coeffs(), strict=True):
        term = ring.constant(scale)
        for x, e in zip(point, exponents, strict=True):
            for _ in range(int(e)):
                term = term * x
        result = result + term
    return result


def runge_kutta_step(method, field, start, ring, sweeps):
    k = [tuple(ring.zero for _ in start)] * method.s

    def moved(row):
        return tuple(
            y + ring.h * sum((ring.constant(x) * k[j][n] for j, x in enumerate(row)), ring.zero)
            for n, y in enumerate(start)
        )

    for _ in range(sweeps):
        k = [field(moved(row)) for row in method.A]
    return moved(method.b)


def test_the_modified_hamiltonian_is_conserved_to_its_order(tableaux):
    problem, ring, method = PolynomialHamiltonian(), PowerSeries(QQ, H_ORDER), tableaux["midpoint"]
    start = (ring.rational(1), ring.rational(1, 2))
    f = problem.differential(b"\0")
    end = runge_kutta_step(method, lambda y: tuple(at(x, y, ring) for x in f), start, ring, H_ORDER + 1)
    terms = modified_hamiltonian(modified_field(b_series(method)), H_ORDER)
    assert len(terms) > 2

    def drift(most):
        change = ring.zero
        for tree, scale in terms:
            if len(tree) <= most:
                power = ring.constant(scale)
                for _ in range(len(tree) - 1):
                    power = power * ring.h
                hamiltonian = problem.hamiltonian(tree)
                change = change + power * (at(hamiltonian, end, ring) - at(hamiltonian, start, ring))
        return change

    # H~ with all terms to h^4 drifts by O(h^6) or less; H alone by O(h^3).
    assert all(c == 0 for c in drift(H_ORDER).coefficients)
    assert drift(1).coefficients[3] != 0
    assert drift(3).coefficients[5] != 0


def test_the_elementary_hamiltonian_s_field_is_the_modified_field(tableaux):
    problem, field = PolynomialHamiltonian(), modified_field(b_series(tableaux["midpoint"]))
    for n in range(1, 6):
        terms = [(t, x) for t, x in modified_hamiltonian(field, n) if len(t) == n]
        total = sum((problem.hamiltonian(t) * x for t, x in terms), problem.ring.zero)
        of_h = (total.derivative(1), -total.derivative(0))
        of_trees = [problem.ring.zero, problem.ring.zero]
        for tree in rooted_trees(n):
            for part, value in enumerate(problem.differential(tree)):
                of_trees[part] = of_trees[part] + value * field(tree) / symmetry(tree)
        assert list(of_h) == of_trees


@pytest.mark.parametrize("name", ["euler", "rk4", "midpoint"])
def test_the_flow_of_the_modified_equation_is_the_step_on_a_concrete_problem(tableaux, name):
    # Time on the unit interval is the variable x of the coefficients, Q[x][[h]].
    problem, time = PolynomialHamiltonian(), Polynomials(("x",))
    ring, method = PowerSeries(time, H_ORDER), tableaux[name]
    start = (ring.rational(1), ring.rational(1, 2))
    f = problem.differential(b"\0")
    step = runge_kutta_step(
        method.map(lambda x: time.one * x),
        lambda y: tuple(at(g, y, ring) for g in f),
        start,
        ring,
        H_ORDER + 1,
    )
    field = modified_field(b_series(method))
    y = start
    for _ in range(H_ORDER):
        slope = [ring.zero, ring.zero]
        for n in range(1, H_ORDER + 1):
            for tree in rooted_trees(n):
                scale = ring.constant(time.one * (field(tree) / symmetry(tree)))
                for _ in range(n):
                    scale = scale * ring.h
                for part, value in enumerate(problem.differential(tree)):
                    slope[part] = slope[part] + scale * at(value, y, ring)
        y = tuple(a + integrated(b, ring) for a, b in zip(start, slope, strict=True))
    final = [[c.compose(time.one) if c.degrees() else c for c in x.coefficients] for x in y]
    assert final == [list(x.coefficients) for x in step]


def integrated(series, ring):
    return ring.from_coefficients(tuple(c.integral(0) for c in series.coefficients))


def test_known_modified_equations():
    # HLW IX.1 for the explicit Euler method and IX.9 for the implicit midpoint rule.
    euler = Character(QQ, ROOTED, lambda tree: QQ.rational(len(tree) == 1))
    midpoint = Character(QQ, ROOTED, lambda tree: QQ.rational(1, 2 ** (len(tree) - 1)))
    trees = [parse(t) for t in (".", "[.]", "[..]", "[[.]]")]
    assert [Fraction(str(modified_field(euler)(t))) for t in trees] == [
        1, Fraction(-1, 2), Fraction(1, 6), Fraction(1, 3),
    ]  # fmt: skip
    assert [Fraction(str(modified_field(midpoint)(t))) for t in trees] == [
        1, 0, Fraction(-1, 12), Fraction(1, 12),
    ]  # fmt: skip
