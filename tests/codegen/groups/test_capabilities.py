"""Capabilities: which group declares which, the identities of each, and the refusal of a group without it."""

from __future__ import annotations

import inspect
from fractions import Fraction
from math import isqrt

import pytest

from codegen.errors import SceneError
from codegen.groups import SO3, Cotangent, LieGroup, Linear, Product, Rn, capabilities
from codegen.groups.capabilities import (
    BodyFrame,
    CayleyMap,
    ClosedFormSeries,
    Coadjoint,
    CotangentBundle,
    Covered,
    DependentCoordinates,
    DirectProduct,
    Inverse,
    LeftTranslation,
    MatrixElements,
    MatrixRepresentation,
    PointMotions,
    Projection,
    RightTrivialisation,
    Rotations,
)
from codegen.groups.linear_algebra import dot, matmul, matvec
from codegen.ir.ad_series import Factor
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import evaluate
from codegen.kernel.variations import Variations
from codegen.scene import FieldScene, HamiltonianScene
from tests.strategies import ALL_GROUPS, BASE_GROUPS, ORDER, hamiltonian_scene, sampler

EXACT, SHARP = "exact, series", "40 digits, uniform"

PROJECTED = sorted(set(BASE_GROUPS) - {"GL(2)", "Heisenberg", "affine"})
"""The groups with a projection; their cotangent bundles have one, too."""

POSES = {"SE(3)", "SE(3) over SU(2)", "SE_2(3)"}
MORE = {"SO(2)", "SU(2)"}
DECLARED = {
    Coadjoint: set(BASE_GROUPS),
    RightTrivialisation: {
        "affine",
        "SO(3)",
        "R^3",
        "GL(2)",
        "Heisenberg",
        "S^3",
        "SL(2)",
        "SO(3) x R^2",
        *POSES,
        *MORE,
    },
    LeftTranslation: {"SO(3)", "R^3", "S^3", "SO(3) x R^2", *POSES, *MORE},
    BodyFrame: {"SO(3)", "SE(3)", "SE_2(3)"},
    Covered: {"SO(3)", "SE(3)", "SE_2(3)"},
    ClosedFormSeries: {"SO(3)", "S^3", "SL(2)", "SU(2)", *POSES},
    MatrixRepresentation: {
        *("SO(3)", "GL(2)", "Heisenberg", "SL(2)", "R^3", "SO(2)", "SE(3)", "SE_2(3)", "affine")
    },
    MatrixElements: {"SO(3)", "GL(2)", "Heisenberg", "SL(2)"},
    Rotations: {"SO(3)"},
    PointMotions: {"SE(2)", "SO(2)", "affine", *POSES},
    Projection: {name for group in PROJECTED for name in (group, f"T*{group}")},
    DependentCoordinates: {"SO(3)"},
    DirectProduct: {"SO(3) x R^2"},
    Inverse: set(ALL_GROUPS),
    CayleyMap: {
        "SO(3)",
        "R^3",
        "GL(2)",
        "Heisenberg",
        "S^3",
        "SE(2)",
        "SL(2)",
        "SO(3) x R^2",
        "SO(2)",
        "SU(2)",
        "SE(3)",
        "SE_2(3)",
        "affine",
    },
    CotangentBundle: {f"T*{name}" for name in BASE_GROUPS},
}
"""The groups of each capability, among the groups and bundles of :data:`PINNED`."""

PINNED = {"SO(3)", "R^3", "GL(2)", "Heisenberg", "S^3", "SE(2)", "SL(2)", "SO(3) x R^2"}
PINNED |= {"SO(2)", "SU(2)", "affine", *POSES}
PINNED |= {f"T*{name}" for name in PINNED}

IDS = [capability.__name__ for capability in DECLARED]


def offering(capability):
    """The names of all groups that offer a capability."""
    return {name for name, group in ALL_GROUPS.items() if group.offers(capability) is not None}


def with_capability(capability, samples=(EXACT, SHARP)):
    """Samplers of all groups that declare a capability."""
    return [
        pytest.param(sampler(ALL_GROUPS[name], sample), id=f"{name}-{sample}")
        for name in sorted(offering(capability))
        for sample in samples
    ]


