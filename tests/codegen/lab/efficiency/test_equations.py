"""Peers and methods in coordinates run on every form of a scene, and the fastest form is the entry."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from click.testing import CliRunner

from codegen import scenes
from codegen.commands.converge import command as converge
from codegen.commands.emit import command as emit
from codegen.lab import timing
from codegen.lab.efficiency import emitted_candidate, peer_candidate
from codegen.lab.efficiency.bench import bench
from codegen.lab.efficiency.emitted_candidate import EmittedCandidate
from codegen.lab.efficiency.equations import all_equations
from codegen.lab.efficiency.peer_candidate import PeerCandidate
from codegen.lab.efficiency.ranking import fastest_form, frontier, places, prevailing_form, seconds_to
from codegen.lab.efficiency.work_precision import Row
from codegen.lab.peers import find
from codegen.lab.reference import cached_reference
from codegen.loader import load
from orderconds.errors import InputError

NAMES = ("as printed", "body momentum and matrix", "body momentum and unit quaternion")


def row(form: str, error: float, seconds: float) -> Row:
    return Row("scene", "method", "peer", 1.0, error=error, seconds=seconds, steps=1, form=form)


MIXED = [row("a", 1e-2, 1.0), row("a", 1e-4, 9.0), row("b", 1e-2, 2.0), row("b", 1e-4, 3.0)]
"""Form a is faster for large errors, form b for small errors."""


@pytest.mark.parametrize("name", ["dipole", "free_rigid_body_product"])
def test_every_form_reaches_the_reference_in_the_norm_of_the_scene(name: str) -> None:
    scene = scenes.load(name)
    (peer,) = find(["c-dop853"])
    exact = cached_reference(scene)
    equations = all_equations(scene)
    assert len(equations) == 3
    for e in equations:
        loose, tight = (e.error(peer.prepare(e.problem, t).run().state, exact) for t in (1e-5, 1e-11))
        assert tight < 1e-8
        assert tight < loose / 100


def test_the_fastest_form_is_the_entry_at_each_accuracy() -> None:
    assert fastest_form(MIXED, 1e-2) == (1.0, "a")
    assert fastest_form(MIXED, 1e-4) == (3.0, "b")
    assert seconds_to(MIXED, 1e-4) == 3.0
    found = {p.decade: p.winner for p in places({"m": MIXED})}
    assert found == {2: "m (a)", 3: "m (b)", 4: "m (b)"}


def test_the_curve_of_an_entry_contains_the_rows_that_no_other_form_beats() -> None:
    assert [(r.form, r.error) for r in frontier(MIXED)] == [("a", 1e-2), ("b", 1e-4)]
    alone = [r for r in MIXED if r.form == "a"]
    assert frontier(alone) == alone
    assert {r.form for r in prevailing_form(MIXED)} == {"b"}


def test_methods_in_coordinates_and_peers_run_on_all_forms_and_others_on_the_manifold() -> None:
    methods, peers = ["ambient:rk4", "cf:cf4"], ["c"]
    match = bench("free_rigid_body_attitude", methods, ["c"], peers, 1e-5, None, str)
    forms: dict[str, list[str]] = {}
    for c in match.candidates:
        forms.setdefault(c.label, []).append(c.form)
    assert forms == {
        "ambient:rk4": [*NAMES],
        "cf:cf4": [""],
        "c-dop853": [*NAMES],
        "c-rk4-projected": [""],
    }
    keys = {c.key for c in match.candidates if isinstance(c, PeerCandidate) and c.label == "c-dop853"}
    assert len(keys) == 3  # rows of another form in the cache are not reused


def test_the_command_restricts_the_forms_and_names_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(peer_candidate, "span_times", partial(timing.span_times, batch=2e-4, batches=2))
    monkeypatch.setattr(peer_candidate, "TOLERANCES", (1e-3, 1e-6))
    match = bench("dipole", ["ambient:rk4"], ["c"], ["c-dop853"], 1e-2, None, str, forms=["quaternion"])
    theirs = tuple(c for c in match.candidates if isinstance(c, PeerCandidate))
    rows = replace(match, candidates=theirs).run(str).rows
    assert [r.form for r in rows] == [NAMES[2]] * 2
    assert rows[-1].as_json()["form"] == NAMES[2]
    with pytest.raises(InputError, match=r"unknown form 'matrix'.*printed, body-matrix, quaternion"):
        bench("dipole", ["ambient:rk4"], ["c"], [], 1e-2, None, str, forms=["matrix"])


def test_an_emitted_step_of_a_form_has_the_error_of_the_method(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(emitted_candidate, "span_times", partial(timing.span_times, batch=2e-4, batches=2))
    scene = scenes.load("dipole")
    method = (
        bench("dipole", ["ambient:rk4"], ["c"], [], 1e-5, None, str, forms=["printed"]).candidates[0].method
    )  # type: ignore[attr-defined]
    (equations,) = all_equations(scene, ["quaternion"])
    candidate = EmittedCandidate(scene, method, cached_reference(scene), equations=equations)
    coarse, fine = (candidate.measure(n).error for n in (20.0, 40.0))
    assert coarse is not None
    assert fine is not None
    assert 14 < coarse / fine < 18


def test_emit_writes_the_integrator_of_a_form_and_says_how_to_convert(tmp_path: Path) -> None:
    words = ["fast_heavy_top", "-m", "ambient:rk4", "--form", "quaternion", "-o", str(tmp_path)]
    done = CliRunner().invoke(emit, words, standalone_mode=False)
    assert done.exception is None
    (module,) = json.loads((tmp_path / "manifest.json").read_text())["modules"]
    assert (module["scene"], module["form"]) == ("fast_heavy_top", "quaternion")
    assert "--form quaternion" in module["command"]
    source = " ".join((tmp_path / f"{module['module']}.c").read_text().split())
    assert "body momentum and unit quaternion; q0 to q3" in source
    assert "(0, g x) = q (0, x) q^c" in source.replace(" * ", " ")
    start = [1.0, 0.0, 0.0, 0.0, 0.0, 70.3125, -70.3124296875]
    assert module["initial"] == start
    assert len(load(str(tmp_path)).step(start, 1e-3)) == 7


def test_converge_measures_a_form_in_the_norm_of_the_scene() -> None:
    words = ["dipole", "-m", "ambient:rk4", "--form", "quaternion", "--steps", "20,40,80,160", "--json"]
    done = CliRunner().invoke(converge, words, standalone_mode=False)
    assert done.exception is None
    (result,) = json.loads(done.output)
    assert result["verdict"] == "holds"
    assert result["method"] == "ambient:rk4 (body momentum and unit quaternion)"
