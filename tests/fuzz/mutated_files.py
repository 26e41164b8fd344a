"""Mutated tableau files in every format, drawn by seeds.

Pieces of one file are deleted, doubled, exchanged, put into another one, or replaced by hostile text.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from random import Random

from orderconds.errors import InputError
from orderconds.exchange import FORMATS, export, read_data
from orderconds.tableau.file_format import Data
from orderconds.tableau.library import available, find

HOSTILE = (
    b"\x00",
    b"\xff\xfe",
    b"\xe2\x80\xae",
    b"\r",
    b"\n",
    b"1e999",
    b"nan",
    b"inf",
    b"-0",
    b"1/0",
    b"~",
    b"0.1~",
    b"[",
    b"]" * 9,
    b"{" * 50,
    b"(" * 60,
    b"\\",
    b"\\\\",
    b"*/",
    b"/*",
    b"#",
    b"%",
    b'"""',
    b"'",
    b"sqrt(",
    b"^",
    b"9" * 400,
    b"0." + b"3" * 300,
    b"a." * 40,
    b"lambda",
    b"__import__('os')",
    b"x^64^64",
    b"2^(1/24)",
    b",,,",
    b"\\begin{pmatrix}",
    b"\\end{array}",
    b"&",
    b"A = [",
    b"proof",
    b"order = 99",
    b"2000-01-01",
    b"true",
    b"1.5",
)
"""Pieces that have a meaning in one of the formats, or none in any."""


@cache
def library() -> tuple[Data, ...]:
    """Return the small files of the library as keys and values."""
    found = []
    for name in available():
        content = Path(find(name)).read_bytes()
        if len(content) < 3000:
            found.append(read_data(content, "toml", name))
    return tuple(found)


@cache
def written(place: int, to: str) -> bytes | None:
    """Return a file of the library in a format, None where that cannot hold it."""
    try:
        return export(library()[place], to)
    except InputError:
        return None


def mutated(content: bytes, other: bytes, generator: Random) -> bytes:
    for _ in range(generator.choice((1, 1, 1, 2, 3, 8))):
        start, end = sorted(generator.randrange(len(content) + 1) for _ in range(2))
        end = min(end, start + generator.choice((1, 3, 20, 400)))
        piece = content[start:end]
        replaced = generator.choice(
            (
                b"",
                piece * 2,
                piece[::-1],
                piece * generator.choice((1, 50)),
                generator.choice(HOSTILE),
                bytes(generator.randrange(256) for _ in range(3)),
                other[start:end],
                piece.swapcase(),
            )
        )
        content = content[:start] + replaced + content[end:]
    return content


def drawn(seed: int) -> tuple[str, bytes]:
    """Return a format and a mutated file."""
    generator = Random(seed)
    of = generator.choice(sorted(FORMATS))
    content = None
    while content is None:
        content = written(generator.randrange(len(library())), of)
    other = written(generator.randrange(len(library())), generator.choice(sorted(FORMATS))) or b""
    return of, mutated(content, other, generator)
