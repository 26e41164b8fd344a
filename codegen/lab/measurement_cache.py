"""A cache on disk for the results of measurements.

Each result is stored in its own file. The key of a result contains the inputs of the measurement, the kind of
processor, and a digest of the program. CPU times depend on the kind of processor. If a file is damaged or
contains a wrong type, the measurement is made again.
"""

from __future__ import annotations

import hashlib
import os
import platform
import shutil
import stat
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import TypeVar

import codegen
import orderconds
from codegen.cache_entry import cache_directory, write_entries
from orderconds.input_file import MAX_WRITTEN_BYTES, content_of

T = TypeVar("T")

FORMAT = 1
"""The version of the file format. The names of the files depend on it."""

FOLDER = ".measured"
"""The name of the cache folder inside the output folder of a report."""

DIGEST = 32
"""The number of bytes of the SHA-256 digest at the start of each file of the cache."""


class MeasurementCache:
    """A cache of results in a folder, where each result has a key. A cache without a folder stores nothing.

    ``program`` identifies the program that computes the results. Results of other programs are not used. The
    default is :func:`program_digest`.

    >>> MeasurementCache(None).get(("a key",), int, lambda: 3)
    3
    """

    def __init__(self, folder: Path | None, program: str | None = None) -> None:
        self.folder, self.program = folder, program

    def get(self, key: Sequence[object], kind: type[T], measure: Callable[[], T]) -> T:
        """Return the stored result with the key ``key``, or call ``measure`` and store its result.

        A result (of type ``kind``) can consist of dataclasses, tuples, numbers and strings. The ``repr`` of a
        value in ``key`` must not differ between processes. Exceptions of ``measure`` are not caught. If the
        folder cannot be used, the result is not stored.
        """
        result = self.find(key, kind)
        if result is None:
            result = measure()
            self.store(key, result)
        return result

    def find(self, key: Sequence[object], kind: type[T]) -> T | None:
        """Return the stored result with the key ``key`` and the type ``kind``.

        Return None if no result is stored, if the file is damaged, or if the result has another type.
        """
        import msgspec

        if self.folder is None or not _secured(self.folder):
            return None
        try:
            content = content_of(self._path(self.folder, key), limit=MAX_WRITTEN_BYTES, own=True)
            digest, body = content[:DIGEST], content[DIGEST:]
            if hashlib.sha256(body).digest() != digest:
                return None
            return msgspec.msgpack.decode(body, type=kind)
        except (OSError, msgspec.DecodeError):  # A wrong type raises a subclass of DecodeError.
            return None

    def store(self, key: Sequence[object], result: object) -> None:
        """Store a result. Do nothing if the folder belongs to another user or cannot be written to."""
        import msgspec

        if self.folder is None:
            return
        body = msgspec.msgpack.encode(result)
        try:
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            if not _secured(self.folder):
                return
            write_entries({self._path(self.folder, key): hashlib.sha256(body).digest() + body})
        except OSError:
            return

    def remove(self) -> None:
        """Delete the folder with all results. Symbolic links, and folders of other users, are not deleted."""
        if self.folder is not None and _secured(self.folder):
            shutil.rmtree(self.folder, ignore_errors=True)

    def _path(self, folder: Path, key: Sequence[object]) -> Path:
        program = program_digest() if self.program is None else self.program
        text = repr((FORMAT, platform.machine(), program, *key))
        return folder / hashlib.sha256(text.encode()).hexdigest()[:32]


def user_cache() -> MeasurementCache:
    """Return the cache in the user's cache folder (:func:`codegen.cache_entry.cache_directory`).

    It contains only reference solutions. Their keys contain a digest of the modules that compute them
    (:mod:`codegen.lab.reference`), so they remain valid if other modules change.
    """
    return MeasurementCache(cache_directory() / "measurements", program="")


@cache
def program_digest() -> str:
    """Return a digest of the modules, templates and data of ``codegen`` and ``orderconds``."""
    packages = (Path(str(package.__file__)).parent for package in (codegen, orderconds))
    return files_digest(p for package in packages for p in sorted(package.rglob("*")) if p.suffix != ".pyc")


def files_digest(files: Iterable[Path]) -> str:
    """Return a digest of the contents of the regular files in ``files``."""
    contents = (hashlib.sha256(path.read_bytes()).digest() for path in files if path.is_file())
    return hashlib.sha256(b"".join(contents)).hexdigest()


def _secured(folder: Path) -> bool:
    """Set the access mode of ``folder`` to 0700 (owner only), and return True on success.

    A symbolic link or a folder of another user is not changed.
    """
    try:
        status = os.lstat(folder)
        if not stat.S_ISDIR(status.st_mode) or (hasattr(os, "getuid") and status.st_uid != os.getuid()):
            return False
        if stat.S_IMODE(status.st_mode) != 0o700:
            os.chmod(folder, 0o700)
    except OSError:
        return False
    return True
