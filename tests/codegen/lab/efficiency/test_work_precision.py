"""Benches: rows describe the runs, counts follow from the program, failures are rows, refinement ends."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace

import pytest
from click.testing import CliRunner

from codegen import scenes
from codegen.commands.bench import command
from codegen.integrator import Statistics
from codegen.lab import timing
from codegen.lab.default_methods import methods_for
from codegen.lab.efficiency import adaptive_candidate, emitted_candidate, peer_candidate
from codegen.lab.efficiency.adaptive_candidate import AdaptiveCandidate
from codegen.lab.efficiency.bench import Bench, bench, picture, table
from codegen.lab.efficiency.emitted_candidate import EmittedCandidate
from codegen.lab.efficiency.ranking import places, seconds_to
from codegen.lab.efficiency.work_precision import Candidate, Row, measure_rows, monotone
from codegen.lab.measurement_cache import MeasurementCache
from codegen.lab.page.formatting import seconds
from codegen.lab.peers import PeerFailed, Prepared, find
from codegen.lab.reference import Reference, cached_reference
from orderconds.errors import InputError

FIELDS = {"scene", "method", "target", "h", "steps", "error", "seconds", "ns_per_step", "evaluations"}
"""What the JSON of ``bench`` promises."""


@pytest.fixture(scope="module", autouse=True)
def _short_samples() -> Iterator[None]:
    """Times of a bench are coarse here: nothing but their order of magnitude is looked at."""
    with pytest.MonkeyPatch.context() as patch:
        for module in (emitted_candidate, adaptive_candidate, peer_candidate):
            patch.setattr(module, "span_times", partial(timing.span_times, batch=2e-4, batches=2))
        yield


@pytest.fixture(scope="module")
def body() -> Bench:
    return bench("free_rigid_body", ["rkmk:rk4", "cf:cf4"], ["c"], ["c"], 0.002, None, str)


@pytest.fixture(scope="module")
def rows(body: Bench) -> tuple[Row, ...]:
    return body.run(str).rows


def test_the_error_of_a_fourth_order_method_falls_sixteenfold_a_rung(rows: tuple[Row, ...]) -> None:
    errors = {r.steps: r.error for r in rows if r.method == "rkmk:rk4"}
    assert errors[16] is not None
    assert errors[32] is not None
    assert 13 < errors[16] / errors[32] < 19


def test_evaluations_and_exponentials_are_those_of_the_program(rows: tuple[Row, ...]) -> None:
    """CF4 shares one exponential of its six (section 2.2.1); RKMK4 has four: k1 needs none."""
    for row in rows:
        if row.method == "cf:cf4":
            assert (row.evaluations, row.exponentials, row.iterations) == (4 * row.steps, 5 * row.steps, 0)
        if row.method == "rkmk:rk4":
            assert (row.evaluations, row.exponentials, row.iterations) == (4 * row.steps, 4 * row.steps, 0)


def test_iterations_multiply_the_operations_of_a_block() -> None:
    scene = scenes.load("dipole")
    (method,) = methods_for(scene, ["vcg:midpoint"])
    row = EmittedCandidate(scene, method, cached_reference(scene)).measure(8.0)
    assert row.iterations is not None
    assert row.evaluations is not None
    assert row.iterations >= 2 * 8
    assert row.evaluations >= row.iterations


def test_every_row_has_the_promised_fields_in_json_and_csv(rows: tuple[Row, ...]) -> None:
    assert all(row.as_json().keys() >= FIELDS for row in rows)
    read = list(csv.DictReader(table(rows).splitlines()))
    assert [r["method"] for r in read] == [r.method for r in rows]
    assert [float(r["error"]) for r in read if r["error"]] == [r.error for r in rows if r.error is not None]


def test_a_ladder_ends_at_its_budget(body: Bench, rows: tuple[Row, ...]) -> None:
    longest = [max(r.seconds or 0.0 for r in rows if r.method == m) for m in ("rkmk:rk4", "cf:cf4")]
    assert all(0.0 < s < 0.1 for s in longest)


def test_an_interrupted_bench_measures_only_what_is_missing(tmp_path: Path) -> None:
    class Cut(Exception):
        pass

    def start() -> Bench:
        return bench("free_rigid_body", ["cf:cf4"], ["c"], ["c-rk4-projected"], 0.0005, str(tmp_path), str)

    heard: list[Row] = []

    def interrupted(row: Row) -> None:
        heard.append(row)
        if len(heard) == 4:
            raise Cut

    with pytest.raises(Cut):
        start().run(interrupted)
    stored = tmp_path / ".free_rigid_body.measured"
    result = start().run(str)
    assert result.rows[:4] == tuple(heard)
    assert not stored.exists()
    assert sorted(p.name for p in tmp_path.iterdir()) == [
        "free_rigid_body.csv",
        "free_rigid_body.json",
        "free_rigid_body.svg",
    ]
    assert len(json.loads((tmp_path / "free_rigid_body.json").read_text())) == len(result.rows)


def test_rows_of_other_code_are_not_reused(tmp_path: Path, body: Bench) -> None:
    cache, done = MeasurementCache(tmp_path / "rows"), list[Row]()
    (first, second) = (c for c in body.candidates if isinstance(c, EmittedCandidate))

    def rows(candidate: Candidate) -> tuple[Row, ...]:
        return measure_rows(candidate, body.scene.name, body.exact, cache, done.append)

    found = rows(first)
    assert rows(first) == found
    changed = EmittedCandidate(first.scene, first.method, body.exact, budget=first.budget)
    changed.key = "other bytes"
    for other in (second, changed):
        assert set(rows(other)).isdisjoint(found)


class Refusing:
    """A peer that refuses every scene."""

    name, controlled, version = "refusing", "tolerance", "1"

    def __init__(self, error: Exception) -> None:
        self.error = error

    def prepare(self, scene: object, control: float) -> Prepared:
        raise self.error


@pytest.mark.parametrize(
    ("error", "reason"),
    [(InputError("no projection"), "no projection"), (RuntimeError("broken"), "RuntimeError: broken")],
)
def test_a_peer_that_refuses_is_one_row_and_the_others_go_on(
    body: Bench, error: Exception, reason: str
) -> None:
    peer = peer_candidate.PeerCandidate(body.scene, Refusing(error), body.exact, 0.0005)  # type: ignore[arg-type]
    result = replace(body, candidates=(peer, body.candidates[0])).run(str)
    refused, *others = result.rows
    assert (refused.method, refused.error, refused.failure) == ("refusing", None, reason)
    assert {r.method for r in others} == {"rkmk:rk4"}
    assert any(r.error is not None for r in others)


def test_a_method_that_cannot_be_emitted_is_a_row_with_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    compile_method = emitted_candidate.compile_method

    def refuse(scene: object, method: object) -> object:
        if getattr(method, "label", "") == "cf:cf4":
            raise InputError("no lowering")
        return compile_method(scene, method)  # type: ignore[arg-type]

    monkeypatch.setattr(emitted_candidate, "compile_method", refuse)
    match = bench("free_rigid_body", ["cf:cf4", "rkmk(0):euler"], ["c"], [], 0.0005, None, str)
    rows = match.run(str).rows
    assert [(r.method, r.failure) for r in rows if r.failure] == [("cf:cf4", "no lowering")]
    assert any(r.method == "rkmk(0):euler" and r.error is not None for r in rows)


def test_a_run_that_fails_is_a_row_with_its_reason() -> None:
    """Projected RK4 with one step over two seconds of a top spinning at 150 rad/s overflows or is far off."""
    scene = scenes.load("fast_heavy_top")
    (peer,) = find(["c-rk4-projected"])
    with pytest.raises(PeerFailed, match="not finite"):
        peer.prepare(scene, 64.0).run()


@pytest.mark.parametrize(
    "name", ["scipy-dop853", "scipy-radau", "scipy-lsoda", "c-dop853", "c-rk4-projected"]
)
@pytest.mark.parametrize("scene", ["dipole", "driven_spin", "linear_oscillator"])
def test_peers_converge_to_the_reference(name: str, scene: str) -> None:
    problem = scenes.load(scene)
    exact = [float(x) for x in cached_reference(problem).state]
    (peer,) = find([name])
    loose, tight = (1e-4, 1e-9) if peer.controlled == "tolerance" else (500.0, 4000.0)
    errors = []
    for control in (loose, tight):
        found = peer.prepare(problem, control).run()
        errors.append(max(abs(a - b) for a, b in zip(found.state, exact, strict=True)))
        assert found.steps > 0
    assert errors[1] < 2e-6
    assert errors[1] < errors[0] / 10 or errors[1] < 1e-11


def test_compiled_dop853_takes_the_steps_of_scipys() -> None:
    """Two codes of one method and one step control: the numbers of evaluations agree, and the errors."""
    scene = scenes.load("driven_spin")
    ours, theirs = (p.prepare(scene, 1e-8).run() for p in find(["c-dop853", "scipy-dop853"]))
    assert ours.evaluations is not None
    assert theirs.evaluations is not None
    assert abs(ours.evaluations - theirs.evaluations) <= 26
    assert max(abs(a - b) for a, b in zip(ours.state, theirs.state, strict=True)) < 1e-6


def test_the_winner_of_a_decade_is_who_gets_there_first(rows: tuple[Row, ...]) -> None:
    entries = {m: [r for r in rows if r.method == m] for m in dict.fromkeys(r.method for r in rows)}
    found = places(entries)
    assert [p.decade for p in found] == sorted(p.decade for p in found)
    for place in found:
        times = {m: seconds_to(e, 10.0**-place.decade) for m, e in entries.items()}
        assert place.seconds == min(t for t in times.values() if t is not None)
    assert all(a.seconds <= b.seconds for a, b in pairwise(found))


def test_the_command_prints_tables_and_writes_a_picture(tmp_path: Path) -> None:
    arguments = ["free_rigid_body", "--method", "rkmk:rk4", "cf:cf4", "--against", "c-dop853", "--budget"]
    done = CliRunner().invoke(command, [*arguments, "0.0005", "-o", str(tmp_path)], standalone_mode=False)
    assert done.exception is None
    assert done.return_value == 0
    assert "times slower" in done.output
    assert "cf:cf4" in done.output
    assert "c-dop853" in done.output
    picture = (tmp_path / "free_rigid_body.svg").read_text()
    assert picture.startswith("<?xml")
    assert "cf:cf4" in picture
    assert "var(--" not in picture


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["free_rigid_body", "-a", "matlab"], "unknown peer"),
        (["free_rigid_body", "-t", "fortran"], "unknown target"),
        (["free_rigid_body", "--budget", "nan"], "the budget"),
        (["free_rigid_body", "-m", "vcg:midpoint"], "vcg"),
        (["no_such_scene"], "unknown scene"),
        (["free_rigid_body", "-m", "cf:cf4", "-o", "/dev/null/x"], "cannot write"),
    ],
)
def test_bad_input_is_one_error(arguments: list[str], message: str) -> None:
    done = CliRunner().invoke(command, arguments, standalone_mode=False)
    assert isinstance(done.exception, InputError)
    assert message in str(done.exception)


def test_a_method_with_step_size_control_is_a_candidate() -> None:
    """The mean step is the span over the accepted steps; rejected ones are counted in evaluations."""
    match = bench("free_rigid_body", [], ["c"], [], 1e-4, None, str, ["ambient:lobatto3a4"])
    rows = match.run(str).rows
    assert {r.method for r in rows} == {"adaptive ambient:lobatto3a4"}
    assert [r.control for r in rows] == sorted((r.control for r in rows), reverse=True)
    good = [r for r in rows if r.error is not None]
    assert good
    for row in good:
        assert row.steps is not None
        assert row.h == 2.0 / row.steps
        assert (row.evaluations or 0) >= 4 * row.steps
        assert row.seconds is not None


@pytest.fixture
def stiff() -> AdaptiveCandidate:
    """The stiff spin by an implicit method of order six, beside DOP853 at a tight tolerance."""
    scene = scenes.load("stiff_driven_spin")
    (peer,), (method,) = find(["c-dop853"]), methods_for(scene, ["ambient:lobatto3a4"])
    return AdaptiveCandidate(
        scene, method, Reference(scene.name, peer.prepare(scene, 1e-12).run().state, 1e-11)
    )


def test_stiff_equations_are_solved_in_steps_that_the_fast_rates_do_not_bound(
    stiff: AdaptiveCandidate,
) -> None:
    """At rates of 2000 over a span of 5 an explicit method needs more than 1500 steps, whatever is asked."""
    row = stiff.measure(1e-3)
    assert (row.error or 1.0) < 1e-6
    assert (row.steps or 60) < 60
    spent = replace(row, seconds=2 * stiff.budget)
    assert stiff.enough([spent])
    assert not stiff.enough([replace(spent, error=20.0)])  # unstable: a tighter tolerance takes less
    failed = stiff.measure(1e-30)
    assert failed.error is None
    assert failed.failure.endswith("the end is not reached: the step became too small to change t")


def test_a_method_without_an_error_estimate_is_refused() -> None:
    with pytest.raises(InputError, match="embedded method"):
        bench("free_rigid_body", [], ["c"], [], 1e-4, None, str, ["ambient:gauss2"])


def test_a_long_run_is_timed_though_no_short_one_was_before() -> None:
    """What a call costs is not known then, and must not be taken for all of the time."""
    scene = scenes.load("free_rigid_body")
    (method,) = methods_for(scene, ["cf:cf4"])
    row = EmittedCandidate(scene, method, cached_reference(scene)).measure(65536.0)
    assert row.seconds


@pytest.mark.parametrize(("seconds", "most"), [(1e-6, 32), (1.0, 1)])
def test_only_short_runs_are_timed_over_several_spans(
    monkeypatch: pytest.MonkeyPatch, seconds: float, most: int
) -> None:
    """The clock advances by ``seconds`` for each span."""
    scene = scenes.load("free_rigid_body")
    (method,) = methods_for(scene, ["cf:cf4"])
    candidate = EmittedCandidate(scene, method, cached_reference(scene))
    clock, final, asked = SimpleNamespace(now=0.0), candidate.runner.final, set[int]()

    def run(steps: int, statistics: Statistics | None = None, spans: int = 1) -> tuple[float, ...]:
        asked.add(spans)
        clock.now += 1e-7 + seconds * spans
        return final(steps, statistics, spans)

    time = SimpleNamespace(process_time=lambda: clock.now, thread_time=lambda: clock.now)
    monkeypatch.setattr(timing, "time", time)
    monkeypatch.setattr(candidate.runner, "final", run)
    candidate.measure(4.0)
    assert max(asked) == most


def test_a_contestant_and_a_peer_have_one_face(body: Bench) -> None:
    candidate: Candidate = body.candidates[-1]
    assert candidate.target == "peer"
    assert isinstance(find(["c-dop853"])[0].prepare(body.scene, 1e-6), Prepared)


def test_times_in_the_wrong_order_are_measured_again() -> None:
    def row(steps: float, seconds: float) -> Row:
        return Row("s", "m", "c", steps, steps=int(steps), error=1e-3, seconds=seconds)

    asked: list[float] = []

    def measure(control: float) -> Row:
        asked.append(control)
        return row(control, control)

    rows = [row(8, 8.0), row(16, 40.0), row(32, 32.0), row(64, 64.0)]
    assert [r.seconds for r in monotone(rows, measure, (16, 32, 64))] == [8.0, 16.0, 32.0, 64.0]
    assert asked == [16, 32]
    failed = [replace(rows[0], seconds=None, error=None, failure="no"), *rows[2:]]
    assert monotone(failed, measure, (8, 16)) == failed


def test_the_spread_is_drawn_and_said(body: Bench) -> None:
    done = body.run(str)
    row = replace(done.rows[5], spread=1.0)
    noisy = replace(done, entries={row.method: (row,)})
    drawn = picture(noisy)
    assert f"{seconds(row.seconds or 0.0)} to {seconds(2 * (row.seconds or 0.0))}, error" in drawn
    still = picture(replace(done, entries={row.method: (replace(row, spread=0.0),)}))
    assert " to " not in still.partition("<title>")[2].partition("</title>")[2].partition("<title>")[2]
