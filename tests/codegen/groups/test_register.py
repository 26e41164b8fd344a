"""A group, an action and scenes defined in this file alone go through laws, listings, emit and converge."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner
from sympy import Matrix, Rational, symbols

from codegen import groups, scenes
from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.errors import SceneError
from codegen.groups import Action, LieGroup
from codegen.groups.capabilities import Coadjoint, RightTrivialisation
from codegen.lab.orders.local_error import local_error, valuation
from codegen.loader import load
from codegen.scene import FieldScene, HamiltonianScene
from orderconds.cli import program
from orderconds.errors import UnknownName
from orderconds.ring import QQ
from tests.codegen.commands.conftest import registered as registered
from tests.promises import ulps
from tests.strategies import sampler


class Unipotent(Coadjoint, RightTrivialisation):
    """Upper triangular matrices with ones on the diagonal, by their three entries a, b and c = g_13.

    (a, b, c)(a', b', c') = (a + a', b + b', c + c' + a b'); exp(x, y, z) = (x, y, z + x y/2).
    """

    name, layout = "U(3)", ", the entries 12, 23 and 13"
    dim = size = 3

    def identity(self, d):
        return (d.rational(0),) * 3

    def mul(self, d, g, k):
        return (g[0] + k[0], g[1] + k[1], g[2] + k[2] + g[0] * k[1])

    def exp(self, d, x):
        return (x[0], x[1], x[2] + d.rational(1, 2) * (x[0] * x[1]))

    def ad(self, d, x, y):
        zero = d.rational(0)
        return (zero, zero, x[0] * y[1] - x[1] * y[0])

    def velocity(self, d, x, g):
        return (x[0], x[1], x[2] + x[0] * g[1])

    def rate(self, d, v, g):
        return (v[0], v[1], v[2] - v[0] * g[1])

    def Ad(self, d, g, x):
        return (x[0], x[1], x[2] + g[0] * x[1] - g[1] * x[0])

    def Adt(self, d, g, mu):
        return (mu[0] - g[1] * mu[2], mu[1] + g[0] * mu[2], mu[2])

    def Adtinv(self, d, g, mu):
        return (mu[0] + g[1] * mu[2], mu[1] - g[0] * mu[2], mu[2])

    def adt(self, d, x, mu):
        return (-(x[1] * mu[2]), x[0] * mu[2], d.rational(0))

    def dexpt(self, d, x, mu):
        half = d.rational(1, 2)
        return tuple(m + half * a for m, a in zip(mu, self.adt(d, x, mu), strict=True))


class Shear(Action):
    """The same group on the plane: (a, b, c).(s, t) = (s + b, t + c + a s)."""

    name = "shear"

    def act(self, d, group, g, y):
        return (y[0] + g[1], y[1] + g[2] + g[0] * y[0])

    def velocity(self, d, group, x, y):
        return (x[1], x[2] + x[0] * y[0])


def on_the_group():
    """A field without symmetry on the group itself."""
    a, b, c = y = Unipotent().point("y")
    f = Matrix([1 - b * c, a + Rational(1, 2), c - a**2])
    return FieldScene(
        group=Unipotent(),
        action=groups.LeftMultiplication(),
        y=y,
        f=f,
        y0=[Rational(1, 2), 0, Rational(1, 3)],
        span=(0, Rational(1, 2)),
        velocity=[f[0], f[1], f[2] + f[0] * b],
        title="A field on U(3)",
    )


def on_the_plane():
    """The harmonic oscillator s' = t, t' = -s, its field put into the algebra by the shear."""
    s, t = symbols("s t_", real=True)
    return FieldScene(
        group=Unipotent(),
        action=Shear(),
        y=[s, t],
        f=[-1, t, 0],
        y0=[1, 0],
        span=(0, 1),
        velocity=[t, -s],
        invariants={"energy": s**2 + t**2},
        title="The oscillator, sheared",
    )


def on_the_bundle():
    """A Hamiltonian of the group and its momentum."""
    q, mu = Unipotent().point("q"), Unipotent().dual("p")
    return HamiltonianScene(
        group=Unipotent(),
        q=q,
        mu=mu,
        H=mu.dot(mu) / 2 + q[0] ** 2 / 2 + q[1] * q[2] + mu[0] * q[1],
        q0=[Rational(1, 2), Rational(-1, 3), 1],
        mu0=[1, 0, Rational(1, 4)],
        span=(0, Rational(1, 2)),
        title="A Hamiltonian on T*U(3)",
    )


SCENES = {"toy_field": on_the_group, "toy_shear": on_the_plane, "toy_bundle": on_the_bundle}


@pytest.fixture(autouse=True)
def toy():
    groups.register(Unipotent)
    groups.register(Shear)
    for name, scene in SCENES.items():
        scenes.register(name, scene(), about=scene.__doc__)
    yield
    for cls in (Unipotent, Shear):
        groups.unregister(cls)
    for name in SCENES:
        scenes.unregister(name)


def call(*arguments):
    done = CliRunner().invoke(program, list(arguments), catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return done.output


@pytest.mark.parametrize("sample", ["doubles, uniform", "40 digits, near the identity", "exact, series"])
class TestTheToyIsALieGroup:
    def test_with_an_exponential_and_a_product(self, sample):
        s = sampler(Unipotent(), sample)
        d, group, (g, k, m), x = s.domain, s.group, (s.element() for _ in range(3)), s.vector()
        assert s.equal(group.mul(d, group.mul(d, g, k), m), group.mul(d, g, group.mul(d, k, m)))
        assert s.equal(group.mul(d, group.exp(d, x), group.exp(d, tuple(-a for a in x))), group.identity(d))
        assert s.equal(group.mul(d, g, group.exp(d, x)), group.mul(d, group.exp(d, group.Ad(d, g, x)), g))
        assert s.equal(group.Adtinv(d, g, group.Adt(d, g, x)), x)
        assert s.equal(group.rate(d, group.velocity(d, x, g), g), x)

    def test_that_acts_on_the_plane(self, sample):
        s = sampler(Unipotent(), sample)
        d, group, g, k, y = s.domain, s.group, s.element(), s.element(), s.covector()[:2]
        act = Shear().act
        assert s.equal(act(d, group, group.mul(d, g, k), y), act(d, group, g, act(d, group, k, y)))


class TestListings:
    def test_show_what_is_registered(self):
        found = {
            kind: {row["name"]: row["about"] for row in json.loads(call("list", kind, "--json"))[kind]}
            for kind in ("groups", "actions", "scenes")
        }
        assert found["groups"]["Unipotent"].startswith("Upper triangular matrices")
        assert found["actions"]["Shear"].startswith("The same group on the plane")
        assert found["scenes"]["toy_shear"] == "The oscillator, sheared"

    def test_forget_what_is_taken_away(self):
        groups.unregister(Unipotent)
        groups.unregister(Shear)
        scenes.unregister("toy_field")
        assert "Unipotent" not in {row["name"] for row in groups.listing()}
        assert "Shear" not in {row["name"] for row in groups.actions.listing()}
        with pytest.raises(UnknownName, match="unknown scene 'toy_field'"):
            scenes.load("toy_field")
        with pytest.raises(UnknownName, match="unknown group 'Unipotent'"):
            groups.get("Unipotent")

    def test_keep_the_built_in_classes_first(self):
        names = [row["name"] for row in groups.listing()]
        assert names[-1] == "Unipotent"
        assert groups.get("Unipotent") is Unipotent
        assert groups.get("SO3") is groups.SO3


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize(
    ("scene", "method"),
    [
        ("toy_field", "rkmk:rk4"),
        ("toy_field", "cf:cf4"),
        ("toy_shear", "cg:cg3"),
        ("toy_bundle", "vcg:midpoint"),
    ],
)
def test_emitted_steps_converge_at_the_stated_order(scene, method, target):
    rows = json.loads(call("converge", scene, "--method", method, "--target", target, "--json"))
    assert [row["verdict"] for row in rows] == ["holds"], rows


def test_emit_writes_both_targets(tmp_path):
    for target in ("c", "python"):
        call(
            "emit", "toy_bundle", "--method", "vcg:midpoint", "--target", target, "-o", str(tmp_path / target)
        )
    manifest = json.loads((tmp_path / "c" / "manifest.json").read_text())["modules"][0]
    assert manifest["state"][0]["meaning"] == "element of U(3), the entries 12, 23 and 13"
    assert manifest["scene"] == "toy_bundle"


@pytest.mark.parametrize("method", ["rkmk:rk4", "cf:cf4", "rkmk(0):midpoint"])
def test_the_order_of_the_program_is_exact(method):
    made = compile_method("toy_field", method)
    order = certified_order(made.method, made.scene).order
    assert valuation(local_error(made.program, made.problem, QQ, order + 1)) == order + 1


def test_both_targets_take_the_same_step_with_the_jacobian():
    emissions = [emit("toy_field", "cf:cf4", target, jacobian=True) for target in ("c", "python")]
    first, second = (load(emission) for emission in emissions)
    start = emissions[0].manifest["initial"]
    assert ulps(first.step(start, 0.1), second.step(start, 0.1)) <= 4
    pairs = zip(first.jacobian(start, 0.1), second.jacobian(start, 0.1), strict=True)
    assert all(list(a) == pytest.approx(list(b), abs=1e-14) for a, b in pairs)


class TestRegisterRefuses:
    def test_what_is_no_group_and_no_action(self):
        for wrong in (int, Unipotent(), "SO3"):
            with pytest.raises(
                SceneError, match=r"cannot register .*; expected a subclass of LieGroup or Action"
            ):
                groups.register(wrong)

    def test_a_class_with_methods_missing(self):
        class Half(LieGroup):
            """Only a product."""

            name = "half"

            def mul(self, d, g, k):
                return g

        with pytest.raises(SceneError, match="the group Half does not implement ad, exp, identity, velocity"):
            groups.register(Half)

    def test_the_name_of_a_built_in_class(self):
        class SO3(Unipotent):
            """Not the rotations."""

        with pytest.raises(SceneError, match="a built-in group has the name SO3"):
            groups.register(SO3)

    def test_what_is_no_scene_and_names_that_are_taken(self):
        with pytest.raises(SceneError, match="x: cannot register 3; expected a scene"):
            scenes.register("x", 3)
        for name in ("dipole", "no name", "a+u"):
            with pytest.raises(
                SceneError, match="expected an identifier, but not the name of a built-in scene"
            ):
                scenes.register(name, on_the_group())


def test_a_second_registration_replaces_the_first():
    class Shear(Action):
        """Another shear."""

        name = "another"
        act = velocity = lambda self, d, group, g, y: y

    groups.register(Shear)
    assert [row["about"] for row in groups.actions.listing() if row["name"] == "Shear"] == ["Another shear."]
    groups.unregister(Shear)


def test_a_scene_that_is_registered_is_described_and_extended_as_any_other():
    assert scenes.about("toy_field") == "A field without symmetry on the group itself."
    with pytest.raises(SceneError, match=r"the Hamiltonian of toy_bundle does not depend on time"):
        scenes.load("toy_bundle+u")
