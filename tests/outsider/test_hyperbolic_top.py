"""A scene with its own action, written from the documentation, goes through the commands."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.outsider.test_outsider import call

SCENE = str(Path(__file__).parent / "hyperbolic_top.py")
METHODS = {"rkmk(2):rk4": 4, "cf:cf4": 4}


@pytest.mark.parametrize("target", ["c", "python"])
def test_emit_names_the_action(target, tmp_path):
    call("emit", SCENE, "--method", "cf:cf4", "--target", target, "-o", str(tmp_path))
    (entry,) = json.loads((tmp_path / "manifest.json").read_text())["modules"]
    assert entry["method"] == "cf:cf4"
    assert any("Moebius transformation" in path.read_text() for path in tmp_path.iterdir())


def test_converge_agrees_with_the_computed_orders():
    done = call("converge", SCENE, "--method", *METHODS, "--json")
    found = {r["method"]: (r["stated_order"], r["verdict"]) for r in json.loads(done.output)}
    assert found == {name: (order, "holds") for name, order in METHODS.items()}


def test_longrun_measures_the_energy():
    done = call("longrun", SCENE, "--method", "cf:cf4", "--steps", "2000", "--json")
    (result,) = json.loads(done.output)
    assert next(k["largest"] for k in result["kept"] if k["name"] == "energy") < 1e-4


@pytest.mark.slow
def test_recommend_reaches_the_error():
    done = call("recommend", SCENE, "--error", "1e-8", "--tableau", "rk4", "--tableau", "dop853", "--json")
    best = json.loads(done.output)["recommended"]
    assert best["error"] <= 1e-8
    assert "dop853" in best["method"]


@pytest.mark.slow
def test_stability_has_no_silent_wrong_answer():
    done = call("stability", SCENE, "--method", "cf:cf4", "--quick", "--json")
    for result in json.loads(done.output):
        assert result["verdict"] == "holds"


@pytest.mark.slow
def test_report_has_the_title_of_the_scene(tmp_path):
    call("report", SCENE, "--method", "cf:cf4", "--quick", "-o", str(tmp_path))
    assert "Top on the hyperbolic plane" in (tmp_path / "index.html").read_text()
