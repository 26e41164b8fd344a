"""Exact orders of published methods, and of the mistakes people make with them."""

from fractions import Fraction

import pytest

from orderconds import families
from orderconds.errors import InputError, UnknownName, ZeroWeight
from orderconds.ring import QQ
from orderconds.tableau import RungeKutta, Tableau, find

GAUSS = {
    2: """
        A = [["1/4", "1/4-sqrt(3)/6"], ["1/4+sqrt(3)/6", "1/4"]]
        b = ["1/2", "1/2"]
        """,
    3: """
        A = [["5/36", "2/9-sqrt(15)/15", "5/36-sqrt(15)/30"],
             ["5/36+sqrt(15)/24", "2/9", "5/36-sqrt(15)/24"],
             ["5/36+sqrt(15)/30", "2/9+sqrt(15)/15", "5/36"]]
        b = ["5/18", "4/9", "5/18"]
        """,
}


def gauss(stages):
    head = f'name = "gauss{stages}"\nfamily = "rk"\nsource = "HLW Table II.1.1"\nbibtex = "hlw"\n'
    tableau = Tableau.loads(head + GAUSS[stages], f"gauss{stages}")
    return tableau.method, tableau.ring


def order(name, method, ring=QQ, *, every=False, limit=7):
    family = families.get(name)
    for n in range(1, limit + 1):
        conditions = family.all_conditions(n) if every else family.conditions(n)
        if not all(ring.is_zero(x) for x in family.residuals(method, ring, conditions)):
            return n - 1
    return limit


ORDERS = {
    "euler": {"rk": 1, "sprk": 1, "cg": 1, "cf": 1, "rkmk(0)": 1, "rkmk": 1},
    "midpoint": {"rk": 2, "sprk": 2, "cg": 2, "rkmk(0)": 2, "rkmk": 2},
    "heun": {"rk": 2, "sprk": 2, "cg": 2, "rkmk(0)": 2},
    "kutta3": {"rk": 3, "sprk": 3, "cg": 2, "rkmk(0)": 2, "rkmk(1)": 3, "rkmk(2)": 3},
    "rk4": {"rk": 4, "sprk": 4, "cg": 2, "rkmk(0)": 2, "rkmk(1)": 3, "rkmk(2)": 4, "rkmk(3)": 4, "rkmk": 4},
    "cg3": {"rk": 3, "cg": 3, "cf": 3, "rkmk(0)": 2, "rkmk(1)": 3},
    "cg3b": {"rk": 3, "cg": 3, "cf": 3},
    "cg3 with its third row exchanged": {"rk": 2, "cg": 2},
    "cg3 with b reversed": {"cg": 1},
}


@pytest.mark.parametrize(
    ("name", "family"), [(name, family) for name, all_ in ORDERS.items() for family in all_]
)
def test_published_tableaux_have_exactly_their_orders(tableaux, name, family):
    expected = ORDERS[name][family]
    assert order(family, tableaux[name]) == expected
    assert order(family, tableaux[name], every=True, limit=5) == expected


@pytest.mark.parametrize(("name", "expected"), [("cf3", 3), ("cf4", 4), ("cf4 with its factors swapped", 2)])
def test_commutator_free_methods_have_exactly_their_orders(commutator_free, name, expected):
    assert order("cf", commutator_free[name]) == expected
    assert order("cf", commutator_free[name], every=True, limit=5) == expected


def test_attaching_a_row_in_reverse_order_of_application_leaves_cg3_at_three(tableaux):
    # Only the order in which the exponentials of a row act is reversed, as a commutator-free method.
    method = tableaux["cg3"].as_crouch_grossman(QQ)
    reversed_rows = type(method)(
        tuple(type(stage)(stage.start, stage.exponentials[::-1]) for stage in method.stages), method.update
    )
    assert order("cf", reversed_rows) == 3


