"""The order to which a method is symmetric."""

from fractions import Fraction

import pytest

from orderconds import Tableau, check
from orderconds.checking.symmetry import symmetry_order
from orderconds.tableau import find


def order_of(name):
    symmetry = check(name).symmetry
    return symmetry.order, symmetry.at_least


@pytest.mark.parametrize(
    ("name", "order"),
    [("euler", 1), ("heun", 3), ("kutta3", 3), ("rk4", 5), ("cf3", 3), ("cf4", 5)],
)
def test_a_method_is_symmetric_at_least_to_the_odd_number_that_its_order_implies(name, order):
    assert order_of(name) == (order, False)
    assert check(name).effective_symmetry is None


def test_a_symmetric_method_is_symmetric_to_every_order():
    assert order_of("gauss2") == (None, False)
    assert order_of("vcf_gauss2") == (None, False)


def test_an_effectively_symmetric_method_is_recognised_on_vector_spaces_and_on_groups():
    report = check("ees25")
    assert report.orders[0].order == 2
    assert (report.symmetry.family, report.effective_symmetry) == ("cf", 5)
    assert report.as_json()["symmetry"] == {
        "family": "cf",
        "order": 5,
        "at_least": False,
        "certificate": "exact",
    }


EES = 'name = "m"\nfamily = "rk"\nA = [[], ["1/3"], ["-5/48", "15/16"]]\nb = ["1/10", "1/2", "2/5"]\n'


def test_a_wrong_coefficient_costs_the_symmetry():
    assert symmetry_order(Tableau.loads(EES), False).order == 5
    assert symmetry_order(Tableau.loads(EES.replace("15/16", "14/16")), False).order == 1


def test_the_order_is_the_power_of_the_defect_of_a_nonlinear_equation():
    """y' = y^2 + 1, whose steps are polynomials in h: the defect of the two steps begins at h^6."""
    assert Tableau.load(find("ees25")).method.s == 3
    A, B = (
        [Fraction(0), Fraction(-7, 15), Fraction(-35, 32)],
        [Fraction(1, 3), Fraction(15, 16), Fraction(2, 5)],
    )

    def step(y, h):
        k = Fraction(0)
        for a, b in zip(A, B, strict=True):
            k = a * k + h * (y * y + 1)
            y = y + b * k
        return y

    y = Fraction(1, 2)
    defects = [abs(step(step(y, h), -h) - y) / h**6 for h in (Fraction(1, 1000), Fraction(1, 10000))]
    assert defects[0] == pytest.approx(defects[1], rel=0.05)
    assert defects[1] > 0
