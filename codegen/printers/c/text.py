"""Formats C source text: line breaks, comments and nested calls."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from codegen.printers.infix import closed

WIDTH = 100


def greatest(terms: list[str], name: str = "greater") -> tuple[str, ...]:
    """Return code for the maximum of the expressions ``terms``: a balanced tree of calls ``name(x, y)``. The
    code is divided into segments. A line may break between two segments.

    >>> greatest(["a", "b", "c"])
    ('greater(a,', 'greater(b,', 'c))')
    """
    if len(terms) == 1:
        return (terms[0],)
    # In a balanced tree, comparisons in different branches are independent, so a processor can execute them
    # in parallel.
    middle = len(terms) // 2
    first, second = greatest(terms[:middle], name), greatest(terms[middle:], name)
    return (*closed(f"{name}(", first, ","), *closed("", second, ")"))


def closed_call(name: str, arguments: list[str]) -> tuple[str, ...]:
    """Return the text of a function call as segments. A line may break between two segments.

    >>> closed_call("f", ["a", "b"])
    ('f(a,', 'b)')
    """
    # Each comma belongs to the segment before it, so no line begins with a comma.
    segments = [f"{x}," for x in arguments[:-1]] + [f"{x})" for x in arguments[-1:]]
    return (f"{name}({segments[0]}", *segments[1:]) if segments else (f"{name}()",)


def comment(text: str) -> str:
    """Return ``text`` with ``*/`` replaced by ``* /``, and ``/*`` by ``/ *``, for use in a C comment."""
    # ``*/`` would end the comment. Compilers warn about ``/*`` inside a comment.
    return text.replace("*/", "* /").replace("/*", "/ *")


def block_comment(text: str) -> list[str]:
    """Return the lines of a C comment that contains ``text``. The list is empty if ``text`` is empty."""
    safe = comment(text)
    # Words are never broken, because users copy shell commands from the text.
    lines = wrap(safe, WIDTH, break_long_words=False, break_on_hyphens=False)
    if len(lines) < 2:
        return [f"/* {line} */" for line in lines]
    return ["/*", *(f" * {line}" for line in lines), " */"]


def fill(
    start: str, segments: tuple[str, ...], end: str, width: int = WIDTH, separator: str = " "
) -> list[str]:
    """Return a statement (``start``, then the segments, then ``end``) as lines.

    ``separator`` is the text between ``start`` and the first segment. If possible, a line has at most
    ``width`` - 8 characters, because the caller indents the lines.

    >>> fill("x =", ("a", "+ b", "+ c"), ";", width=18)
    ['x = a + b', '    + c;']
    """
    lines = [start]
    for position, segment in enumerate(segments):
        # The line with the last segment must also have space for ``end``.
        tail = end if position == len(segments) - 1 else ""
        # The caller indents the lines later, so 8 characters of the width stay free.
        if position and len(lines[-1]) + 1 + len(segment) + len(tail) > width - 8:
            lines.append(f"    {segment}{tail}")
        else:
            lines[-1] += f"{' ' if position else separator}{segment}{tail}"
    return lines


def together(statements: Sequence[str], width: int = WIDTH) -> list[str]:
    """Return the statements as lines, with as many statements on each line as fit.

    A line with several statements has at most ``width`` - 8 characters.

    >>> together(["a = 1;", "b = 2;", "c = 3;"], width=22)
    ['a = 1; b = 2;', 'c = 3;']
    """
    lines: list[str] = []
    for statement in statements:
        # The caller indents the lines later, so 8 characters of the width stay free.
        if lines and len(lines[-1]) + 1 + len(statement) <= width - 8:
            lines[-1] += f" {statement}"
        else:
            lines.append(statement)
    return lines
