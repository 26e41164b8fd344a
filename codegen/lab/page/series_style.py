"""The colour, marker and dash pattern of each method in the pictures and tables of the report.

A method has the same colour and marker in every section, on every page and in the pictures of the README.

The dash pattern of a line has the following meanings:

- Solid: a method with equal steps.
- Dash-dotted: a method with step-size control.
- Dotted: a method with equal steps, in a target (programming language) that is not the default target.
- Dashed, with open markers: a peer (another integrator, measured for comparison).
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
"""The number of CSS variables ``--series-1``, ``--series-2``, ... with the colours of curves."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "h", "p", "*")
"""The markers in the notation of Matplotlib."""

PEER_COLOURS = ("var(--ink)", "var(--muted)")

ADAPTIVE = "adaptive "
"""The first word of the label of a method with step-size control, followed by a space."""

Dash = tuple[float, ...]
SOLID: Dash = ()
DASHED: Dash = (4, 2)
DOTTED: Dash = (1, 1.6)
DASH_DOTTED: Dash = (6, 2, 1, 2)
DASHES = (SOLID, DASHED, DASH_DOTTED, DOTTED)

Place = tuple[int, int]
"""A pair (index of a colour, index of a marker)."""


@dataclass(frozen=True)
class Style:
    """The appearance of a curve.

    ``colour`` is a CSS variable of the page, and ``marker`` is one of :data:`MARKERS`. ``dash`` contains the
    lengths of dashes and gaps as multiples of the line width. If ``hollow`` is True, only the outlines of the
    markers are drawn.
    """

    colour: str
    marker: str
    dash: Dash = SOLID
    hollow: bool = False


def numbered(place: int) -> Style:
    """Return the style of the curve with the number ``place``, counted from 0."""
    colour = f"var(--series-{place % COLOURS + 1})"
    return Style(colour, MARKERS[place % len(MARKERS)], DASHES[place % len(DASHES)])


class Styles:
    """The styles of all methods and peers (other integrators) in a report or picture.

    The methods in ``PICTURED`` have fixed colours and markers. Each other method gets the least used colour
    and the least used marker.

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
        """Return the style of the method or peer (other integrator) that ``label`` names.

        The label can contain the prefix ``adaptive`` and a suffix in brackets, as in :func:`method_name`.
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
    """Return the name of the method or peer (other integrator) that ``label`` contains.

    >>> method_name("adaptive ambient:dop853 (body momentum and unit quaternion)")
    'ambient:dop853'
    """
    return label.removeprefix(ADAPTIVE).partition(" (")[0]


def _digest(name: str) -> int:
    return int.from_bytes(sha256(name.encode()).digest()[:4], "big")


@cache
def _fixed() -> Mapping[str, Place]:
    """Return a dictionary that maps each method in ``PICTURED`` to the indices of its colour and its marker.

    If possible, no two methods in a figure have the same colour or the same marker.
    """
    places: dict[str, Place] = {}
    for name in dict.fromkeys(name for group in PICTURED for name in group):
        beside = {other for group in PICTURED if name in group for other in group}
        used = [place for other, place in places.items() if other in beside]
        places[name] = _free(used, 0, set(places.values()))
    return MappingProxyType(places)


def _free(used: Iterable[Place], first: int, taken: Iterable[Place] = ()) -> Place:
    """Return the index of the colour and the index of the marker that occur least often in ``used``.

    The function chooses the colour first. If several markers occur equally often, the function prefers
    markers for which the pair (colour, marker) is not in ``taken``. If there is still a choice between
    colours or between markers, the integer ``first`` decides. For example, ``first`` is a hash value of the
    name of a method.
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
