"""Pictures show the states of emitted code, and their numbers follow from these states."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np
import pytest
from click.testing import CliRunner
from sympy import Symbol, symbols

from codegen.errors import SceneError
from codegen.lab.page.svg import PLACEHOLDERS, standalone
from codegen.lab.pictures import draw, listing, orders, register
from codegen.lab.pictures.deviation import maxima
from codegen.lab.pictures.lattice_means import means
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.registry import find, unregister
from codegen.lab.pictures.source import Source, formulas
from codegen.lab.pictures.sphere import projection
from codegen.lab.reference import cached_reference
from codegen.loader import load_lattice
from codegen.scene import param
from codegen.scene.figure import (
    Deviation,
    Figure,
    LatticeMeans,
    Motion,
    Orders,
    PlaneCurves,
    Run,
    Scan,
    SpaceCurves,
    SphereCurves,
    Sweep,
    TimeSeries,
    read_figures,
)
from codegen.scene.sites import neighbour
from codegen.scenes import GALLERY, load
from orderconds.cli import program
from orderconds.errors import UnknownName
from tests.codegen.chains import S, chain, open_chain

EULER = Run("rkmk(0):euler", 0.1, 20)
AMBIENT = Run("ambient:euler", 0.1, 20)
EXACT = Run("rkmk(2):rk4", 0.05, 40, stride=2)
M = symbols("m0:3", real=True)


@pytest.fixture(scope="module")
def source() -> Source:
    return Source(load("free_rigid_body"))


def test_a_path_contains_the_states_of_the_emitted_module(source):
    integrator = source.integrator(EULER)
    states = source.path(EULER).states
    assert len(states) == 21
    assert states[-1].tolist() == list(integrator.run(integrator.initial, 0.1, 20))
    assert source.path(EXACT).times[1] == pytest.approx(0.1)


def test_formulas_and_invariants_are_evaluated_on_the_states(source):
    rows = source.values(EULER, [M[0] + 2 * M[1] * Symbol("t"), "radius"])
    path = source.path(EULER)
    assert np.allclose(rows[0], path.states[:, 0] + 2 * path.states[:, 1] * path.times, atol=1e-15)
    assert np.allclose(rows[1], (path.states**2).sum(axis=1), atol=1e-15)


def test_an_unknown_symbol_or_invariant_is_an_error(source):
    with pytest.raises(SceneError, match="symbol z"):
        formulas(source.problem, [Symbol("z")])
    with pytest.raises(SceneError, match=r"unknown quantity 'momentum'[\s\S]*radius"):
        formulas(source.problem, ["momentum"])


def test_the_numbers_of_a_plane_curve_are_its_last_point(source):
    figure = PlaneCurves(name="p", title="Plane", runs=(EULER, AMBIENT), point=(M[0], M[1]))
    drawn = draw(figure, source)
    assert drawn.numbers[EULER.name] == source.path(EULER).states[-1][:2].tolist()
    assert drawn.svg.count("data-key") == 2 * 2  # the line and the text of each entry of the legend


def test_a_sphere_curve_measures_the_distance_from_the_sphere(source):
    figure = SphereCurves(name="s", title="Sphere", runs=(EULER, AMBIENT), point=tuple(M))
    distances = draw(figure, source).numbers
    assert distances[EULER.name] < 1e-14
    assert distances[AMBIENT.name] > 1e-2  # Euler's method leaves the sphere


def test_dots_are_drawn_at_every_state(source):
    figure = PlaneCurves(name="p", title="P", runs=(EULER,), point=(M[0], M[1]), panels=True, dots=True)
    (dots,) = re.findall(r'<g data-series="0">\s*<path d="([^"]*)"', draw(figure, source).svg)
    assert dots.count("M") == dots.count("L") == len(source.path(EULER).states)


def test_a_space_curve_states_the_ranges_of_its_coordinates(source):
    figure = SpaceCurves(name="s", title="S", runs=(EULER,), point=M)
    states = source.path(EULER).states
    expected = [[low, high] for low, high in zip(states.min(axis=0), states.max(axis=0), strict=True)]
    assert draw(figure, source).numbers[EULER.name] == expected


def test_the_flow_on_the_torus_ends_at_the_minimum_and_follows_the_arrows():
    problem = load("torus_gradient_flow")
    source, figure = Source(problem), find(problem, "flow")
    assert draw(figure, source).numbers["rkmk(2):rk4"] == pytest.approx([math.pi / 2, 0.0], abs=1e-3)
    path = source.path(figure.runs[0])
    angles = source.values(figure.runs[0], figure.angles)
    rates = source.values(figure.runs[0], figure.directions)
    slopes = np.gradient(angles, path.times, axis=1)
    assert abs(slopes - rates)[:, 5:-5].max() < 0.02 * abs(rates).max()


def test_windows_and_running_maxima_are_the_largest_deviations(source):
    energy = source.values(AMBIENT, ["energy"])[0]
    sizes = abs(energy - energy[0])[1:]
    windows = Deviation(name="d", title="D", runs=(AMBIENT,), quantity="energy", window=5)
    assert maxima(windows, source, AMBIENT)[1].tolist() == [max(sizes[k : k + 5]) for k in range(0, 20, 5)]
    running = Deviation(name="d", title="D", runs=(AMBIENT,), quantity="energy")
    times, largest = maxima(running, source, AMBIENT)
    assert times[-1] == pytest.approx(2.0)
    assert largest[-1] == sizes.max()
    assert (np.diff(largest) >= 0).all()
    assert draw(running, source).numbers == {AMBIENT.name: sizes.max()}


def test_a_time_series_subtracts_the_reference(source):
    figure = TimeSeries(
        name="t", title="T", runs=(EULER,), quantities={"m0": M[0]}, reference=EXACT, difference=True
    )
    low, high = draw(figure, source).numbers[EULER.name]["m0"]
    gap = source.path(EULER).states[:, 0] - source.path(EXACT).states[:, 0]
    assert (low, high) == (gap.min(), gap.max())


def test_a_time_series_may_have_more_quantities_than_colours_and_markers(source):
    quantities = {f"q{k}": k * M[k % 3] for k in range(1, 15)}
    figure = TimeSeries(name="t", title="T", runs=(EULER,), quantities=quantities)
    assert list(draw(figure, source).numbers[EULER.name]) == list(quantities)


def test_a_reference_with_other_times_is_refused(source):
    figure = TimeSeries(
        name="t",
        title="T",
        runs=(EULER,),
        quantities={"m0": M[0]},
        difference=True,
        reference=Run("rkmk(2):rk4", 0.05, 40),
    )
    with pytest.raises(SceneError, match="different output times"):
        draw(figure, source)


def test_the_best_value_of_a_scan_is_a_minimum_between_the_values_of_the_sweep(source):
    run = Run("rkmk(0):euler", 1.0, 1, sweep=Sweep("alpha", 0.0, 4.0, 9))
    figure = Scan(name="a", title="A", runs=(run,), reference=Run("rkmk(2):rk4", 0.05, 20))
    found = draw(figure, source).numbers[run.name]
    exact = np.array(source.end(figure.reference))

    def error(alpha: float) -> float:
        return math.dist(source.end(run, alpha), exact)

    assert found["error"] == pytest.approx(error(found["alpha"]), rel=1e-12)
    assert found["error"] < min(error(0.5 * k) for k in range(9))
    assert found["error"] < min(error(found["alpha"] + d) for d in (-1e-3, 1e-3))


def test_a_sweep_of_the_step_size_makes_one_step_of_each_size(source):
    run = Run("rkmk(0):euler", 0.0, 1, sweep=Sweep("h", 0.0, 2.0, 3))
    integrator = source.integrator(run)
    ends = [list(integrator.step(integrator.initial, h)) for h in (0.0, 1.0, 2.0)]
    assert source.path(run).states.tolist() == ends


def test_quantities_of_a_sweep_use_the_end_time_and_the_value_of_the_parameter(source):
    t, alpha = Symbol("t"), param("alpha", 0)
    swept = Run("rkmk(0):euler", 0.5, 4, sweep=Sweep("alpha", 0.0, 4.0, 3))
    found = source.values(swept, [t, alpha, M[0] + t * alpha])
    assert found[0].tolist() == [2.0, 2.0, 2.0]
    assert found[1].tolist() == [0.0, 2.0, 4.0]
    ends = [source.end(swept, value)[0] + 2 * value for value in (0.0, 2.0, 4.0)]
    assert found[2].tolist() == ends
    steps = Run("rkmk(0):euler", 0.0, 3, sweep=Sweep("h", 0.0, 2.0, 3))
    assert source.values(steps, [t, alpha]).tolist() == [[0.0, 3.0, 6.0], [0.0, 0.0, 0.0]]


def test_the_errors_of_a_figure_of_orders_have_the_order_of_the_method(source):
    run = Run("rkmk(2):rk4", 0.1, 0)
    figure = Orders(name="o", title="O", runs=(run,), halvings=3, orders=(4,))
    errors = list(draw(figure, source).numbers[run.name].values())
    integrator = source.integrator(run)
    exact = [float(x) for x in cached_reference(source.problem).state]
    assert errors[0] == pytest.approx(math.dist(integrator.run(integrator.initial, 0.1, 20), exact), rel=1e-6)
    assert math.log2(errors[2] / errors[3]) == pytest.approx(4.0, abs=0.1)


def test_an_order_plot_names_runs_that_fail(source, monkeypatch):
    run = Run("rkmk(2):rk4", 0.1, 0)
    figure = Orders(name="o", title="O", runs=(run,), halvings=3)
    assert draw(figure, source).note == ""
    all_points = orders.errors(figure, source, run)
    monkeypatch.setattr(orders, "errors", lambda *_: all_points[1:])
    assert draw(figure, source).note == "rkmk(2):rk4 fails with 1 of 4 step sizes."
    monkeypatch.setattr(orders, "errors", lambda *_: [])
    with pytest.raises(SceneError, match="fails with all step sizes"):
        draw(figure, source)


def test_step_control_keeps_the_requested_output_times(source):
    run = Run("ambient:dormand_prince5", 0.1, 20, tolerance=1e-6)
    path = source.path(run)
    assert path.times.tolist() == pytest.approx([0.1 * k for k in range(21)])
    assert 1e-9 < abs(path.states - source.path(EXACT).states).max() < 1e-4


def test_a_run_that_ends_early_is_named_with_its_reason():
    source = Source(load("driven_spin"))
    run = Run("ambient:euler", 1e3, 200)
    x, y = (Symbol(s, real=True) for s in source.problem.symbols[:2])
    drawn = draw(PlaneCurves(name="p", title="P", runs=(run,), point=(x, y), bounds=(-1, 1, -1, 1)), source)
    assert re.search(r"ambient:euler ends early: step \d+: ", drawn.note)


def test_a_picture_is_a_closed_document_that_does_not_depend_on_the_process(source):
    figure = find(load("free_rigid_body"), "isotropy")
    first, second = (str(draw(figure, Source(load("free_rigid_body"))).svg) for _ in range(2))
    assert first == second
    document = standalone(first)
    ElementTree.fromstring(document)
    assert not re.search(r"(href|src)=\"(?!#)|url\((?!#)", document)
    assert not any(colour in document for colour in PLACEHOLDERS.values())


def test_a_new_kind_of_figure_can_be_registered(source):
    @dataclass(frozen=True, kw_only=True)
    class Blank(Figure):
        """A figure without content."""

    figure = Blank(name="b", title="B", runs=())
    with pytest.raises(SceneError, match=r"kind Blank[\s\S]*PlaneCurves"):
        draw(figure, source)
    register(Blank, lambda figure, source: Drawn("", figure.title))
    try:
        assert draw(figure, source).note == "B"
    finally:
        unregister(Blank)


def test_the_variable_figures_contains_distinct_figures():
    figure = Figure(name="a", title="A", runs=())
    assert read_figures("scene", [figure]) == (figure,)
    with pytest.raises(SceneError, match="variable `figures`"):
        read_figures("scene", [figure, "b"])
    with pytest.raises(SceneError, match="variable `figures`"):
        read_figures("scene", 3)
    with pytest.raises(SceneError, match="two figures with the name 'a'"):
        read_figures("scene", [figure, figure])


def test_an_unknown_figure_is_an_error_that_lists_the_figures():
    with pytest.raises(UnknownName, match=r"no figure 'isotopy'[\s\S]*did you mean isotropy"):
        find(load("free_rigid_body"), "isotopy")
    with pytest.raises(UnknownName, match="whose file defines `figures`"):
        find(load("driven_spin"), "a")


@pytest.mark.slow
def test_the_listing_names_scene_and_figure():
    assert {
        "name": "heavy_top centre",
        "about": find(load("heavy_top"), "centre").title + " (Fig. 2.6 of Marthinsen's thesis)",
    } in listing()


@pytest.mark.slow
@pytest.mark.parametrize("scene", GALLERY)
def test_every_figure_of_the_gallery_is_drawn_without_a_failed_run(scene):
    problem = load(scene)
    source = Source(problem)
    for figure in problem.figures:
        drawn = draw(figure, source)
        assert "ends early" not in drawn.note
        assert drawn.numbers
        ElementTree.fromstring(standalone(str(drawn.svg)))


def test_means_over_a_lattice_are_means_of_arrays():
    scene = chain()
    t = Symbol("t")
    evaluate = means(scene, [S[0] * neighbour(S, (1,))[1], t * S[2] * neighbour(S, (-1,))[2]])
    states = np.random.default_rng(1).normal(size=(5, 3))
    after, before = np.roll(states, -1, axis=0), np.roll(states, 1, axis=0)
    expected = [(states[:, 0] * after[:, 1]).mean(), 2.5 * (states[:, 2] * before[:, 2]).mean()]
    assert evaluate(states, 2.5) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("scene", "formula", "message"),
    [
        (load("free_rigid_body"), M[0], "the scene has no sites"),
        (open_chain(), neighbour(S, (1,))[0], "an open boundary"),
        (chain(), "length", "is not a formula"),
        (chain(), Symbol("z"), "symbol z"),
    ],
)
def test_impossible_means_are_errors(scene, formula, message):
    with pytest.raises(SceneError, match=message):
        means(scene, [formula])


def lattice_figure(h):
    rng = np.random.default_rng(1)
    return LatticeMeans(
        name="spin",
        title="Mean spin",
        runs=(Run("rkmk(0):euler", h, 6, stride=2),),
        quantities={"third": S[2]},
        shape=(7,),
        start=lambda shape: rng.normal(size=(*shape, 3)),
    )


@pytest.mark.slow
def test_the_figure_of_a_lattice_shows_runs_of_emitted_code():
    source, figure = Source(chain()), lattice_figure(0.1)
    numbers = draw(figure, source).numbers
    lattice = load_lattice(source.artifact(figure.runs[0]))
    states = lattice_figure(0.1).start((7,))
    last = lattice.run(states, 0.1, 6).states
    first, most, end = numbers["rkmk(0):euler"]["third"]
    assert (first, end) == pytest.approx((states[:, 2].mean(), last[:, 2].mean()), rel=1e-13)
    assert most >= max(first, end)
    with pytest.raises(SceneError, match="fails after t = 0"):
        draw(lattice_figure(1e308), source)


LATTICE_FILE = """
from sympy import Matrix, symbols
from codegen.groups import SO3, Rotation
from codegen.scene import SiteScene, right
from codegen.scene.figure import LatticeMeans, Run, TimeSeries

