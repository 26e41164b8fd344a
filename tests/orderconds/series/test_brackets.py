"""Munthe-Kaas methods with few brackets: how many, that no program has fewer, and their exact local error."""

from fractions import Fraction
from functools import cache

import pytest

from orderconds import families
from orderconds.errors import InputError
from orderconds.ring import QQ, PowerSeries
from orderconds.series.bracketed_steps import BracketedSeries
from orderconds.series.brackets import fewest_brackets
from orderconds.series.graded import GradedAlgebra
from orderconds.series.lie_butcher import forest_residuals
from orderconds.tableau import RungeKutta, Tableau
from orderconds.trees.levels import text


def explicit(rows, b):
    def numbers(row):
        read = [Fraction(x) for x in row.split()]
        filled = read + [Fraction(0)] * (len(b.split()) - len(read))
        return tuple(QQ.rational(x.numerator, x.denominator) for x in filled)

    return RungeKutta(tuple(map(numbers, rows)), numbers(b))


KUTTA_3 = explicit(["", "1/2", "-1 2"], "1/6 2/3 1/6")
RK4 = explicit(["", "1/2", "0 1/2", "0 0 1"], "1/6 1/3 1/3 1/6")
THREE_EIGHTHS = explicit(["", "1/3", "-1/3 1", "1 -1 1"], "1/8 3/8 3/8 1/8")
BUTCHER_5 = explicit(
    ["", "1/4", "1/8 1/8", "0 -1/2 1", "3/16 0 0 9/16", "-3/7 2/7 12/7 -12/7 8/7"],
    "7/90 0 32/90 12/90 32/90 7/90",
)
DORMAND_PRINCE_5 = explicit(
    [
        "",
        "1/5",
        "3/40 9/40",
        "44/45 -56/15 32/9",
        "19372/6561 -25360/2187 64448/6561 -212/729",
        "9017/3168 -355/33 46732/5247 49/176 -5103/18656",
    ],
    "35/384 0 500/1113 125/192 -2187/6784 11/84",
)
BUTCHER_6 = explicit(
    [
        "",
        "1/3",
        "0 2/3",
        "1/12 1/3 -1/12",
        "-1/16 9/8 -3/16 -3/8",
        "0 9/8 -3/8 -3/4 1/2",
        "9/44 -9/11 63/44 18/11 0 -16/11",
    ],
    "11/120 0 27/40 27/40 -4/15 -4/15 11/120",
)

BUTCHER_6_SIXTHS = explicit(
    [
        "",
        "1/3",
        "0 2/3",
        "1/12 1/3 -1/12",
        "25/48 -55/24 35/48 15/8",
        "3/20 -11/24 -1/8 1/2 1/10",
        "-261/260 33/13 43/156 -118/39 32/195 80/39",
    ],
    "13/200 0 11/40 11/40 4/25 4/25 13/200",
)
VERNER_6 = explicit(
    [
        "",
        "1/6",
        "4/75 16/75",
        "5/6 -8/3 5/2",
        "-165/64 55/6 -425/64 85/96",
        "12/5 -8 4015/612 -11/36 88/255",
        "-8263/15000 124/75 -643/680 -81/250 2484/10625",
        "3501/1720 -300/43 297275/52632 -319/2322 24068/84065 0 3850/26703",
    ],
    "3/40 0 875/2244 23/72 264/1955 0 125/11592 43/616",
)

CASES = {
    "kutta3": (KUTTA_3, 3, 1, 1),
    "rk4": (RK4, 4, 2, 2),
    "three eighths": (THREE_EIGHTHS, 4, 2, 2),
    "butcher5": (BUTCHER_5, 5, 5, 5),
    "dormand-prince 5": (DORMAND_PRINCE_5, 5, 5, 5),
    "butcher6": (BUTCHER_6, 6, 9, 9),
    "butcher6 with sixths": (BUTCHER_6_SIXTHS, 6, 9, 9),
    "verner6": (VERNER_6, 6, 10, 9),
}


QUICK = [pytest.param(name, marks=pytest.mark.slow if name == "verner6" else ()) for name in CASES]


@cache
def program_of(name):
    method, order, _, _ = CASES[name]
    return fewest_brackets(QQ, method.A, method.b, order)


def order_of(series, most):
    for n in range(1, most + 1):
        if any(x != 0 for x in forest_residuals(series, QQ, n).values()):
            return n - 1
    return most


@pytest.mark.parametrize("name", QUICK)
def test_brackets_are_few_and_the_order_is_kept_exactly(name):
    _, order, brackets, least = CASES[name]
    program = program_of(name)
    assert (len(program.brackets), program.least) == (brackets, least)
    assert order_of(BracketedSeries(QQ, program), order + 1) == order


def test_rk4_has_the_two_brackets_of_munthe_kaas_and_owren():
    # u3 = k2/2 - [k1, k2]/8, u = (k1 + 2 k2 + 2 k3 + k4)/6 - [k1, k4]/12 (Munthe-Kaas and Owren 1999).
    program = program_of("rk4")
    algebra = GradedAlgebra(QQ, (1, 1, 1, 1), 4)
    values = {("k", n): {(n,): QQ.one} for n in range(4)}

    def value(row):
        return algebra.combine(*((x, values[name]) for name, x in row.items()))

    for r, (left, right) in enumerate(program.brackets):
        values["B", r] = algebra.bracket(value(left), value(right))
    third, last = value(program.stages[2]), value(program.update)
    assert third == {(1,): QQ.rational(1, 2), (0, 1): QQ.rational(-1, 8), (1, 0): QQ.rational(1, 8)}
    assert [last.get(word, 0) for word in ((0, 3), (3, 0), (0, 1), (0, 2), (1, 2))] == [
        QQ.rational(-1, 12), QQ.rational(1, 12), 0, 0, 0,
    ]  # fmt: skip
    assert [value(program.stages[n]) for n in (0, 3)] == [{}, {(2,): QQ.one}]


