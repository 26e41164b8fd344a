"""Scenes: what is read from them, and that whatever is wrong is one message that names file and line."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy
import pytest
from sympy import Matrix, Rational, Symbol, symbols

from codegen import scenes
from codegen.errors import SceneError
from codegen.groups import SO3, LeftMultiplication, Rn, Rotation
from codegen.ir.domain import ExprDomain, FloatDomain, PreciseDomain, SeriesDomain
from codegen.ir.values import Kind
from codegen.scene import FieldScene, HamiltonianScene, param
from codegen.scene.run_time import with_runtime
from orderconds.errors import InputError, UnknownName
from orderconds.ring import QQ
from tests.strategies import hamiltonian_scene, starting

TESTS = Path(__file__).parents[2]
INVALID = sorted((TESTS / "invalid" / "scenes").glob("*.py"))
y = Matrix(symbols("y0:3", real=True))


def sphere(**changes):
    arguments = {"group": SO3(), "action": Rotation(), "y": y, "f": y, "y0": [1, 0, 0], "span": (0, 1)}
    return FieldScene(**(arguments | changes))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"group": "SO3"}, r"scene: the group 'SO3'; expected an object of codegen\.groups, such as SO3\(\)"),
        ({"group": SO3}, "scene: the group SO3; expected an object of"),
        ({"action": Rotation}, r"scene: the action Rotation; expected an object of .* such as Rotation\(\)"),
        ({"f": 3}, "scene: f is 3; expected a column of 3 components"),
        ({"y0": None}, "scene: y0 is None; expected a column of 3 components"),
    ],
)
def test_what_is_no_group_action_or_column_is_told(changes, message):
    with pytest.raises(SceneError, match=message):
        sphere(**changes)


@pytest.mark.parametrize("path", INVALID, ids=lambda p: p.stem)
def test_an_invalid_file_is_one_message_with_file_and_line(path):
    line, message = path.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ").split(": ", 1)
    with pytest.raises(SceneError) as caught:
        scenes.load(str(path))
    assert str(caught.value).startswith(f"{path}:{line}: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_no_python_names_the_line(tmp_path):
    path = tmp_path / "broken.py"
    path.write_text("x = 1\nscene = FieldScene(\n", encoding="utf-8")
    with pytest.raises(SceneError, match=r"broken.py:2: the scene raises SyntaxError"):
        scenes.load(str(path))


def test_an_error_in_a_function_of_the_file_names_its_line(tmp_path):
    path = tmp_path / "deep.py"
    path.write_text("def f():\n    return 1 / 0\n\n\nscene = f()\n", encoding="utf-8")
    with pytest.raises(SceneError, match=r"deep.py:2: the scene raises ZeroDivisionError"):
        scenes.load(str(path))


def test_a_file_without_scene_says_what_is_missing(tmp_path):
    path = tmp_path / "empty.py"
    path.write_text("scene = 3\n", encoding="utf-8")
    with pytest.raises(SceneError, match=r"empty.py: no scene is defined; expected scene = FieldScene"):
        scenes.load(str(path))


def test_a_file_that_is_missing_is_named():
    with pytest.raises(SceneError, match=r"nowhere/at_all.py: no such file"):
        scenes.load("nowhere/at_all.py")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("class Odd(BaseException): ...\nraise Odd('x')\n", r"odd.py:2: the scene raises Odd: x"),
        ("x = 1\0\n", r"odd.py: the scene raises SyntaxError"),
        ("raise SystemExit(3)\n", r"odd.py:1: the scene raises SystemExit: 3"),
    ],
)
def test_whatever_a_file_raises_is_one_message(tmp_path, text, said):
    path = tmp_path / "odd.py"
    path.write_text(text)
    with pytest.raises(SceneError, match=said):
        scenes.load(str(path))


def test_what_a_scene_prints_does_not_reach_stdout(capsys, tmp_path):
    path = tmp_path / "loud.py"
    path.write_text("print('hello')\nfrom codegen.scenes.dipole import scene\n")
    scenes.load(str(path))
    assert capsys.readouterr() == ("", "hello\n")


def test_an_interrupt_inside_a_scene_is_an_interrupt(tmp_path):
    path = tmp_path / "odd.py"
    path.write_text("raise KeyboardInterrupt\n")
    with pytest.raises(KeyboardInterrupt):
        scenes.load(str(path))


def test_an_unknown_scene_lists_the_known_ones():
    with pytest.raises(
        UnknownName,
        match=r"unknown scene 'dipol'; expected one of actuated.*, dipole, .*; did you mean dipole?",
    ):
        scenes.load("dipol")


@pytest.mark.parametrize("name", scenes.GALLERY)
def test_the_gallery_has_names_and_titles(name):
    scene = scenes.load(name)
    assert scene.name == name
    assert len(scene.title.split()) > 1
    assert scene.sites is None
    assert scene.semilinear is None


@pytest.mark.slow
def test_every_scene_is_listed_with_its_title():
    listed = {row["name"]: row["about"] for row in scenes.listing()}
    assert list(listed) == sorted(scenes.every_name())
    for name in (*scenes.LATTICES, *scenes.SEMILINEAR):
        scene = scenes.load(name)
        assert scene.name == name
        assert listed[name] == scene.title
        assert len(scene.title.split()) > 1
        assert (scene.sites is not None) == (name in scenes.LATTICES)
        assert (scene.semilinear is not None) == (name in scenes.SEMILINEAR)


def test_every_file_of_a_scene_is_in_one_registry():
    """The file of a scene defines ``scene`` at the beginning of a line."""
    folder = Path(scenes.__file__).parent
    files = sorted(p.stem for p in folder.glob("*.py") if "\nscene = " in p.read_text(encoding="utf-8"))
    assert sorted((*scenes.GALLERY, *scenes.LATTICES, *scenes.SEMILINEAR)) == files


def test_a_scene_of_a_user_has_its_title_or_the_first_line_of_its_docstring_or_the_name_of_its_file(tmp_path):
    text = (TESTS / "valid" / "scenes" / "pendulum.py").read_text(encoding="utf-8")
    given, described, untitled = (tmp_path / f"{name}.py" for name in ("given", "described", "swing"))
    given.write_text(text, encoding="utf-8")
    text = text.replace('    title="Pendulum with a moving support",\n', "")
    described.write_text(text, encoding="utf-8")
    untitled.write_text(text.partition("\n")[2], encoding="utf-8")
    first = "A spherical pendulum whose support moves, with everything that a scene may hold"
    assert scenes.load(str(described)).title == first
    assert scenes.load(str(given)).title == "Pendulum with a moving support"
    assert scenes.load(str(untitled)).title == "swing"


class TestAValidFile:
    @pytest.fixture
    def scene(self):
        return scenes.load(str(TESTS / "valid" / "scenes" / "pendulum.py"))

    def test_is_named_after_the_file(self, scene):
        assert scene.name == "pendulum"
        assert scene.title == "Pendulum with a moving support"

    def test_has_its_state_span_and_parameters(self, scene):
        assert [(b.name, b.kind, len(b.symbols)) for b in scene.state] == [
            ("q", Kind.GROUP, 9),
            ("mu", Kind.DUAL, 3),
        ]
        assert scene.span == (Fraction(0), Fraction(10))
        assert {k: v.text() for k, v in scene.parameters.items()} == {"length": "3/2", "rate": "2"}
        assert sorted(scene.invariants) == ["vertical"]

    def test_depends_on_time(self, scene):
        assert not scene.autonomous
        assert scene.is_hamiltonian

    def test_evaluates_its_initial_state(self, scene):
        assert scene.initial(FloatDomain(0.1))[9:] == (1.5, 0.0, 0.5)

    def test_loads_twice_alike(self, scene):
        again = scenes.load(str(TESTS / "valid" / "scenes" / "pendulum.py"))
        assert again.parameters == scene.parameters
        assert [str(r) for r in again.roots] == [str(r) for r in scene.roots]


class TestParameters:
    def test_are_folded_unless_asked_for(self):
        scene = sphere(f=param("a", 3) * y)
        space = ExprDomain()
        state = tuple(space.space.sym(s) for s in scene.symbols)
        folded = scene.apply(space, "field", None, (state,))[0]
        assert str(folded[0]) == "(3 * y0)"
        kept = with_runtime(scene, ["a"]).apply(space, "field", None, (state,))[0]
        assert str(kept[0]) in ("(a * y0)", "(y0 * a)")

    def test_can_be_folded_at_another_value(self):
        scene = with_runtime(sphere(f=param("a", 3) * y + param("b", 1) * y), ["a=-1/4"])
        assert {k: v.text() for k, v in scene.parameters.items()} == {"a": "-1/4", "b": "1"}
        assert scene.fixed == (("a", "-1/4"),)
        assert scene.runtime == ()

    def test_at_another_value_keep_what_the_scene_says(self):
        scene = sphere(f=param("a", 0) * Matrix([1, 0, 0]) - y, invariants={"height": y[2] ** 2 + y.dot(y)})
        with pytest.raises(SceneError, match="the invariant height changes"):
            with_runtime(scene, ["a=1"])

    @pytest.mark.parametrize("value", ["", "x", "1/0", "nan", "sqrt(2)", "9^9^9", "1e999999999"])
    def test_are_rational(self, value):
        with pytest.raises(SceneError, match="of the parameter a; expected 0 or a rational number"):
            with_runtime(sphere(f=param("a", 3) * y), [f"a={value}"])

    @pytest.mark.parametrize("value", ["1e400", "-1e309", "1e-400", "1/" + "9" * 320])
    def test_are_numbers_that_doubles_hold(self, value):
        with pytest.raises(SceneError, match=r"of the parameter a; expected .* between 1e-307 and 1e308"):
            with_runtime(sphere(f=param("a", 3) * y), [f"a={value}"])

    @pytest.mark.parametrize("power", [-308, 309])
    def test_have_defaults_that_doubles_hold(self, power):
        with pytest.raises(SceneError, match=r"parameter a: the default 1\.00E.*between 1e-307 and 1e308"):
            param("a", Rational(10) ** power)

    def test_have_one_value(self):
        with pytest.raises(SceneError, match="two values of the parameter a; expected one value"):
            with_runtime(sphere(f=param("a", 3) * y), ["a=1", "a=2"])

    def test_of_one_scene_mean_nothing_in_another(self):
        sphere(f=param("leaked", 3) * y)
        with pytest.raises(SceneError, match="the symbol leaked in"):
            sphere(f=Symbol("leaked", real=True) * y)

    def test_of_two_scenes_may_share_a_name(self):
        one, two = param("shared", 1), param("shared", 2)
        assert sphere(f=one * y).parameters["shared"].text() == "1"
        assert sphere(f=two * y).parameters["shared"].text() == "2"
        assert sphere(f=one * y).parameters["shared"].text() == "1"

    def test_that_no_formula_holds_are_not_listed(self):
        param("idle", 1)
        assert sphere().parameters == {}

    def test_that_are_unknown_cannot_be_kept(self):
        with pytest.raises(SceneError, match="unknown parameter 'b'; expected one of: a"):
            with_runtime(sphere(f=param("a", 3) * y), ["b"])

    @pytest.mark.parametrize("name", ["t", "h", "my parameter", "2a", ""])
    def test_have_names_that_programs_can_use(self, name):
        with pytest.raises(SceneError, match="a symbol called"):
            sphere(f=param(name, 1) * y)


class TestDerivatives:
    """xi = D_2 H and n = -(D_1 H).q^-1, against difference quotients exact in h."""

    @pytest.mark.parametrize("group", ["SO(3)", "R^3", "GL(2)", "Heisenberg"])
    def test_are_those_of_the_hamiltonian(self, group):
        scene = hamiltonian_scene(group)
        d = SeriesDomain(QQ, 1)
        state = starting(scene, d)
        q, mu = state["q"], state["mu"]
        xi, n = scene.apply(d, "hamilton", None, (q, mu))

        def slope(q, mu):
            (value,) = [scene.invariant(d, "energy", (*q, *mu))]
            return value.coefficients[1]

        for a in range(scene.dimension()):
            unit = tuple(d.rational(int(a == b)) for b in range(scene.dimension()))
            step = tuple(d.h * u for u in unit)
            assert slope(q, tuple(m + s for m, s in zip(mu, step, strict=True))) == xi[a].coefficients[0]
            moved = scene.group.mul(d, scene.group.exp(d, step), q)
            assert -slope(moved, mu) == n[a].coefficients[0]

    def test_the_energy_is_constant_along_the_flow(self):
        from codegen.lab.orders.local_error import exact_flow

        scene, d = hamiltonian_scene("SO(3)"), SeriesDomain(QQ, 6)
        energy = scene.invariant(d, "energy", exact_flow(scene, QQ, 6))
        assert [c for c in energy.coefficients[1:] if c != 0] == []


def test_a_hamiltonian_scene_is_a_field_on_the_cotangent_group():
    scene = hamiltonian_scene("SO(3)")
    view = scene.as_field()
    assert view.group.name == "T*SO(3)"
    assert not view.is_hamiltonian
    d = PreciseDomain(0, 30)
    assert view.initial(d) == scene.initial(d)
    assert view.velocity(d, view.initial(d)) == scene.velocity(d, scene.initial(d))


@pytest.mark.parametrize("wrong", [{"H": [1, 2]}, {"H": Matrix([1, 2])}, {"H": "mu0 +"}, {"H": None}])
def test_a_hamiltonian_is_a_scalar(wrong):
    G = SO3()
    arguments = {"q": G.point("q"), "mu": G.dual("mu"), "q0": Matrix.eye(3), "mu0": [1, 0, 0], "span": (0, 1)}
    with pytest.raises(InputError):
        HamiltonianScene(group=G, **arguments, **wrong)


def test_a_point_must_be_one_that_the_group_acts_on():
    with pytest.raises(
        SceneError, match=r"a point with 3 coordinates; expected a point with 9 .* SO\(3\) acts by left"
    ):
        sphere(action=LeftMultiplication())
    with pytest.raises(SceneError, match="a point with 3 coordinates"):
        sphere(group=Rn(2), action=LeftMultiplication(), f=[1, 2])


@pytest.mark.parametrize(
    "value", [0.1, numpy.float64(0.1), numpy.float32(0.1), "0.1", Fraction(1, 10), Rational(1, 10)]
)
def test_a_float_as_default_means_its_decimal(value):
    assert param("a", value).default == (1, 10)


def test_floats_mean_their_decimals_in_every_place():
    scene = sphere(f=0.3 * y, y0=[0.6, 0, 0.8], span=(0, 0.1))
    exact = sphere(f=Rational(3, 10) * y, y0=[Rational(3, 5), 0, Rational(4, 5)], span=(0, Rational(1, 10)))
    assert [str(e) for e in scene.roots] == [str(e) for e in exact.roots]
    assert [str(e) for e in scene.state[0].initial] == [str(e) for e in exact.state[0].initial]
    assert scene.span == exact.span == (0, Fraction(1, 10))


@pytest.mark.parametrize(
    "q0", [numpy.eye(3), numpy.eye(3).tolist(), numpy.eye(3, dtype=int), Matrix.eye(3), list(Matrix.eye(3))]
)
def test_an_initial_matrix_is_an_array_a_list_of_rows_or_a_sympy_matrix(q0):
    group = SO3()
    q, mu = group.point("q"), group.dual("mu")
    scene = HamiltonianScene(group=group, q=q, mu=mu, H=mu.dot(mu) / 2, q0=q0, mu0=[1, 0, 0], span=(0, 1))
    assert [str(e) for e in scene.state[0].initial] == [*"100010001"]


def test_a_rounded_initial_state_gets_a_hint():
    group = SO3()
    q, mu = group.point("q"), group.dual("mu")
    turn = [
        [0.9950041652780258, -0.09983341664682815, 0],
        [0.09983341664682815, 0.9950041652780258, 0],
        [0, 0, 1],
    ]
    with pytest.raises(SceneError, match="write exact numbers"):
        HamiltonianScene(group=group, q=q, mu=mu, H=mu.dot(mu), q0=turn, mu0=[1, 0, 0], span=(0, 1))