def coordinates(s, size):
    """A vector of ``size`` numbers."""
    return tuple(s.domain.rational(k + 1, 3) + s.scalar() for k in range(size))


class Bare(Rn):
    """R^n without the coadjoint action and the trivialisation that it inherits."""

    def offers(self, capability):
        """Return self for the base class only."""
        return self if capability is LieGroup else None


def test_every_capability_is_tested_here():
    classes = [x for _, x in inspect.getmembers(capabilities, inspect.isclass) if issubclass(x, LieGroup)]
    assert {c for c in classes if c is not LieGroup} == set(DECLARED)
    assert len({c.provides for c in classes}) == len(classes)


@pytest.mark.parametrize("capability", DECLARED, ids=IDS)
def test_a_group_offers_what_it_declares(capability):
    assert offering(capability) & PINNED == DECLARED[capability] & PINNED


@pytest.mark.parametrize("capability", DECLARED, ids=IDS)
def test_a_group_without_a_capability_is_refused_by_its_name(capability):
    with pytest.raises(SceneError) as caught:
        Bare(2).require(capability, where="here")
    text = str(caught.value)
    assert text.startswith(f"here: R^2 has no {capability.provides}; expected a group with the capability")
    assert f"codegen.groups.capabilities.{capability.__name__}" in text


def test_a_group_with_a_missing_method_cannot_be_created():
    class Incomplete(Rotations):
        """Nothing but a name."""

        name = "incomplete"

    with pytest.raises(TypeError, match="abstract"):
        Incomplete()


class TestAProduct:
    def test_has_the_capabilities_that_all_factors_have(self):
        assert Product(SO3(), Rn(2)).offers(RightTrivialisation) is not None
        assert Product(SO3(), Bare(2)).offers(RightTrivialisation) is None
        assert Product(SO3(), Product(SO3(), Bare(2))).offers(RightTrivialisation) is None
        assert Product(SO3(), Bare(1)).offers(Coadjoint) is None

    def test_names_the_factor_that_lacks_one(self):
        from codegen.ir.domain import FloatDomain

        product = Product(Rn(1), Bare(2))
        with pytest.raises(SceneError, match=r"R\^2 has no coadjoint action"):
            product.adt(FloatDomain(0.1), (1.0,) * 3, (1.0,) * 3)


class TestACallerRefuses:
    def test_momenta_on_a_group_without_coadjoint_action(self):
        with pytest.raises(SceneError, match=r"R\^2 has no coadjoint action"):
            Cotangent(Bare(2))
        group = Bare(1)
        q, mu = group.point("q"), group.dual("p")
        H = mu[0] ** 2
        with pytest.raises(SceneError, match=r"^top: R\^1 has no coadjoint action"):
            HamiltonianScene(group=group, q=q, mu=mu, H=H, q0=[0], mu0=[1], span=(0, 1), name="top")

    def test_linear_maps_of_a_group_that_has_no_matrices(self):
        group = Rn(2)
        with pytest.raises(
            SceneError,
            match=r"R\^2 has no matrix el.*the action linear maps needs.*another action of R\^2",
        ):
            FieldScene(group=group, action=Linear(), y=group.dual("y"), f=[1, 2], y0=[0, 0], span=(0, 1))

    def test_a_jacobian_on_a_group_without_right_trivialisation(self):
        with pytest.raises(SceneError, match=r"right trivialisation, which is not implemented for SE\(2\)"):
            Variations.of(hamiltonian_scene("SE(2)"))


@pytest.mark.parametrize("s", with_capability(RightTrivialisation))
def test_the_rate_of_the_velocity_of_x_is_x(s):
    x, g = s.vector(), s.element()
    assert s.equal(s.group.rate(s.domain, s.group.velocity(s.domain, x, g), g), x)


@pytest.mark.parametrize("s", with_capability(Coadjoint))
def test_the_transported_momentum_is_that_of_the_product_on_the_cotangent_group(s):
    x, n, mu = s.vector(), s.covector(), s.covector()
    lifted, g = Cotangent(s.group), s.element()
    after = lifted.mul(s.domain, lifted.exp(s.domain, x + n), g + mu)
    assert s.equal(s.group.transport(s.domain, x, n, mu), after[s.group.size :])