def test_order_six_takes_no_bracket_for_the_sixth_stage_value():
    program = program_of("butcher6")
    newest = [max(n for row in rows for kind, n in row if kind == "k") for rows in program.brackets]
    assert newest == [1, 1, 2, 2, 3, 3, 4, 6, 6]


def test_one_bracket_taken_away_costs_the_order():
    program = program_of("rk4")
    spoilt = dict(program.update)
    del spoilt["B", 1]
    broken = type(program)(program.brackets, program.stages, spoilt, 0, program.grades)
    assert order_of(BracketedSeries(QQ, broken), 4) < 4


def test_uncut_munthe_kaas_series_and_its_program_agree_up_to_the_order():
    program, whole = program_of("rk4"), families.get("rkmk").series(RK4, QQ)
    for n in range(1, 5):
        short = forest_residuals(BracketedSeries(QQ, program), QQ, n)
        assert short == forest_residuals(whole, QQ, n), [text(w) for w in short]


def test_tableaux_over_number_fields_are_reduced_too():
    tableau = Tableau.loads('name = "root"\nfamily = "rk"\nA = [["sqrt(2)"]]\nb = ["1"]')
    field, root = tableau.ring, tableau.method.A[0][0]
    one = field.one
    # Kutta's one-parameter family of order 3 with c2 = sqrt(2)/2, c3 = 1.
    c = root / 2
    b3 = (one / 3 - c / 2) / (one - c)
    b2 = (one / 2 - b3) / c
    a32 = one / 6 / (b3 * c)
    A = [[field.zero] * 3, [c, field.zero, field.zero], [one - a32, a32, field.zero]]
    program = fewest_brackets(field, A, [one - b2 - b3, b2, b3], 3)
    series = BracketedSeries(field, program)
    assert all(field.is_zero(x) for n in (1, 2, 3) for x in forest_residuals(series, field, n).values())
    assert len(program.brackets) == 1


def test_implicit_tableaux_are_refused():
    with pytest.raises(InputError, match="a_11 = 1/2"):
        fewest_brackets(QQ, [[QQ.rational(1, 2)]], [QQ.one], 2)


# The same on a concrete problem in gl(3), stepped over Q[[h]] with matrices.

SIZE = 3


class Problem:
    """y' = f(y) y in Q^3, f(y) = M_0 + sum y_i M_i + y_1 y_2 y_3 M_4."""

    def __init__(self, order):
        self.ring, self.order = PowerSeries(QQ, order), order
        r = self.ring.rational
        self.M = [
            [[r((7 * i * i + 3 * j + 5 * k * j + i * k) % 5 - 2) for j in range(SIZE)] for i in range(SIZE)]
            for k in range(5)
        ]
        self.y0 = [r(1), r(-1, 2), r(2, 3)]

    def add(self, *scaled):
        return [
            [sum((x * m[i][j] for x, m in scaled), self.ring.zero) for j in range(SIZE)] for i in range(SIZE)
        ]

    def mul(self, a, b):
        return [
            [sum((a[i][k] * b[k][j] for k in range(SIZE)), self.ring.zero) for j in range(SIZE)]
            for i in range(SIZE)
        ]

    def act(self, a, y):
        return [sum((a[i][k] * y[k] for k in range(SIZE)), self.ring.zero) for i in range(SIZE)]

    def field(self, y):
        scales = [self.ring.one, *y, y[0] * y[1] * y[2]]
        return self.add(*zip(scales, self.M, strict=True))

    def exp(self, u, y):
        result, term = y, y
        for n in range(1, self.order + 1):
            term = [x * self.ring.rational(1, n) for x in self.act(u, term)]
            result = [a + b for a, b in zip(result, term, strict=True)]
        return result

    def step(self, program):
        values = {}

        def value(row):
            zero = [[self.ring.zero] * SIZE for _ in range(SIZE)]
            return self.add(
                (self.ring.one, zero), *((self.ring.constant(x), values[name]) for name, x in row.items())
            )

        waiting = dict(enumerate(program.brackets))
        for i, row in enumerate((*program.stages, program.update)):
            for r in [
                r
                for r, rows in waiting.items()
                if all(name in values or name[0] == "B" for x in rows for name in x)
            ]:
                if all(name in values for x in waiting[r] for name in x):
                    left, right = map(value, waiting.pop(r))
                    minus = self.ring.rational(-1)
                    values["B", r] = self.add(
                        (self.ring.one, self.mul(left, right)), (minus, self.mul(right, left))
                    )
            y = self.exp(value(row), self.y0)
            values["k", i] = self.add((self.ring.h, self.field(y)))
        return y

    def flow(self):
        y = self.y0
        for _ in range(self.order):
            slope = self.act(self.field(y), y)
            y = [start + self.integral(x) for start, x in zip(self.y0, slope, strict=True)]
        return y

    def integral(self, x):
        return self.ring.from_coefficients(
            (QQ.zero, *(c * QQ.rational(1, n) for n, c in enumerate(x.coefficients[:-1], start=1)))
        )


@pytest.mark.parametrize("name", QUICK)
def test_the_local_error_of_a_concrete_step_starts_one_power_above_the_order(name):
    order = CASES[name][1]
    problem = Problem(order + 1)
    step = problem.step(program_of(name))
    error = [a - b for a, b in zip(step, problem.flow(), strict=True)]
    assert all(x.coefficients[n] == 0 for x in error for n in range(order + 1))
    assert any(x.coefficients[order + 1] != 0 for x in error)
