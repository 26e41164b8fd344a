"""A group of a user with one wrong formula is refused when a scene is read; the message names the law."""

from __future__ import annotations

from copy import copy
from fractions import Fraction

import pytest

from codegen.errors import SceneError
from codegen.groups import SE2, SE3, SO2, SO3, Cotangent, LeftMultiplication, Product, Rn
from codegen.groups.base import LieGroup
from codegen.groups.laws import check_laws
from codegen.scene import FieldScene, HamiltonianScene
from tests.strategies import GROUPS, quarter_turn


def own(group, **members):
    """A copy of a group, as an object of a class of this file with other members."""
    result = copy(group)
    result.__class__ = type("Own", (type(group),), members)
    return result


def minus(x):
    return tuple(-a for a in x)


def opposite(base, name, place):
    """A method whose argument at ``place`` has the wrong sign."""

    def method(self, d, *arguments):
        changed = [minus(a) if i == place else a for i, a in enumerate(arguments)]
        return getattr(base, name)(self, d, *changed)

    return method


def transposed(base, name):
    """A method that replaces the rotation matrix g by its inverse."""
    return lambda self, d, g, x: getattr(base, name)(self, d, base.inverse(self, d, g), x)


def truncated(self, d, x):
    """The exponential series up to x^8."""
    a, term = self.hat(d, x), self.identity(d)
    total = term
    for k in range(1, 9):
        term = tuple(d.rational(1, k) * b for b in self.mul(d, a, term))
        total = tuple(p + q for p, q in zip(total, term, strict=True))
    return total


def third(self, d, x, y, order):
    """The series of dexp^{-1} with a wrong coefficient of the double bracket."""
    right = LieGroup.dexpinv(self, d, x, y, order)
    if order < 2:
        return right
    double = self.ad(d, x, self.ad(d, x, y))
    return tuple(a + d.rational(1, 12) * b for a, b in zip(right, double, strict=True))


