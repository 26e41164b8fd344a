"""The laws of a left action, for every action and group it is used with."""

from __future__ import annotations

import pytest
from sympy import Matrix, Symbol, eye, symbols

from codegen.errors import SceneError
from codegen.groups import (
    SE2,
    SL2,
    SO3,
    Action,
    AdjointAction,
    AffineAction,
    CoadjointAction,
    Columns,
    Conjugation,
    Cotangent,
    DiagonalAction,
    FactorwiseAction,
    LeftMultiplication,
    Linear,
    Motion,
    Product,
    RightMultiplication,
    Rn,
    Rotation,
    Stiefel,
    actions,
    get,
    listing,
)
from codegen.groups.capabilities import Coadjoint, Inverse
from codegen.groups.linear_algebra import dot, matvec
from codegen.ir.domain import FloatDomain
from codegen.scene import FieldScene
from orderconds.errors import UnknownName
from tests.codegen.groups.action_cases import ACTIONS, AFFINE, HERE, ONE_OF_EACH, orthogonal
from tests.strategies import ALL_GROUPS, GROUPS, SAMPLES, sampler

NON_ABELIAN = ("SO(3)", "SE(2)", "SL(2)", "Heisenberg", "SO(3) x R^2", "SE(3)", "affine")
"""The groups on whose algebras and duals actions are tested."""

INVERTIBLE = sorted(n for n, g in ALL_GROUPS.items() if g.offers(Inverse) and g.offers(Coadjoint))

CASES = [
    *(
        pytest.param(LeftMultiplication(), name, None, id=f"left multiplication-{name}")
        for name in ALL_GROUPS
    ),
    *(
        pytest.param(RightMultiplication(), name, None, id=f"right multiplication-{name}")
        for name in INVERTIBLE
    ),
    *(
        pytest.param(action, name, group.dim, id=f"{action.name}-{name}")
        for action in (AdjointAction(), CoadjointAction())
        for name, group in GROUPS.items()
        if name in NON_ABELIAN
    ),
    *(pytest.param(action, name, size, id=f"{action.name}-{name}") for action, name, size in ACTIONS),
]


def drawn(name, size, sample):
    """A sampler of a group, and a point: an element of the group, or ``size`` coordinates."""
    s = sampler(HERE[name], sample)
    if size is None:
        return s, s.element()
    return s, tuple(s.domain.rational(k + 1, 2) + s.scalar() for k in range(size))


@pytest.mark.parametrize("sample", [x for x in SAMPLES if "turn" not in x])
@pytest.mark.parametrize(("a", "name", "size"), CASES)
class TestALeftAction:
    def test_the_identity_moves_nothing(self, a, name, size, sample):
        s, y = drawn(name, size, sample)
        assert s.equal(a.act(s.domain, s.group, s.group.identity(s.domain), y), y)

    def test_a_product_acts_by_its_right_factor_first(self, a, name, size, sample):
        s, y = drawn(name, size, sample)
        d, g, k = s.domain, s.element(), s.element()
        once = a.act(d, s.group, s.group.mul(d, g, k), y)
        assert s.equal(once, a.act(d, s.group, g, a.act(d, s.group, k, y)))

    def test_actexp_is_the_action_of_exp(self, a, name, size, sample):
        s, y = drawn(name, size, sample)
        d, x = s.domain, s.vector()
        assert s.equal(a.actexp(d, s.group, x, y), a.act(d, s.group, s.group.exp(d, x), y))


@pytest.mark.parametrize(("a", "name", "size"), CASES)
def test_velocity_is_the_derivative_along_exp(a, name, size):
    s, y = drawn(name, size, "exact, series")
    d = s.domain
    y = tuple(d.ring.constant(c.coefficients[0]) for c in y)
    x = tuple(d.rational(s.rng.randint(-4, 4), 3) for _ in range(s.group.dim))
    moved = a.actexp(d, s.group, tuple(d.h * c for c in x), y)
    velocity = a.velocity(d, s.group, x, y)
    assert [m.coefficients[1] for m in moved] == [v.coefficients[0] for v in velocity]


@pytest.mark.parametrize(("a", "name", "size"), CASES)
def test_velocity_is_the_derivative_at_a_point_far_from_the_identity(a, name, size):
    s, y = drawn(name, size, "40 digits, uniform")
    d, x, eps = s.domain, s.vector(), s.domain.rational(1, 10**12)
    ends = [a.actexp(d, s.group, tuple(e * c for c in x), y) for e in (eps, -eps)]
    slope = tuple((p - q) / (eps + eps) for p, q in zip(*ends, strict=True))
    gaps = [abs(p - q) for p, q in zip(slope, a.velocity(d, s.group, x, y), strict=True)]
    assert max(gaps) < 1e-20


@pytest.mark.parametrize(("a", "name", "size"), CASES)
def test_a_point_has_the_number_of_coordinates_that_the_action_states(a, name, size):
    group = HERE[name]
    a.check(group)
    assert a.point_size(group) == (group.size if size is None else size)


def test_every_action_is_tested_here():
    assert {row["name"] for row in actions.listing()} == set(ONE_OF_EACH)


