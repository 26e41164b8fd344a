"""An emitted module: its files and its manifest entry, and the folder they are written to and read from.

A folder's ``manifest.json`` lists its modules, one a (module, target). Files take their final names only
when they are whole, the manifest last, so that an interrupted write leaves the folder as it was or complete.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from orderconds.errors import InputError

MANIFEST = "manifest.json"


@dataclass(frozen=True)
class Artifact:
    """One module in one target: ``files`` maps names to texts, ``manifest`` is its entry in the folder's."""

    files: Mapping[str, str]
    manifest: Mapping[str, Any]

    @property
    def key(self) -> tuple[str, str]:
        """Module name and target."""
        return self.manifest["module"], self.manifest["target"]

    def write(self, directory: str | Path) -> list[Path]:
        """Write files and manifest into a folder, made where missing; return their paths.

        Other modules of the folder stay. An InputError where the folder cannot be written to.
        """
        folder = Path(directory)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            entries = [e for e in entries_of(folder) if (e["module"], e["target"]) != self.key]
            texts = dict(self.files) | {MANIFEST: manifest_text([*entries, dict(self.manifest)])}
            return write_texts({folder / name: text for name, text in texts.items()})
        except OSError as error:
            raise InputError(
                f"cannot write there: {error.strerror}",
                where=str(folder),
                expected="a folder that can be written to",
            ) from None


def digest(text: str) -> str:
    """Return the sha256 of a text's bytes."""
    return hashlib.sha256(text.encode()).hexdigest()


def manifest_text(entries: list[dict[str, Any]]) -> str:
    """Return the manifest of some modules: sorted, and the same bytes for the same modules."""
    ordered = sorted(entries, key=lambda e: (e["module"], e["target"]))
    return json.dumps({"modules": ordered}, indent=2, sort_keys=True, ensure_ascii=False) + "\n"


def entries_of(folder: Path) -> list[dict[str, Any]]:
    """Return the entries of a folder's manifest, none where there is no manifest."""
    path = folder / MANIFEST
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))["modules"]
        if not all({"module", "target", "files"} <= entry.keys() for entry in entries):
            raise KeyError("module")
    except FileNotFoundError:
        return []
    except OSError as problem:
        reason = (problem.strerror or "unreadable").lower()
        raise InputError(reason, where=str(path), expected="the file that emit wrote") from None
    except (ValueError, KeyError, TypeError, AttributeError):
        raise InputError(
            "this is not a manifest", where=str(path), expected="the file that emit wrote", hint="remove it"
        ) from None
    return list(entries)


def read(directory: str | Path, module: str = "", target: str = "") -> Artifact:
    """Return a module from a folder; ``module`` and ``target`` choose where the folder holds several.

    InputError: no such module, more than one, a file that is missing or not as it was emitted.
    """
    folder = Path(directory)
    entries = entries_of(folder)
    found = [e for e in entries if module in ("", e["module"]) and target in ("", e["target"])]
    if len(found) != 1:
        known = ", ".join(f"{e['module']} ({e['target']})" for e in entries)
        raise InputError(
            f"{len(found)} modules answer to {module or 'any name'} ({target or 'any target'})",
            where=str(folder),
            expected=f"one of {known}" if known else "a folder that emit wrote",
        )
    files: dict[str, str] = {}
    for name, sha256 in found[0]["files"].items():
        path = folder / name
        files[name] = path.read_text(encoding="utf-8") if path.is_file() else ""
        if digest(files[name]) != sha256:
            what = "was changed" if path.is_file() else "is missing"
            raise InputError(
                f"{name} {what} since it was emitted", where=str(folder), hint=f"type: {found[0]['command']}"
            )
    return Artifact(files, found[0])


def write_text(path: Path, text: str) -> Path:
    """Write a file under a temporary name, then give it its own; return its path."""
    return write_texts({path: text})[0]


def write_texts(texts: Mapping[Path, str]) -> list[Path]:
    """Write files under temporary names, and when all are written give them their own; return their paths."""
    written: dict[Path, str] = {}
    try:
        for path, text in texts.items():
            handle, written[path] = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
            with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as stream:
                stream.write(text)
            os.chmod(written[path], 0o666 & ~_umask())
        for path, temporary in written.items():
            os.replace(temporary, path)
    except BaseException:
        for temporary in written.values():
            Path(temporary).unlink(missing_ok=True)
        raise
    return list(texts)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
