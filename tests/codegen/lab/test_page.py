"""The page: whole, self-contained, and the same each time but for its times."""

from __future__ import annotations

import re
from html.parser import HTMLParser

import pytest

from codegen.lab import study as measured
from codegen.lab.page import render
from codegen.lab.study import Study, methods_for, study
from codegen.lab.timing import Timing
from codegen.scenes import load

VOID = {"meta", "br", "hr", "img", "link"}


class Balanced(HTMLParser):
    """Fails on a tag that is closed wrongly; collects tags and attributes."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[tuple[str, dict[str, str | None]]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def found() -> Study:
    told: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(measured, "timings", lambda run, steps: tuple(Timing(n, n * 1e-7) for n in steps))
        scene = load("free_rigid_body")
        result = study("free_rigid_body", scene, methods_for(scene, ("cg:cg3", "cf:cf4")), told.append)
    assert "free_rigid_body, cf:cf4: convergence" in told
    return result


@pytest.fixture(scope="module")
def page(found: Study) -> str:
    return render([found], "orderconds report free_rigid_body -o DIR")


def test_every_tag_is_closed(page: str) -> None:
    parser = Balanced()
    parser.feed(page)
    assert parser.open == []


def test_nothing_is_fetched(page: str) -> None:
    parser = Balanced()
    parser.feed(page)
    for tag, attributes in parser.seen:
        assert tag not in {"script", "link", "img", "iframe"}
        for name in ("src", "href", "xlink:href"):
            assert (attributes.get(name) or "#").startswith("#")
    assert "@import" not in page
    assert "url(http" not in page


def test_every_link_within_the_page_has_its_target(page: str) -> None:
    targets = set(re.findall(r' id="([^"]+)"', page))
    assert set(re.findall(r'href="#([^"]+)"', page)) <= targets
    assert set(re.findall(r"url\(#([^)]+)\)", page)) <= targets


def test_the_page_shows_orders_conditions_residuals_and_what_was_left_out(page: str) -> None:
    for text in (
        "cg:cg3",
        "computed order",
        "exact",
        "holds",
        "bit for bit",
        "<i>a</i><sub>ij</sub> <i>c</i><sub>j</sub> = 1/6",
        "−1/24",
        "equation solving: every stage is explicit here",
        "orderconds emit free_rigid_body --method cg:cg3 --target c",
        "orderconds report free_rigid_body -m cg:cg3 -m cf:cf4 -o DIR",
        "prefers-color-scheme: dark",
        'name="viewport"',
    ):
        assert text in page


def test_the_page_is_the_same_when_the_times_are(page: str, found: Study) -> None:
    assert render([found], "orderconds report free_rigid_body -o DIR") == page


def test_text_of_a_scene_cannot_become_markup(found: Study) -> None:
    from dataclasses import replace

    wild = replace(found.scene, title="<script>alert(1)</script> & (x)")
    assert "<script" not in render([replace(found, scene=wild)], "x")
