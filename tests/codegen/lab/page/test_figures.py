"""Pictures that a page can hold: no size, no date, no fixed colour, the same bytes each time."""

from __future__ import annotations

import math
import re
from xml.etree import ElementTree

import pytest

from codegen.lab.page.figures import (
    PLANE,
    SLOPES,
    Curve,
    convergence_figure,
    efficiency_figure,
    growth_figure,
    region_figure,
    spread,
)
from codegen.lab.page.formatting import superscript
from codegen.lab.page.series_style import Styles
from codegen.lab.page.svg import standalone

STYLES = Styles(["cg:cg3", "cf:cf4"])


def curve(label: str, order: int) -> Curve:
    points = tuple((0.4 / 2**k, 1e-2 * (0.4 / 2**k) ** order) for k in range(6))
    return Curve(label, points, STYLES.of(label), order)


CURVES = [curve("cg:cg3", 3), curve("cf:cf4", 4)]
NAMESPACE = "{http://www.w3.org/2000/svg}"


def regions(name: str, title: str, curves: list[Curve], label: str) -> str:
    """Draw a disk and a half plane under the labels of the curves."""
    functions = [
        (curves[0].label, curves[0].style, lambda z: 1 + z),
        (curves[1].label, curves[1].style, lambda z: (2 + z) / (2.1 - z)),
    ]
    return region_figure(name, title, functions).replace("imaginary part of hλ", label)


@pytest.fixture(scope="module", params=[convergence_figure, efficiency_figure, growth_figure, regions])
def svg(request: pytest.FixtureRequest) -> str:
    return str(request.param("a figure", "Two <methods>", CURVES, "error at t = 2"))


def test_a_figure_is_one_svg_element_scaled_by_the_page(svg: str) -> None:
    root = ElementTree.fromstring(svg)
    assert root.tag.endswith("svg")
    assert "viewBox" in root.attrib
    assert not {"width", "height"} & root.attrib.keys()


def test_every_colour_is_the_pages(svg: str) -> None:
    assert set(re.findall(r"(?:stroke|fill): ([^;(\"]+)", svg)) == {"none", "var"}
    assert all("fill: var(--" in text for text in re.findall(r"<text [^>]*>", svg))
    assert "<style" not in svg


def test_nothing_is_fetched_and_nothing_tells_the_date(svg: str) -> None:
    assert "<metadata" not in svg
    assert not re.findall(r"(?:href|src)=\"(?!#)", svg)


def test_text_stays_text(svg: str) -> None:
    assert {"cg:cg3", "cf:cf4", "error at t = 2"} <= set(re.findall(r">([^<>\n]+)</text>", svg))


def test_the_same_data_give_the_same_bytes() -> None:
    first, second = (convergence_figure("x", "t", CURVES, "e") for _ in range(2))
    assert first == second


def test_two_figures_of_a_page_share_no_identifier_that_means_two_things() -> None:
    texts = [convergence_figure("x", "t", CURVES, "e"), convergence_figure("y", "t", CURVES, "e")]
    clips = [set(re.findall(r' id="([^"]+)"', text)) for text in texts]
    assert clips[0].isdisjoint(clips[1])
    for text in texts:
        identifiers = re.findall(r' id="([^"]+)"', text)
        assert len(identifiers) == len(set(identifiers))


def test_a_reference_line_is_dashed_for_each_order_once() -> None:
    again = Curve("again", CURVES[0].points, STYLES.of("again"), 3)
    text = convergence_figure("x", "t", [*CURVES, again], "e")
    assert len(re.findall("stroke-dasharray", text)) == 2
    assert {"h³", "h⁴"} <= set(re.findall(r">([^<>\n]+)</text>", text))


def path_points(svg: str, number: int) -> list[tuple[float, float]]:
    """Return the points of the longest line of a series without fill."""
    body = re.split(r'<g data-(?:series|key)="', svg)[1:]
    lines = [
        path
        for part in body
        if part.startswith(f'{number}"')
        for path in re.findall(r'<path d="([^"]+)"[^>]*style="fill: none', part)
    ]
    return [(float(x), float(y)) for x, y in re.findall(r"[ML] ([\d.-]+) ([\d.-]+)", max(lines, key=len))]