@pytest.mark.parametrize("s", with_capability(BodyFrame))
def test_mulexp_is_the_product_with_the_exponential(s):
    d, g, x = s.domain, s.element(), s.vector()
    assert s.equal(s.group.mulexp(d, g, x), s.group.mul(d, g, s.group.exp(d, x)))


@pytest.mark.parametrize("s", with_capability(Covered))
class TestTheCover:
    def test_the_covering_map_is_a_homomorphism(self, s):
        d, group = s.domain, s.group
        p, q = (group.cover.exp(d, s.vector()) for _ in range(2))
        product = group.mul(d, group.covering(d, p), group.covering(d, q))
        assert s.equal(group.covering(d, group.cover.mul(d, p, q)), product)

    def test_the_covering_map_commutes_with_exponentials(self, s):
        d, group, x = s.domain, s.group, s.vector()
        q = group.cover.exp(d, group.lifted_velocity(d, x))
        assert s.equal(group.covering(d, q), group.exp(d, x))

    def test_the_projected_covering_does_not_depend_on_the_length(self, s):
        d, group = s.domain, s.group
        q = group.cover.exp(d, s.vector())
        length = getattr(group.cover, "linear", group.cover).size
        longer = (*(d.rational(3, 2) * a for a in q[:length]), *q[length:])
        assert s.equal(group.projected_covering(d, longer), group.covering(d, q))


@pytest.mark.parametrize("s", with_capability(LeftTranslation))
class TestLeftTranslations:
    def test_the_left_velocity_is_the_velocity_of_ad(self, s):
        d, g, x = s.domain, s.element(), s.vector()
        assert s.equal(s.group.left_velocity(d, g, x), s.group.velocity(d, s.group.Ad(d, g, x), g))

    def test_adinv_inverts_ad(self, s):
        d, g, x = s.domain, s.element(), s.vector()
        assert s.equal(s.group.Adinv(d, g, s.group.Ad(d, g, x)), x)

    def test_the_relations_hold_on_the_group(self, s):
        names = [f"q{k}" for k in range(s.group.size)]
        d, value = s.domain, dict(zip(names, s.element(), strict=True))
        relations = s.group.relations(names)
        for (a, b), terms in relations:
            total = d.rational(0)
            for c, monomial in terms:
                term = d.number(c)
                for symbol in monomial:
                    term = term * value[symbol]
                total = total + term
            assert s.equal((total,), (value[a] * value[b],))


@pytest.mark.parametrize(("name", "count"), [("SO(3)", 6), ("R^3", 0), ("S^3", 1), ("SO(3) x R^2", 6)])
def test_every_relation_of_the_group_is_listed(name, count):
    group = ALL_GROUPS[name]
    assert len(group.relations([f"q{k}" for k in range(group.size)])) == count


WORDS = {
    "exp": (Factor("exp", Fraction(2, 3)),),
    "dexp": (Factor("dexp", Fraction(-1)),),
    "dexpinv": (Factor("dexpinv", Fraction(1), 4),),
    "product": (
        Factor("exp", Fraction(-1, 2)),
        Factor("dexp", Fraction(1)),
        Factor("dexpinv", Fraction(2), 2),
    ),
    "inverse": (Factor("dexp", Fraction(1, 2), 0, -1),),
}


