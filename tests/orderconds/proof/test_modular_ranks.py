"""No certificate rests on a rank modulo a prime that is too small.

Ranks modulo primes select the independent conditions of the families of actions. A check evaluates the
conditions of all classes of trees, which needs no rank. A proof solves the independent conditions only, so it
verifies over Q that the others follow.
"""

from __future__ import annotations

import pytest

from orderconds import check, families
from orderconds.proof import equations as proof_equations
from orderconds.proof.certificate import certify
from orderconds.proof.krawczyk import NotProved
from orderconds.series import action_rank, action_relations, lie_butcher_rank
from orderconds.tableau import Tableau, find

FILE = """name = "three"
family = "rk"
A = [["b1/2"], ["b1", "b2/2"], ["b1", "b2", "b3/2"]]
b = ["b1", "b2", "b3"]
[numbers]
b1 = "0.50000000000000000000~"
b2 = "0.30000000000000000000~"
b3 = "0.20000000000000000000~"
[proof]
conditions = "vcg"
order = 1
pins = ["b2", "b3"]
"""


def forbidden(*_: object, **__: object) -> None:
    raise AssertionError("a rank modulo a prime was computed")


@pytest.mark.parametrize(
    ("name", "family"),
    [("gauss2", "vcg"), ("triple_jump", "vcg"), ("cf4", "vcf"), ("gauss2", "vrkmk(2)"), ("rk4", "rkmk(2)")],
)
def test_a_check_computes_no_rank_modulo_a_prime(
    name: str, family: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    tableau = Tableau.load(find(name))
    claimed = check(tableau, family).orders
    monkeypatch.setattr(action_rank, "pivot_columns", forbidden)
    monkeypatch.setattr(lie_butcher_rank, "pivot_columns", forbidden)
    monkeypatch.setattr(action_relations, "combinations", forbidden)
    assert check(tableau, family).orders == claimed


@pytest.mark.parametrize("family", ["vcg", "vcf", "vrkmk(0)", "vrkmk(2)", "vrkmk_pade(2)"])
def test_dependent_conditions_follow_over_the_rationals(family: str) -> None:
    assert all(families.get(family).dependence_holds(n) for n in (1, 2, 3, 4))


def test_a_relation_that_holds_modulo_both_primes_only_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each coefficient is off by the product of the primes, so it is right modulo each of them."""
    right = action_relations.relations
    p, q = action_relations.PRIMES

    def wrong(*arguments: object) -> object:
        return {
            tree: tuple((x + p * q, trees) for x, trees in polynomial)
            for tree, polynomial in right(*arguments).items()  # type: ignore[arg-type]
        }

    family = families.get("vcg")
    assert family.dependence_holds(3)
    monkeypatch.setattr(action_relations, "relations", wrong)
    assert not family.dependence_holds(3)


def test_a_proof_is_refused_where_dependence_does_not_hold(monkeypatch: pytest.MonkeyPatch) -> None:
    vcg = type(families.get("vcg"))
    proof_equations._up_to.cache_clear()
    with monkeypatch.context() as patched:
        patched.setattr(vcg, "dependence_holds", lambda self, order: order != 1)
        with pytest.raises(NotProved, match="modulo primes and does not hold over Q"):
            certify(Tableau.loads(FILE))
    proof_equations._up_to.cache_clear()
    assert certify(Tableau.loads(FILE)).facts
