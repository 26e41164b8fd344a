"""Text of C: lines that are filled, comments that end where they should, nested calls."""

from __future__ import annotations

from collections.abc import Sequence

WIDTH = 100


def paired(terms: list[str]) -> tuple[str, ...]:
    """Spell a sum of terms, added in pairs and then left to right, for lines to break between.

    >>> paired(["a", "b", "c"])
    ('(a + b)', '+ c')
    """
    if len(terms) < 3:
        return (terms[0], *(f"+ {x}" for x in terms[1:]))
    pairs = [terms[k : k + 2] for k in range(0, len(terms), 2)]
    texts = [f"({x[0]} + {x[1]})" if len(x) == 2 else x[0] for x in pairs]
    return (texts[0], *(f"+ {x}" for x in texts[1:]))


def greatest(terms: list[str]) -> str:
    """Spell the greatest of some terms as a balanced tree of two-argument calls."""
    if len(terms) == 1:
        return terms[0]
    middle = len(terms) // 2
    return f"greater({greatest(terms[:middle])}, {greatest(terms[middle:])})"


def comment(text: str) -> str:
    """Return text that cannot end the C comment it stands in."""
    return text.replace("*/", "* /").replace("/*", "/ *")


def broken(text: str) -> tuple[str, ...]:
    """Cut nested calls after their commas."""
    return tuple(text.replace(", ", ",|").split("|"))


def fill(start: str, pieces: tuple[str, ...], end: str, width: int = WIDTH, joint: str = " ") -> list[str]:
    """Join start, pieces and end with spaces, breaking lines before pieces that do not fit.

    ``joint`` stands between start and the first piece.

    >>> fill("x =", ("a", "+ b", "+ c"), ";", width=18)
    ['x = a + b', '    + c;']
    """
    lines = [start]
    for position, piece in enumerate(pieces):
        tail = end if position == len(pieces) - 1 else ""
        if position and len(lines[-1]) + 1 + len(piece) + len(tail) > width - 8:
            lines.append(f"    {piece}{tail}")
        else:
            lines[-1] += f"{' ' if position else joint}{piece}{tail}"
    return lines


def together(statements: Sequence[str], width: int = WIDTH) -> list[str]:
    """Return lines of as many short statements as there is room for.

    >>> together(["a = 1;", "b = 2;", "c = 3;"], width=22)
    ['a = 1; b = 2;', 'c = 3;']
    """
    lines: list[str] = []
    for statement in statements:
        if lines and len(lines[-1]) + 1 + len(statement) <= width - 8:
            lines[-1] += f" {statement}"
        else:
            lines.append(statement)
    return lines