@pytest.mark.parametrize("s", with_capability(ClosedFormSeries))
class TestClosedFormSeries:
    def test_one_factor_is_the_operation_of_its_name(self, s):
        d, group, x, y, mu = s.domain, s.group, s.vector(), s.vector(), s.covector()
        exp, dexp, dexpinv = ((Factor(name, Fraction(1), 4),) for name in ("exp", "dexp", "dexpinv"))
        g = group.exp(d, x)
        assert s.equal(group.series(d, exp, False, x, y), group.Ad(d, g, y))
        assert s.equal(group.series(d, exp, True, x, mu), group.Adt(d, g, mu))
        assert s.equal(group.series(d, dexp, True, x, mu), group.dexpt(d, x, mu))
        assert s.equal(group.series(d, dexpinv, False, x, y), group.dexpinv(d, x, y, 4))
        assert s.equal(group.series(d, dexpinv, True, x, mu), group.dexpinvt(d, x, mu, 4))

    @pytest.mark.parametrize("dual", [False, True])
    def test_a_word_applies_its_factors_one_after_the_other(self, s, dual):
        d, x, v = s.domain, s.vector(), s.covector()
        stepwise = v
        for factor in WORDS["product"]:
            stepwise = s.group.series(d, (factor,), dual, x, stepwise)
        assert s.equal(s.group.series(d, WORDS["product"], dual, x, v), stepwise)

    def test_a_power_of_minus_one_inverts(self, s):
        d, x, v = s.domain, s.vector(), s.covector()
        straight = (Factor("dexp", Fraction(1, 2)),)
        there = s.group.series(d, straight, False, x, v)
        assert s.equal(s.group.series(d, WORDS["inverse"], False, x, there), v)

    @pytest.mark.parametrize("dual", [False, True])
    def test_the_nested_sum_is_the_sum_of_the_terms(self, s, dual):
        d, x = s.domain, s.vector()
        terms = [(d.rational(k + 1, 3), word, s.covector()) for k, word in enumerate(WORDS.values())]
        single = [tuple(f * a for a in s.group.series(d, word, dual, x, v)) for f, word, v in terms]
        total = tuple(sum(parts[1:], parts[0]) for parts in zip(*single, strict=True))
        assert s.equal(s.group.series_sum(d, terms, dual, x), total)


@pytest.mark.parametrize("s", with_capability(MatrixRepresentation))
class TestMatrixRepresentation:
    def test_of_a_product_is_the_product_of_the_matrices(self, s):
        d, g, k = s.domain, s.element(), s.element()
        matrices = [s.group.matrix(d, x) for x in (g, k, s.group.mul(d, g, k))]
        assert s.equal(matmul(*matrices[:2], isqrt(len(matrices[0]))), matrices[2])

    def test_of_a_velocity_is_the_product_with_hat(self, s):
        d, g, x = s.domain, s.element(), s.vector()
        a, m = s.group.hat(d, x), s.group.matrix(d, g)
        assert s.equal(s.group.element(matmul(a, m, isqrt(len(m)))), s.group.velocity(d, x, g))

    def test_has_inverse_maps(self, s):
        d, g, x = s.domain, s.element(), s.vector()
        assert s.equal(s.group.element(s.group.matrix(d, g)), g)
        assert s.equal(s.group.vee(d, s.group.hat(d, x)), x)

    def test_is_linear_for_differences(self, s):
        d, g, k = s.domain, s.element(), s.element()
        rows = zip(s.group.matrix(d, g), s.group.matrix(d, k), strict=True)
        gap = s.group.element(tuple(a - b for a, b in rows))
        assert s.equal(gap, tuple(a - b for a, b in zip(g, k, strict=True)))


@pytest.mark.parametrize("s", with_capability(DirectProduct))
def test_the_parts_of_a_product_are_elements_of_its_factors(s):
    g, x = s.element(), s.vector()
    for values, width in ((g, "size"), (x, "dim")):
        parts = s.group.parts(values)
        assert [len(part) for part in parts] == [getattr(f, width) for f in s.group.factors]
        assert tuple(a for part in parts for a in part) == values
    exponentials = [f.exp(s.domain, part) for f, part in zip(s.group.factors, s.group.parts(x), strict=True)]
    assert s.equal(sum(exponentials, ()), s.group.exp(s.domain, x))


@pytest.mark.parametrize("s", with_capability(CotangentBundle))
def test_the_canonical_bivector_takes_the_differential_of_h_to_its_field(s):
    """For the differential (ad*_xi mu - n, xi) it is (xi, n)."""
    z, f = s.element(), s.vector()
    base = s.group.base
    xi, n = f[: base.dim], f[base.dim :]
    slope = tuple(a - b for a, b in zip(base.adt(s.domain, xi, z[base.size :]), n, strict=True))
    assert s.equal(s.group.canonical(s.domain, z, (*slope, *xi)), f)


