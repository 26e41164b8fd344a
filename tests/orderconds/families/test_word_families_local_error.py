"""The order found by conditions is that of the exact local error, of matrices over power series in h."""

import random
from functools import reduce

import pytest

from orderconds import families
from orderconds.ring import QQ, PowerSeries
from orderconds.tableau import AdjointComposition, Composition, Splitting, Tableau, available, find
from orderconds.tableau.brackets import Bracket, Product

SIZE = 3
FOLDERS = ("composition", "magnus", "splitting")
WORD_FAMILIES = (
    "composition",
    "symmetric_composition",
    "splitting",
    "splitting(3)",
    "magnus",
    "cf_magnus",
    "fer",
    "cayley",
)


class Matrices:
    """SIZE x SIZE matrices over R[[h]]/h^(order + 1), R the ring of a tableau."""

    def __init__(self, ring, order, seed):
        self.ring, self.h, self.order = ring, PowerSeries(ring, order), order
        self.numbers = random.Random(seed)

    def constant(self, x):
        return [[self.h.constant(x) if i == j else self.h.zero for j in range(SIZE)] for i in range(SIZE)]

    def one(self):
        return self.constant(self.ring.one)

    def random(self):
        draw = self.numbers.randint
        entry = lambda: self.h.rational(draw(-3, 3), draw(1, 2))  # noqa: E731
        return [[entry() for _ in range(SIZE)] for _ in range(SIZE)]

    def times(self, x, y):
        return [
            [sum((x[i][k] * y[k][j] for k in range(SIZE)), self.h.zero) for j in range(SIZE)]
            for i in range(SIZE)
        ]

    def add(self, *xs):
        return [[sum((x[i][j] for x in xs), self.h.zero) for j in range(SIZE)] for i in range(SIZE)]

    def scaled(self, x, a):
        return [[entry * a for entry in row] for row in x]

    def power_of_h(self, n):
        return self.h.from_coefficients((*[self.ring.zero] * n, self.ring.one))

    def power_series(self, x, quotient):
        """1 + q_1 x + q_1 q_2 x^2 + ..., q_m = quotient(m)."""
        result = term = self.one()
        for m in range(1, self.order + 1):
            term = self.scaled(self.times(term, x), self.ring.rational(*quotient(m)))
            result = self.add(result, term)
        return result

    def exp(self, x):
        return self.power_series(x, lambda m: (1, m))

    def cay(self, x):
        below = self.power_series(x, lambda m: (1, 2))
        return self.add(self.scaled(below, 2), self.scaled(self.one(), -1))

    def inverse(self, x):
        """1/x where x begins with the identity."""
        return self.power_series(self.add(self.one(), self.scaled(x, -1)), lambda m: (1, 1))

    def valuation(self, x):
        """The lowest power of h with a coefficient that is proved not to vanish."""
        entries = [entry.coefficients for row in x for entry in row]
        return next(
            n for n in range(self.order + 1) if any(self.ring.is_zero(e[n]) is False for e in entries)
        )


def step_and_flow(method, m):
    if isinstance(method, Splitting):
        parts = [m.random() for _ in method.parts]
        factors = [m.exp(m.scaled(parts[part], m.h.h * x)) for part, x in method.steps]
        return reduce(lambda y, x: m.times(x, y), factors, m.one()), m.exp(m.scaled(m.add(*parts), m.h.h))
    if isinstance(method, Composition | AdjointComposition):
        fields = [m.random() for _ in range(m.order)]

        def basic(step, symmetric):
            terms, power = [], m.ring.one
            for k, field in enumerate(fields, 1):
                power = power * step
                if k % 2 or not symmetric:
                    terms.append(m.scaled(field, m.power_of_h(k) * power))
            return m.exp(m.add(*terms))

        if isinstance(method, Composition):
            factors = [basic(x, True) for x in method.gamma]
        else:
            pairs = zip(method.alpha, method.beta, strict=True)
            factors = [f for x, y in pairs for f in (m.inverse(basic(-y, False)), basic(x, False))]
        return reduce(lambda y, x: m.times(x, y), factors, m.one()), m.exp(m.scaled(fields[0], m.h.h))
    fields = [m.random() for _ in range(4)]
    return linear_step(method, m, fields), linear_flow(m, fields)


