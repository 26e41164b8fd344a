"""Neighbours of a scene file: modules in the same folder that the scene may import.

A neighbour is ignored if the standard library or an installed package has a module of the same name. A
scene in another folder may have a different neighbour of the same name. Therefore the neighbours are removed
from ``sys.modules`` after the scene has been loaded.
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
"""The packages of this program. A module with one of these names in the folder of a scene is ignored."""


class Neighbours(MetaPathFinder):
    """An import hook that finds modules in ``folder``. ``names`` contains the names of these modules."""

    def __init__(self, folder: Path, names: frozenset[str]) -> None:
        self.folder, self.names = folder, names

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the import specification of the module ``fullname``. If the module is not in ``self.names``,
        return None."""
        if path is not None or fullname not in self.names:
            return None
        return PathFinder.find_spec(fullname, [str(self.folder)], target)


@contextmanager
def neighbours_of(file: Path) -> Iterator[None]:
    """Make the neighbours of a scene file importable within a ``with`` block.

    The neighbours are the modules in the folder of the scene file. At the end of the block, the neighbours
    are removed from ``sys.modules``.
    """
    folder = file.resolve().parent
    names = frozenset(name for name in _modules(folder) if not _installed(name))
    hidden = _taken(names)
    finder, cached = Neighbours(folder, names), sys.dont_write_bytecode
    sys.meta_path.insert(0, finder)
    # Python must not write bytecode into the user's folder.
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
    if name in OWN or name in sys.stdlib_module_names:
        return True
    places = [p for p in sys.path if Path(p).name in ("site-packages", "dist-packages")]
    return PathFinder.find_spec(name, places) is not None


def _taken(names: frozenset[str]) -> dict[str, ModuleType]:
    """Remove the given modules and their submodules from ``sys.modules``, and return them by name."""
    loaded = [name for name in sys.modules if name.partition(".")[0] in names]
    return {name: sys.modules.pop(name) for name in loaded}
