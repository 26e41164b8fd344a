"""Methods read in other formats keep their meaning, and move between rings."""

from __future__ import annotations

import pytest

from orderconds.ring import QQ, Balls, PowerSeries
from orderconds.tableau import CommutatorFree, Composition, RungeKutta, Tableau, find

KUTTA = 'name = "k"\nfamily = "rk"\nA = [[], ["1/2"], ["-1", "2"]]\nb = ["1/6", "0", "5/6"]\n'


def runge_kutta(tableau: Tableau) -> RungeKutta:
    assert isinstance(tableau.method, RungeKutta)
    return tableau.method


def test_crouch_grossman_has_one_exponential_for_each_non_zero_coefficient_first_stage_first() -> None:
    q = QQ.rational
    method = runge_kutta(Tableau.loads(KUTTA)).as_crouch_grossman(QQ)
    assert [stage.exponentials for stage in method.stages] == [
        (),
        ((q(1, 2), 0, 0),),
        ((-1, 0, 0), (0, 2, 0)),
    ]
    assert method.update.exponentials == ((q(1, 6), 0, 0), (0, 0, q(5, 6)))
    assert all(stage.start is None for stage in (*method.stages, method.update))


def test_crouch_grossman_on_an_abelian_group_is_the_tableau_itself() -> None:
    method = runge_kutta(Tableau.loads(KUTTA))
    assert method.as_crouch_grossman(QQ).as_runge_kutta(QQ) == method


def test_a_composition_of_midpoints_is_the_diagonally_implicit_tableau_of_lemma_3_5_4() -> None:
    tableau = Tableau.load(find("triple_jump"))
    field, method = tableau.ring, tableau.read_as(("rk",))
    assert isinstance(tableau.method, Composition)
    assert isinstance(method, RungeKutta)
    g1, g2, g3 = tableau.method.gamma
    assert method.b == (g1, g2, g3)
    assert ((g1 / 2, field.zero, field.zero), (g1, g2 / 2, field.zero), (g1, g2, g3 / 2)) == method.A
    assert g1 + g2 + g3 == 1
    assert g1**3 + g2**3 + g3**3 == 0


def test_a_tableau_is_read_in_the_formats_it_has() -> None:
    rk, cf, composition = (Tableau.load(find(name)) for name in ("rk4", "cf4", "triple_jump"))
    assert rk.read_as(("cf", "rk")) is rk.method
    assert cf.read_as(("cf", "rk")) is cf.method
    assert cf.read_as(("rk",)) is None
    assert isinstance(composition.read_as(("composition", "rk")), Composition)
    assert isinstance(cf.abelian(), RungeKutta)
    assert isinstance(cf.method, CommutatorFree)


def test_cf4_on_an_abelian_group_is_the_classical_method() -> None:
    assert Tableau.load(find("cf4")).abelian() == Tableau.load(find("rk4")).method


def test_cf3_on_an_abelian_group_is_heuns_method_of_order_3() -> None:
    q = QQ.rational
    heun = RungeKutta(((0, 0, 0), (q(1, 3), 0, 0), (0, q(2, 3), 0)), (q(1, 4), 0, q(3, 4)))
    assert Tableau.load(find("cf3")).abelian() == heun


def test_a_tableau_moves_to_another_ring_with_all_its_coefficients() -> None:
    tableau = Tableau.load(find("gauss2"))
    balls = tableau.over(Balls(100))
    assert float(runge_kutta(balls).A[0][1]) == pytest.approx(0.25 - 3**0.5 / 6, rel=1e-15)
    assert tableau.over(tableau.ring) == tableau
    series = Tableau.load(find("kutta3")).over(PowerSeries(QQ, 3))
    assert series.embedded is not None
    assert series.ring.is_zero(series.embedded.b[1] - 1)
    floats = tableau.over(QQ, float)
    assert runge_kutta(floats).b == (0.5, 0.5)
    with pytest.raises(TypeError, match="no map"):
        tableau.over(QQ)
