"""The colour, marker and dash of each method in the pictures and tables of all pages.

A method has the same colour and marker in every section, on every page and in the pictures of the README. The
line is solid for equal steps, and dash-dotted for step-size control. The line is dotted for other targets
than the default target. Peers (other integrators, measured for comparison) have open markers and dashed
lines. Colour-blind readers can distinguish the colours. In grey print, markers and dashes distinguish the
methods.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from types import MappingProxyType

from codegen.lab.default_methods import PICTURED
from codegen.lab.peers import PEERS
from codegen.printers import names

COLOURS = 8
"""Number of colours of the series, which are the CSS variables ``--series-1``, ``--series-2`` and so on."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "h", "p", "*")
"""The markers in the notation of Matplotlib."""

PEER_COLOURS = ("var(--ink)", "var(--muted)")

ADAPTIVE = "adaptive "
"""The beginning of a label of a method with step-size control."""

Dash = tuple[float, ...]
SOLID: Dash = ()
DASHED: Dash = (4, 2)
DOTTED: Dash = (1, 1.6)
DASH_DOTTED: Dash = (6, 2, 1, 2)

Place = tuple[int, int]
"""The indices of a colour and a marker that belong together."""


@dataclass(frozen=True)
class Style:
    """The appearance of a series.

    ``colour`` is a CSS variable of the page, and ``marker`` is a marker of :data:`MARKERS`. ``dash`` contains
    the lengths of dashes and gaps in line widths, and is empty for a solid line. If ``hollow`` is True,
    markers are outlines.
    """

    colour: str
    marker: str
    dash: Dash = SOLID
    hollow: bool = False


class Styles:
    """The styles of all methods and peers of a report or picture, by label.

    Methods that the commands use by default have a fixed colour and marker. Other methods get the colour and
    marker that are rarest in the report. If several pairs of colour and marker are equally rare, the label of
    the method determines the pair.

    >>> styles = Styles(["cf:cf4", "rkmk:heun"])
    >>> styles.of("adaptive cf:cf4").colour == styles.of("cf:cf4").colour
    True
    >>> styles.of("cf:cf4").colour == styles.of("rkmk:heun").colour
    False
    """

    def __init__(self, labels: Iterable[str]) -> None:
        chosen = sorted({method_name(label) for label in labels} - set(PEERS), key=_digest)
        self._places = {name: _fixed()[name] for name in chosen if name in _fixed()}
        for name in chosen:
            if name not in self._places:
                self._places[name] = _free(self._places.values(), _digest(name))

    def of(self, label: str) -> Style:
        """Return the style of a label.

        The label may begin with ``adaptive``, and may end with a target or a form of the equations in
        brackets.
        """
        name = method_name(label)
        if name in PEERS:
            number = list(PEERS).index(name)
            return Style(PEER_COLOURS[number % 2], MARKERS[number % len(MARKERS)], DASHED, hollow=True)
        known = self._places.get(name) or _fixed().get(name)
        colour, marker = known or _free(self._places.values(), _digest(name))
        other = label.partition(" (")[2].partition(")")[0] in names()
        dash = DASH_DOTTED if label.startswith(ADAPTIVE) else DOTTED if other else SOLID
        return Style(f"var(--series-{colour + 1})", MARKERS[marker], dash)


def method_name(label: str) -> str:
    """Return the method or peer of a label.

    >>> method_name("adaptive ambient:dop853 (body momentum and unit quaternion)")
    'ambient:dop853'
    """
    return label.removeprefix(ADAPTIVE).partition(" (")[0]


def _digest(name: str) -> int:
    return int.from_bytes(sha256(name.encode()).digest()[:4], "big")


@cache
def _fixed() -> Mapping[str, Place]:
    """Return the places (colour and marker) of the default methods.

    If possible, methods in the same picture (the same tuple of ``PICTURED``) differ in colour and in marker.
    """
    places: dict[str, Place] = {}
    for name in dict.fromkeys(name for group in PICTURED for name in group):
        beside = {other for group in PICTURED if name in group for other in group}
        used = [place for other, place in places.items() if other in beside]
        places[name] = _free(used, 0, set(places.values()))
    return MappingProxyType(places)


def _free(used: Iterable[Place], first: int, taken: Iterable[Place] = ()) -> Place:
    """Return the indices of the colour and of the marker that occur least often in ``used``.

    If several indices are equally rare, ``first`` determines the choice. Pairs in ``taken`` are avoided if
    possible.
    """
    used, taken = tuple(used), set(taken) | set(used)
    colours, markers = ([place[k] for place in used] for k in (0, 1))
    colour = min(range(COLOURS), key=lambda c: (colours.count(c), (c - first) % COLOURS))
    begin = first // COLOURS + colour
    marker = min(
        range(len(MARKERS)),
        key=lambda m: (markers.count(m), (colour, m) in taken, (m - begin) % len(MARKERS)),
    )
    return colour, marker
