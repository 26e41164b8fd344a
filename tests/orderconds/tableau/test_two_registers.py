"""Schemes with two registers: their expansion, and their recognition in tableaux of other forms."""

from __future__ import annotations

from dataclasses import replace

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from orderconds.checking import check, read
from orderconds.errors import TableauError
from orderconds.ring import QQ
from orderconds.tableau import CommutatorFree, Stage, Tableau
from orderconds.tableau.properties import low_storage
from orderconds.tableau.two_registers import TwoRegisters, second_exponent, two_registers

RATIONALS = st.fractions(-3, 3, max_denominator=7).map(lambda q: fmpq(q.numerator, q.denominator))
SCHEMES = st.integers(1, 6).flatmap(
    lambda s: st.tuples(
        st.lists(RATIONALS, min_size=s, max_size=s), st.lists(RATIONALS, min_size=s, max_size=s)
    )
)
CF = 'name = "m"\nfamily = "cf"\n'


def scheme(A: list[fmpq], B: list[fmpq]) -> TwoRegisters:
    return TwoRegisters((QQ.zero, *A[1:]), tuple(B))


def step(found: TwoRegisters, y: fmpq, f: list[fmpq]) -> list[fmpq]:
    """Return the values of Y, computed with two registers, if F is ``f`` at the stages (a vector space)."""
    k, values = QQ.zero, [y]
    for a, b, slope in zip(found.A, found.B, f, strict=True):
        k = a * k + slope
        values.append(values[-1] + b * k)
    return values


@settings(max_examples=25)
@given(SCHEMES)
def test_the_stages_are_the_values_of_the_second_register(
    coefficients: tuple[list[fmpq], list[fmpq]],
) -> None:
    found = scheme(*coefficients)
    f = [fmpq(2 * i * i - 7, i + 3) for i in range(found.s)]
    method = found.as_commutator_free(QQ).as_runge_kutta(QQ)
    rows = [sum((x * y for x, y in zip(row, f, strict=True)), fmpq(5)) for row in (*method.A, method.b)]
    assert rows == step(found, fmpq(5), f)


@settings(max_examples=25)
@given(SCHEMES)
def test_every_scheme_is_recognised_in_both_forms(coefficients: tuple[list[fmpq], list[fmpq]]) -> None:
    """A coefficient A_i that no increment contains is found as zero; the methods are equal all the same."""
    expanded = scheme(*coefficients).as_commutator_free(QQ)
    abelian = expanded.as_runge_kutta(QQ)
    on_group, on_space = two_registers(expanded, QQ), two_registers(abelian, QQ)
    assert on_group.scheme.as_commutator_free(QQ) == expanded
    assert on_space.scheme.as_commutator_free(QQ).as_runge_kutta(QQ) == abelian


@settings(max_examples=25)
@given(SCHEMES, st.data())
def test_one_changed_coefficient_is_another_scheme_or_none(
    coefficients: tuple[list[fmpq], list[fmpq]], data: st.DataObject
) -> None:
    method = scheme(*coefficients).as_commutator_free(QQ).as_runge_kutta(QQ)
    row = data.draw(st.integers(1, method.s))
    column = data.draw(st.integers(0, row - 1))
    rows = [list(x) for x in (*method.A, method.b)]
    rows[row][column] += 1
    changed = replace(method, A=tuple(map(tuple, rows[:-1])), b=tuple(rows[-1]))
    found = two_registers(changed, QQ)
    if found.holds:
        assert found.scheme.as_commutator_free(QQ).as_runge_kutta(QQ) == changed
    else:
        assert found.scheme is None
        assert found.reason


