"""The page: whole, self-contained, and the same each time but for its times."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from codegen.errors import MethodError
from codegen.lab import subject as subjects
from codegen.lab.efficiency import emitted_candidate, peer_candidate
from codegen.lab.efficiency.requirements import DECADES, REQUIREMENTS
from codegen.lab.measurements.advice import Advice, Advised, Line, completed, monotone
from codegen.lab.measurements.cost import Cost
from codegen.lab.measurements.long_runs import LongRuns
from codegen.lab.measurements.orders import Orders, agreement
from codegen.lab.measurements.stability import StabilityTests
from codegen.lab.orders import order_study
from codegen.lab.page import documents
from codegen.lab.page.documents import page_name, render, render_overview, summary
from codegen.lab.registry import selected
from codegen.lab.scene_results import Measured, SceneResults, measure_scene
from codegen.lab.stability.endurance import Endurance
from codegen.lab.stability.extreme_steps import SILENT, WRONG
from codegen.lab.stability.order_reduction import OrderReduction
from codegen.lab.subject import QUICK, Effort, MethodResults, subject
from codegen.lab.timing import Timing
from codegen.scenes import load


def part(results: SceneResults, kind):
    """Return the result of a measurement."""
    return next(m.result for m in results.measured if isinstance(m.measurement, kind))


def with_part(results: SceneResults, kind, *found) -> SceneResults:
    """Return results with other findings of a measurement."""

    def changed(m: Measured) -> Measured:
        return replace(m, result=MethodResults(found)) if isinstance(m.measurement, kind) else m

    return replace(results, measured=tuple(map(changed, results.measured)))


VOID = {"wbr", "meta", "br", "hr", "img", "link"}


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


SHORT = Effort(1.0, ("c-rk4-projected",), 1000, back=True, rounding=True, stiff=False, endurance=False)


@pytest.fixture(scope="module")
def found() -> SceneResults:
    told: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(order_study, "timings", lambda run, steps: tuple(Timing(n, n * 1e-7) for n in steps))
        for module in (emitted_candidate, peer_candidate):
            patch.setattr(module, "span_times", lambda run, _: [1e-7 * run(1), 2e-7 * run(1)])
        methods = ("cg:cg3", "cf:cf4")
        planned = subject("free_rigid_body", load("free_rigid_body"), methods, effort=SHORT)
        result = measure_scene(replace(planned, progress=told.append), selected(()))
    assert "free_rigid_body, cf:cf4: convergence" in told
    return result


@pytest.fixture(scope="module")
def overview(found: SceneResults) -> str:
    return render_overview([summary(found)], "orderconds report free_rigid_body -o DIR")


@pytest.fixture(scope="module", params=["scene", "overview"])
def document(request: pytest.FixtureRequest, page: str, overview: str) -> str:
    return page if request.param == "scene" else overview


@pytest.fixture(scope="module")
def page(found: SceneResults) -> str:
    return render(found, "orderconds report free_rigid_body -o DIR")


def test_every_tag_is_closed(document: str) -> None:
    parser = Balanced()
    parser.feed(document)
    assert parser.open == []


def test_nothing_is_fetched(document: str) -> None:
    parser = Balanced()
    parser.feed(document)
    for tag, attributes in parser.seen:
        assert tag not in {"link", "img", "iframe"}
        assert tag != "script" or not attributes
        for name in ("src", "xlink:href"):
            assert (attributes.get(name) or "#").startswith("#")
        assert re.fullmatch(r"#\w+|free_rigid_body\.html|index\.html", attributes.get("href") or "#top")
    assert "@import" not in document
    assert "url(http" not in document
    script = document.partition("<script>")[2].partition("</script>")[0]
    assert script
    for word in ("fetch(", "XMLHttpRequest", "import(", "http:", "https:", "localStorage", "eval("):
        assert word not in script


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
        "a solver for implicit equations: all stages are explicit",
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


def test_the_executors_agree_to_rounding(found: SceneResults) -> None:
    assert all(m.spread is not None and m.spread < 1e-14 for m in part(found, Orders).measured)


def test_the_page_is_the_same_when_the_times_are(page: str, found: SceneResults) -> None:
    assert render(found, "orderconds report free_rigid_body -o DIR") == page


def test_text_of_a_scene_cannot_become_markup(found: SceneResults) -> None:
    wild = replace(found.scene, title="<script>alert(1)</script> & (x)")
    spoilt = replace(found, subject=replace(found.subject, scene=wild))
    for document in (render(spoilt, "x"), render_overview([summary(spoilt)], "x")):
        assert "<script>alert" not in document
        assert document.count("<script") == 1


def test_the_overview_links_to_the_page_and_names_each_requirement(
    overview: str, found: SceneResults
) -> None:
    assert f'<a href="{page_name(found)}">' in overview
    for need in REQUIREMENTS:
        assert need.name in overview
    assert re.findall(r"No method satisfies[^<]*", overview) == ["No method satisfies: symplectic, adaptive."]


def test_each_cell_of_the_advice_has_the_time_the_step_and_the_command(
    overview: str, found: SceneResults
) -> None:
    lines = {line.need: line.best for line in part(found, Advice).advice}
    cells = [best for best in lines["any emitted method"] if best is not None]
    assert len(cells) == len(DECADES)
    times = [best.seconds for best in cells]
    assert times == sorted(times)  # a smaller error never takes less time
    for best in cells:
        assert best.command == f"orderconds emit free_rigid_body --method {best.method} -o ."
        assert best.h is not None
        assert best.steps == round(2 / best.h)
        assert best.command in overview
    assert lines["symplectic"] == (None,) * len(DECADES)


def test_methods_of_the_page_replace_results_that_an_interrupted_search_lacks(found: SceneResults) -> None:
    advice, cost = part(found, Advice), part(found, Cost)
    none = tuple(Line(r.name, r.meaning, tuple(None for _ in DECADES)) for r in REQUIREMENTS)
    lines = {line.need: line.best for line in completed(none, advice.features, cost.result.entries)}
    assert any(lines["any emitted method"])
    assert not any(lines["symplectic"])  # only a search makes long runs
    for need, best in lines.items():
        for place in filter(None, best):
            known = next(f for f in advice.features if f.label == place.method.partition(" (")[0])
            assert next(r for r in REQUIREMENTS if r.name == need).goal(2).met(known)


def test_a_run_that_reaches_a_smaller_error_in_less_time_also_serves_the_larger_errors() -> None:
    times = [None, 3.0, 3.0, 2.0, 4.0, *[None] * (len(DECADES) - 5)]
    given = [
        seconds and Advised(10.0**-k, f"method {k}", seconds, steps=k)
        for k, seconds in zip(DECADES, times, strict=True)
    ]
    best = monotone(Line("symplectic", "", tuple(given))).best
    assert [b and b.seconds for b in best] == [2.0, 2.0, 2.0, 2.0, 4.0, *times[5:]]
    assert [b.error for b in best if b] == [10.0**-k for k in DECADES][:5]
    assert {b.method for b in best[:4] if b} == {f"method {DECADES[3]}"}


def test_faster_methods_of_the_page_replace_results_of_an_interrupted_search(
    found: SceneResults,
) -> None:
    advice, cost = part(found, Advice), part(found, Cost)
    requirement = next(r for r in REQUIREMENTS if r.name == "any emitted method")

    def filled(seconds: float) -> tuple[Advised | None, ...]:
        slow = tuple(Advised(10.0**-k, "searched", seconds) for k in DECADES)
        line = Line(requirement.name, requirement.meaning, slow)
        return completed((line,), advice.features, cost.result.entries)[0].best

    # Every run of the page takes less than 1000 s and more than 1e-12 s.
    replaced = [best for best in filled(1e3) if best is not None and best.method != "searched"]
    assert replaced
    assert all(best.seconds < 1e3 for best in replaced)
    assert all(best is not None and best.method == "searched" for best in filled(1e-12))


def test_a_part_that_was_not_asked_for_has_no_section(found: SceneResults) -> None:
    only = replace(found, measured=tuple(m for m in found.measured if m.name == "orders"))
    short = render(only, "x")
    assert '<section id="orders">' in short
    for part in ("advice", "cost", "stability", "long"):
        assert f'id="{part}"' not in short
        assert f'href="#{part}"' not in short


def test_stiff_variants_endurance_and_wrong_results_are_shown(found: SceneResults) -> None:
    (one, *others) = part(found, StabilityTests).measured
    spin = OrderReduction("stiff spin", 2e3, 4, ((0.1, 1e-2, ""),), 2.0, "order reduction from 4 to 2.0")
    ended = Endurance("forward", 10_000_000, 1e-12, None)
    answers = one.findings.answers
    bad = replace(answers[0], verdict=f"{WRONG}: a result that is not finite")
    findings = replace(
        one.findings, stiff=(spin,), endurance=(ended,), notes=("no reference",), answers=(bad, *answers[1:])
    )
    page = render(with_part(found, StabilityTests, replace(one, findings=findings), *others), "x")
    for text in (
        '<th scope="row">stiff spin</th>',
        "order reduction from 4 to 2.0",
        "10000000 steps",
        "no reference",
    ):
        assert text in page
    assert '<td class="num fails">1</td>' in page
    assert (
        "Of 70 steps with extreme input, 1 had a wrong result that was reported as success (<code>cg" in page
    )
    assert '<td class="num fails">1</td>' not in render(found, "x")


def test_an_undetermined_result_is_shown_and_fails_only_the_stability_command(found: SceneResults) -> None:
    (one, *others) = part(found, StabilityTests).measured
    answers = one.findings.answers
    findings = replace(one.findings, answers=(replace(answers[0], verdict=SILENT), *answers[1:]))
    lost = replace(one, findings=findings)
    assert lost.honest
    assert not lost.held
    results = with_part(found, StabilityTests, lost, *others)
    assert results.held == found.held
    assert "; 1 had an undetermined result;" in render(results, "x")
    heading = '<th scope="col" class="num">undetermined</th>'
    assert heading in render(results, "x")
    assert heading not in render(found, "x")


def test_a_method_that_fails_is_a_row_with_the_reason_and_the_others_are_measured(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    compile_method = subjects.compile_method

    def refuse(scene, method):
        if method.label == "cf:cf4":
            raise MethodError("no lowering <here>")
        return compile_method(scene, method)

    monkeypatch.setattr(subjects, "compile_method", refuse)
    planned = subject("free_rigid_body", load("free_rigid_body"), ("cf:cf4", "cg:cg3"), effort=QUICK)
    results = measure_scene(planned, selected(()))
    assert not results.held
    page = render(results, "x")
    for name in ("orders", "cost", "stability", "long"):
        section = page.partition(f'<section id="{name}">')[2].partition("</section>")[0]
        assert "cf:cf4" in section
        assert "no lowering &lt;here&gt;" in section
        assert "cg:cg3" in section
    found = results.as_json()
    for key in ("methods", "stability", "longruns"):
        assert [(m["method"], m.get("failure") or "") for m in found[key]] == [
            ("cg:cg3", ""),
            ("cf:cf4", "no lowering <here>"),
        ]
    assert ("cf:cf4", "no lowering <here>") in [(r["method"], r["failure"]) for r in found["cost"]]


def test_a_measurement_that_fails_does_not_hide_the_others(
    found: SceneResults, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(self, subject):
        raise MethodError("no orders today")

    monkeypatch.setattr(Orders, "run", fail)
    planned = subject("free_rigid_body", load("free_rigid_body"), ("cg:cg3",), effort=QUICK)
    results = measure_scene(planned, selected(("orders", "long")))
    page = render(results, "x")
    assert "no orders today" in page
    assert '<section id="long">' in page
    assert results.as_json()["methods"] == {"failure": "no orders today"}
    assert not results.held


def sections(page: str) -> dict[str, str]:
    """Return the HTML of each section by name."""
    return dict(re.findall(r'<section id="(\w+)">(.*?)</section>', page, flags=re.DOTALL))


def test_every_section_begins_with_a_sentence_of_verdict(page: str) -> None:
    found = sections(page)
    assert len(found) == 8
    for text in found.values():
        (verdict,) = re.findall(r'</h2>\n<p class="verdict">(.+?)</p>', text)
        assert verdict.endswith(".")


def test_the_verdict_follows_from_the_data(page: str, found: SceneResults) -> None:
    orders = part(found, Orders)
    assert "equals the computed order for all 2 methods." in sections(page)["orders"]
    failed = MethodResults(orders.measured[:1], (subjects.MethodFailure("cf:cf4", "no reason"),))
    measured = tuple(
        replace(m, result=failed) if isinstance(m.measurement, Orders) else m for m in found.measured
    )
    text = sections(render(replace(found, measured=measured), "x"))["orders"]
    assert '<p class="verdict bad">' in text
    assert "for 1 of 2 methods; the exceptions are <code>cf:cf4</code> (failed)." in text


def test_the_verdict_on_cost_names_the_fastest_at_each_accuracy(page: str, found: SceneResults) -> None:
    places = part(found, Cost).result.places
    text = sections(page)["cost"]
    for place in places:
        assert f"<code>{place.winner.partition(' (')[0]}</code>" in text.partition("</p>")[0]


def test_the_verdict_on_long_runs_names_the_law_of_each_method(page: str, found: SceneResults) -> None:
    verdict = sections(page)["long"].partition("</p>")[0]
    for run in part(found, LongRuns).measured:
        (energy,) = (k for k in run.kept if k.name == "energy")
        assert f"<code>{run.method}</code>" in verdict
        assert energy.drift.law in verdict


def test_every_table_has_a_caption_and_headings_with_a_scope(document: str) -> None:
    tables = re.findall(r"<table[^>]*>(.*?)</table>", document, flags=re.DOTALL)
    assert tables
    for table in tables:
        assert re.match(r"\s*<caption>[^<]+", table)
        head = table.partition("<thead>")[2].partition("</thead>")[0]
        assert all('scope="col"' in cell for cell in re.findall(r"<th\b[^>]*>", head))


def test_no_table_of_stability_has_more_than_seven_columns(page: str) -> None:
    """At a width of 1280 px, more columns are wider than the page."""
    for head in re.findall(r"<thead>(.*?)</thead>", sections(page)["stability"], flags=re.DOTALL):
        assert head.count("<th ") <= 7


def test_every_picture_has_title_and_description(page: str) -> None:
    pictures = re.findall(r'<svg[^>]*role="img".*?</svg>', page, flags=re.DOTALL)
    assert len(pictures) == 6
    for picture in pictures:
        assert re.search(r"<title id=[^>]+>[^<]+Free rigid body", picture)
        assert re.search(r"<desc id=[^>]+>[^<]{20,}", picture)


def keys(text: str) -> dict[str, set[tuple[str, ...]]]:
    """Return the looks of each method in the tables: colour and outline of its key."""
    looks: dict[str, set[tuple[str, ...]]] = {}
    for key, label in re.findall(
        r'<svg class="key"(.*?)</svg><code>([^<]+)</code>', text.replace("<wbr>", ""), flags=re.DOTALL
    ):
        found = re.findall(r"stroke:(var\([^)]+\))", key)[:1] + re.findall(r'd="(M[^"]+Z)"', key)
        looks.setdefault(label.removeprefix("adaptive "), set()).add(tuple(found))
    return looks


def test_a_method_has_one_colour_and_marker_in_all_tables_and_pages(page: str, overview: str) -> None:
    looks = keys(page + overview)
    assert {"cg:cg3", "cf:cf4", "c-rk4-projected"} <= looks.keys()
    assert all(len(found) == 1 for found in looks.values())
    assert len(set.union(*looks.values())) == len(looks)
    for name in ("advice", "orders", "cost", "stability", "long", "conditions", "emitted"):
        assert {"cg:cg3", "cf:cf4"} <= keys(sections(page)[name]).keys()


def test_a_method_has_the_colour_of_the_tables_in_all_pictures(page: str, found: SceneResults) -> None:
    seen = set()
    for picture in re.findall(r'<svg[^>]*role="img".*?</svg>', page, flags=re.DOTALL):
        labels = dict(re.findall(r'data-key="(\d+)">\s*<text[^>]*>([^<]+)<', picture))
        for number, label in labels.items():
            lines = re.findall(rf'data-series="{number}">\s*<path[^>]*stroke: (var\([^)]+\))', picture)
            # A figure that the scene declares may show other runs.
            if label in found.subject.labels:
                assert set(lines) == {found.subject.styles.of(label).colour}
                seen.add(label)
    assert len(seen) == len(found.subject.labels)


def test_nothing_is_hidden_without_the_script(document: str) -> None:
    body = document.partition("<main>")[2].partition("</main>")[0]
    assert not re.search(r"\shidden[\s>]|display: ?none|visibility: ?hidden", body)
    style = document.partition("<style>")[2].partition("</style>")[0]
    hiding = re.findall(r"([^{}]+)\{[^{}]*display: none", style)
    assert {rule.strip() for rule in hiding} == {"svg .off", ".tip[hidden]", ".advice thead"}
    assert 'class="off"' not in body


def test_code_in_the_description_of_a_scene_is_marked_and_escaped() -> None:
    assert documents._formatted("See ``a < b`` & `c`.") == ("See <code>a &lt; b</code> &amp; <code>c</code>.")
