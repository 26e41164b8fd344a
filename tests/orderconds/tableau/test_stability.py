"""A- and L-stability against Hairer and Wanner's table IV.5.13, and against values on the imaginary axis."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orderconds.ring import QQ
from orderconds.tableau import RungeKutta, Tableau, find
from orderconds.tableau.properties import properties, undecided
from orderconds.tableau.rational_stability import determinant, stable
from orderconds.tableau.record import from_data
from orderconds.tableau.stability import (
    StabilityFunction,
    bounded_on_axis,
    poles_right,
    positive_roots,
    stability,
    stability_function,
)

THEORY = {
    "Radau IIA 2": ('[["5/12", "-1/12"], ["3/4", "1/4"]]', '["3/4", "1/4"]', True, True),
    "Lobatto IIIA 2": ('[[], ["1/2", "1/2"]]', '["1/2", "1/2"]', True, False),
    "Lobatto IIIB 2": ('[["1/2", "0"], ["1/2", "0"]]', '["1/2", "1/2"]', True, False),
    "Lobatto IIIC 2": ('[["1/2", "-1/2"], ["1/2", "1/2"]]', '["1/2", "1/2"]', True, True),
    "SDIRK of order 3, gamma = (3 + sqrt(3))/6": (
        '[["(3+sqrt(3))/6"], ["-sqrt(3)/3", "(3+sqrt(3))/6"]]',
        '["1/2", "1/2"]',
        True,
        False,
    ),
    "SDIRK of order 3, gamma = (3 - sqrt(3))/6": (
        '[["(3-sqrt(3))/6"], ["sqrt(3)/3", "(3-sqrt(3))/6"]]',
        '["1/2", "1/2"]',
        False,
        False,
    ),
    "theta = 1/2 + 10^-20": ('[["0.50000000000000000001"]]', '["1"]', True, False),
    "theta = 1/2 - 10^-20": ('[["0.49999999999999999999"]]', '["1"]', False, False),
    "a pole on the left": ('[["-1"]]', '["1"]', False, False),
    "a factor that cancels": ('[["1/2", "0"], ["0", "-1"]]', '["1", "0"]', True, False),
    "constant": ('[["1", "-1"], ["1", "-1"]]', '["0", "0"]', True, False),
}


@pytest.mark.parametrize("name", THEORY)
def test_textbook_methods(name: str) -> None:
    A, b, a_stable, l_stable = THEORY[name]
    found = properties(Tableau.loads(f'name = "t"\nfamily = "rk"\nA = {A}\nb = {b}\n'))
    assert (found["a_stable"], found["l_stable"]) == (a_stable, l_stable)


def test_balls_decide_nothing_but_explicit_methods_and_signs_of_steps() -> None:
    ball = Tableau.loads('name = "t"\nfamily = "rk"\nA = [["0.50000~"]]\nb = ["1"]\n')
    assert properties(ball)["a_stable"] is None
    explicit = Tableau.loads('name = "t"\nfamily = "rk"\nA = [[], ["0.50000~"]]\nb = ["0", "1"]\n')
    assert properties(explicit)["a_stable"] is False
    negative = (
        'name = "t"\nfamily = "composition"\nbase = "symmetric-2"\ngamma = ["1.35~", "-1.70~", "1.35~"]\n'
    )
    assert properties(Tableau.loads(negative))["a_stable"] is False


FRACTIONS = st.fractions(min_value=-3, max_value=3, max_denominator=8)


def q(x):  # type: ignore[no-untyped-def]
    return QQ.rational(x.numerator, x.denominator)


@given(st.lists(FRACTIONS, min_size=2, max_size=4, unique=True), st.integers(1, 3))
def test_sturm_counts_the_positive_roots_of_a_product(roots, scale) -> None:  # type: ignore[no-untyped-def]
    p = [QQ.rational(scale)]
    for root in roots:
        low = [-q(root) * x for x in p] + [QQ.zero]
        p = [x + y for x, y in zip(low, [QQ.zero, *p], strict=True)]
    assert positive_roots(p, QQ) == sum(root > 0 for root in roots)
    assert poles_right(p, QQ) is all(root > 0 for root in roots)


@given(st.lists(FRACTIONS, min_size=6, max_size=6))
def test_the_verdict_agrees_with_samples_on_the_axis(entries) -> None:  # type: ignore[no-untyped-def]
    a, b, c, d, v, w = map(q, entries)
    R = stability_function(RungeKutta(((a, b), (c, d)), (v, w)), QQ)
    bounded = bounded_on_axis(StabilityFunction(R.numerator, R.denominator), QQ)

    def modulus(p, y):  # type: ignore[no-untyped-def]
        return abs(sum(float(int(x.p) / int(x.q)) * (1j * y) ** k for k, x in enumerate(p)))

    samples = [1.1**k for k in range(-80, 81)]
    if bounded:
        assert all(modulus(R.numerator, y) <= modulus(R.denominator, y) * (1 + 1e-9) for y in samples)


def test_l_stable_implies_a_stable() -> None:
    for A, b, *_ in THEORY.values():
        tableau = Tableau.loads(f'name = "t"\nfamily = "rk"\nA = {A}\nb = {b}\n')
        assert isinstance(tableau.method, RungeKutta)
        found = stability(tableau.method, tableau.ring)
        assert found["a_stable"] or not found["l_stable"]


def dense(s: int, number: str = "") -> Tableau:
    """Return a full tableau of small numbers, always the same."""
    rows = [
        [f"{(7 * i * i + 3 * j * j + i * j) % 19 - 9}/{(i + 2 * j) % 7 + 1}" for j in range(s)]
        for i in range(s)
    ]
    A = [
        [f"{x} + {number}/{i + j + 1}" if number else x for j, x in enumerate(row)]
        for i, row in enumerate(rows)
    ]
    return from_data({"name": "t", "family": "rk", "A": A, "b": rows[0]})


def by_flint(method: RungeKutta) -> tuple[bool, bool] | None:
    less = [[a - w for a, w in zip(row, method.b, strict=True)] for row in method.A]
    return stable(determinant(less), determinant(method.A))


@pytest.mark.parametrize("s", [2, 3, 5, 8])
def test_flint_decides_rational_tableaux_as_the_exact_signs_do(s: int) -> None:
    method = dense(s).abelian()
    R = stability_function(method, QQ)
    a_stable = poles_right(R.denominator, QQ) and bounded_on_axis(R, QQ)
    assert by_flint(method) == (a_stable, a_stable and len(R.numerator) < len(R.denominator))


@pytest.mark.parametrize(
    "name", ["gauss1", "radau2a2", "lobatto3b3", "lobatto3c3", "lobatto3a3", "qin_zhang2"]
)
def test_flint_decides_methods_of_the_library_as_the_exact_signs_do(name: str) -> None:
    method = Tableau.load(find(name)).abelian()
    R = stability_function(method, QQ)
    a_stable = poles_right(R.denominator, QQ) and bounded_on_axis(R, QQ)
    assert by_flint(method) == (a_stable, a_stable and len(R.numerator) < len(R.denominator))


def test_a_pole_on_the_axis_is_left_to_exact_signs() -> None:
    method = RungeKutta(((QQ.zero, -QQ.one), (QQ.one, QQ.zero)), (QQ.one, QQ.zero))
    assert by_flint(method) is None
    assert stability(method, QQ)["a_stable"] is False


@pytest.mark.parametrize("s", [30, 60])
def test_a_dense_rational_tableau_of_many_stages_is_decided(s: int) -> None:
    assert stability(dense(s).abelian(), QQ)["a_stable"] is False


@pytest.mark.parametrize(("s", "number"), [(101, ""), (60, "sqrt(2)"), (12, "2^(1/19)")])
def test_what_would_take_long_is_not_computed_and_the_reason_given(s: int, number: str) -> None:
    tableau = dense(s, number)
    found = stability(tableau.abelian(), tableau.ring)
    assert found == {"a_stable": None, "l_stable": None}
    assert undecided(tableau, found)["a_stable"].startswith("not computed: ")