S = Matrix(symbols("S0:3", real=True))
runs = (Run("rkmk(0):euler", 0.1, 4),)
scene = SiteScene(group=SO3(), action=Rotation(), y=S, f=right(S), y0=[1, 0, 0], span=(0, 1))
figures = [
    LatticeMeans(
        name="mean", title="Mean", quantities={"third": S[2]}, runs=runs, shape=(3,),
        start=lambda shape: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ),
    TimeSeries(name="time", title="Time", quantities={"third": S[2]}, runs=runs),
]
"""


@pytest.mark.slow
def test_the_command_draws_the_means_of_a_lattice(tmp_path):
    file, output = tmp_path / "spins.py", tmp_path / "mean.svg"
    file.write_text(LATTICE_FILE, encoding="utf-8")
    result = CliRunner().invoke(program, ["figure", str(file), "mean", "-o", str(output)])
    assert result.exit_code == 0, result.output
    assert "<svg" in output.read_text(encoding="utf-8")


def test_the_command_refuses_a_figure_of_one_system_on_a_lattice(tmp_path):
    file, output = tmp_path / "spins.py", tmp_path / "time.svg"
    file.write_text(LATTICE_FILE, encoding="utf-8")
    result = CliRunner().invoke(program, ["figure", str(file), "time", "-o", str(output)])
    assert result.exit_code == 2
    assert "a chain or lattice" in result.output
    assert not output.exists()


BODY = (M[0], M[1], M[2])


def motion(**options):
    given = {
        "name": "motion",
        "title": "Motion",
        "bars": {"arrow": ((0, 0, 0), BODY), "shadow": ((0, 0, 0), (M[0], M[1], 0))},
        "trace": BODY,
        "fixed": {"pole": (0, 0, 1)},
        "runs": (EULER,),
        "seconds": 5,
    }
    return Motion(**(given | options))


def test_an_animation_shows_the_states_and_respects_reduced_motion(source):
    drawn = draw(motion(), source)
    state = source.path(EULER).states[-1]
    assert drawn.numbers["arrow"] == state.tolist()
    assert drawn.numbers["shadow"] == [*state[:2].tolist(), 0]
    svg = standalone(str(drawn.svg))
    ElementTree.fromstring(svg.split("\n", 1)[1])
    # Every animation is inside a rule for readers without a preference for reduced motion.
    moves = re.findall(r"animation:[^}]*", svg)
    inside = re.findall(r"@media \(prefers-reduced-motion:no-preference\){[^{}]*{(animation:[^}]*)}}", svg)
    assert len(moves) == 2
    assert moves == inside
    assert "<script" not in svg
    # Each bar has one keyframe for each state.
    assert [rule.count("%{transform") for rule in svg.split("@keyframes")[1:]] == [21, 21]


def test_the_bars_of_an_animation_have_their_projected_lengths(source):
    frame = projection(0, 0)
    drawn = str(draw(motion(direction=(0, 0)), source).svg)
    rule = drawn.split("@keyframes")[1]
    scales = np.array([float(x) for x in re.findall(r"scale\(([\d.]+),1\)", rule)])
    lengths = np.hypot(*(frame @ source.path(EULER).states.T)[:2])
    assert np.abs(scales - lengths / lengths.max()).max() < 1e-4


def test_an_animation_has_one_run(source):
    with pytest.raises(SceneError, match="a moving body has 2 runs"):
        draw(motion(runs=(EULER, AMBIENT)), source)