WRONG = {
    "bracket": (SO3(), {"ad": opposite(SO3, "ad", 0)}, r"exp\(h x\) exp\(h y\)"),
    "truncated exp": (SO3(), {"exp": truncated, "laws": LieGroup.laws}, r"exp\(x\) exp\(2 x\) = exp\(3 x\)"),
    "order of mul": (SO3(), {"mul": lambda s, d, g, k: SO3.mul(s, d, k, g)}, r"velocity\(x, g\)"),
    "velocity": (SE2(), {"velocity": opposite(SE2, "velocity", 0)}, r"velocity\(x, g\)"),
    "identity": (SO2(), {"identity": lambda s, d: (-d.rational(1), d.rational(0))}, r"exp\(0\) = e"),
    "abelian": (SO3(), {"abelian": True}, "because abelian is true"),
    "dim": (SO3(), {"dim": 4, "blocks": ((4, 9),)}, "fails at a sample element"),
    "size": (SO2(), {"size": 3, "blocks": ((1, 3),)}, "identity has 2 components; expected 3"),
    "blocks": (SE3(), {"blocks": ((3, 9), (3, 4))}, "the sum of the blocks"),
    "dexpinv": (SO3(), {"dexpinv": third}, r"dexpinv\(x, y, 2\)"),
    "expbasis": (SO3(), {"expbasis": lambda s, d, k, t: LieGroup.expbasis(s, d, k, -t)}, "expbasis"),
    "expmul": (SO3(), {"expmul": lambda s, d, x, g: SO3.mul(s, d, g, SO3.exp(s, d, x))}, "expmul"),
    "laws": (SO3(), {"laws": lambda s, d, g: (("g_11 = 1", g[0] - d.rational(1)),)}, "g_11 = 1"),
    "Ad": (SO3(), {"Ad": transposed(SO3, "Ad")}, r"exp\(Ad_g x\) g"),
    "Adt": (SO3(), {"Adt": transposed(SO3, "Adt")}, r"<Ad\*_g mu, y>"),
    "Adtinv": (SO3(), {"Adtinv": transposed(SO3, "Adtinv")}, r"Ad\*_{g\^-1} Ad\*_g mu"),
    "adt": (SO3(), {"adt": opposite(SO3, "adt", 0)}, r"<ad\*_x mu, y>"),
    "dexpt": (SO3(), {"dexpt": opposite(SO3, "dexpt", 0)}, r"dexp\*_x mu"),
    "transport": (SO3(), {"transport": opposite(SO3, "transport", 1)}, "transport"),
    "dexpinvt": (SO3(), {"dexpinvt": opposite(SO3, "dexpinvt", 0)}, "dexpinvt"),
    "P": (SO3(), {"P": opposite(SO3, "P", 1)}, "violates P"),
    "cotangent_expmul": (
        SO3(),
        {"cotangent_expmul": opposite(SO3, "cotangent_expmul", 1)},
        "cotangent_expmul",
    ),
    "inverse": (SO3(), {"inverse": lambda s, d, g: g}, None),
    "rate": (SO3(), {"rate": opposite(SO3, "rate", 0)}, r"rate\(velocity"),
    "Adinv": (SO3(), {"Adinv": SO3.Ad}, r"Ad_{g\^-1}"),
    "left_velocity": (SO3(), {"left_velocity": lambda s, d, g, x: SO3.velocity(s, d, x, g)}, "left_velocity"),
    "mulexp": (SO3(), {"mulexp": opposite(SO3, "mulexp", 1)}, "mulexp"),
    "cay": (SO3(), {"cay": opposite(SO3, "cay", 0)}, "dcayinv"),
    "dcayinv": (SO3(), {"dcayinv": opposite(SO3, "dcayinv", 0)}, "dcayinv"),
    "sandwich": (SO3(), {"sandwich": opposite(SO3, "sandwich", 1)}, "x y x"),
    "project": (SO3(), {"project": lambda s, d, g: SO3.mul(s, d, g, g)}, "project"),
    "complete": (SO3(), {"complete": lambda s, d, g, missing: g}, "complete"),
    "matrix": (SO3(), {"matrix": lambda s, d, g: SO3.inverse(s, d, g)}, "matrix"),
    "hat": (SO3(), {"hat": opposite(SO3, "hat", 0)}, "hat"),
    "vee": (SO3(), {"vee": lambda s, d, m: SO3.vee(s, d, minus(m))}, "vee"),
    "rotate": (SO3(), {"rotate": opposite(SO3, "rotate", 0)}, None),
    "exp that fails": (SO2(), {"exp": lambda s, d, x: (x[0] / x[0], x[0])}, "fails at a sample element"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_formula_is_seen(name):
    group, members, text = WRONG[name]
    with pytest.raises(SceneError, match=rf"^mine: .*{text or ''}.*correct the class Own"):
        check_laws(own(group, **members), "mine")


@pytest.mark.parametrize("name", GROUPS)
def test_right_formulas_are_accepted(name):
    check_laws(own(GROUPS[name]))


@pytest.mark.parametrize(
    "around", [lambda g: g, lambda g: Product(Rn(1), g), Cotangent], ids=["itself", "product", "bundle"]
)
def test_a_group_is_checked_in_products_and_bundles(around):
    with pytest.raises(SceneError, match=r"SO\(3\) violates"):
        check_laws(around(own(SO3(), ad=opposite(SO3, "ad", 0))))


def test_a_scene_with_a_wrong_group_is_refused():
    group = own(SO3(), adt=opposite(SO3, "adt", 0))
    q, mu = group.point("q"), group.dual("mu")
    with pytest.raises(SceneError, match=r"^top: the group SO\(3\) violates <ad\*_x mu, y>"):
        HamiltonianScene(
            group=group, q=q, mu=mu, H=mu.dot(mu), q0=quarter_turn(), mu0=[1, 0, 0], span=(0, 1), name="top"
        )
    with pytest.raises(SceneError, match=r"^field: the group SO\(3\) violates"):
        FieldScene(
            group=group,
            action=LeftMultiplication(),
            y=q,
            f=[1, 0, q[0]],
            y0=quarter_turn(),
            span=(0, Fraction(1)),
            name="field",
        )
