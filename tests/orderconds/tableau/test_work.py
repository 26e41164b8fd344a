"""Counts of a step against what the sources say."""

from __future__ import annotations

import pytest

from orderconds import check
from orderconds.checking import read
from orderconds.families import get
from orderconds.tableau import Tableau
from orderconds.tableau.work import Work


@pytest.mark.parametrize(
    ("name", "family", "cutoff", "expected"),
    [
        ("cf4", "cf", None, Work(4, 5, 0)),  # Celledoni, Marthinsen and Owren 2003: five exponentials
        ("cf3", "cf", None, Work(3, 3, 0)),  # one saved by reuse
        ("carpenter_kennedy4", "cf", None, Work(5, 5, 0)),  # one a stage
        ("cg3", "cg", None, Work(3, 6, 0)),
        ("euler", "cg", None, Work(1, 1, 0)),
        ("rk4", "rkmk", 0, Work(4, 4, 0)),
        ("rk4", "rkmk", 2, Work(4, 4, 6)),
        ("rk4", "rkmk", 3, Work(4, 4, 6)),  # B_3 = 0
        ("rk4", "rk", None, Work(4)),
        ("magnus2", "magnus", None, Work(1, 1, 0)),
        ("magnus4", "magnus", None, Work(2, 1, 1)),
        ("magnus6", "magnus", None, Work(3, 1, 3)),  # Blanes, Casas, Oteo and Ros 2009: three commutators
        ("magnus8", "magnus", None, Work(4, 1, 6)),  # and six
        ("fer4", "fer", None, Work(2, 2, 2)),
        ("cf_magnus6", "cf_magnus", None, Work(3, 5, 0)),
        ("cf_magnus8_8", "cf_magnus", None, Work(4, 8, 0)),  # as many exponentials as in Hofstaetter 2019
        ("cf_magnus8_11", "cf_magnus", None, Work(4, 11, 0)),
        ("cayley6", "cayley", None, Work(3, 1, 3)),
    ],
)
def test_counts(name: str, family: str, cutoff: int | None, expected: Work) -> None:
    options = {} if cutoff is None else {"cutoff": cutoff}
    assert get(family, **options).work(read(name)) == expected


def test_a_last_stage_that_is_the_next_first_is_not_evaluated_again() -> None:
    text = (
        'name = "t"\nfamily = "rk"\nA = [[], ["1/2"], ["0", "3/4"], ["2/9", "1/3", "4/9"]]\n'
        'b = ["2/9", "1/3", "4/9", "0"]\n'
    )
    assert get("rk").work(Tableau.loads(text)) == Work(3)


def test_equal_exponents_are_one_exponential() -> None:
    text = 'name = "t"\nfamily = "rk"\nA = [[], ["1/2"], ["1/2", "1/2"]]\nb = ["1/2", "1/4", "1/4"]\n'
    assert get("cg").work(Tableau.loads(text)) == Work(3, 4, 0)


def test_the_report_has_the_counts_of_each_family_checked() -> None:
    record = check("rk4", family="rkmk(1)").as_json()
    assert record["work"] == {"rkmk(1)": {"evaluations": 4, "exponentials": 4, "brackets": 3}}


@pytest.mark.parametrize(
    ("name", "evaluated", "exponentials"),
    [("zonneveld4", 4, 4), ("verner6", 7, 7), ("dormand_prince5", 6, 6), ("verner9_efficient", 15, 15)],
)
def test_a_stage_that_only_the_estimate_uses_costs_nothing(
    name: str, evaluated: int, exponentials: int
) -> None:
    work = get("rkmk", cutoff=0).work(read(name))
    assert work is not None
    assert (work.evaluations, work.exponentials) == (evaluated, exponentials)


def test_an_exponential_of_an_unused_stage_of_a_commutator_free_method_is_not_counted() -> None:
    text = """
name = "t"
family = "cf"
[[stage]]
[[stage]]
exp = [["1/2"]]
[[stage]]
from = 2
exp = [["0", "1/3"], ["0", "1/5"]]
[update]
exp = [["0", "1"]]
"""
    work = get("cf").work(Tableau.loads(text))
    assert work == Work(2, 2, 0)
