"""The order of an emitted program is computed: its local error over Q[[h]] agrees with the conditions.

Every family, on scenes without symmetry: the coefficients vanish exactly up to the order that the conditions
give, and the first that do not are residuals times elementary differentials, exactly.
"""

from __future__ import annotations

from dataclasses import replace

import pytest

from codegen.certify import certified_order
from codegen.errors import SceneError
from codegen.ir.number import Number
from codegen.ir.operations import InverseDexpSlope, Linear
from codegen.ir.program import Solve
from codegen.ir.values import Coefficient
from codegen.lab.orders.local_error import leading_term, local_error, predicted, valuation
from codegen.lower import lower, problem_for
from codegen.method import Method
from codegen.passes import optimise
from orderconds.families import family_class
from tests.strategies import butcher, field_scene, full, full_exponentials, hamiltonian_scene, shipped

SUM_OF_CUBES_ZERO = butcher(
    "midpoints",
    [["1/4", 0, 0, 0], ["1/2", "1/3", 0, 0], ["1/2", "2/3", "5/12", 0], ["1/2", "2/3", "5/6", "-1/2"]],
    ["1/2", "2/3", "5/6", "-1"],
)
KUTTA3_OFF = butcher("kutta3_off", [[0, 0, 0], ["1/2", 0, 0], [-1, 2, 0]], ["1/6", "7/10", "2/15"])


def error_of(scene, method, order):
    view = problem_for(scene, method)
    program, _ = optimise(lower(scene, method), view)
    return view, local_error(program, view, method.ring, order)


def agree(scene, method, order):
    """The local error starts at h^(order + 1), with the coefficients that the conditions predict."""
    view, error = error_of(scene, method, order + 1)
    power, found = leading_term(error)
    expected = predicted(view, method, power)
    assert power == order + 1
    assert all(method.ring.is_zero(x - y) is True for x, y in zip(found, expected, strict=True))


def case(family, tableau, order, cutoff=None):
    name = tableau if isinstance(tableau, str) else tableau.name
    made = shipped(tableau) if isinstance(tableau, str) else tableau
    method = Method(family, made, cutoff)
    return pytest.param(method, order, id=f"{method.family_label}-{name}-order{order}")


RUNGE_KUTTA = [
    case("rk", "euler", 1),
    case("rk", "heun", 2),
    case("rk", "kutta3", 3),
    case("rk", "rk4", 4),
    case("rk", "gauss2", 4),
    case("rk", full(2), 1),
    case("rk", KUTTA3_OFF, 1),
]
LIE = [
    case("cg", "euler", 1),
    case("cg", "cg3", 3),
    case("cg", "cg3b", 3),
    case("cg", "rk4", 2),
    case("cg", "kutta3", 2),
    case("cg", "gauss1", 2),
    case("cg", full(2), 1),
    case("cf", "cf3", 3),
    case("cf", "cf4", 4),
    case("cf", "luescher3", 3),
    case("cf", "williamson3", 3),
    case("rkmk", "rk4", 4, 2),
    case("rkmk", "rk4", 3, 1),
    case("rkmk", "rk4", 2, 0),
    case("rkmk", "kutta3", 3, 1),
    case("rkmk", "gauss2", 3, 1),
    case("rkmk", full(2), 1, 1),
    case("rkmk", "rk4", 4),
    case("rkmk", "kutta3", 3),
    case("rkmk", "heun", 2),
]
VARIATIONAL = [
    case("vcg", "midpoint", 2),
    case("vcg", "kutta3", 2),
    case("vcg", "heun", 2),
    case("vcg", SUM_OF_CUBES_ZERO, 3),
    case("vcg", full(2), 1),
    case("vrkmk_pade", "midpoint", 2, 0),
    case("vrkmk_pade", "kutta3", 3, 1),
    case("vrkmk_pade", "kutta3", 2, 0),
    case("vrkmk_pade", full(2), 1, 1),
    case("vcf", "midpoint", 2),
    case("vcf", full_exponentials(2), 1),
    case("vrkmk", "midpoint", 2, 0),
    case("vrkmk", "kutta3", 2, 0),
    case("vrkmk", "kutta3", 3, 1),
    case("vrkmk", "heun", 2, 2),
    case("vrkmk", full(2), 1, 1),
]
PARTITIONED = [
    case("sprk", "midpoint", 2),
    case("sprk", "kutta3", 3),
    case("sprk", "heun", 2),
    case("sprk", "gauss2", 4),
    case("sprk", full(2), 1),
    case("sprk", "rk4", 4),
]