def test_products_from_the_start_value_are_recognised() -> None:
    """The same scheme in a file whose stages are products that begin at y0."""
    method = read("williamson3").method
    products = [Stage(None, method.from_start(x)) for x in (*method.stages, method.update)]
    found = two_registers(CommutatorFree(tuple(products[:-1]), products[-1]), QQ)
    assert found.holds
    assert [str(x) for x in found.scheme.A] == ["0", "-5/9", "-153/128"]
    assert [str(x) for x in found.scheme.B] == ["1/3", "15/16", "8/15"]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (
            'family = "rk"\nA = [[], ["1/2"], ["1/4", "0"]]\nb = ["0", "0", "1"]\n',
            "the increment of stage 2 contains k_1 (coefficient -1/4) but not k_2; in a 2N scheme, this "
            "increment can contain k_1 only together with k_2",
        ),
        (
            'family = "rk"\nA = [[], ["1/2"]]\nb = ["1/3", "0"]\n',
            "the increment of stage 2 contains k_1 (coefficient -1/6) but not k_2; in a 2N scheme, this "
            "increment can contain k_1 only together with k_2",
        ),
        ('family = "rk"\nA = [["1/2"]]\nb = ["1"]\n', "the first stage is not the start value"),
        (
            'family = "rk"\nA = [[], ["0", "1/2"]]\nb = ["0", "1"]\n',
            "the increment of stage 1 depends on k_2: the method is implicit",
        ),
        (
            'family = "cf"\n[[stage]]\n[[stage]]\nexp = [["1/2"], ["1/4"]]\n[update]\nexp = [["0", "1"]]\n',
            "no single exponential leads from stage 1 to stage 2",
        ),
        (
            'family = "cf"\n[[stage]]\n[[stage]]\nexp = [["1/2"]]\n[update]\nexp = [["0", "1"]]\n',
            "no single exponential leads from stage 2 to the update",
        ),
        (
            'family = "rk"\nA = [[], ["1/2"], ["0", "1/2"]]\nb = ["0", "0", "1"]\n',
            "in the increment of stage 3, k_1 has the coefficient 0, but a 2N scheme requires the "
            "coefficient 1/2",
        ),
    ],
)
def test_a_tableau_without_this_form_has_a_reason(text: str, reason: str) -> None:
    tableau = Tableau.loads('name = "m"\n' + text)
    found = two_registers(tableau.method, tableau.ring)
    assert (found.holds, found.reason) == (False, reason)
    assert check(tableau).low_storage.reason == reason


def test_rounded_decimals_decide_only_if_the_form_holds_for_all_of_their_values() -> None:
    assert low_storage(read("carpenter_kennedy4")).holds is True
    rounded = Tableau.loads(
        'name = "m"\nfamily = "rk"\nA = [[], ["0.5000~"], ["0.2500~", "0.3000~"]]\n'
        'b = ["0.1000~", "0.4000~", "0.5000~"]'
    )
    assert low_storage(rounded).holds is False
    exact = read("williamson3").abelian()
    digits = [
        [f'"{float(x.p) / float(x.q):.12f}~"' for x in row[:i]] for i, row in enumerate((*exact.A, exact.b))
    ]
    *rows, b = (f"[{', '.join(row)}]" for row in digits)
    near = Tableau.loads(f'name = "m"\nfamily = "rk"\nA = [{", ".join(rows)}]\nb = {b}')
    assert low_storage(near).holds is None
    assert check(near).undecided["low_storage"] == "rounded decimals"


def test_other_formats_have_no_such_property() -> None:
    assert low_storage(read("strang")) is None
    assert "low_storage" not in check("strang").properties


def test_a_false_claim_of_the_property_fails() -> None:
    text = 'name = "m"\nfamily = "rk"\nA = [[], ["1/2"]]\nb = ["0", "1"]\n[claims]\nrk = 2\nlow_storage = '
    assert check(Tableau.loads(text + "true")).verdict == "holds"
    assert check(Tableau.loads(text + "false")).verdict == "fails"


def test_a_denominator_that_may_be_zero_leaves_the_form_undecided() -> None:
    text = 'name = "m"\nfamily = "rk"\nA = [[], ["1/2"], ["1/2", "0.~"]]\nb = ["1/4", "1/4", "1/2"]'
    tableau = Tableau.loads(text)
    found = low_storage(tableau)
    assert found is not None
    assert found.holds is None
    assert found.scheme is None
    assert found.reason == "the coefficient of k_2 in the increment of stage 2 may be zero"
    assert check(tableau).low_storage.as_json() == {
        "holds": None,
        "space": "vector space",
        "reason": found.reason,
    }


PAIR = """
name = "pair"
family = "cf"
[low_storage]
A = ["0", "-1"]
B = ["1", "1/2"]
[embedded]
order = 1
from = %d
exp = [["1/2", "-1/2"]]
"""


def test_a_second_update_may_start_from_the_update():
    """Heun's method: the second update y1 + h/2 (F_1 - F_2) is that of Euler."""
    tableau = Tableau.loads(PAIR % 3)
    assert check(tableau, family="cf").embedded.orders["cf"] == 1
    second = tableau.embedded.update
    row = second_exponent(tableau.method, second, QQ)
    assert [str(x) for x in row] == ["1/2", "-1/2"]
    assert [str(sum(x)) for x in zip(*tableau.method.from_start(second), strict=True)] == ["1", "0"]
    from_stage = Tableau.loads(PAIR % 2)
    assert second_exponent(from_stage.method, from_stage.embedded.update, QQ) is None
    with pytest.raises(TableauError, match="from = 4"):
        Tableau.loads(PAIR % 4)
