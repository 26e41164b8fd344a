"""Write and check the folder ``generated/``, which contains the modules that ``regenerate.toml`` lists."""

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
    """One entry of ``regenerate.toml``: a scene, a method, and the target languages."""

    scene: str
    method: str
    targets: tuple[str, ...]

    def emissions(self) -> list[Artifact]:
        """Compile the method for the scene, and return one emitted module for each target."""
        compiled = compile_method(self.scene, self.method)
        named = {"scene": self.scene, "method": self.method}
        return [emit_compiled(compiled, target, "", named) for target in self.targets]


def entries(path: Path = LIST) -> list[Entry]:
    """Return the entries of ``regenerate.toml``. InputError is raised for an entry that cannot be read.

    A file without entries is an error, because :func:`write` would then remove all emitted files.
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
    """Return the entry for one table of ``regenerate.toml``.

    InputError is raised if the keys of the table, or the types of its values, are wrong.
    """
    if not isinstance(module, dict) or sorted(module) != sorted(KEYS):
        keys = ", ".join(sorted(module)) if isinstance(module, dict) else repr(module)
        raise InputError(
            f"the keys of the module are: {keys}", where=where, expected=f"the keys {', '.join(KEYS)}"
        )
    scene, method, targets = (module[key] for key in KEYS)
    texts = [scene, method, *(targets if isinstance(targets, list) else [None])]
    if not all(isinstance(text, str) for text in texts):
        raise InputError(
            f"the values of scene, method and targets are: {scene!r}, {method!r}, {targets!r}",
            where=where,
            expected="two strings and a list of strings",
        )
    return Entry(scene, method, tuple(targets))


def contents(listed: list[Entry]) -> dict[str, str]:
    """Return the files that the folder ``generated/`` should contain, including the manifests.

    Each key of the result is the path of a file, relative to the folder.
    """
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
    """One difference between the folder and the expected files.

    ``kind`` is one of these words:

    - ``missing``: the folder does not contain this expected file.
    - ``different``: this expected file has a different content in the folder.
    - ``stale``: the file was emitted earlier, but it is no longer expected.
    - ``unknown``: no manifest lists this file, and :func:`write` does not remove it.
    """

    path: str
    kind: str


def compare(directory: Path, files: dict[str, str]) -> list[Difference]:
    """Return the differences between a folder and the expected files, sorted by path.

    ``files`` maps the path of each expected file to its text.
    """
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
    """Return the paths of all manifests in the folder, and of all files that these manifests list."""
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
    """Write the expected files and remove stale files. Return the differences found before these changes."""
    changed = compare(directory, files)
    # The manifests are written last. If the writing is interrupted, the old manifests still list the stale
    # files. Therefore the next call finds and removes these files.
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