@pytest.mark.parametrize(("method", "order"), RUNGE_KUTTA)
def test_runge_kutta_by_elementary_differentials(method, order):
    agree(field_scene("R^3"), method, order)


@pytest.mark.parametrize("place", ["S^2", "GL(2)"])
@pytest.mark.parametrize(("method", "order"), LIE)
def test_lie_group_methods_by_frozen_derivatives(place, method, order):
    agree(field_scene(place), method, order)


@pytest.mark.parametrize("place", ["SO(3)", "Heisenberg", "S^3", "SL(2)", "SE(2)", "SO(3) x R^2"])
def test_on_other_groups_too(place):
    agree(field_scene(place), Method("cg", shipped("cg3")), 3)


@pytest.mark.parametrize("place", ["S^3", "SL(2)", "SE(2)", "SO(3) x R^2"])
def test_with_too_few_brackets_on_other_groups_too(place):
    agree(field_scene(place), Method("rkmk", shipped("rk4"), 1), 3)


def test_on_the_cotangent_group():
    agree(hamiltonian_scene("SO(3)"), Method("rkmk", shipped("rk4"), 1), 3)


@pytest.mark.parametrize("group", ["SO(3)", pytest.param("GL(2)", marks=pytest.mark.slow)])
@pytest.mark.parametrize(("method", "order"), VARIATIONAL)
def test_variational_methods_by_action_trees(group, method, order):
    agree(hamiltonian_scene(group), method, order)


@pytest.mark.parametrize("family", ["vcf", "vrkmk", "vrkmk_pade"])
def test_on_a_vector_space_all_variational_families_are_one(family):
    scene, tableau = hamiltonian_scene("R^3"), shipped("kutta3")
    cutoff = 2 if family_class(family).takes_cutoff else None
    found = [error_of(scene, m, 4)[1] for m in (Method(family, tableau, cutoff), Method("vcg", tableau))]
    assert found[0] == found[1]


