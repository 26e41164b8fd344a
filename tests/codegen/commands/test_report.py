"""``orderconds report``: where the page goes, and one message for bad input before anything is measured."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from codegen.certify import CertifiedOrder
from codegen.lab import report
from codegen.lab.measurements import long_runs
from codegen.lab.orders import order_study
from orderconds.cli import program


def run(*words: str) -> Result:
    return CliRunner().invoke(program, ["report", *words])


def test_the_page_is_written_and_named_at_the_end(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "folder"
    result = run("free_rigid_body", "-m", "cg:cg3", "--only", "orders", "-o", str(folder))
    assert result.exit_code == 0, result.output
    assert result.stdout.splitlines()[-1] == f"the report: {folder / 'index.html'}"
    assert sorted(p.name for p in folder.iterdir()) == ["free_rigid_body.html", "index.html"]
    assert (folder / "index.html").read_text(encoding="utf-8").endswith("</html>\n")


def test_json_holds_the_measurements_and_stdout_nothing_else(tmp_path: Path) -> None:
    found = json.loads(
        run("free_rigid_body", "-m", "rkmk(0):euler", "--quick", "-o", str(tmp_path), "--json").stdout
    )
    (scene,) = found["scenes"]
    (method,) = scene["methods"]
    assert (scene["scene"], method["method"]) == ("free_rigid_body", "rkmk(0):euler")
    assert {row["method"] for row in scene["cost"]} == {"rkmk(0):euler", "c-dop853"}
    assert [s["verdict"] for s in scene["stability"]] == ["holds"]
    assert [run["steps"] for run in scene["longruns"]] == [10_000]
    assert method["c"]["verdict"] == method["python"]["verdict"] == method["verdict"] == "holds"


def test_an_order_that_is_not_observed_exits_1_and_is_on_the_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(order_study, "certified_order", lambda method, scene: CertifiedOrder(4, "exact"))
    result = run("free_rigid_body", "-m", "cg:cg3", "--only", "orders", "-o", str(tmp_path))
    assert result.exit_code == 1
    assert "fails: observed order 3.00, stated 4" in result.stdout
    assert '<td class="fails">fails</td>' in (tmp_path / "free_rigid_body.html").read_text(encoding="utf-8")


def test_a_user_scene_is_reported_by_its_own_words(tmp_path: Path) -> None:
    scene = tmp_path / "spin.py"
    scene.write_text(
        '"""A spin in a turning field, as its author says it."""\n'
        "from sympy import Matrix, cos, sin, symbols\n"
        "from codegen.groups import SO3, Rotation\n"
        "from codegen.scene import FieldScene\n"
        "t = symbols('t', real=True)\n"
        "m = SO3().dual('m')\n"
        "scene = FieldScene(title='Spin', group=SO3(), action=Rotation(), y=m, span=(0, 1),\n"
        "    f=Matrix([cos(t), sin(2*t), m[2]]) + m, y0=Matrix([1, 0, 0]))\n"
    )
    folder = tmp_path / "out"
    result = run(str(scene), "-m", "rkmk(2):rk4", "--quick", "-o", str(folder))
    assert result.exit_code == 0, result.output
    page = (folder / "spin.html").read_text(encoding="utf-8")
    assert "as its author says it" in page
    assert str(tmp_path) not in page


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nowhere",), "unknown scene"),
        (("free_rigid_body", "-m", "vcg:gauss1"), "the family vcg cannot be used on free_rigid_body"),
        (("free_rigid_body", "-m", "cg33"), "cg33"),
        (("free_rigid_body", "--only", "horoscope"), "unknown measurement 'horoscope'"),
        (("free_rigid_body", "--quick", "--full"), "--quick and --full contradict each other"),
    ],
)
def test_bad_input_is_one_message_before_anything_is_measured(
    words: tuple[str, ...], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(report, "measure_scene", None)
    result = run(*words, "-o", str(tmp_path))
    assert result.exit_code == 2
    assert result.stdout == ""
    assert said in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_to_is_found_out_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(report, "measure_scene", None)
    blocked = tmp_path / "file"
    blocked.write_text("", encoding="utf-8")
    result = run("free_rigid_body", "-o", str(blocked / "inside"))
    assert result.exit_code == 2
    assert "cannot write to this path" in result.stderr


def test_a_page_that_cannot_be_finished_leaves_the_old_one(tmp_path: Path) -> None:
    page = report.write_file(tmp_path / "index.html", "old\n")

    with pytest.raises(UnicodeEncodeError):
        report.write_file(page, "half a page, then \ud800")
    assert page.read_text(encoding="utf-8") == "old\n"
    assert [p.name for p in tmp_path.iterdir()] == ["index.html"]


def test_what_only_the_compiler_writes_is_reported_without_its_conditions(tmp_path):
    """No index sum spells the conditions of dexp cut off, or what fails of a program of brackets."""
    methods = {"free_rigid_body": "rkmk:kutta3", "dipole": "vrkmk_pade(0):gauss1"}
    for scene, method in methods.items():
        result = run(scene, "-m", method, "--only", "orders", "-o", str(tmp_path / scene))
        assert result.exit_code == 0, result.output


def test_an_interrupted_report_goes_on_where_it_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = ("free_rigid_body", "-m", "cg:cg3", "--only", "long", "--quick", "-o", str(tmp_path))
    long_run, calls = long_runs.long_run, []

    def counted(*arguments, **options):
        calls.append(arguments)
        return long_run(*arguments, **options)

    def interrupted(*arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr(long_runs, "long_run", counted)
    with monkeypatch.context() as patch:
        patch.setattr(report, "render", interrupted)
        assert run(*words).exit_code != 0
    assert (tmp_path / ".measured").is_dir()
    result = run(*words)
    assert result.exit_code == 0, result.output
    assert len(calls) == 1
    assert sorted(p.name for p in tmp_path.iterdir()) == ["free_rigid_body.html", "index.html"]
    run(*words)
    assert len(calls) == 2


def test_the_gallery_is_all_or_named(tmp_path: Path) -> None:
    result = run("dipole", "--all", "-o", str(tmp_path))
    assert result.exit_code == 2
    assert "SCENE cannot be used with --all" in result.output


@pytest.mark.slow
def test_scenes_measured_at_the_same_time_have_the_same_pages(tmp_path: Path) -> None:
    words = ("free_rigid_body", "driven_spin", "-m", "cg:cg3", "--only", "conditions", "--quick", "--json")
    results = [run(*words, "-o", str(tmp_path / n), "--processes", n) for n in ("1", "2")]
    first, second = (json.loads(result.stdout)["scenes"] for result in results)
    assert first == second
    pages = [sorted((tmp_path / n).iterdir()) for n in ("1", "2")]
    assert [p.name for p in pages[0]] == [p.name for p in pages[1]]
    assert [p.name for p in pages[0]] == ["driven_spin.html", "free_rigid_body.html", "index.html"]
    for one, two in zip(*pages, strict=True):
        assert one.read_text(encoding="utf-8") == two.read_text(encoding="utf-8")
