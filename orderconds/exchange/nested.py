"""Nested arrays in source text, such as ``{{1, 2}, {3, 4}}``. The source is not executed."""

from __future__ import annotations

from typing import TypeAlias

from orderconds.errors import TableauError

Cells: TypeAlias = "str | list[Cells]"
"""The text of one cell, or a list of cells."""

MAX_DEPTH = 3


def nested(text: str, opening: str, closing: str, where: str) -> Cells:
    """Return the cells of a nested array in source text.

    Commas separate the cells, except within parentheses.

    >>> nested("[[1, Rational(1, 2)], [3, 4]]", "[", "]", "x")
    [['1', 'Rational(1, 2)'], ['3', '4']]
    """
    stack: list[list[Cells]] = [[]]
    cell, parentheses = "", 0
    for character in text:
        if character == opening and not parentheses:
            if len(stack) > MAX_DEPTH:
                raise TableauError("brackets nested too deep", where=where, expected="rows of numbers")
            stack.append([])
        elif character in (closing, ",") and not parentheses:
            if cell.strip():
                stack[-1].append(cell.strip())
            cell = ""
            if character == closing:
                if len(stack) == 1:
                    raise TableauError(
                        f"{closing!r} without {opening!r}", where=where, expected="rows of numbers"
                    )
                finished = stack.pop()
                stack[-1].append(finished)
        else:
            parentheses += (character == "(") - (character == ")")
            cell += character
    if len(stack) != 1 or len(stack[0]) != 1 or cell.strip():
        raise TableauError(
            f"brackets that do not match in {text[:40]!r}", where=where, expected="rows of numbers"
        )
    return stack[0][0]
