"""The page: whole, self-contained, and the same each time but for its times."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from codegen.lab import contest
from codegen.lab import study as measured
from codegen.lab.efficiency.requirements import NEEDS
from codegen.lab.page.documents import page_name, render, render_overview
from codegen.lab.measurements.orders import agreement
from codegen.lab.stability.endurance import Endurance
from codegen.lab.stability.extreme_steps import SILENT, WRONG
from codegen.lab.stability.order_reduction import OrderReduction
from codegen.lab.survey import Effort, Survey, plan, survey
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


SHORT = Effort(1.0, ("c-rk4-projected",), 1000, back=True, rounding=True, harsh=False, endurance=False)


@pytest.fixture(scope="module")
def found() -> Survey:
    told: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(measured, "timings", lambda run, steps: tuple(Timing(n, n * 1e-7) for n in steps))
        patch.setattr(contest, "samples", lambda call: (1e-4, 2e-4))
        methods = ("cg:cg3", "cf:cf4")
        result = survey(plan("free_rigid_body", load("free_rigid_body"), methods, effort=SHORT), told.append)
    assert "free_rigid_body, cf:cf4: convergence" in told
    return result


@pytest.fixture(scope="module")
def overview(found: Survey) -> str:
    return render_overview([found], "orderconds report free_rigid_body -o DIR")


@pytest.fixture(scope="module", params=["scene", "overview"])
def document(request: pytest.FixtureRequest, page: str, overview: str) -> str:
    return page if request.param == "scene" else overview


@pytest.fixture(scope="module")
def page(found: Survey) -> str:
    return render(found, "orderconds report free_rigid_body -o DIR")


def test_every_tag_is_closed(document: str) -> None:
    parser = Balanced()
    parser.feed(document)
    assert parser.open == []


def test_nothing_is_fetched(document: str) -> None:
    parser = Balanced()
    parser.feed(document)
    for tag, attributes in parser.seen:
        assert tag not in {"script", "link", "img", "iframe"}
        for name in ("src", "xlink:href"):
            assert (attributes.get(name) or "#").startswith("#")
        assert re.fullmatch(r"#\w+|free_rigid_body\.html|index\.html", attributes.get("href") or "#top")
    assert "@import" not in document
    assert "url(http" not in document


def test_every_link_within_the_page_has_its_target(document: str) -> None:
    targets = set(re.findall(r' id="([^"]+)"', document))
    assert set(re.findall(r'href="#([^"]+)"', document)) <= targets
    assert set(re.findall(r"url\(#([^)]+)\)", document)) <= targets


def test_the_page_shows_orders_conditions_residuals_and_what_was_left_out(page: str) -> None:
    for text in (
        "cg:cg3",
        "computed order",
        "exact",
        "holds",
        "<i>a</i><sub>ij</sub> <i>c</i><sub>j</sub> = 1/6",
        "−1/24",
        "equation solving: every stage is explicit here",
        "orderconds emit free_rigid_body --method cg:cg3 --target c",
        "orderconds report free_rigid_body -m cg:cg3 -m cf:cf4 --only orders -o DIR",
        "orderconds report free_rigid_body -m cg:cg3 -m cf:cf4 --only long -o DIR",
        "orderconds bench free_rigid_body -m cg:cg3 -m cf:cf4 -a c-rk4-projected --budget 1 -o DIR",
        "largest deviation of energy",
        "compensated",
        "momentum times 1e+75",
        "prefers-color-scheme: dark",
        'name="viewport"',
    ):
        assert text in page


@pytest.mark.parametrize(("spread", "said"), [(None, "no run"), (0.0, "bit for bit"), (2e-16, "2 · 10⁻¹⁶")])
def test_agreement_is_said_in_words(spread: float | None, said: str) -> None:
    assert agreement(spread).replace(".0", "") == said


def test_the_executors_agree_to_rounding(found: Survey) -> None:
    assert all(m.spread is not None and m.spread < 1e-14 for m in found.orders)


def test_the_page_is_the_same_when_the_times_are(page: str, found: Survey) -> None:
    assert render(found, "orderconds report free_rigid_body -o DIR") == page


def test_text_of_a_scene_cannot_become_markup(found: Survey) -> None:
    wild = replace(found.scene, title="<script>alert(1)</script> & (x)")
    spoilt = replace(found, plan=replace(found.plan, scene=wild))
    assert "<script" not in render(spoilt, "x") + render_overview([spoilt], "x")


def test_the_overview_links_to_the_page_and_names_what_meets_each_need(overview: str, found: Survey) -> None:
    assert f'<a href="{page_name(found)}">' in overview
    for need in NEEDS:
        assert need.name in overview
    assert re.findall(r"Met by none[^<]*", overview) == [
        "Met by none of the methods here: symplectic, adaptive."
    ]


def test_a_part_that_was_not_asked_for_has_no_section(found: Survey) -> None:
    only = replace(found, cost=None, advice=(), stability=(), longruns=())
    short = render(only, "x")
    assert '<section id="orders">' in short
    for part in ("advice", "cost", "stability", "long"):
        assert f'id="{part}"' not in short
        assert f'href="#{part}"' not in short


def test_harsh_variants_long_runs_and_wrong_answers_are_told(found: Survey) -> None:
    (one, *others) = found.stability
    spin = OrderReduction("stiff spin", 2e3, 4, ((0.1, 1e-2, ""),), 2.0, "order reduction 4 to 2.0")
    ended = Endurance("onwards", 10_000_000, 1e-12, None)
    bad = replace(one.answers[0], verdict=f"{WRONG}: an answer that is not finite")
    told = replace(
        one, stiff=(spin,), endurance=(ended,), notes=("no reference",), answers=(bad, *one.answers[1:])
    )
    page = render(replace(found, stability=(told, *others)), "x")
    for text in ("<dt>stiff spin</dt>", "order reduction 4 to 2.0", "10000000 steps", "no reference"):
        assert text in page
    assert '<td class="num fails">1</td>' in page
    assert '<td class="num fails">1</td>' not in render(found, "x")


def test_an_undetermined_answer_is_told_and_fails_what_asks_for_digits_only(found: Survey) -> None:
    (one, *others) = found.stability
    lost = replace(one, answers=(replace(one.answers[0], verdict=SILENT), *one.answers[1:]))
    assert lost.honest
    assert not lost.held
    survey = replace(found, stability=(lost, *others))
    assert survey.held == found.held
    assert " + 1 undetermined" in render(survey, "x")