def test_the_boundary_of_stability_is_where_the_function_has_modulus_one() -> None:
    """Of Euler's method the circle of radius one about -1: its points in the picture lie on a circle."""
    svg = region_figure("euler", "t", [("euler", STYLES.of("euler"), lambda z: 1 + z)])
    points = path_points(svg, 0)
    assert len(points) > 50
    x, y = ((min(c) + max(c)) / 2 for c in zip(*points, strict=True))
    radii = [((a - x) ** 2 + (b - y) ** 2) ** 0.5 for a, b in points]
    assert max(radii) < 1.01 * min(radii)
    for title in marker_titles(svg)["0"]:
        real, imaginary = re.findall(r"[+−]?\d+\.\d+", title)
        z = complex(float(real.replace("−", "-")), float(imaginary.replace("−", "-")))
        assert abs(1 + z) == pytest.approx(1.0, abs=0.02)


def test_stable_regions_are_shaded_and_their_boundaries_have_markers() -> None:
    drawn = regions("r", "t", CURVES, "e")
    assert len(re.findall(r"fill-opacity: 0\.\d+", drawn)) == len(CURVES)
    assert all(len(titles) > 2 for titles in marker_titles(drawn).values())


def test_methods_with_the_same_boundary_have_markers_at_different_points() -> None:
    functions = [(label, STYLES.of(label), lambda z: 1 + z) for label in ("a", "b")]
    one, other = marker_titles(region_figure("r", "t", functions)).values()
    assert len(one) > 2
    assert {t.partition(":")[2] for t in one}.isdisjoint(t.partition(":")[2] for t in other)


def test_a_picture_of_bounded_regions_is_no_larger_than_they_are() -> None:
    def largest(value) -> float:
        drawn = region_figure("r", "t", [("a", STYLES.of("a"), value)])
        ticks = re.findall(r">(−?\d+)(?:\.0)?</text>", drawn)
        return max(abs(int(t.replace("−", "-"))) for t in ticks)

    assert largest(lambda z: 1 + z) <= 3
    assert largest(lambda z: (2 + z) / (2 - z)) == -PLANE[0]


def marker_titles(svg: str) -> dict[str, list[str]]:
    """Return the titles of the markers of each series, by number."""
    found: dict[str, list[str]] = {}
    for group in ElementTree.fromstring(svg).iter(f"{NAMESPACE}g"):
        if "data-series" in group.attrib:
            titles = [t.text or "" for use in group.iter(f"{NAMESPACE}use") for t in use]
            found.setdefault(group.attrib["data-series"], []).extend(titles)
    return found


def test_every_marker_has_its_values_as_title() -> None:
    titles = marker_titles(convergence_figure("x", "t", CURVES, "e"))
    assert [len(t) for t in titles.values()] == [len(c.points) for c in CURVES]
    assert titles["0"][0] == "cg:cg3: h = 0.4, error 6.4 · 10⁻⁴"
    titles = marker_titles(efficiency_figure("x", "t", CURVES, "e"))
    assert titles["1"][0] == "cf:cf4: 400 ms, error 2.6 · 10⁻⁴"


def test_markers_lie_at_the_points_of_their_titles() -> None:
    """A later point has a smaller error, so its marker is further left and further down."""
    root = ElementTree.fromstring(convergence_figure("x", "t", CURVES, "e"))
    for group in root.iter(f"{NAMESPACE}g"):
        if "data-series" in group.attrib:
            places = [(float(u.attrib["x"]), -float(u.attrib["y"])) for u in group.iter(f"{NAMESPACE}use")]
            assert places == sorted(places, reverse=True)


def test_every_series_has_an_entry_in_the_legend_with_its_number(svg: str) -> None:
    numbers = set(re.findall(r'data-series="(\d+)"', svg))
    assert numbers == {"0", "1"}
    for number, label in zip("01", ("cg:cg3", "cf:cf4"), strict=True):
        entry = re.search(rf'<g data-key="{number}">\s*<text[^>]*>([^<]+)<', svg)
        assert entry
        assert entry[1] == label
    assert svg.count("data-key=") == 4  # a handle and a text for each series


