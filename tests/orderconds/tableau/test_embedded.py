"""Embedded methods: their stages are the method's own, their orders are computed, and equal rows are
refused."""

from __future__ import annotations

import pytest

from orderconds import families
from orderconds.checking import check, family_order
from orderconds.errors import TableauError
from orderconds.tableau import Claims, CommutatorFree, EmbeddedUpdate, RungeKutta, Tableau, dumps, find
from tests.exact_steps import GROUPS, local_error_power

PAIRS = {
    "cf3": ("cf", 3, 2),
    "cf43": ("cf", 4, 3),
    "luescher3": ("cf", 3, 2),
    "cg3": ("cg", 3, 2),
    "cg43": ("cg", 4, 3),
}
"""Name: family, order, embedded order."""


def tableau(name: str) -> Tableau:
    return Tableau.load(find(name))


def lower(name: str) -> Tableau:
    found = tableau(name).lower()
    assert found is not None
    return found


@pytest.mark.parametrize("name", PAIRS)
def test_a_pair_has_its_orders_by_the_conditions_and_by_the_local_error(name: str) -> None:
    family, order, embedded = PAIRS[name]
    report = check(tableau(name))
    assert report.verdict == "holds"
    assert next(f.order for f in report.orders if f.family == family) == order
    assert report.embedded is not None
    assert report.embedded.orders[family] == report.embedded.claimed == embedded
    powers = {local_error_power(lower(name), family, None, group, embedded + 1) for group in GROUPS.values()}
    assert powers - {None} == {embedded + 1}


@pytest.mark.parametrize("name", PAIRS)
def test_the_claims_of_a_method_are_no_claims_of_its_embedded_method(name: str) -> None:
    assert tableau(name).claims.orders
    assert lower(name).claims == Claims()
    assert "claims" not in dumps(lower(name))


@pytest.mark.parametrize("name", PAIRS)
def test_an_error_estimate_is_not_zero_on_vector_spaces(name: str) -> None:
    main, other = tableau(name).abelian(), lower(name).abelian()
    assert main.A == other.A
    assert any(x != y for x, y in zip(main.b, other.b, strict=True))


def test_the_embedded_update_of_cf43_shares_its_first_exponential_and_is_free_but_for_another() -> None:
    found = tableau("cf43")
    assert isinstance(found.method, CommutatorFree)
    assert isinstance(found.embedded, EmbeddedUpdate)
    update = found.method.from_start(found.method.update)
    assert update[0] == found.embedded.update.exponentials[0]
    assert len(found.embedded.update.exponentials) == 2


@pytest.mark.parametrize("t", ["1/10", "1/6", "1/3"])
def test_every_part_that_the_fifth_stage_takes_leaves_order_3(t: str) -> None:
    text = find("cf43").read_text(encoding="utf-8")
    changed = text.replace('"0", "1/4"]]', f'"1/4 - {t}", "{t}"]]')
    assert changed != text
    found = Tableau.loads(changed).lower()
    assert found is not None
    assert family_order(found, families.get("cf")).order == 3


def test_weights_of_order_3_on_the_five_stages_of_cg4_are_those_of_order_4() -> None:
    """The linear conditions leave one direction d; q(b + t d) = q(b) + t^2 q(d) with q(d) not zero."""
    found = tableau("cg4")
    assert isinstance(found.method, RungeKutta)
    ring, b, c, s = found.ring, found.method.b, found.method.c, 5
    nested = [sum((a * c[j] for j, a in enumerate(row)), ring.zero) for row in found.method.A]
    direction = (c[2] - c[3], ring.zero, ring.one, -ring.one, c[3] - c[2])
    for row in ([ring.one] * s, c, [x * x for x in c], nested):
        assert ring.is_zero(sum((x * y for x, y in zip(row, direction, strict=True)), ring.zero))

    def q(u, v):  # type: ignore[no-untyped-def]
        own = sum((u[i] * c[i] * v[i] for i in range(s)), ring.zero)
        return own + 2 * sum((u[i] * c[i] * v[j] for j in range(s) for i in range(j)), ring.zero)

    assert ring.is_zero(q(b, direction) + q(direction, b))
    assert not ring.is_zero(q(direction, direction))


SAME = {
    "spelled alike": '[["1/4", "1/6", "1/6", "-1/12"], ["-1/12", "1/6", "1/6", "1/4"]]',
    "a factor split": '[["1/8", "1/12", "1/12", "-1/24"], ["1/8", "1/12", "1/12", "-1/24"], '
    '["-1/12", "1/6", "1/6", "1/4"]]',
    "there and back": '[["1"], ["-1"], ["1/4", "1/6", "1/6", "-1/12"], [], ["-1/12", "1/6", "1/6", "1/4"]]',
}


@pytest.mark.parametrize("product", SAME.values(), ids=SAME)
def test_an_embedded_update_that_is_the_update_is_refused(product: str) -> None:
    text = (
        find("cf4")
        .read_text(encoding="utf-8")
        .replace("[claims]", f"[embedded]\norder = 3\nexp = {product}\n[claims]")
    )
    with pytest.raises(TableauError, match="embedded: an embedded method that is equal to the method itself"):
        Tableau.loads(text)


def test_an_update_with_its_factors_exchanged_is_another() -> None:
    text = find("cf4").read_text(encoding="utf-8")
    rows = '[["-1/12", "1/6", "1/6", "1/4"], ["1/4", "1/6", "1/6", "-1/12"]]'
    found = Tableau.loads(text.replace("[claims]", f"[embedded]\norder = 2\nexp = {rows}\n[claims]"))
    assert check(found).verdict == "holds"


MALFORMED = {
    "a stage that is not there": ("from = 6", "embedded: from = 6"),
    "a row too long": ('exp = [["1", "0", "0", "0", "0"]]', r"embedded.exp\[1\]: 5 entries"),
    "an unknown key": ("b = []", "embedded: unknown key 'b'; expected one of exp, from, order"),
}


@pytest.mark.parametrize(("line", "message"), MALFORMED.values(), ids=MALFORMED)
def test_a_malformed_embedded_update_is_refused_by_name(line: str, message: str) -> None:
    text = (
        find("cf4")
        .read_text(encoding="utf-8")
        .replace("[claims]", f"[embedded]\norder = 3\n{line}\n[claims]")
    )
    with pytest.raises(TableauError, match=message):
        Tableau.loads(text)


@pytest.mark.parametrize("name", PAIRS)
def test_a_pair_reads_back_the_same(name: str) -> None:
    found = tableau(name)
    again = Tableau.loads(dumps(found))
    assert (again.method, again.embedded, again.claims) == (found.method, found.embedded, found.claims)
