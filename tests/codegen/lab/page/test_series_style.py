"""A method has one colour and marker everywhere, and any two series can be told apart."""

from __future__ import annotations

import itertools
import math

import pytest

from codegen.lab.default_methods import PICTURED
from codegen.lab.page.series_style import COLOURS, MARKERS, Styles
from codegen.lab.page.svg import LIGHT, SERIES_DARK, SERIES_LIGHT
from codegen.lab.peers import PEERS

DEFICIENCIES = {
    "none": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "red": (
        (0.152286, 1.052583, -0.204868),
        (0.114503, 0.786281, 0.099216),
        (-0.003882, -0.048116, 1.051998),
    ),
    "green": (
        (0.367322, 0.860646, -0.227968),
        (0.280085, 0.672501, 0.047413),
        (-0.011820, 0.042940, 0.968881),
    ),
    "blue": (
        (1.255528, -0.076749, -0.178779),
        (-0.078411, 0.930809, 0.147602),
        (0.004733, 0.691367, 0.303900),
    ),
}
"""Linear RGB as seen without a receptor; G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, A physiologically
based model for simulation of color vision deficiency, IEEE TVCG 15 (2009), severity 1."""

APART = 0.06
"""Smallest distance of two colours in Oklab (B. Ottosson, 2020); a just noticeable difference is 0.02."""

READABLE = 3.0
"""Smallest contrast of a line with the page (Web Content Accessibility Guidelines 2.1, criterion 1.4.11)."""

PAPER = {"light": "#fdfcf9", "dark": "#16171a"}


def linear(colour: str) -> list[float]:
    parts = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]


def seen(colour: str, deficiency: str) -> tuple[float, float, float]:
    """Return a colour as it is seen, in Oklab."""
    given = linear(colour)
    mixed = (sum(a * x for a, x in zip(row, given, strict=True)) for row in DEFICIENCIES[deficiency])
    r, g, b = (min(1.0, max(0.0, x)) for x in mixed)
    long, middle, short = (
        math.cbrt(x)
        for x in (
            0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b,
            0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b,
            0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b,
        )
    )
    return (
        0.2104542553 * long + 0.7936177850 * middle - 0.0040720468 * short,
        1.9779984951 * long - 2.4285922050 * middle + 0.4505937099 * short,
        0.0259040371 * long + 0.7827717662 * middle - 0.8086757660 * short,
    )


def contrast(one: str, other: str) -> float:
    weights = (0.2126, 0.7152, 0.0722)
    low, high = sorted(sum(w * x for w, x in zip(weights, linear(c), strict=True)) for c in (one, other))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("deficiency", DEFICIENCIES)
@pytest.mark.parametrize("colours", [SERIES_LIGHT, SERIES_DARK], ids=["light", "dark"])
def test_any_two_colours_of_series_differ_for_every_reader(colours: tuple[str, ...], deficiency: str) -> None:
    assert len(colours) == COLOURS
    views = [seen(colour, deficiency) for colour in colours]
    assert min(math.dist(a, b) for a, b in itertools.combinations(views, 2)) > APART


@pytest.mark.parametrize(("mode", "colours"), [("light", SERIES_LIGHT), ("dark", SERIES_DARK)])
def test_every_series_has_enough_contrast_with_the_page(mode: str, colours: tuple[str, ...]) -> None:
    assert min(contrast(colour, PAPER[mode]) for colour in colours) >= READABLE
    if mode == "light":
        assert min(contrast(colour, LIGHT["var(--paper)"]) for colour in colours) >= READABLE


@pytest.mark.parametrize("group", range(len(PICTURED)))
def test_methods_of_one_picture_differ_in_marker_and_up_to_eight_also_in_colour(group: int) -> None:
    styles = [Styles(PICTURED[group]).of(label) for label in PICTURED[group]]
    assert len({s.marker for s in styles}) == len(styles)
    assert len({s.colour for s in styles}) == min(len(styles), COLOURS)


def test_no_two_default_methods_have_the_same_colour_and_marker() -> None:
    labels = list(dict.fromkeys(label for group in PICTURED for label in group))
    styles = Styles(labels)
    assert len({(styles.of(x).colour, styles.of(x).marker) for x in labels}) == len(labels)


def test_a_default_method_has_one_style_in_every_picture() -> None:
    for group in PICTURED:
        for label in group:
            alone = Styles([label]).of(label)
            assert Styles([*group, "cg:cg3"]).of(label) == alone == Styles([]).of(label)


def test_the_style_of_a_method_does_not_depend_on_the_order_of_the_methods() -> None:
    labels = ["cf:mine", "cf:cf4", "vcg:yours", "rkmk:another", "c-dop853"]
    expected = [Styles(labels).of(label) for label in labels]
    for order in itertools.permutations(labels):
        assert [Styles(order).of(label) for label in labels] == expected


def test_methods_outside_the_defaults_differ_in_colour_and_marker() -> None:
    labels = [f"cf:method{k}" for k in range(COLOURS)]
    styles = [Styles(labels).of(label) for label in labels]
    assert len({s.colour for s in styles}) == COLOURS
    assert len({s.marker for s in styles}) == COLOURS
    many = [f"cf:method{k}" for k in range(COLOURS * len(MARKERS))]
    styles = [Styles(many).of(label) for label in many]
    assert len({s.marker for s in styles}) == len(MARKERS)


def test_the_line_shows_how_a_method_runs() -> None:
    styles = Styles(["cf:cf43"])
    fixed, adaptive, python, form = (
        styles.of(label)
        for label in ("cf:cf43", "adaptive cf:cf43", "cf:cf43 (python)", "cf:cf43 (body momentum and matrix)")
    )
    assert {(s.colour, s.marker) for s in (fixed, adaptive, python, form)} == {(fixed.colour, fixed.marker)}
    assert len({fixed.dash, adaptive.dash, python.dash}) == 3
    assert form == fixed


def test_peers_are_dashed_and_hollow_in_colours_of_text() -> None:
    styles = Styles(PEERS)
    assert all(styles.of(p).hollow and styles.of(p).dash for p in PEERS)
    assert {styles.of(p).colour for p in PEERS} == {"var(--ink)", "var(--muted)"}
    looks = [(styles.of(p).colour, styles.of(p).marker) for p in PEERS]
    assert len(set(looks)) == len(looks)