def test_a_line_of_a_long_run_has_a_few_markers() -> None:
    points = tuple((float(k), 1e-9 * k) for k in range(1, 500))
    curves = [Curve(label, points, STYLES.of(label)) for label in ("cg:cg3", "cf:cf4")]
    one, other = marker_titles(growth_figure("x", "t", curves, "e")).values()
    assert 4 <= len(one) <= 12
    assert {t.partition(":")[2] for t in one} != {t.partition(":")[2] for t in other}


def test_a_work_precision_diagram_has_the_slopes_of_orders() -> None:
    drawn = efficiency_figure("x", "t", CURVES, "e")
    assert {f"p = {SLOPES[0]}", *map(str, SLOPES[1:])} <= set(re.findall(r">([^<>\n]+)</text>", drawn))
    lines = re.findall(r'<path d="([^"]+)"[^>]*stroke-dasharray: 0\.8[^>]*stroke: var\(--muted\)', drawn)
    assert len(lines) == len(SLOPES)
    tens = {axis: ten_apart(drawn, axis) for axis in "xy"}
    for line, order in zip(lines, SLOPES, strict=True):
        (a, b), (c, d) = ((float(x), float(y)) for x, y in re.findall(r"[ML] ([\d.]+) ([\d.]+)", line))
        assert (d - b) / tens["y"] == pytest.approx(order * (c - a) / tens["x"], rel=1e-3)


def ten_apart(drawn: str, axis: str) -> float:
    """Return the distance in the picture of two values with the ratio 10, from the first series."""
    group = next(
        g for g in ElementTree.fromstring(drawn).iter(f"{NAMESPACE}g") if g.attrib.get("data-series") == "0"
    )
    places = [float(use.attrib[axis]) for use in group.iter(f"{NAMESPACE}use")]
    values = [p["xy".index(axis)] for p in CURVES[0].points]
    decades = math.log10(values[0] / values[-1])
    return abs(places[0] - places[-1]) / decades


def test_title_and_description_name_the_picture_and_its_series(svg: str) -> None:
    root = ElementTree.fromstring(svg)
    title, description = root.find(f"{NAMESPACE}title"), root.find(f"{NAMESPACE}desc")
    assert title is not None
    assert title.text == "Two <methods>"
    assert description is not None
    assert "cg:cg3" in (description.text or "")
    assert "cf:cf4" in (description.text or "")
    assert root.attrib["role"] == "img"
    ids = {title.attrib["id"], description.attrib["id"]}
    assert set(root.attrib["aria-labelledby"].split()) == ids


def test_a_standalone_picture_has_no_variables_of_a_page(svg: str) -> None:
    document = standalone(svg)
    assert "var(" not in document
    root = ElementTree.fromstring(document.partition("\n")[2])
    assert root[0].tag == f"{NAMESPACE}title"


def test_curves_have_the_style_that_they_are_given() -> None:
    style = STYLES.of("cf:cf4")
    drawn = efficiency_figure("x", "t", [Curve("any", CURVES[0].points, style)], "e")
    assert set(re.findall(r"var\(--series-\d+\)", drawn)) == {style.colour}


def test_dashes_and_hollow_markers_are_drawn() -> None:
    drawn = efficiency_figure("x", "t", [Curve("c-dop853", CURVES[0].points, STYLES.of("c-dop853"))], "e")
    body = drawn.partition("data-series")[2]
    assert "stroke-dasharray" in body
    assert "fill: var(--paper)" in body


@pytest.mark.parametrize("shift", [0.0, 0.3, 0.9])
def test_spread_points_are_distinct_and_in_order(shift: float) -> None:
    chosen = spread([float(k) ** 2 for k in range(100)], 9, shift)
    assert chosen == sorted(set(chosen))
    assert 4 <= len(chosen) <= 9


def test_order_twelve_is_in_superscript() -> None:
    assert superscript(12) == "¹²"
