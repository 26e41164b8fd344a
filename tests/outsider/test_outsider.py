"""A scene that nobody planned for, written from the documentation, goes through every command."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program

SCENE = str(Path(__file__).parent / "spherical_pendulum.py")
METHODS = ("vcg:midpoint", "cf:cf4", "splitting:strang")


SOME = [METHODS[:2], pytest.param(METHODS, marks=pytest.mark.slow)]
"""Measurements that take long run on an implicit and an explicit method in the quick run."""


def call(*arguments: str) -> Result:
    done = CliRunner().invoke(program, list(arguments), catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return done


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("target", ["c", "python"])
def test_emit(method, target, tmp_path):
    call("emit", SCENE, "--method", method, "--target", target, "-o", str(tmp_path))
    entries = json.loads((tmp_path / "manifest.json").read_text())["modules"]
    assert [entry["method"] for entry in entries] == [method]


def test_converge():
    done = call("converge", SCENE, "--method", *METHODS, "--json")
    found = {r["method"]: r for r in json.loads(done.output)}
    assert {m: r["stated_order"] for m, r in found.items()} == dict(zip(METHODS, (2, 4, 2), strict=True))
    assert {r["verdict"] for r in found.values()} == {"holds"}


def test_bench(tmp_path):
    call("bench", SCENE, "--method", "cf:cf4", "--against", "c", "--budget", "0.002", "-o", str(tmp_path))
    rows = json.loads((tmp_path / "spherical_pendulum.json").read_text())
    assert {r["method"] for r in rows} == {"cf:cf4", "c-dop853", "c-rk4-projected"}
    assert min(r["error"] for r in rows if r["error"] is not None) < 1e-10


@pytest.mark.parametrize("methods", SOME)
def test_stability(methods):
    done = call("stability", SCENE, "--method", *methods, "--quick", "--json")
    for result in json.loads(done.output):
        assert result["verdict"] == "holds"
        assert {c["verdict"].partition(":")[0] for c in result["cases"]} == {"accurate", "status"}


@pytest.mark.parametrize("methods", SOME)
def test_longrun(methods):
    done = call("longrun", SCENE, "--method", *methods, "--steps", "2000", "--json")
    for result in json.loads(done.output):
        kept = {k["name"]: k["largest"] for k in result["kept"]}
        assert kept["manifold"] < 1e-12
        if not result["method"].startswith("cf"):
            assert kept["momentum_about_vertical"] < 1e-11
            assert kept["energy"] < 1e-2


def test_report(tmp_path):
    call("report", SCENE, "--method", "splitting:strang", "--quick", "-o", str(tmp_path))
    overview, page = ((tmp_path / name).read_text() for name in ("index.html", "spherical_pendulum.html"))
    assert "Spherical pendulum" in overview
    assert '<a href="spherical_pendulum.html">' in overview
    for text in ("splitting:strang", "symplectic defect of a step", "largest deviation of energy", "wrong"):
        assert text in page
