"""Semidirect products: SE(2), SE(3) and SE_2(3) from one construction."""

from __future__ import annotations

import pytest

from codegen.errors import SceneError
from codegen.groups import GL, S3, SE2, SE3, SE23, SO2, SO3, SU2, Affine, Rn, Semidirect
from codegen.groups.capabilities import ClosedFormSeries, LeftTranslation, MatrixRepresentation, Projection
from codegen.groups.dual_numbers import DualDomain
from codegen.groups.linear_algebra import matvec
from codegen.groups.representations import AlgebraVectors, MatrixColumns, PlaneVectors
from codegen.ir.domain import ExprDomain, FloatDomain, PreciseDomain
from codegen.scene.classical_forms import classical_forms, operations
from tests.codegen.groups.test_rigid_motions import body_on_a_spring
from tests.strategies import sampler

PLANE = Semidirect(SO2(), PlaneVectors(), "SE(2)")
OPERATIONS = {
    "exp": "x",
    "mul": "gg",
    "ad": "xx",
    "adt": "xm",
    "Ad": "gx",
    "Adt": "gm",
    "Adtinv": "gm",
    "dexpt": "xm",
    "velocity": "xg",
    "project": "g",
    "expmul": "xg",
}
"""Operations of SE(2), with the kinds of their arguments: elements g, vectors x, covectors m."""


@pytest.mark.parametrize("name", OPERATIONS)
def test_rotations_of_the_plane_with_vectors_are_the_motions_of_the_plane(name):
    s = sampler(SE2(), "exact, series")
    draw = {"g": s.element, "x": s.vector, "m": s.covector}
    arguments = [draw[kind]() for kind in OPERATIONS[name]]
    results = [getattr(group, name)(s.domain, *arguments) for group in (SE2(), PLANE)]
    assert s.equal(*results)


@pytest.mark.parametrize("name", OPERATIONS)
def test_the_construction_needs_no_more_operations_than_formulas_by_hand(name):
    d = ExprDomain()
    sizes = {"g": PLANE.size, "x": PLANE.dim, "m": PLANE.dim}
    kinds = OPERATIONS[name]
    arguments = [
        tuple(d.space.sym(f"{kind}{k}{i}") for i in range(sizes[kind])) for k, kind in enumerate(kinds)
    ]
    by_hand, constructed = (operations(list(getattr(group, name)(d, *arguments))) for group in (SE2(), PLANE))
    assert constructed <= by_hand


@pytest.mark.parametrize("sample", ["exact, series", "40 digits, uniform", "doubles, uniform"])
def test_matrices_and_quaternions_are_the_same_motions(sample):
    s = sampler(SE3(), sample)
    d, x, z = s.domain, s.vector(), s.vector()[:3]
    matrices, quaternions = SE3(), SE3(SU2())
    ends = [group.move(d, group.exp(d, x), z) for group in (matrices, quaternions)]
    assert s.equal(*ends)
    y = s.vector()
    assert s.equal(matrices.ad(d, x, y), quaternions.ad(d, x, y))
    assert s.equal(matrices.dexpt(d, x, y), quaternions.dexpt(d, x, y))


def test_velocity_and_position_of_a_vehicle_are_two_motions_with_one_attitude():
    s = sampler(SE23(), "exact, series")
    d, x, motions = s.domain, s.vector(), SE3()
    g = s.group.exp(d, x)
    assert s.equal(g[:12], motions.exp(d, x[:6]))
    assert s.equal((*g[:9], *g[12:]), motions.exp(d, (*x[:3], *x[6:])))


def test_a_motion_is_the_product_with_its_matrix():
    s = sampler(SE3(), "exact, series")
    d, g, z = s.domain, s.element(), s.vector()[:3]
    assert s.equal((*s.group.move(d, g, z), d.rational(1)), matvec(s.group.matrix(d, g), (*z, d.rational(1))))


@pytest.mark.parametrize(
    ("linear", "capability", "offered"),
    [
        (SO3(), ClosedFormSeries, True),
        (SO3(), MatrixRepresentation, True),
        (SU2(), MatrixRepresentation, False),
        (S3(), ClosedFormSeries, True),
        (S3(), LeftTranslation, True),
    ],
)
def test_a_product_has_the_capabilities_for_which_there_are_formulas(linear, capability, offered):
    product = Semidirect(linear, AlgebraVectors())
    assert (product.offers(capability) is not None) is offered


def test_matrices_without_projection_give_a_product_without_projection():
    assert Semidirect(GL(2), MatrixColumns()).offers(Projection) is None


def test_symbols_of_the_two_parts_are_different():
    for group in (SE3(), SE3(SU2()), SE23(), PLANE, Semidirect(Rn(1), MatrixColumns())):
        names = [symbol.name for symbol in group.symbols("q")]
        assert len(set(names)) == len(names) == group.size


def test_columns_of_a_group_without_matrices_are_refused():
    with pytest.raises(SceneError, match=r"S\^3 has no matrix representation"):
        Semidirect(S3(), MatrixColumns())


def test_vectors_of_an_algebra_without_closed_forms_are_refused():
    with pytest.raises(SceneError, match=r"GL\(2\) has no closed form of functions of ad"):
        Semidirect(GL(2), AlgebraVectors())


@pytest.mark.parametrize("sample", ["exact, series", "40 digits, uniform"])
def test_linear_maps_with_columns_are_the_affine_maps(sample):
    """The elements of one group are matrices of the other, and the bases of the algebras are permuted."""
    product, matrices = Semidirect(GL(2), MatrixColumns()), Affine(2)
    s = sampler(product, sample)
    d, x, mu = s.domain, s.vector(), s.covector()

    def permuted(v):
        return (v[0], v[1], v[4], v[2], v[3], v[5])

    assert s.equal(product.matrix(d, product.exp(d, x)), matrices.exp(d, permuted(x)))
    assert s.equal(permuted(product.dexpt(d, x, mu)), matrices.dexpt(d, permuted(x), permuted(mu)))


def test_no_copies_are_refused():
    with pytest.raises(SceneError, match="number of copies of a space is 0"):
        AlgebraVectors(0)


def test_equations_on_se3_have_a_form_with_a_unit_quaternion():
    problem = body_on_a_spring()
    form = classical_forms(problem)[-1]
    assert len(form.problem.symbols) == 4 + 3 + 6
    d = PreciseDomain(0, 40)
    state = tuple(problem.initial(d))
    back = form.scene_state(d, form.form_state(d, state))
    assert max(abs(a - b) for a, b in zip(back, state, strict=True)) < 1e-38


def test_the_cover_has_the_motions_of_the_group():
    s = sampler(SE23(), "exact, series")
    d, x = s.domain, s.vector()
    q = s.group.cover.exp(d, s.group.lifted_velocity(d, x))
    assert s.equal(s.group.covering(d, q), s.group.exp(d, x))


@pytest.mark.parametrize(("function", "args"), [("sqrt", 1), ("atan2", 2), ("", 1)])
def test_dual_numbers_have_no_rule_for_other_functions(function, args):
    dual = DualDomain(FloatDomain(0.0))
    with pytest.raises(ArithmeticError, match="no formula for dual numbers"):
        dual.call(function, *(dual.rational(2),) * args)
