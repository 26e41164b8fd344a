"""Functions that find the tableau files of the library."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from orderconds.errors import UnknownName

_PACKAGE = Path(__file__).resolve().parents[1]


@cache
def root() -> Path:
    """Return the folder of tableau files: ``tableaux`` in the source tree, or its copy in an installed
    package.

    >>> root().is_dir()
    True
    """
    beside = _PACKAGE.parent / "pyproject.toml"
    if beside.is_file() and 'name = "orderconds"' in beside.read_text(encoding="utf-8").splitlines():
        return _PACKAGE.parent / "tableaux"
    return _PACKAGE / "_tableaux"


@cache
def _files() -> dict[str, Path]:
    return {path.stem: path for path in sorted(root().rglob("*.toml"), key=lambda p: p.stem)}


def available() -> tuple[str, ...]:
    """Return the sorted names of all tableaux. The name of a tableau is the name of its file without the
    suffix ``.toml``.

    >>> "gauss2" in available()
    True
    """
    return tuple(_files())


def find(name: str) -> Path:
    """Return the file of the tableau ``name``. If there is no such tableau, raise :class:`UnknownName` with
    similar names in the message.

    >>> find("gauss2").name
    'gauss2.toml'
    """
    if name in _files():
        return _files()[name]
    from difflib import get_close_matches

    near = get_close_matches(name, available(), n=3)
    hint = f"did you mean {', '.join(near)}?" if near else "`orderconds list tableaux` shows all tableaux"
    raise UnknownName(f"no tableau {name!r}", expected="a tableau of the library or a file", hint=hint)


def bibliography() -> Path:
    """Return the BibTeX file with the sources of the tableaux.

    >>> bibliography().name
    'sources.bib'
    """
    return root() / "sources.bib"
