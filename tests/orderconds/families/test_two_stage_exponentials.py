"""Two stages and order four on groups need four exponentials: the proof in docs/reference/discoveries.md.

The partial products of exponentials form a tree with the root y0. With at most three exponentials there are
four shapes in which the path to y1 has at least two exponentials. Each violates the condition of the
word . [.].
"""

import pytest

from orderconds import Tableau, families
from orderconds.series.lie_butcher import exact_value
from orderconds.tableau import find

WORD = b"\0\0\1"
"""The word . [.], in which the vertex acts first."""

GAUSS = (("1/4", "1/4 - sqrt(3)/6"), ("1/4 + sqrt(3)/6", "1/4"))
DIFFERENCE = ("sqrt(3)/6", "sqrt(3)/6")


def row(values, sign=""):
    return "[" + ", ".join(f'"{sign}({x})"' for x in values) + "]"


def rest(first):
    return "[" + ", ".join(f'"1/2 - ({x})"' for x in first) + "]"


def residual(update):
    stages = "".join(f"[[stage]]\nexp = [{row(values)}]\n" for values in GAUSS)
    text = f'name = "m"\nfamily = "cf"\n{stages}[update]\nexp = [{", ".join(update)}]\n'
    tableau = Tableau.loads(text)
    series, ring, exact = (
        families.get("cf").series(tableau.method, tableau.ring),
        tableau.ring,
        exact_value(WORD),
    )
    assert ring.is_zero(series(b"\0") - ring.one) is True
    assert ring.is_zero(series(b"\0\1") - ring.rational(1, 2)) is True
    return ring.text(series(WORD) - ring.rational(exact.numerator, exact.denominator))


@pytest.mark.parametrize("first", [0, 1])
def test_a_stage_on_the_way_of_an_update_with_two_exponentials_costs_order_three(first):
    assert residual([row(GAUSS[first]), rest(GAUSS[first])]) == "-1/24"


@pytest.mark.parametrize(
    ("first", "sign", "expected"), [(0, "", "-1/24 + sqrt(3)/72"), (1, "-", "-1/24 - sqrt(3)/72")]
)
def test_both_stages_on_the_way_of_an_update_with_three_exponentials_cost_order_three(first, sign, expected):
    assert residual([row(GAUSS[first]), row(DIFFERENCE, sign), rest(GAUSS[1 - first])]) == expected


def test_one_exponential_in_the_update_costs_order_three():
    assert residual([row(("1/2", "1/2"))]) == "-1/12"


def test_the_method_of_the_library_has_four_exponentials():
    tableau = Tableau.load(find("vcf_gauss2"))
    work = families.get("vcf").work(tableau)
    assert work is not None
    assert work.exponentials == 4
