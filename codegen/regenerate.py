"""The folder ``generated/``: it contains exactly the modules that ``regenerate.toml`` lists."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

from codegen.artifact import MANIFEST, Artifact, entries_of, manifest_text, write_text, writing
from codegen.emitter import compile_method, emit_compiled
from orderconds.errors import InputError
from orderconds.input_file import content_of, read_text, reason
from orderconds.output_file import is_temporary

LIST = Path(__file__).with_name("regenerate.toml")
KEYS = ("scene", "method", "targets")


@dataclass(frozen=True)
class Entry:
    """One entry of ``regenerate.toml``: a method on a scene, and its targets."""

    scene: str
    method: str
    targets: tuple[str, ...]

    def emissions(self) -> list[Artifact]:
        """Emit the method of this entry on its scene for each target, and return the emitted modules."""
        compiled = compile_method(self.scene, self.method)
        named = {"scene": self.scene, "method": self.method}
        return [emit_compiled(compiled, target, "", named) for target in self.targets]


def entries(path: Path = LIST) -> list[Entry]:
    """Return the entries of ``regenerate.toml``. InputError is raised for an entry that cannot be read.

    A list without modules is an error, because it would remove every file of ``generated/``.
    """
    text = read_text(path, "a list of modules")
    try:
        data = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"the file is not valid TOML: {error}", where=str(path)) from None
    modules = data.get("module", [])
    if set(data) != {"module"} or not isinstance(modules, list) or not modules:
        keys = ", ".join(data) or "none"
        raise InputError(
            f"the file is not a list of modules; its keys are: {keys}",
            where=str(path),
            expected="tables [[module]] only",
        )
    return [_entry(module, f"{path}: module {number}") for number, module in enumerate(modules, start=1)]


def _entry(module: object, where: str) -> Entry:
    """Return one entry of the list; raise InputError if its keys or the types of its values are wrong."""
    if not isinstance(module, dict) or sorted(module) != sorted(KEYS):
        keys = ", ".join(sorted(module)) if isinstance(module, dict) else repr(module)
        raise InputError(
            f"the keys of the module are: {keys}", where=where, expected=f"the keys {', '.join(KEYS)}"
        )
    scene, method, targets = (module[key] for key in KEYS)
    texts = [scene, method, *(targets if isinstance(targets, list) else [None])]
    if not all(isinstance(text, str) for text in texts):
        raise InputError(
            f"the values of the module are: {scene!r}, {method!r}, {targets!r}",
            where=where,
            expected="two strings and a list of strings",
        )
    return Entry(scene, method, tuple(targets))


def contents(listed: list[Entry]) -> dict[str, str]:
    """Return the expected files of the folder with their manifests, by path relative to the folder."""
    files: dict[str, str] = {}
    manifests: dict[str, list[dict[str, object]]] = {}
    for entry in listed:
        for artifact in entry.emissions():
            folder = Path(entry.scene).stem
            manifests.setdefault(folder, []).append(dict(artifact.manifest))
            for name, text in artifact.files.items():
                if files.setdefault(f"{folder}/{name}", text) != text:
                    raise InputError(
                        f"two modules emit the file {name} with different contents", where=str(LIST)
                    )
    for folder, manifest in manifests.items():
        files[f"{folder}/{MANIFEST}"] = manifest_text(manifest)
    return dict(sorted(files.items()))


@dataclass(frozen=True)
class Difference:
    """A path at which the folder differs from the listed modules, and the kind of difference.

    ``kind`` is ``missing``, ``different``, ``stale`` (emitted, but not by a listed module) or ``unknown``
    (never emitted). An unknown file must not be removed.
    """

    path: str
    kind: str


def compare(directory: Path, files: dict[str, str]) -> list[Difference]:
    """Return the differences between the folder and the expected files, sorted by path."""
    there = {p.relative_to(directory).as_posix() for p in directory.rglob("*") if p.is_file()}
    ours = emitted(directory)
    extra = [path for path in sorted(there - files.keys()) if not ignored(path)]
    differences = [Difference(path, "stale" if path in ours else "unknown") for path in extra]
    for path, text in files.items():
        if path not in there:
            differences.append(Difference(path, "missing"))
        elif not _holds(directory / path, text.encode()):
            differences.append(Difference(path, "different"))
    return sorted(differences, key=lambda d: d.path)


def _holds(path: Path, content: bytes) -> bool:
    try:
        return content_of(path, limit=len(content)) == content
    except OSError:  # an unreadable file, or a file larger than the limit, counts as different
        return False


def emitted(directory: Path) -> set[str]:
    """Return the paths of emitted files according to the manifests, including the manifests."""
    paths: set[str] = set()
    for manifest in directory.glob(f"*/{MANIFEST}"):
        folder = manifest.parent.name
        names = [name for entry in entries_of(manifest.parent) for name in entry["files"]]
        paths.update(f"{folder}/{name}" for name in (*names, MANIFEST))
    return paths


def ignored(path: str) -> bool:
    """Return True for a file that Python creates beside an emitted module, and for a temporary file."""
    return "__pycache__" in path.split("/") or is_temporary(path.rpartition("/")[2])


def write(directory: Path, files: dict[str, str]) -> list[Difference]:
    """Write the files, remove stale files, and return the differences that existed before writing."""
    changed = compare(directory, files)
    # Manifests are written last. Until then ``emitted`` finds the emitted files in the old manifests.
    last = sorted(changed, key=lambda d: (d.path.endswith(MANIFEST), d.path))
    try:
        for difference in last:
            path = directory / difference.path
            if difference.kind == "stale":
                path.unlink(missing_ok=True)
            elif difference.kind != "unknown":
                path.parent.mkdir(parents=True, exist_ok=True)
                with writing(path.parent):
                    write_text(path, files[difference.path])
    except OSError as error:
        raise InputError(f"cannot write to this path: {reason(error)}", where=str(directory)) from None
    return changed
