"""Emitted modules: their files, and the manifest of a folder.

The file ``manifest.json`` has an entry for each module and target. An entry contains the digests of the files
of the module. If a process is killed before the manifest is complete, the digests can be wrong.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from codegen.folder_lock import locked
from orderconds.errors import InputError
from orderconds.input_file import MAX_WRITTEN_BYTES, content_of, reason
from orderconds.output_file import is_temporary, write_files

MANIFEST = "manifest.json"


@dataclass(frozen=True, repr=False)
class Artifact:
    """An emitted module in one target language.

    ``files`` maps the name of each file to its text. ``manifest`` is the entry of the module in
    ``manifest.json``.
    """

    files: Mapping[str, str]
    manifest: Mapping[str, Any]

    def __repr__(self) -> str:
        return f"<emitted {self.key[0]}, target {self.key[1]}: {', '.join(sorted(self.files))}>"

    @property
    def key(self) -> tuple[str, str]:
        """The module name and the target language."""
        return self.manifest["module"], self.manifest["target"]

    def write(self, directory: str | Path) -> list[Path]:
        """Write the files and the manifest into a folder, and return their paths.

        An old module of the same name and target is replaced.

        InputError is raised in two cases:
        - The folder cannot be written to.
        - The old module belongs to another scene or method, and neither module was emitted with ``--prefix``.
        """
        folder = Path(directory)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with writing(folder):
                entries = entries_of(folder)
                for entry in entries:
                    self._refuse_clash(entry, folder)
                others = [e for e in entries if (e["module"], e["target"]) != self.key]
                texts = dict(self.files) | {MANIFEST: manifest_text([*others, dict(self.manifest)])}
                return write_texts({folder / name: text for name, text in texts.items()})
        except OSError as error:
            raise InputError(
                f"cannot write to this path: {reason(error)}",
                where=str(folder),
                expected="a folder that can be written to",
            ) from None

    def _refuse_clash(self, entry: Mapping[str, Any], folder: Path) -> None:
        """Raise InputError if ``entry`` has the name and target of this module, but another scene or method.

        If the option ``--prefix`` set the name of this module or of ``entry``, no error is raised.
        """
        mine, theirs = (tuple(x.get(key) for key in ("scene", "method")) for x in (self.manifest, entry))
        chosen = any("--prefix" in str(x.get("command", "")).split() for x in (self.manifest, entry))
        if (entry["module"], entry["target"]) == self.key and mine != theirs and not chosen:
            raise InputError(
                f"the folder contains a module {self.key[0]} for the method {theirs[1]} and the scene "
                f"{theirs[0]}, but the new module is for the method {mine[1]} and the scene {mine[0]}",
                where=str(folder),
                hint="choose another name with --prefix NAME, or another folder with -o DIR",
            )


@contextmanager
def writing(folder: Path) -> Iterator[None]:
    """Lock a folder for writing during a ``with`` block.

    Before the block begins, temporary files of killed processes are removed.
    """
    with locked(folder) as held:
        if held:  # without the lock, another process may be writing the temporary files
            for path in folder.iterdir():
                if is_temporary(path.name):
                    path.unlink(missing_ok=True)
        yield


def digest(text: str) -> str:
    """Return the SHA-256 digest of a text in UTF-8."""
    return hashlib.sha256(text.encode()).hexdigest()


def manifest_text(entries: list[dict[str, Any]]) -> str:
    """Return the text of a manifest.

    Entries and keys are sorted, so the text does not depend on the order in which the modules were written.
    """
    ordered = sorted(entries, key=lambda e: (e["module"], e["target"]))
    return json.dumps({"modules": ordered}, indent=2, sort_keys=True, ensure_ascii=False) + "\n"


def entries_of(folder: Path) -> list[dict[str, Any]]:
    """Return the entries of a folder's manifest, or an empty list if there is no manifest."""
    path = folder / MANIFEST
    try:
        entries = json.loads(content_of(path, limit=MAX_WRITTEN_BYTES))["modules"]
        if not all(map(_is_entry, entries)):
            raise KeyError("module")
    except FileNotFoundError:
        return []
    except OSError as problem:
        raise InputError(
            reason(problem), where=str(path), expected="a manifest written by orderconds emit"
        ) from None
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise InputError(
            "this file is not a manifest of emitted modules",
            where=str(path),
            expected="a manifest written by orderconds emit",
            hint="remove the file, then emit the modules again",
        ) from None
    return list(entries)


def _is_entry(entry: Mapping[str, Any]) -> bool:
    """Return True if a manifest entry is valid. KeyError is raised if a key is missing."""
    files = entry["files"]
    plain = [entry["module"], entry["target"], *files, *files.values()]
    return all(isinstance(x, str) for x in plain) and not any("/" in name or "\\" in name for name in files)


def read(directory: str | Path, module: str = "", target: str = "") -> Artifact:
    """Read a module from a folder.

    An empty ``module`` matches all names, and an empty ``target`` matches all target languages.

    InputError is raised if the number of matching modules is not one. InputError is also raised if a file of
    the module is missing, was changed, or cannot be read.
    """
    folder = Path(directory)
    try:
        with locked(folder, shared=True):
            return _read(folder, entries_of(folder), module, target)
    # If the folder cannot be locked, the module is read without a lock.
    except OSError:
        return _read(folder, entries_of(folder), module, target)


def _read(folder: Path, entries: list[dict[str, Any]], module: str, target: str) -> Artifact:
    chosen = [e for e in entries if module in ("", e["module"]) and target in ("", e["target"])]
    if len(chosen) != 1:
        known = ", ".join(f"{e['module']} ({e['target']})" for e in entries)
        raise InputError(
            f"{len(chosen)} modules match the name {module or '(any)'} and the target {target or '(any)'}",
            where=str(folder),
            expected=f"one of {known}" if known else "a folder written by orderconds emit",
        )
    files: dict[str, str] = {}
    for name, sha256 in chosen[0]["files"].items():
        try:
            content = content_of(folder / name, limit=MAX_WRITTEN_BYTES)
        except OSError as problem:
            missing = isinstance(problem, FileNotFoundError)
            what = "is missing" if missing else f"cannot be read ({reason(problem)})"
        else:
            files[name] = content.decode(errors="replace")
            what = "" if hashlib.sha256(content).hexdigest() == sha256 else "was changed after it was emitted"
        if what:
            hint = f"emit the module again: {chosen[0].get('command', 'orderconds emit')}"
            raise InputError(f"{name} {what}", where=str(folder), hint=hint)
    return Artifact(files, chosen[0])


def write_text(path: Path, text: str) -> Path:
    """Write a file atomically, and return its path."""
    return write_texts({path: text})[0]


def write_texts(texts: Mapping[Path, str]) -> list[Path]:
    """Write files, and return their paths. Each file is written atomically."""
    write_files({path: text.encode() for path, text in texts.items()})
    return list(texts)