@pytest.mark.parametrize("name", INVERTIBLE)
@pytest.mark.parametrize("sample", ["doubles, uniform", "exact, series"])
def test_the_inverse_of_an_element_is_its_inverse_on_both_sides(name, sample):
    s = sampler(ALL_GROUPS[name], sample)
    d, group, g = s.domain, s.group, s.element()
    back = group.inverse(d, g)
    assert s.equal(group.mul(d, g, back), group.identity(d))
    assert s.equal(group.mul(d, back, g), group.identity(d))


def test_the_inverse_on_a_cotangent_bundle_is_that_of_its_product():
    s = sampler(Cotangent(SE2()), "exact, series")
    g = s.element()
    assert s.equal(s.group.mul(s.domain, g, s.group.inverse(s.domain, g)), s.group.identity(s.domain))


class TestStiefel:
    def test_the_action_keeps_orthonormal_columns(self):
        s = sampler(orthogonal(4), "40 digits, uniform")
        start = tuple(s.domain.rational(int(i == j)) for i in range(4) for j in range(2))
        y = Stiefel(2).actexp(s.domain, s.group, s.vector(), start)
        assert all(abs(x) < 1e-37 for _, x in Stiefel(2).laws(s.domain, s.group, y))

    def test_the_projection_squares_the_defect(self):
        d, group, eps = FloatDomain(0.1), orthogonal(4), 1e-4
        start = tuple(float(i == j) for i in range(4) for j in range(2))
        y = tuple(a + eps * (k + 1) / 8 for k, a in enumerate(start))
        near = Stiefel(2).to_orbit(d, group, y, start)
        assert max(abs(x) for _, x in Stiefel(2).laws(d, group, y)) > eps / 8
        assert max(abs(x) for _, x in Stiefel(2).laws(d, group, near)) < 2 * eps * eps


def test_an_affine_map_is_the_product_of_its_matrix_and_the_point_with_a_one():
    s = sampler(AFFINE, "exact, series")
    g, y = s.element(), s.covector()[:2]
    moved = AffineAction().act(s.domain, s.group, g, y)
    assert s.equal((*moved, s.domain.rational(1)), matvec(g, (*y, s.domain.rational(1))))


def test_conjugation_keeps_the_trace_of_the_square():
    s = sampler(HERE["SO(4)"], "40 digits, uniform")
    P = tuple(s.domain.rational(k % 5, 3) for k in range(16))
    moved = Conjugation().actexp(s.domain, s.group, s.vector(), P)

    def square(m):
        return sum(dot(m[4 * i : 4 * i + 4], m[i::4]) for i in range(4))

    assert abs(square(moved) - square(P)) < 1e-36


def test_the_coadjoint_action_keeps_the_casimir_of_se2():
    s = sampler(SE2(), "exact, series")
    mu = s.covector()
    after = CoadjointAction().actexp(s.domain, s.group, s.vector(), mu)
    assert s.equal((dot(after[1:], after[1:]),), (dot(mu[1:], mu[1:]),))


def scene(group, action, n, f=None, y0=None):
    """A scene with a zero field, or ``f``, on n coordinates."""
    y = Matrix(symbols(f"y0:{n}", real=True))
    return FieldScene(
        group=group, action=action, y=y, f=f or [0] * group.dim, y0=y0 or [1, *[0] * (n - 1)], span=(0, 1)
    )