def linear_step(method, m, fields):
    nodes = []
    for c in method.c:
        powers = [m.ring.one]
        for _ in fields[1:]:
            powers.append(powers[-1] * c)
        terms = [
            m.scaled(x, m.power_of_h(k) * p) for k, (x, p) in enumerate(zip(fields, powers, strict=True), 1)
        ]
        nodes.append(m.add(*terms))
    named = {}

    def term(t):
        if isinstance(t, Bracket):
            x, y = term(t.left), term(t.right)
            return m.add(m.times(x, y), m.scaled(m.times(y, x), -1))
        if isinstance(t, Product):
            return reduce(m.times, map(term, t.factors))
        return named[t] if isinstance(t, str) else nodes[t]

    def combined(combination):
        return m.add(*(m.scaled(term(t), x) for t, x in combination))

    for name, combination in method.elements:
        named[name] = combined(combination)
    transform = m.exp if method.transform == "exp" else m.cay
    return reduce(lambda y, x: m.times(transform(combined(x)), y), method.exponents, m.one())


def linear_flow(m, fields):
    """Y' = (X_1 + h X_2 + ...) Y, Y(0) = 1: coefficients of h^n by their recurrence."""
    flow = [[[[m.h.base.one if i == j else m.h.base.zero for j in range(SIZE)] for i in range(SIZE)]]]
    known = flow[0]
    for n in range(1, m.order + 1):
        new = [[m.ring.zero] * SIZE for _ in range(SIZE)]
        for k, field in enumerate(fields[:n], 1):
            for i in range(SIZE):
                for j in range(SIZE):
                    for p in range(SIZE):
                        new[i][j] = new[i][j] + field[i][p].coefficients[0] * known[n - k][p][j]
        known.append([[x * m.ring.rational(1, n) for x in row] for row in new])
    return [
        [m.h.from_coefficients(tuple(known[n][i][j] for n in range(m.order + 1))) for j in range(SIZE)]
        for i in range(SIZE)
    ]


def local_error_order(method, ring, order, seed=1):
    """The order that the local error of random matrices shows, at most ``order``."""
    m = Matrices(ring, order + 1, seed)
    step, flow = step_and_flow(method, m)
    return m.valuation(m.add(step, m.scaled(flow, -1))) - 1


def library():
    for name in available():
        if find(name).parent.name in FOLDERS:
            tableau = Tableau.load(find(name))
            claims = {c.label: c.order for c in tableau.claims.orders if c.label in WORD_FAMILIES}
            if name != "triple_jump6":  # a field of degree 15 costs minutes
                yield pytest.param(name, max(claims.values()), id=name)


@pytest.mark.parametrize(("name", "claimed"), list(library()))
def test_a_librarys_claims_are_the_order_of_the_local_error(name, claimed):
    tableau = Tableau.load(find(name))
    if tableau.name == "blanes_moan_rkn6":
        claimed = 4  # matrices know no quadratic part
    assert local_error_order(tableau.method, tableau.ring, claimed) == claimed


def order(family, method, ring=QQ, limit=9):
    found = families.get(family)
    for n in range(1, limit + 1):
        if not all(ring.is_zero(x) for x in found.residuals(method, ring, found.conditions(n))):
            return n - 1
    return limit


MISREADINGS = {
    "magnus4 with the other sign of the commutator": (
        "magnus4",
        lambda t: t.replace("[2,1]", "[1,2]"),
        "magnus",
        2,
    ),
    "cf_magnus4 with its nodes exchanged": (
        "cf_magnus4",
        lambda t: t.replace('c = ["1/2 - r/6", "1/2 + r/6"]', 'c = ["1/2 + r/6", "1/2 - r/6"]'),
        "cf_magnus",
        2,
    ),
    "magnus6 with one coefficient of its last bracket wrong": (
        "magnus6",
        lambda t: t.replace("-1/60", "-1/30"),
        "magnus",
        4,
    ),
    "magnus8 with the sign of one bracket's bracket wrong": (
        "magnus8",
        lambda t: t.replace('"[b,s1]" = "1/2"', '"[b,s1]" = "-1/2"'),
        "magnus",
        6,
    ),
    "fer6 with one coefficient of its last brackets wrong": (
        "fer6",
        lambda t: t.replace('1/360" }\nn', '1/300" }\nn'),
        "fer",
        5,
    ),
    "cayley6 without its fifth power": (
        "cayley6",
        lambda t: t.replace(', "a*a*a*a*a" = "1/120"', ""),
        "cayley",
        4,
    ),
    "fer4 with the other sign of its double commutator": (
        "fer4",
        lambda t: t.replace('"[s,[2,1]]" = "-r/24"', '"[s,[2,1]]" = "r/24"'),
        "fer",
        3,
    ),
    "cayley4 without its cubic term": (
        "cayley4",
        lambda t: t.replace(', "s*s*s" = "-1/12"', ""),
        "cayley",
        2,
    ),
    "McLachlan's composition with a wrong coefficient": (
        "mclachlan4",
        lambda t: t.replace("-2 + 10*r", "-2 + 9*r").replace("-23 - 20*r", "-23 - 18*r"),
        "composition",
        2,
    ),
    "ruth3 with its first two kicks exchanged": (
        "ruth3",
        lambda t: t.replace("7/24", "x").replace("3/4", "7/24").replace('"x"', '"3/4"'),
        "splitting",
        1,
    ),
}