@pytest.mark.parametrize(("method", "order"), PARTITIONED)
def test_on_a_vector_space_variational_methods_are_partitioned_ones(method, order):
    """One program, of family vcg; predicted by trees with directed edges, to order 3 by action trees too."""
    scene = hamiltonian_scene("R^3")
    lowered = replace(method, family="vcg")
    view, error = error_of(scene, lowered, order + 1)
    power, found = leading_term(error)
    assert power == order + 1
    for family in ("sprk", "vcg") if order < 4 else ("sprk",):
        expected = predicted(view, replace(method, family=family), power)
        assert all(method.ring.is_zero(x - y) is True for x, y in zip(found, expected, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("group", ["SO(3)", "GL(2)"])
def test_the_triple_jump_has_order_four(group):
    agree(hamiltonian_scene(group), Method("vcg", shipped("triple_jump")), 4)


@pytest.mark.parametrize(
    ("tableau", "cutoff", "order"),
    [("rk4", 2, 4), ("rk4", 1, 3), pytest.param("gauss2", 2, 4, marks=pytest.mark.slow), ("gauss2", 1, 3)],
)
def test_variational_munthe_kaas_of_order_four(tableau, cutoff, order):
    agree(hamiltonian_scene("SO(3)"), Method("vrkmk", shipped(tableau), cutoff), order)


FIFTH = butcher(
    "dormand_prince",
    [
        [0] * 6,
        ["1/5", 0, 0, 0, 0, 0],
        ["3/40", "9/40", 0, 0, 0, 0],
        ["44/45", "-56/15", "32/9", 0, 0, 0],
        ["19372/6561", "-25360/2187", "64448/6561", "-212/729", 0, 0],
        ["9017/3168", "-355/33", "46732/5247", "49/176", "-5103/18656", 0],
    ],
    ["35/384", 0, "500/1113", "125/192", "-2187/6784", "11/84"],
)


@pytest.mark.parametrize(
    ("tableau", "order", "brackets"), [(FIFTH, 5, 5), (shipped("butcher6"), 6, 9)], ids=["fifth", "sixth"]
)
def test_with_the_fewest_brackets_orders_five_and_six_are_kept(tableau, order, brackets):
    """The first coefficients of the local error vanish exactly, the next do not."""
    method = Method("rkmk", tableau)
    view, error = error_of(field_scene("S^2"), method, order + 1)
    assert valuation(error) == order + 1
    assert certified_order(method).order == order
    assert optimise(lower(field_scene("S^2"), method), view)[0].counts()["ad"] == brackets


def test_without_the_derivative_of_dexpinv_vrkmk_loses_its_order():
    """P* left out, and P* with the wrong sign: order 1 in place of 3, and the check of the order sees it."""
    scene, method = hamiltonian_scene("SO(3)"), Method("vrkmk", shipped("kutta3"), 1)
    view, right = problem_for(scene, method), lower(scene, method)

    made = {x.targets[0].name for x in right.assigns() if isinstance(x.operation, InverseDexpSlope)}

    def altered(factor):
        def change(assign):
            if not isinstance(assign.operation, Linear):
                return assign
            pairs = zip(assign.operation.coefficients, assign.args, strict=True)
            scaled = tuple(
                Coefficient(c.value * Number.rational(factor), c.power) if a.name in made else c
                for c, a in pairs
            )
            return replace(assign, operation=Linear(scaled))

        body = tuple(
            replace(s, body=tuple(map(change, s.body))) if isinstance(s, Solve) else change(s)
            for s in right.body
        )
        return replace(right, body=body)

    found = [valuation(local_error(altered(factor), view, method.ring, 4)) for factor in (1, 0, -1)]
    assert found == [4, 2, 2]


@pytest.mark.parametrize(("cutoff", "order"), [(1, 3), pytest.param(2, 4, marks=pytest.mark.slow)])
def test_munthe_kaas_with_dexp_cut_off(cutoff, order):
    agree(hamiltonian_scene("SO(3)"), Method("vrkmk_pade", shipped("gauss2"), cutoff), order)


def test_variational_commutator_free_of_order_four():
    agree(hamiltonian_scene("SO(3)"), Method("vcf", shipped("cf4")), 4)


def test_crouch_grossman_of_owren_and_marthinsen_has_order_four():
    agree(field_scene("S^2"), Method("cg", shipped("cg4")), 4)


@pytest.mark.parametrize(("method", "order"), [*LIE, *VARIATIONAL])
def test_the_order_is_the_one_that_check_reports(method, order):
    assert certified_order(method).order == order


@pytest.mark.parametrize(
    ("method", "scene"),
    [
        (Method("rk", shipped("rk4")), field_scene("R^3")),
        (Method("cg", shipped("cg3")), field_scene("S^2")),
        (Method("rkmk", shipped("rk4"), 2), field_scene("GL(2)")),
        (Method("vcg", SUM_OF_CUBES_ZERO), hamiltonian_scene("SO(3)")),
    ],
    ids=["rk", "cg", "rkmk", "vcg"],
)
def test_a_weight_off_by_a_little_breaks_the_order(method, scene):
    ring, rk = method.ring, method.runge_kutta()
    b = (rk.b[0] + ring.rational(1, 10**9), *rk.b[1:])
    wrong = replace(method, coefficients=replace(method.tableau, family="rk", method=replace(rk, b=b)))
    assert valuation(error_of(scene, wrong, 2)[1]) == 1


def test_another_method_of_the_same_order_has_another_leading_term():
    scene, one, other = field_scene("S^2"), Method("cg", shipped("cg3")), Method("cg", shipped("cg3b"))
    view, error = error_of(scene, one, 4)
    power, found = leading_term(error)
    assert power == 4
    assert found == predicted(view, one, power)
    assert found != predicted(view, other, power)


def test_a_scene_that_depends_on_time_has_no_prediction():
    method = Method("cg", shipped("cg3"))
    with pytest.raises(SceneError, match="depends on time"):
        predicted(field_scene("S^2", time=True), method, 4)


@pytest.mark.parametrize("family", ["rk", "cg", "vcg"])
def test_with_time_the_order_stays(family):
    """A scene that depends on time is a scene in one dimension more."""
    scene = {"rk": field_scene("R^3", time=True), "cg": field_scene("S^2", time=True)}.get(
        family, hamiltonian_scene("SO(3)", time=True)
    )
    tableau, order = {"rk": ("rk4", 4), "cg": ("cg3", 3), "vcg": ("midpoint", 2)}[family]
    assert valuation(error_of(scene, Method(family, shipped(tableau)), order + 1)[1]) == order + 1
