"""A new measurement is one class: registered, it is in the listing, the page, the overview and the JSON."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from codegen.lab import Measurement, Section, listing, register
from codegen.lab.registry import measurements, selected, unregister
from codegen.lab.subject import MethodResults, Subject
from orderconds.cli import program
from orderconds.errors import InputError, UnknownName
from tests.codegen.commands.conftest import registered

__all__ = ["registered"]


class Lines(Measurement[MethodResults[tuple[str, int]]]):
    """The length of the emitted C, as a toy measurement."""

    name = "lines"
    title = "Length & size"
    about = "lines of emitted C"

    def run(self, subject: Subject) -> MethodResults[tuple[str, int]]:
        return subject.each(lambda m: (m.label, sum(text.count("\n") for _, text in m.files)))

    def as_json(self, result: MethodResults[tuple[str, int]]) -> object:
        return [{"method": label, "lines": count} for label, count in result.measured]

    def holds(self, result: MethodResults[tuple[str, int]]) -> bool:
        return all(count > 0 for _, count in result.measured)

    def section(self, result: MethodResults[tuple[str, int]], subject: Subject) -> Section:
        template = "<ul>{% for label, n in rows %}<li>{{ label }}: {{ n }} & more</li>{% endfor %}</ul>"
        return Section(template, {"rows": [(f"<{label}>", n) for label, n in result.measured]})

    def overview(self, result: MethodResults[tuple[str, int]], subject: Subject) -> Section:
        return Section("<p>toy overview of {{ name }}</p>", {"name": subject.scene.name})


@pytest.fixture
def toy() -> Iterator[None]:
    register(Lines)
    yield
    unregister(Lines)


def run(*words: str) -> Result:
    return CliRunner().invoke(program, list(words))


@pytest.mark.usefixtures("toy")
def test_a_registered_measurement_is_in_pages_json_and_listing(tmp_path: Path) -> None:
    done = run("report", "free_rigid_body", "-m", "cg:cg3", "--only", "lines", "-o", str(tmp_path), "--json")
    assert done.exit_code == 0, done.output
    (scene,) = json.loads(done.stdout)["scenes"]
    (found,) = scene["lines"]
    assert found["method"] == "cg:cg3"
    page = (tmp_path / "free_rigid_body.html").read_text(encoding="utf-8")
    assert '<section id="lines">\n<h2>Length &amp; size</h2>' in page
    assert f"<li>&lt;cg:cg3&gt;: {found['lines']} & more</li>" in page
    assert '<a href="#lines">Length &amp; size</a>' in page
    assert "toy overview of free_rigid_body" in (tmp_path / "index.html").read_text(encoding="utf-8")
    listed = run("list", "measurements", "--json")
    assert {"name": "lines", "about": "lines of emitted C"} in json.loads(listed.stdout)["measurements"]
    assert "lines of emitted C" in run("list", "measurements").stdout


@pytest.mark.usefixtures("toy")
def test_a_registered_measurement_that_does_not_hold_fails_the_report(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Lines, "holds", lambda self, result: False)
    done = run("report", "free_rigid_body", "-m", "cg:cg3", "--only", "lines", "-o", str(tmp_path))
    assert done.exit_code == 1


def test_without_registration_there_is_no_such_measurement(tmp_path: Path) -> None:
    assert "lines" not in {m["name"] for m in listing()}
    done = run("report", "free_rigid_body", "--only", "lines", "-o", str(tmp_path))
    assert done.exit_code == 2


@pytest.mark.usefixtures("toy")
def test_a_name_is_registered_once() -> None:
    class Other(Lines):
        """Another measurement with the same name."""

    class Orders(Lines):
        """A measurement with a built-in name."""

        name = "orders"

    register(Lines)
    assert [m["name"] for m in listing()].count("lines") == 1
    for kind in (Other, Orders):
        with pytest.raises(InputError, match="already"):
            register(kind)


def test_names_are_unique_and_described() -> None:
    every = measurements()
    assert len({m.name for m in every}) == len(every)
    assert len({m.json_key or m.name for m in every}) == len(every)
    assert all(m.title and m.about for m in every)


def test_parts_are_selected_with_the_measurement_they_belong_to() -> None:
    for chosen in (("orders",), ("cost", "long")):
        expected = [m.name for m in measurements() if m.name in chosen or m.part_of in chosen]
        assert [m.name for m in selected(chosen)] == expected
    assert {"orders", "conditions", "emitted"} <= {m.name for m in selected(("orders",))}
    assert {"advice", "cost", "long"} <= {m.name for m in selected(("cost", "long"))}
    assert [m.name for m in selected(("advice",))] == ["advice"]
    assert selected(())[0].name == "advice"
    with pytest.raises(UnknownName, match="horoscope"):
        selected(("horoscope",))
