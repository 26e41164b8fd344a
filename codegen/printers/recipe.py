"""The recipe: the data of the comment at the beginning of an emitted file.

The comment describes the origin and the properties of the file, and shows an example of its use.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Recipe:
    """The data for the header comment of an emitted file.

    The data contain no date and no path, so emitting twice gives the same file.

    - ``facts`` are (word, sentence) pairs, for example ("method", "RKMK on rk4 ..."), in the order of the
      header.
    - ``left_out`` are the lines about omitted operations and omitted arguments.
    - ``initial``, ``h`` and ``steps`` are the initial state, step size and number of steps of the usage
      example.
    - ``defaults`` are the values of the run-time parameters in the scene.
    - ``command`` is the command that regenerates the file.
    - ``version`` is the version of orderconds.
    """

    title: str
    facts: tuple[tuple[str, str], ...]
    initial: tuple[float, ...]
    h: float = 0.01
    steps: int = 1000
    defaults: Mapping[str, float] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()
    command: str = ""
    version: str = ""


LONGEST_STATE = 64
"""If a state has at most this number of coordinates, the usage example contains the whole initial state."""

MOST_ENTRIES = 16
"""The largest number of nonzero coordinates that the usage example sets one by one.

The limit applies to states with more than :data:`LONGEST_STATE` coordinates.
"""


IN_MANIFEST = "copy the initial state from the manifest to 'state'"
"""A comment for usage examples that do not contain the initial state."""


def entries_set(initial: Sequence[float]) -> tuple[tuple[int, float], ...] | None:
    """Return one pair (index, value) for each coordinate that has its own assignment in the usage example.

    - For a state with at most :data:`LONGEST_STATE` coordinates, the result is None, because the usage
      example contains the whole initial state.
    - For a longer state, the result contains the pairs of all nonzero coordinates. If there are more than
      :data:`MOST_ENTRIES` of these pairs, the result is empty, because the usage example would be too long.

    >>> entries_set([1.0, 0.0]), entries_set([0.0] * 99 + [1.0])
    (None, ((99, 1.0),))
    """
    if len(initial) <= LONGEST_STATE:
        return None
    # The usage example first sets all coordinates to zero.
    entries = tuple((place, x) for place, x in enumerate(initial) if x)
    # If the result is empty, the usage example contains the comment IN_MANIFEST.
    return entries if len(entries) <= MOST_ENTRIES else ()


def entry(word: str, sentences: Sequence[str], width: int) -> list[str]:
    """Return the lines of one header entry. The word is in the left column, the sentences in the right."""
    indent = " " * 12
    lines: list[str] = []
    for number, sentence in enumerate(sentences):
        # The first sentence starts after ``word``, and the other sentences start in the same column.
        start = indent if number else f"{word + ':':<12}"
        lines += textwrap.wrap(
            sentence,
            width,
            initial_indent=start,
            subsequent_indent=indent,
            break_long_words=False,
            # A line break after a hyphen would damage a command in the header.
            break_on_hyphens=False,
        )
    return lines


def header(
    recipe: Recipe,
    layout: Sequence[str],
    counts: Sequence[str],
    width: int,
    stack: str = "",
    inputs: Sequence[str] = (),
) -> list[str]:
    """Return the lines of the header, without the usage example.

    ``layout`` describes the state. ``counts`` lists the operations of a step. ``stack`` is a sentence with a
    bound on the stack memory of a call. Lines are broken at ``width`` characters, but only between words. A
    quoted text in the command is one word.

    >>> header(Recipe("Step", (("method", "Lie-Euler"),), (1.0,)), ["m0: momentum"], ["2 mul a step"], 40)
    ['Step', '', 'method:     Lie-Euler', 'state:      m0: momentum', 'operations: 2 mul a step']
    """
    # An empty line follows the title, because Python tools read the first paragraph as a summary.
    lines = [*textwrap.wrap(recipe.title, width), ""]
    for word, sentence in recipe.facts:
        lines += entry(word, [sentence], width)
    lines += entry("state", layout, width)
    # If ``inputs`` or ``left_out`` is empty, the header has no such entry.
    lines += entry("inputs", inputs, width)
    lines += entry("left out", recipe.left_out, width)
    lines += entry("operations", counts, width)
    lines += entry("stack", [stack] if stack else [], width)
    # ``entry`` may replace a space by a line break. Inside a quoted file name, a line break would damage the
    # command, so the quoted spaces are replaced by "\0" during the call of ``entry``.
    command = re.sub(r"'[^']*'", lambda quoted: quoted[0].replace(" ", "\0"), recipe.command)
    lines += [line.replace("\0", " ") for line in entry("command", [command] if command else [], width)]
    lines += entry("version", [f"orderconds {recipe.version}"] if recipe.version else [], width)
    return lines