@pytest.mark.parametrize("what", MISREADINGS)
def test_misread_methods_have_the_lower_order_that_their_local_error_shows(what):
    name, wrong, family, expected = MISREADINGS[what]
    text = find(name).read_text(encoding="utf-8")
    assert wrong(text) != text
    tableau = Tableau.loads(wrong(text))
    assert order(family, tableau.method, tableau.ring) == expected
    assert local_error_order(tableau.method, tableau.ring, expected) == expected


def test_a_composition_has_the_order_of_the_splitting_it_is_for_flows_of_two_parts(random_rational):
    family, splitting = families.get("composition"), families.get("splitting")
    for name in ("mclachlan4",):
        tableau = Tableau.load(find(name))
        as_splitting = tableau.read_as(("splitting",))
        assert order("composition", tableau.method, tableau.ring) == 4
        assert order("splitting", as_splitting, tableau.ring) == 4
    for _ in range(3):
        alpha, beta = (tuple(random_rational() for _ in range(2)) for _ in range(2))
        scale = QQ.one / sum((*alpha, *beta), QQ.zero)
        method = AdjointComposition(tuple(x * scale for x in alpha), tuple(x * scale for x in beta))
        assert order(family.name, method) == order(splitting.name, method.as_splitting())


def test_a_nystroem_splitting_of_order_six_has_that_order_where_t_is_quadratic():
    # x'' = -V'(x) in two dimensions, V of degree four: exact drifts and kicks over power series.
    tableau = Tableau.load(find("blanes_moan_rkn6"))
    assert nystroem_order(tableau.method, tableau.ring, 6) == 6
    assert nystroem_order(Tableau.load(find("ruth3")).method, QQ, 3) == 3
    assert nystroem_order(Tableau.load(find("strang")).method, QQ, 2) == 2


def force(x, y, one):
    """-grad V for V = x^2 y^2/2 + x^3/3 - 2 x y + y^3 + x/3."""
    return (
        -(x * y * y) - x * x + y * 2 - one / 3,
        -(x * x * y) + x * 2 - y * y * 3,
    )


def nystroem_order(method, ring, order):
    h = PowerSeries(ring, order + 1)
    q, p = [h.rational(1, 3), h.rational(-1, 2)], [h.rational(2, 5), h.rational(1, 7)]
    start = (list(q), list(p))
    for part, x in method.steps:
        if part == method.rkn:
            p = [a + f * (h.h * x) for a, f in zip(p, force(*q, h.one), strict=True)]
        else:
            q = [a + b * (h.h * x) for a, b in zip(q, p, strict=True)]
    exact_q, exact_p = start
    for _ in range(order + 1):  # Picard iteration gains a power of h each time
        velocity, slope = exact_p, force(*exact_q, h.one)
        exact_q = [a + integral(h, v) for a, v in zip(start[0], velocity, strict=True)]
        exact_p = [a + integral(h, f) for a, f in zip(start[1], slope, strict=True)]
    errors = [a - b for a, b in zip((*q, *p), (*exact_q, *exact_p), strict=True)]
    for n in range(order + 2):
        if any(h.base.is_zero(e.coefficients[n]) is False for e in errors):
            return n - 1
    return order + 1


def integral(h, x):
    shifted = (c * h.base.rational(1, n) for n, c in enumerate(x.coefficients[:-1], 1))
    return h.from_coefficients((h.base.zero, *shifted))