@pytest.mark.parametrize(
    ("stages", "expected"),
    [
        (2, {"rk": 4, "sprk": 4, "cg": 2, "rkmk(0)": 2, "rkmk(1)": 3, "rkmk(2)": 4, "rkmk": 4}),
        (
            3,
            {
                "rk": 6,
                "sprk": 6,
                "cg": 2,
                "rkmk(0)": 2,
                "rkmk(1)": 3,
                "rkmk(2)": 5,
                "rkmk(3)": 5,
                "rkmk(4)": 6,
            },
        ),
    ],
)
def test_gauss_methods_have_order_twice_their_stages_and_munthe_kaas_order_min_p_r_plus_2(stages, expected):
    method, ring = gauss(stages)
    assert {family: order(family, method, ring) for family in expected} == expected


def test_rk4_with_one_weight_off_by_5e_11_has_order_zero(tableaux):
    method = tableaux["rk4"]
    moved = RungeKutta(method.A, (method.b[0] + QQ.rational(5, 10**11), *method.b[1:]))
    assert order("rk", moved) == 0


def test_a_zero_weight_is_named_where_the_family_divides_by_it(tableaux):
    method = RungeKutta(tableaux["heun"].A, (QQ.zero, QQ.one))
    family = families.get("sprk")
    with pytest.raises(ZeroWeight, match="b_1 = 0"):
        family.evaluate(method, QQ, family.conditions(2))


def test_unknown_families_and_options_are_refused_with_the_nearest_name():
    with pytest.raises(UnknownName, match="did you mean 'rkmk'"):
        families.get("rkmc")
    with pytest.raises(InputError, match="no option"):
        families.get("cg", cutoff=1)
    with pytest.raises(InputError, match="has no options"):
        families.get("cg(1)")
    with pytest.raises(InputError, match="cutoff"):
        families.get("rkmk", cutoff=-1)


def test_families_are_labelled_with_their_options():
    assert families.get("rkmk", cutoff=1).label() == families.get("rkmk(1)").label() == "rkmk(1)"
    assert families.get("rkmk").label() == "rkmk"


def library_method(name):
    tableau = Tableau.load(find(name))
    return tableau.method, tableau.ring


def with_each_row_reversed(method):
    """The same coefficients attached to the stages in reverse, within each row."""
    rows = [row[:i][::-1] + row[i:] for i, row in enumerate(method.A)]
    return RungeKutta(tuple(rows), method.b)


def test_owren_and_marthinsens_method_has_order_four_and_its_misreadings_less():
    method, ring = library_method("cg4")
    assert order("cg", method, ring) == order("rk", method, ring) == 4
    assert order("cg", with_each_row_reversed(method), ring) <= 2
    assert order("cg", RungeKutta(method.A, method.b[::-1]), ring) <= 2
    read = method.as_crouch_grossman(ring)
    backwards = tuple(type(stage)(stage.start, stage.exponentials[::-1]) for stage in read.stages)
    assert order("cf", type(read)(backwards, read.update), ring) == 3


def test_attaching_each_row_of_cg3_in_reverse_leaves_order_two():
    method, ring = library_method("cg3")
    assert order("cg", with_each_row_reversed(method), ring) == 2


def collocation(nodes):
    """The collocation tableau of rational nodes: Lagrange polynomials integrated (HLW II.1, Theorem 1.4)."""
    lagrange = []
    for node in nodes:
        polynomial = [Fraction(1)]
        for other in nodes:
            if other != node:
                raised, lowered = [Fraction(0), *polynomial], [*polynomial, Fraction(0)]
                polynomial = [(x - other * y) / (node - other) for x, y in zip(raised, lowered, strict=True)]
        lagrange.append(polynomial)

    def integral(polynomial, end):
        value = sum(x * end ** (k + 1) / (k + 1) for k, x in enumerate(polynomial))
        return QQ.rational(value.numerator, value.denominator)

    A = tuple(tuple(integral(p, node) for p in lagrange) for node in nodes)
    return RungeKutta(A, tuple(integral(p, Fraction(1)) for p in lagrange))


def test_munthe_kaas_order_of_a_tableau_of_order_eight_is_r_plus_two():
    # Seven equidistant nodes are symmetric, so that collocation has order 8, exactly over Q.
    method = collocation([Fraction(k, 6) for k in range(7)])
    found = {r: order(f"rkmk({r})", method, limit=8) for r in range(6)}
    assert found == {0: 2, 1: 3, 2: 5, 3: 5, 4: 7, 5: 7}
    assert order("rk", method, limit=9) == 8