@pytest.mark.parametrize("s", with_capability(MatrixElements))
class TestMatrixElements:
    def test_velocity_and_product_are_products_of_matrices(self, s):
        d, g, k, x, n = s.domain, s.element(), s.element(), s.vector(), s.group.order
        assert s.equal(s.group.mul(d, g, k), matmul(g, k, n))
        assert s.equal(s.group.velocity(d, x, g), matmul(s.group.hat(d, x), g, n))

    def test_a_point_is_a_square_matrix_of_its_symbols(self, s):
        point, n = s.group.point("g"), s.group.order
        assert point.shape == (n, n)
        assert list(point) == s.group.symbols("g")
        assert str(point[0, n - 1]) == f"g0{n - 1}"


@pytest.mark.parametrize("s", with_capability(Rotations))
def test_a_rotation_is_the_product_with_the_exponential_and_keeps_the_length(s):
    d, x, y = s.domain, s.vector(), coordinates(s, s.group.order)
    turned = s.group.rotate(d, x, y)
    assert s.equal(turned, matvec(s.group.exp(d, x), y))
    assert s.equal((dot(turned, turned),), (dot(y, y),))


@pytest.mark.parametrize("s", with_capability(PointMotions))
class TestPointMotions:
    def test_a_product_moves_by_its_right_factor_first(self, s):
        d, g, k, z = s.domain, s.element(), s.element(), coordinates(s, s.group.point_size)
        assert s.equal(s.group.move(d, s.group.mul(d, g, k), z), s.group.move(d, g, s.group.move(d, k, z)))

    def test_the_velocity_moves_with_the_point(self, s):
        d, g, x, z = s.domain, s.element(), s.vector(), coordinates(s, s.group.point_size)
        origin = (d.rational(0),) * s.group.point_size
        turned = s.group.point_velocity(d, s.group.Ad(d, g, x), s.group.move(d, g, z))
        ends = [s.group.move(d, g, p) for p in (s.group.point_velocity(d, x, z), origin)]
        assert s.equal(turned, tuple(a - b for a, b in zip(*ends, strict=True)))


@pytest.mark.parametrize("s", with_capability(Projection, (EXACT,)))
class TestProjection:
    def test_an_element_stays(self, s):
        g = s.element()
        assert s.equal(s.group.project(s.domain, g), g)

    def test_a_defect_of_first_order_becomes_one_of_second_order(self, s):
        d, group = s.domain, s.group
        g = tuple(x + d.h * d.rational(s.rng.choice((-4, -2, -1, 1, 2, 4)), 3) for x in s.element())
        if not group.laws(d, g):
            pytest.skip("every tuple of coordinates is an element")
        before, after = ([x for _, x in group.laws(d, y)] for y in (g, group.project(d, g)))
        assert any(x.coefficients[1] != 0 for x in before)
        assert all(x.coefficients[:2] == (0, 0) for x in after)
        assert ORDER >= 2
        assert any(c != 0 for x in after for c in x.coefficients[2:])


@pytest.mark.parametrize("s", with_capability(DependentCoordinates))
def test_dependent_coordinates_follow_from_the_others(s):
    g, zero = s.element(), s.domain.rational(0)
    for missing in s.group.determined():
        without = tuple(zero if i in missing else x for i, x in enumerate(g))
        assert s.equal(s.group.complete(s.domain, without, missing), g)


def test_operations_of_a_capability_serve_expressions_too():
    """Code generation evaluates them over expressions: the value is that of the same formula in numbers."""
    s = sampler(SO3(), SHARP)
    d = ExprDomain()
    names = [f"x{k}" for k in range(3)], [f"y{k}" for k in range(3)]
    x, y = (tuple(d.space.sym(name) for name in row) for row in names)
    numbers = s.vector(), s.covector()
    values = {
        n: v for row, vector in zip(names, numbers, strict=True) for n, v in zip(row, vector, strict=True)
    }
    for word in WORDS.values():
        roots = s.group.series(d, word, False, x, y)
        assert s.equal(
            tuple(evaluate(roots, s.domain, values)), s.group.series(s.domain, word, False, *numbers)
        )
