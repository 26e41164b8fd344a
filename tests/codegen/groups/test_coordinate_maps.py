"""Coordinate maps: their inverse differentials, the order of RKMK with them, and refusals."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import product

import pytest
from sympy import Matrix, Rational, symbols

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.errors import SceneError
from codegen.groups import (
    GL,
    S3,
    SE2,
    SE3,
    SE23,
    SL2,
    SO3,
    Conjugation,
    Cotangent,
    Galilean,
    LeftMultiplication,
    MatrixGroup,
    Product,
    Rotation,
    Semidirect,
)
from codegen.groups.capabilities import CayleyMap, Coadjoint
from codegen.groups.coordinate_maps import MAPS, CoordinateMap, coordinate_map
from codegen.groups.linear_algebra import matmul
from codegen.groups.representations import MatrixColumns
from codegen.integrator import Status, StepFailed
from codegen.ir.domain import PreciseDomain, SeriesDomain
from codegen.ir.interpret import interpret
from codegen.lab.orders.local_error import local_error, predicted, valuation
from codegen.loader import load
from codegen.scene import FieldScene, HamiltonianScene
from orderconds.ring import QQ
from tests.codegen.groups.action_cases import elementary, orthogonal
from tests.strategies import ALL_GROUPS, field_scene, quarter_turn, sampler

SYMPLECTIC = MatrixGroup(
    "Sp(4)",
    [
        *(elementary(4, (i, j, 1), (j + 2, i + 2, -1)) for i in range(2) for j in range(2)),
        *(elementary(4, (0, 2, 1)), elementary(4, (1, 3, 1)), elementary(4, (0, 3, 1), (1, 2, 1))),
        *(elementary(4, (2, 0, 1)), elementary(4, (3, 1, 1)), elementary(4, (2, 1, 1), (3, 0, 1))),
    ],
)

HERE = ALL_GROUPS | {"SO(4)": orthogonal(4), "Sp(4)": SYMPLECTIC}

CASES = [
    *(("cayley", name) for name, group in HERE.items() if group.offers(CayleyMap)),
    *(("second_kind", name) for name, group in HERE.items() if group.offers(Coadjoint)),
]


@pytest.mark.parametrize(("name", "group_name"), CASES)
class TestACoordinateMap:
    def test_the_inverse_differential_is_the_inverse_of_the_derivative(self, name, group_name):
        tau, group = MAPS[name], HERE[group_name]
        s = sampler(group, "40 digits, uniform")
        d, x, y, eps = s.domain, s.vector(), s.vector(), s.domain.rational(1, 10**12)
        v = tau.inverse_differential(d, group, x, y)
        ends = [
            tau.element(d, group, tuple(a + e * b for a, b in zip(x, v, strict=True))) for e in (eps, -eps)
        ]
        slope = tuple((p - q) / (eps + eps) for p, q in zip(*ends, strict=True))
        expected = group.velocity(d, y, tau.element(d, group, x))
        assert max(abs(p - q) for p, q in zip(slope, expected, strict=True)) < 1e-18

    def test_zero_is_the_identity_and_the_derivative_at_zero_is_the_identity_map(self, name, group_name):
        tau, group = MAPS[name], HERE[group_name]
        s = sampler(group, "exact, series")
        d = s.domain
        x = tuple(d.rational(k + 1, 3) for k in range(group.dim))
        along = tuple(d.h * a for a in x)
        g = tau.element(d, group, along)
        assert [a.coefficients[0] for a in g] == [a.coefficients[0] for a in group.identity(d)]
        pulled = tau.inverse_differential(d, group, along, x)
        assert [a.coefficients[0] for a in pulled] == [a.coefficients[0] for a in x]
        slope = [QQ.rational(1) * a.coefficients[1] for a in g]
        expected = group.velocity(d, x, group.identity(d))
        assert slope == [a.coefficients[0] for a in expected]

    def test_the_element_is_in_the_group(self, name, group_name):
        s = sampler(HERE[group_name], "40 digits, uniform")
        g = MAPS[name].element(s.domain, s.group, s.vector())
        assert all(abs(x) < 1e-37 for _, x in s.group.laws(s.domain, g))


AFFINE = Semidirect(GL(2), MatrixColumns(), "affine")
MATRICES = [SO3(), SL2(), orthogonal(4), SYMPLECTIC, GL(2), SE3(), SE23(), AFFINE, Galilean()]


@pytest.mark.parametrize("group", MATRICES, ids=lambda g: g.name)
class TestTheCayleyMap:
    def test_is_the_quotient_of_matrices_exactly(self, group):
        d = SeriesDomain(QQ, 4)
        x = tuple(d.rational(k + 2, 7) for k in range(group.dim))
        n, half = group.order, d.rational(1, 2)
        a = tuple(half * e for e in group.hat(d, x))
        one = tuple(d.rational(int(i == j)) for i in range(n) for j in range(n))
        left, right = (
            tuple(i - e for i, e in zip(one, a, strict=True)),
            tuple(i + e for i, e in zip(one, a, strict=True)),
        )
        assert all(
            d.ring.is_zero(p - q) is True
            for p, q in zip(matmul(left, group.matrix(d, group.cay(d, x)), n), right, strict=True)
        )

    def test_has_the_inverse_differential_as_a_product_of_matrices_exactly(self, group):
        d = SeriesDomain(QQ, 1)
        x, y = (tuple(d.rational(3 * k + j, 5) for k in range(group.dim)) for j in (1, 2))
        n, half = group.order, d.rational(1, 2)
        a = tuple(half * e for e in group.hat(d, x))
        one = tuple(d.rational(int(i == j)) for i in range(n) for j in range(n))
        left = tuple(i - e for i, e in zip(one, a, strict=True))
        right = tuple(i + e for i, e in zip(one, a, strict=True))
        product = matmul(matmul(left, group.hat(d, y), n), right, n)
        result = group.hat(d, group.dcayinv(d, x, y))
        assert all(d.ring.is_zero(p - q) is True for p, q in zip(product, result, strict=True))


WITH_CAYLEY = [name for name, group in HERE.items() if group.offers(CayleyMap)]


@pytest.mark.parametrize("name", WITH_CAYLEY)
def test_the_inverse_differential_contains_the_product_x_y_x(name):
    s = sampler(HERE[name], "exact, series")
    d, group, x, y = s.domain, s.group, s.vector(), s.vector()
    half, quarter = d.rational(1, 2), d.rational(1, 4)
    terms = zip(y, group.ad(d, x, y), group.sandwich(d, x, y), strict=True)
    assert s.equal(group.dcayinv(d, x, y), tuple(a - half * b - quarter * c for a, b, c in terms))
    # The formula that groups inherit is the same product.
    assert s.equal(group.sandwich(d, x, y), CayleyMap.sandwich(group, d, x, y))


def test_the_cayley_map_of_quaternions_covers_the_one_of_rotations():
    # A quaternion has half the angle of its rotation: cay(x) on SO(3) is the image of (1, x/2)/|(1, x/2)|,
    # and cay(y) on S^3 is (1, y/2)^2/|(1, y/2)|^2.
    s = sampler(SO3(), "exact, series")
    d, x = s.domain, s.vector()
    quaternion = (d.rational(1), *(d.rational(1, 2) * a for a in x))
    assert s.equal(SO3().cay(d, x), SO3().projected_covering(d, quaternion))
    square = S3().mul(d, quaternion, quaternion)
    length = sum((a * a for a in quaternion[1:]), quaternion[0] * quaternion[0])
    assert s.equal(S3().cay(d, x), tuple(a / length for a in square))


@pytest.mark.parametrize("group", [orthogonal(4), SYMPLECTIC, SL2()], ids=lambda g: g.name)
def test_the_exponential_of_a_basis_element_in_closed_form_is_the_series(group):
    d = PreciseDomain(0, 40)
    for k in range(group.dim):
        t = d.rational(3 * k + 2, 5)
        x = tuple(t if i == k else d.rational(0) for i in range(group.dim))
        pairs = zip(group.expbasis(d, k, t), MatrixGroup.exp(group, d, x), strict=True)
        assert max(abs(p - q) for p, q in pairs) < 1e-34


@pytest.mark.parametrize(
    "group",
    [
        MatrixGroup(
            "SL(3)",
            [elementary(3, (i, j, 1)) for i in range(3) for j in range(3) if i != j]
            + [elementary(3, (0, 0, 1), (1, 1, -1)), elementary(3, (1, 1, 1), (2, 2, -1))],
        ),
        Cotangent(SO3()),
        Product(SO3(), Cotangent(SO3())),
    ],
    ids=lambda g: g.name,
)
def test_a_group_without_a_cayley_map_is_refused_when_the_scene_is_read(group):
    y = group.point("y")
    with pytest.raises(SceneError, match=r"^top: .* has no Cayley map; .*x\^3.*coordinates=\"exp\""):
        FieldScene(
            group=group,
            action=LeftMultiplication(),
            y=list(y),
            f=[0] * group.dim,
            y0=[1, *[0] * (group.size - 1)],
            span=(0, 1),
            coordinates="cayley",
            name="top",
        )


def test_a_hamiltonian_scene_has_the_exponential_map_only():
    q, mu = SO3().point("q"), SO3().dual("mu")
    arguments = {"group": SO3(), "q": q, "mu": mu, "H": mu.dot(mu), "mu0": [1, 2, 3], "span": (0, 1)}
    with pytest.raises(SceneError, match=r"^top: coordinates='cayley' on T\*G; expected coordinates=\"exp\""):
        HamiltonianScene(**arguments, q0=quarter_turn(), coordinates="cayley", name="top")
    HamiltonianScene(**arguments, q0=quarter_turn(), coordinates="exp", name="top")


def test_an_unknown_map_is_refused_by_the_names_of_the_known_maps():
    for wrong in ("caley", 3, None):
        with pytest.raises(
            SceneError, match=r"s: coordinates=.*; expected one of 'exp', 'cayley', 'second_kind'"
        ):
            coordinate_map(wrong, SO3(), "s")
    assert coordinate_map("exp", SO3(), "s") is None


def test_second_kind_needs_an_adjoint_map():
    with pytest.raises(
        SceneError,
        match=r"T.SO.3. has no adjoint map, but .* need an adjoint map; expected a group with an",
    ):
        coordinate_map("second_kind", Cotangent(SO3()), "s")


NAMES = ("SO(3)", "S^2", "GL(2)", "S^3", "SL(2)", "SE(2)", "Heisenberg")


def in_coordinates(name, coordinates):
    scene = field_scene(name)
    return replace(scene, coordinates=coordinate_map(coordinates, scene.group, name))


QUICK = [("S^2", "cayley", "rkmk:kutta3"), ("SL(2)", "second_kind", "rkmk:kutta3")]


@pytest.mark.parametrize(
    ("name", "coordinates", "method"),
    [
        pytest.param(*case, marks=() if case in QUICK else pytest.mark.slow)
        for case in product(NAMES, ("cayley", "second_kind"), ("rkmk:kutta3", "rkmk(0):rk4"))
    ],
)
def test_the_order_on_the_group_is_the_order_of_the_tableau(name, coordinates, method):
    scene = in_coordinates(name, coordinates)
    made = compile_method(scene, method)
    order = certified_order(made.method, made.scene).order
    assert order == {"rkmk:kutta3": 3, "rkmk(0):rk4": 4}[method]
    assert valuation(local_error(made.program, made.problem, QQ, order + 1)) == order + 1


def spinning(group, action, y0, coordinates):
    """A quadratic field without symmetry on the orbit of y0."""
    n = len(y0)
    y = Matrix(symbols(f"y0:{n}", real=True))
    f = [y[k % n] - y[(k + 1) % n] * y[(3 * k + 2) % n] / 2 + Rational(k + 1, 4) for k in range(group.dim)]
    return FieldScene(
        group=group, action=action, y=y, f=f, y0=y0, span=(0, 1), coordinates=coordinates, name="spinning"
    )


DIAGONAL = [int(i == j) * (i + 1) for i in range(4) for j in range(4)]

EMITTED = [
    (SO3(), Rotation(), [1, 2, 2], "cayley"),
    (SO3(), Rotation(), [1, 2, 2], "second_kind"),
    (SE2(), LeftMultiplication(), [1, 0, 1, 2], "second_kind"),
    (S3(), LeftMultiplication(), [1, 0, 0, 0], "cayley"),
    (SL2(), LeftMultiplication(), [1, 0, 0, 1], "second_kind"),
    (GL(2), LeftMultiplication(), [1, 0, 0, 1], "cayley"),
    (SE3(), LeftMultiplication(), [*quarter_turn(), Fraction(1, 2), 0, -1], "cayley"),
    (GL(2), LeftMultiplication(), [1, 0, 0, 1], "second_kind"),
    (orthogonal(4), Conjugation(), DIAGONAL, "cayley"),
]


@pytest.mark.parametrize(
    ("group", "action", "y0", "coordinates"),
    [
        pytest.param(*case, id=f"{case[0].name}-{case[3]}", marks=() if k in (0, 7) else pytest.mark.slow)
        for k, case in enumerate(EMITTED)
    ],
)
def test_emitted_code_takes_the_step_of_the_interpreter(group, action, y0, coordinates):
    scene = spinning(group, action, y0, coordinates)
    made = compile_method(scene, "rkmk:rk4")
    d = PreciseDomain(Fraction(1, 8), 40)
    exact = interpret(made.program, made.problem, d, {"y": scene.initial(d)})["y"]
    for target in ("c", "python"):
        emission = emit(scene, "rkmk:rk4", target)
        after = load(emission).step([float(x) for x in y0], 0.125)
        assert max(abs(a - float(b)) for a, b in zip(after, exact, strict=True)) < 1e-13, target
        text = " ".join(" ".join(emission.files.values()).replace("*", " ").split())
        assert scene.coordinates.text.split(",")[0] in text


def test_the_header_says_that_the_cut_off_is_not_read():
    scene = spinning(SO3(), Rotation(), [1, 2, 2], "cayley")
    text = emit(scene, "rkmk(1):rk4", "python")
    assert "the cut-off 1 has no effect" in " ".join(" ".join(text.files.values()).split())


def test_other_families_use_the_exponential_map():
    plain, cayley = (
        emit(spinning(SO3(), Rotation(), [1, 2, 2], c), "cf:cf4", "python").files for c in ("exp", "cayley")
    )
    assert plain == cayley


def test_predictions_from_order_conditions_assume_exponential_coordinates():
    scene = in_coordinates("S^2", "cayley")
    made = compile_method(scene, "rkmk:kutta3")
    with pytest.raises(SceneError, match="in the coordinates cayley; expected exponential coordinates"):
        predicted(made.problem, made.method, 4)


class Doubled(CoordinateMap):
    """exp(x/2) exp(x/2), which is exp(x): a map of a user that is written with few operations."""

    name, text = "doubled", "exponential in two halves"

    def check(self, group, where=""):
        """Every group has this map."""

    def element(self, d, group, x):
        half = group.exp(d, tuple(d.rational(1, 2) * a for a in x))
        return group.mul(d, half, half)

    def inverse_differential(self, d, group, x, y):
        return group.dexpinv(d, x, y, 6)


def test_a_scene_may_bring_its_own_map():
    scene = replace(field_scene("S^2"), coordinates=coordinate_map(Doubled(), SO3(), "S^2"))
    made = compile_method(scene, "rkmk:rk4")
    assert valuation(local_error(made.program, made.problem, QQ, 5)) == 5


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_step_to_a_singular_point_of_the_cayley_map_returns_a_status(target):
    # 1 - x/2 is singular for x = h diag(1, -1) at h = 2.
    y = SL2().point("y")
    scene = FieldScene(
        group=SL2(),
        action=LeftMultiplication(),
        y=list(y),
        f=[0, 0, 1],
        y0=[1, 0, 0, 1],
        span=(0, 1),
        coordinates="cayley",
    )
    module = load(emit(scene, "rkmk:euler", target))
    assert module.step([1, 0, 0, 1], 1.0) == pytest.approx([3, 0, 0, 1 / 3])
    with pytest.raises(StepFailed) as caught:
        module.step([1, 0, 0, 1], 2.0)
    assert caught.value.status is Status.TOO_FAR
