from __future__ import annotations

from fractions import Fraction

import pytest

from codegen.ir.number import Number
from orderconds.tableau import Tableau


def field():
    """1/2 + sqrt(3)/6 and its conjugate, of one field."""
    text = 'name = "x"\nfamily = "rk"\nA = [["1/4"]]\nb = ["%s"]\n'
    tableau = Tableau.loads(text % "1/2 + sqrt(3)/6")
    x = Number(tableau.ring, tableau.method.b[0])
    return x, Number.rational(1) - x


def ball():
    tableau = Tableau.loads('name = "x"\nfamily = "rk"\nA = [["0"]]\nb = ["0.81772~"]\n')
    return Number(tableau.ring, tableau.method.b[0])


def test_rationals_are_exact():
    third = Number.rational(1, 3)
    assert third + third + third == Number.rational(1)
    assert (third * Number.rational(3)).is_one
    assert (third - third).is_zero
    assert (third / third).is_one
    assert (-third).fraction() == Fraction(-1, 3)


def test_a_double_is_rounded_once():
    assert float(Number.rational(1, 10)) == 0.1
    assert float(Number.rational(2**53 + 1, 2**53)) == 1.0
    assert float(Number.rational(10**400 + 1, 10**400)) == 1.0


def test_algebraic_numbers_add_up_exactly():
    x, y = field()
    assert (x + y) == Number.rational(1) or (x + y - Number.rational(1)).is_zero
    assert (x * y - Number.rational(1, 6)).is_zero
    assert float(x) == pytest.approx(0.788675134594813, abs=1e-15)


def test_equal_algebraic_numbers_are_equal_and_hash_alike():
    (x, y), (z, _) = field(), field()
    assert x == z
    assert hash(x) == hash(z)
    assert x != y


def test_a_ball_never_proves_zero_but_cancels_with_itself():
    x = ball()
    assert not x.is_zero
    assert (x - x).is_zero
    assert (x + -x).is_zero
    assert (x / x).is_one


def test_a_factor_one_widens_no_ball():
    x = ball()
    assert x * Number.rational(1) == x
    assert Number.rational(1) * x == x


def test_only_rationals_have_a_fraction():
    with pytest.raises(TypeError, match="not stored as a rational"):
        field()[0].fraction()


def test_numbers_of_two_fields_do_not_meet():
    text = 'name = "x"\nfamily = "rk"\nA = [["0"]]\nb = ["sqrt(2)"]\n'
    tableau = Tableau.loads(text)
    with pytest.raises(TypeError, match="two different rings"):
        field()[0] + Number(tableau.ring, tableau.method.b[0])


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1/2", Fraction(1, 2)),
        ("+.5", Fraction(1, 2)),
        ("3.", Fraction(3)),
        ("-3e-2", Fraction(-3, 100)),
        ("1E308", Fraction(10**308)),
        ("0e-999", Fraction(0)),
    ],
)
def test_typed_numbers_are_read_exactly(text, value):
    assert Number.read(text).fraction() == value


@pytest.mark.parametrize(
    "text", ["", ".", "1/0", "1 2", "1_0", "\u0661", "1e400", "1e-320", "1e99999999", "inf"]
)
def test_what_is_no_number_or_none_that_a_double_holds_is_refused(text):
    with pytest.raises(ValueError, match="a rational number"):
        Number.read(text)


def test_zero_has_no_inverse():
    with pytest.raises(ZeroDivisionError):
        Number.rational(0) / Number.rational(0)
