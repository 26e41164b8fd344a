"""Formats Python source text and breaks long lines."""

from __future__ import annotations

import json
from collections.abc import Sequence

WIDTH = 88


def quoted(text: str) -> str:
    """Return ``text`` as a Python string literal in double quotes."""
    # A JSON string is also a Python literal, and always has double quotes.
    return json.dumps(text, ensure_ascii=False)


def filled(start: str, terms: Sequence[str], end: str, depth: int) -> list[str]:
    """Return ``start``, the ``terms`` separated by commas, and ``end``, on one line if possible.

    If this line is too long, ``start`` and ``end`` have lines of their own, and the terms are on the lines
    between them.

    >>> filled("x = f(", ["a" * 42, "b" * 42, "c"], ")", 0)[2]
    '    bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb, c,'
    """
    space = "    " * depth
    line = f"{space}{start}{', '.join(terms)}{end}"
    if len(line) <= WIDTH:
        return [line]
    # Python allows a comma after the last term.
    return [f"{space}{start}", *packed([f"{term}," for term in terms], depth + 1), f"{space}{end}"]


def packed(segments: Sequence[str], depth: int) -> list[str]:
    """Return indented lines that contain the segments, separated by spaces.

    Only a line with a single segment may have more than :data:`WIDTH` characters.
    """
    space = "    " * depth
    lines = [f"{space}{segments[0]}"]
    for segment in segments[1:]:
        # A segment that does not fit on the current line starts a new line.
        if len(lines[-1]) + 1 + len(segment) > WIDTH:
            lines.append(f"{space}{segment}")
        else:
            lines[-1] += f" {segment}"
    return lines


def indented(start: str, segments: tuple[str, ...], depth: int) -> list[str]:
    """Return ``start`` and ``segments`` on one line if possible.

    If this line is too long, the segments are in parentheses on several lines.

    >>> indented("x = ", ("a", "+ b"), 1)
    ['    x = a + b']
    """
    space = "    " * depth
    line = f"{space}{start}{' '.join(segments)}"
    # A line with a single segment cannot be broken.
    if len(line) <= WIDTH or len(segments) == 1:
        return [line]
    return [f"{space}{start}(", *packed(segments, depth + 1), f"{space})"]


def listed(start: str, terms: Sequence[str], depth: int) -> list[str]:
    """Return ``start`` and a tuple of terms on one line if possible.

    If this line is too long, the terms are in parentheses on several lines.
    """
    space = "    " * depth
    # In Python, a tuple with a single term needs a comma after the term.
    line = f"{space}{start}{', '.join(terms)}{',' if len(terms) == 1 else ''}"
    if len(line) <= WIDTH:
        return [line]
    # Parentheses allow the tuple to continue on the next line.
    return filled(f"{start}(", terms, ")", depth)


def unpacked(names: Sequence[str], value: str, depth: int) -> list[str]:
    """Return the lines of the assignment that unpacks the list ``value`` into ``names``."""
    lines = listed("", names, depth)
    # If the names do not fit on one line, they are printed in parentheses.
    if len(lines) == 1 and len(f"{lines[0]} = {value}") <= WIDTH:
        return [f"{lines[0]} = {value}"]
    return filled("(", names, f") = {value}", depth)
