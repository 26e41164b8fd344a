"""The laws of a left action, for every action and group it is used with."""

from __future__ import annotations

import pytest

from codegen.errors import SceneError
from codegen.groups import LeftMultiplication, Motion, Product, Rotation, get, listing
from orderconds.errors import UnknownName
from tests.strategies import ALL_GROUPS, SAMPLES, sampler

ACTIONS = [
    (Rotation(), "SO(3)", 3),
    (Rotation(), "GL(2)", 2),
    (Rotation(), "SL(2)", 2),
    (Rotation(), "Heisenberg", 3),
    (Motion(), "SE(2)", 2),
]
"""Actions, each with a group of ``tests/strategies.py`` and the number of coordinates of a point."""

CASES = [
    *(
        pytest.param(LeftMultiplication(), name, None, id=f"left multiplication-{name}")
        for name in ALL_GROUPS
    ),
    *(pytest.param(action, name, size, id=f"{action.name}-{name}") for action, name, size in ACTIONS),
]


def drawn(name, size, sample):
    """A sampler of a group, and a point: an element of the group, or ``size`` coordinates."""
    s = sampler(ALL_GROUPS[name], sample)
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


def test_groups_are_listed_with_what_they_are():
    rows = [row if isinstance(row, dict) else row.__dict__ for row in listing()]
    assert len(rows) == len({str(row) for row in rows}) >= 5


def test_an_unknown_group_lists_the_known_ones():
    with pytest.raises(UnknownName, match="unknown group 'SO4'; expected one of Affine, Cotangent"):
        get("SO4")
    assert get("SO3").name == "SO(3)"


def test_a_product_without_factors_is_refused():
    with pytest.raises(SceneError, match="a product without factors"):
        Product()