class TestAReaderOfAScene:
    @pytest.mark.parametrize(
        ("group", "action", "n", "expected"),
        [
            (SO3(), Conjugation(), 6, "a point with 9 coordinates, because SO.3. acts by conjugation"),
            (SO3(), Columns(2), 3, "a point with 6 coordinates"),
            (SE2(), CoadjointAction(), 4, "a point with 3 coordinates"),
            (SE2(), RightMultiplication(), 3, "a point with 4 coordinates"),
            (AFFINE, AffineAction(), 3, "a point with 2 coordinates"),
            (SE2(), DiagonalAction(LeftMultiplication(), Motion()), 4, "a point with 6 coordinates"),
            (HERE["SO(3) x SE(2)"], FactorwiseAction(Rotation(), Motion()), 6, "a point with 5 coordinates"),
        ],
    )
    def test_names_the_number_of_coordinates_that_a_point_has(self, group, action, n, expected):
        with pytest.raises(SceneError, match=f"a point with {n} coordinates; expected {expected}"):
            scene(group, action, n)

    @pytest.mark.parametrize(
        ("group", "action", "n", "text"),
        [
            (
                SL2(),
                Stiefel(1),
                2,
                "SL.2. does not preserve .*; expected a group of orthogonal matrices.*use Columns.1.",
            ),
            (
                SO3(),
                Stiefel(4),
                12,
                "4 columns with 3 rows cannot be orthonormal; expected at most 3 columns",
            ),
            (
                SO3(),
                AffineAction(),
                2,
                "basis matrix 0 of the Lie algebra has a nonzero last row; .*use Linear",
            ),
            (SO3(), FactorwiseAction(Rotation()), 3, "SO.3. has no factors, which .*LeftMultiplication"),
            (
                Product(SO3(), Rn(1)),
                FactorwiseAction(Rotation()),
                3,
                "the number of actions is 1, but",
            ),
            (
                SE2(),
                DiagonalAction(Motion(), Linear()),
                4,
                "SE.2. has no matrix elements, which the action linear maps",
            ),
        ],
    )
    def test_refuses_a_group_that_cannot_act(self, group, action, n, text):
        with pytest.raises(SceneError, match=text):
            scene(group, action, n)

    def test_refuses_columns_that_are_not_orthonormal(self):
        with pytest.raises(SceneError, match=r"violates \(Y\^T Y\)\[1, 0\] = 0 by 1"):
            scene(SO3(), Stiefel(2), 6, y0=[1, 1, 0, 0, 0, 0])

    def test_refuses_an_element_that_is_not_in_the_group(self):
        with pytest.raises(SceneError, match=r"expected an element of SO\(3\)"):
            scene(SO3(), RightMultiplication(), 9, y0=list(2 * eye(3)))

    def test_accepts_y_f_as_right_multiplication_by_the_negative_generator(self):
        group = SO3()
        y, w = group.point("y"), Matrix([1, Symbol("t"), 2])
        hat = Matrix([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
        FieldScene(
            group=group,
            action=RightMultiplication(),
            y=list(y),
            f=-w,
            y0=eye(3),
            span=(0, 1),
            velocity=y * hat,
        )

    def test_refuses_a_part_without_a_number_of_coordinates(self):
        class Silent(Action):
            """Translations that do not state their size."""

            name = "silence"

            def act(self, d, group, g, y):
                return y

            def velocity(self, d, group, x, y):
                return y

        with pytest.raises(
            SceneError, match=r"the action silence does not define .*point_size\(self, group\) in Silent"
        ):
            scene(Rn(2), DiagonalAction(LeftMultiplication(), Silent()), 2)
        with pytest.raises(SceneError, match=r"silence of the factor R\^2 does not define .*in Silent"):
            scene(Product(Rn(2)), FactorwiseAction(Silent()), 2)

    def test_refuses_an_action_whose_velocity_is_no_derivative(self):
        class Reversed(Motion):
            """Motions with the velocity of the opposite motion."""

            def velocity(self, d, group, x, y):
                return tuple(-a for a in super().velocity(d, group, x, y))

        with pytest.raises(
            SceneError,
            match=r"velocity\[0\] of the action rigid motion is .*eps x.*correct the class Reversed",
        ):
            scene(SE2(), Reversed(), 2)

    def test_refuses_an_action_whose_identity_moves_points(self):
        class Shifted(Motion):
            """Motions followed by a translation."""

            def act(self, d, group, g, y):
                return (y[0] + d.rational(1), y[1])

            def velocity(self, d, group, x, y):
                return (d.rational(0), d.rational(0))

        with pytest.raises(
            SceneError,
            match=r"act\[0\] of the action rigid motion is .*, the value of y, because act\(identity, y\) ",
        ):
            scene(SE2(), Shifted(), 2)

    def test_refuses_a_right_action(self):
        class Reversed(Rotation):
            """Rotations by the transpose of the matrix."""

            def act(self, d, group, g, y):
                return super().act(d, group, group.inverse(d, g), y)

            def actexp(self, d, group, x, y):
                return super().actexp(d, group, tuple(-a for a in x), y)

            def velocity(self, d, group, x, y):
                return super().velocity(d, group, tuple(-a for a in x), y)

        with pytest.raises(SceneError, match=r"act\[0\] of the action .* must be a left action; .*Reversed"):
            scene(SO3(), Reversed(), 3)

    def test_refuses_another_formula_for_the_action_of_an_exponential(self):
        class First(Motion):
            """Motions whose actexp has the first terms of the series only."""

            def actexp(self, d, group, x, y):
                return tuple(a + b for a, b in zip(y, self.velocity(d, group, x, y), strict=True))

        with pytest.raises(
            SceneError, match=r"actexp\[0\] of the action rigid motion is .*act\(exp\(x\), y\)"
        ):
            scene(SE2(), First(), 2)

    @pytest.mark.parametrize("make", [DiagonalAction, FactorwiseAction])
    def test_refuses_no_parts(self, make):
        with pytest.raises(
            SceneError, match=r"no actions were given to \w+; expected (at least )?one action"
        ):
            make()

    @pytest.mark.parametrize("k", [0, -1, 1.5])
    def test_refuses_a_number_of_columns_that_is_no_count(self, k):
        with pytest.raises(SceneError, match=r"columns = .*; expected a positive integer"):
            Columns(k)


def test_groups_are_listed_with_what_they_are():
    rows = [row if isinstance(row, dict) else row.__dict__ for row in listing()]
    assert len(rows) == len({str(row) for row in rows}) >= 5


def test_an_unknown_group_lists_the_known_ones():
    with pytest.raises(UnknownName, match="unknown group 'SO4'; expected one of Affine, Cotangent"):
        get("SO4")
    assert get("SO3").name == "SO(3)"


def test_a_product_without_factors_is_refused():
    with pytest.raises(SceneError, match="the product has no factors"):
        Product()
