"""A family in a file of its own, registered with one call, is known to every command."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from fractions import Fraction
from importlib import metadata
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from orderconds import Tableau, check, derive, families
from orderconds.checking import claimable_families
from orderconds.cli import program
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError, UnknownName
from orderconds.families import Family, registry
from orderconds.families.base import expect
from orderconds.formula import coefficient, index_sum, product
from orderconds.proof.implications import consequences
from orderconds.ring.protocol import Element, Ring
from orderconds.solve.solver import Order, solve
from orderconds.solve.spec import Spec
from orderconds.stage_expansion import expand_stages
from orderconds.tableau import Method, RungeKutta
from orderconds.tableau.work import Work


class Quadrature(Family):
    """The rule sum_i b_i f(c_i) for the integral of f: one condition an order."""

    name = "quadrature"
    description = "Quadrature rules: nodes c_i and weights b_i."
    formats = ("rk",)
    unknowns = "rk"

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        powers = [coefficient("c", "i")] * (order - 1)
        formula = index_sum(("i",), (), product(coefficient("b", "i"), *powers))
        return (OrderCondition(self.label(), order, f"t^{order - 1}", formula, Fraction(1, order), order),)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        tableau = expect(method, RungeKutta)
        values = []
        for condition in conditions:
            total = ring.zero
            for b, c in zip(tableau.b, tableau.c, strict=True):
                for _ in range(condition.order - 1):
                    b = b * c
                total = total + b
            values.append(total)
        return tuple(values)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Quadrature | None:
        return cls() if isinstance(tableau.method, RungeKutta) else None

    def work(self, tableau: Tableau) -> Work | None:
        return Work(len(tableau.abelian().b))


@pytest.fixture(autouse=True)
def registered() -> Iterator[None]:
    families.register(Quadrature)
    yield
    families.unregister("quadrature")


def run(*args: str) -> Result:
    return CliRunner().invoke(program, args)


RADAU = 'name = "r"\nfamily = "rk"\nA = [[], ["1/3", "1/3"]]\nb = ["1/4", "3/4"]\n[claims]\nrk = 3\n'


def test_its_conditions_are_derived() -> None:
    assert [str(c) for c in derive("quadrature", 3).conditions] == [
        "sum_i b_i = 1",
        "sum_i b_i c_i = 1/2",
        "sum_i b_i c_i^2 = 1/3",
    ]
    record = json.loads(run("derive", "quadrature", "--order", "2", "--json").stdout)
    assert (record["family"], record["counts"]) == ("quadrature", [1, 1])


def test_its_conditions_are_expanded_in_stages() -> None:
    expanded = expand_stages(derive("quadrature", 2), 2, explicit=True).conditions
    assert [str(c) for c in expanded] == ["b_1 + b_2 = 1", "b_2 a_21 = 1/2"]


def test_an_order_is_found_and_its_cost_counted() -> None:
    (found,) = check("gauss2", family="quadrature").orders
    assert (found.order, found.certificate, found.failing[0].condition.tree) == (4, "exact", "t^4")
    assert check("gauss2", family="quadrature").work == {"quadrature": Work(2)}


def test_it_is_a_claim_in_files(tmp_path: Path) -> None:
    file = tmp_path / "r.toml"
    file.write_text(RADAU + "quadrature = 3\n")
    assert run("check", str(file)).exit_code == 0
    file.write_text(RADAU + "quadrature = 2\n")
    result = run("check", str(file), "--json")
    (record,) = json.loads(result.stdout)
    assert (result.exit_code, record["orders"]["quadrature"]["order"]) == (1, 3)


def test_a_complete_file_claims_it() -> None:
    tableau = Tableau.loads(RADAU)
    assert "quadrature" in [family.name for family in claimable_families(tableau)]
    assert any("quadrature" in claim for claim in check(tableau, complete=True).broken_claims)


def test_a_search_finds_its_methods_and_claims_the_order() -> None:
    found = solve(Order("quadrature", 4, Spec(stages=2, symmetric=True))).solution
    assert found is not None
    assert found.tableau.claims.order("quadrature") == 4
    (order,) = check(found.tableau, family="quadrature").orders
    assert order.order >= 4


def test_a_search_proves_that_there_is_no_method() -> None:
    outcome = solve(Order("quadrature", 2, Spec(stages=1, explicit=True)))
    assert outcome.none is not None
    assert outcome.none.reason == "1 = 0 is false"


def test_it_is_listed_last_with_its_description() -> None:
    listed = json.loads(run("list", "families", "--json").stdout)["families"]
    assert listed[-1] == {"name": "quadrature", "about": Quadrature.description}
    assert families.names()[-1] == "quadrature"


def test_theorems_of_a_registered_family_are_used() -> None:
    class Stronger(Quadrature):
        name = "stronger"
        implies = {"cg": "an example"}  # noqa: RUF012

    families.register(Stronger)
    try:
        assert consequences([("stronger", 3)])["rk"] == 3
    finally:
        families.unregister("stronger")


def test_a_family_that_was_forgotten_is_unknown() -> None:
    families.unregister("quadrature")
    with pytest.raises(UnknownName, match="unknown family 'quadrature'"):
        families.get("quadrature")
    assert run("derive", "quadrature", "--order", "2").exit_code == 2
    families.register(Quadrature)


@pytest.mark.parametrize("name", ["rkmk(-1)", "rk-mk"])
def test_an_unknown_name_is_quoted_as_it_was_given(name: str) -> None:
    with pytest.raises(UnknownName) as refused:
        families.get(name)
    assert refused.value.found == f"unknown family {name!r}"


@pytest.mark.parametrize(
    ("attributes", "message"),
    [
        ({"name": ""}, "no name"),
        ({"description": ""}, "no description"),
        ({"formats": ()}, "no formats"),
        ({"name": "Capital"}, "the name 'Capital'"),
        ({"name": "rk"}, "another family has the name 'rk'"),
        ({}, "another family has the name 'quadrature'"),
    ],
)
def test_a_family_needs_a_free_name_a_description_and_formats(
    attributes: dict[str, object], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        families.register(type("Another", (Quadrature,), attributes))
    assert families.family_class("quadrature") is Quadrature


def test_registering_the_same_class_again_changes_nothing() -> None:
    before = families.names()
    assert families.register(Quadrature) is Quadrature
    assert families.names() == before


def package(folder: Path, name: str, target: str) -> None:
    (folder / "installed_family.py").write_text(
        "from orderconds.families.rk import RungeKuttaFamily\n\n\n"
        "class Installed(RungeKuttaFamily):\n"
        '    name, description = "installed", "Of another package."\n'
    )
    info = folder / "installed_family-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: installed-family\nVersion: 1\n")
    (info / "entry_points.txt").write_text(f"[orderconds.families]\n{name} = {target}\n")


def test_the_family_of_an_installed_package_is_found_by_its_entry_point(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package(tmp_path, "installed", "installed_family:Installed")
    monkeypatch.syspath_prepend(tmp_path)
    listed = json.loads(run("list", "families", "--json").stdout)["families"]
    assert {"name": "installed", "about": "Of another package."} in listed
    (found,) = json.loads(run("check", "rk4", "--family", "installed", "--json").stdout)
    assert found["orders"]["installed"]["order"] == 4
    families.unregister("installed")


@pytest.mark.parametrize(
    ("name", "target", "message"),
    [
        ("absent", "installed_family:Absent", "cannot load the family"),
        ("other", "installed_family:Installed", "a subclass of Family with the name 'other'"),
    ],
)
def test_an_entry_point_that_is_no_family_of_that_name_is_an_error(
    name: str, target: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package(tmp_path, name, target)
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(InputError, match=message):
        families.get(name)


def test_entry_points_are_not_scanned_for_known_names(monkeypatch: pytest.MonkeyPatch) -> None:
    def scanned(**_: str) -> None:
        raise AssertionError("entry points were scanned")

    monkeypatch.setattr(metadata, "entry_points", scanned)
    assert families.get("vcg").label() == "vcg"
    assert families.get("quadrature").label() == "quadrature"


@pytest.mark.parametrize("name", families.with_conditions())
def test_a_built_in_family_is_complete_without_options(name: str) -> None:
    family = families.get(name)
    assert family.label() == name
    assert all(condition.family == name for condition in family.conditions(1))
    assert set(family.implies) <= set(families.names())
    assert all(family.implies.values())
    assert {family.abelian, family.low_order} <= {None, *families.names()}


def test_a_family_with_an_order_bound_has_no_conditions_beyond_it() -> None:
    result = run("derive", "discrete_gradient", "--order", "3")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "no method of this family has a higher order" in result.stderr
    (found,) = check("gauss3", family="discrete_gradient").orders
    assert (found.order, found.failing, found.limit) == (2, (), None)
    (below,) = check("euler", family="discrete_gradient").orders
    assert (below.order, [f.condition.tree for f in below.failing]) == (1, ["[.]"])


@pytest.mark.parametrize("name", ["gauss1", "gauss2", "lobatto3c3", "kutta3"])
def test_slgi_is_vrkmk_without_brackets_and_ambient_is_rk(name: str) -> None:
    for one, other in (("slgi", "vrkmk(0)"), ("ambient", "rk")):
        (x,), (y,) = check(name, family=one).orders, check(name, family=other).orders
        assert (x.order, [f.residual for f in x.failing]) == (y.order, [f.residual for f in y.failing])


@pytest.mark.parametrize("cutoff", [0, 1, 2])
def test_dexp_cut_after_r_brackets_has_order_r_plus_two_at_least(cutoff: int) -> None:
    (found,) = check("gauss3", family=f"vrkmk_pade({cutoff})").orders
    assert found.order >= cutoff + 2


def test_a_module_of_the_list_that_registers_no_family_is_an_error_with_the_reason(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(registry.BUILT_IN, "absent", "orderconds.families.memo")
    with pytest.raises(AssertionError, match=r"orderconds\.families\.memo .* @register"):
        families.get("absent")
