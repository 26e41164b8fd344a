"""Neighbours of a scene file: modules in the same folder that the scene may import.

A neighbour with the name of a module of the standard library or of an installed package is ignored. All other
neighbours take precedence over other modules of the same name. The neighbours are removed after the scene has
been loaded. A scene in another folder can therefore import its own neighbour of the same name.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import invalidate_caches
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType

OWN = frozenset({"codegen", "orderconds"})
"""The packages of this program. Modules with these names in the folder of a scene are ignored."""


class Neighbours(MetaPathFinder):
    """Finds the modules and packages of one folder."""

    def __init__(self, folder: Path, names: frozenset[str]) -> None:
        self.folder, self.names = folder, names

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the import specification of a module in the folder; None if ``fullname`` is no neighbour."""
        if path is not None or fullname not in self.names:
            return None
        return PathFinder.find_spec(fullname, [str(self.folder)], target)


@contextmanager
def neighbours_of(file: Path) -> Iterator[None]:
    """Return a context manager; in its block, imports find the neighbours of a scene file. At the end of the
    block the neighbours are removed from ``sys.modules``.
    """
    folder = file.resolve().parent
    names = frozenset(name for name in _modules(folder) if not _installed(name))
    hidden = _taken(names)
    finder, cached = Neighbours(folder, names), sys.dont_write_bytecode
    sys.meta_path.insert(0, finder)
    # No bytecode is written, because the folder belongs to the user. Moreover, bytecode could be out of date:
    # Python does not notice a second change of the source within one second.
    sys.dont_write_bytecode = True
    invalidate_caches()
    try:
        yield
    finally:
        sys.dont_write_bytecode = cached
        sys.meta_path.remove(finder)
        _taken(names)
        sys.modules.update(hidden)


def _modules(folder: Path) -> Iterator[str]:
    """Yield the names of the modules and packages in a folder."""
    for path in sorted(folder.iterdir()):
        if path.suffix == ".py" and path.stem.isidentifier():
            yield path.stem
        elif path.name.isidentifier() and (path / "__init__.py").is_file():
            yield path.name


def _installed(name: str) -> bool:
    """Return True if a name is a module of this program, of the standard library or of an installed
    package.
    """
    if name in OWN or name in sys.stdlib_module_names:
        return True
    places = [p for p in sys.path if Path(p).name in ("site-packages", "dist-packages")]
    return PathFinder.find_spec(name, places) is not None


def _taken(names: frozenset[str]) -> dict[str, ModuleType]:
    """Remove the modules with these names, and their submodules, from ``sys.modules``. Return a dictionary
    from names to the removed modules."""
    loaded = [name for name in sys.modules if name.partition(".")[0] in names]
    return {name: sys.modules.pop(name) for name in loaded}
