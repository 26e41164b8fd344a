"""Pictures that a page can hold: no size, no date, no fixed colour, the same bytes each time."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest

from codegen.lab.page.figures import (
    Curve,
    convergence_figure,
    efficiency_figure,
    growth_figure,
    region_figure,
)

CURVES = [
    Curve("cg:cg3", tuple((0.4 / 2**k, 1e-2 * (0.4 / 2**k) ** 3) for k in range(6)), 3),
    Curve("cf:cf4", tuple((0.4 / 2**k, 1e-3 * (0.4 / 2**k) ** 4) for k in range(6)), 4),
]


def regions(name: str, curves: list[Curve], label: str) -> str:
    """Draw a disk and a half plane under the labels of the curves."""
    functions = [(curves[0].label, 0, lambda z: 1 + z), (curves[1].label, 1, lambda z: (2 + z) / (2.1 - z))]
    return region_figure(name, functions).replace("imaginary part of hλ", label)


@pytest.fixture(params=[convergence_figure, efficiency_figure, growth_figure, regions])
def svg(request: pytest.FixtureRequest) -> str:
    return str(request.param("a figure", CURVES, "error at t = 2"))


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
    first, second = (convergence_figure("x", CURVES, "e") for _ in range(2))
    assert first == second


def test_two_figures_of_a_page_share_no_identifier_that_means_two_things() -> None:
    texts = [convergence_figure("x", CURVES, "e"), convergence_figure("y", CURVES, "e")]
    clips = [set(re.findall(r' id="([^"]+)"', text)) for text in texts]
    assert clips[0].isdisjoint(clips[1])
    for text in texts:
        identifiers = re.findall(r' id="([^"]+)"', text)
        assert len(identifiers) == len(set(identifiers))


def test_a_reference_line_is_dashed_for_each_order_once() -> None:
    text = convergence_figure("x", [*CURVES, Curve("again", CURVES[0].points, 3)], "e")
    assert len(re.findall("stroke-dasharray", text)) == 2
    assert {"h³", "h⁴"} <= set(re.findall(r">([^<>\n]+)</text>", text))


def test_the_boundary_of_stability_is_where_the_function_has_modulus_one() -> None:
    """Of Euler's method the circle of radius one about -1: its points in the picture lie on a circle."""
    svg = region_figure("euler", [("euler", 0, lambda z: 1 + z)])
    (path,) = (d for d in re.findall(r'<path d="([^"]+)"[^>]*stroke: var\(--series-1\)', svg) if len(d) > 500)
    points = [tuple(map(float, p)) for p in re.findall(r"[ML] ([\d.]+) ([\d.]+)", path)]
    x, y = (sum(c) / len(points) for c in zip(*points, strict=True))
    radii = [((a - x) ** 2 + (b - y) ** 2) ** 0.5 for a, b in points]
    assert max(radii) < 1.03 * min(radii)


def test_curves_keep_the_place_that_they_are_given() -> None:
    moved = [Curve(c.label, c.points, place=4) for c in CURVES[:1]]
    assert "--series-5" in efficiency_figure("x", moved, "e")
    assert "--series-1)" not in efficiency_figure("x", moved, "e")
