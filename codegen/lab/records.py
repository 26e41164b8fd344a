"""Measurements kept while a report is made, so that an interrupted one goes on where it stopped.

One file a measurement, named by a digest of everything that it depends on, in a hidden folder beside the
pages. The folder goes when all pages are complete: times of another day are not those of the machine now.
"""

from __future__ import annotations

import hashlib
import platform
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

T = TypeVar("T")

FOLDER = ".measured"


class Records:
    """Measurements by key, in a folder; None keeps nothing.

    >>> Records(None).of(("a key",), int, lambda: 3)
    3
    """

    def __init__(self, folder: Path | None) -> None:
        self.folder = folder

    def of(self, key: tuple[object, ...], kind: type[T], measure: Callable[[], T]) -> T:
        """Return the measurement of a key: the one on record, else what ``measure`` returns, put on record.

        ``kind`` is its type, built of dataclasses, tuples and plain values. A file that was cut off, or is of
        another version, is as good as none.
        """
        if self.folder is None:
            return measure()
        import msgspec

        path = self.folder / hashlib.sha256(repr((*key, platform.machine())).encode()).hexdigest()[:32]
        try:
            return msgspec.msgpack.decode(path.read_bytes(), type=kind)
        except (OSError, msgspec.DecodeError):  # a ValidationError is a DecodeError
            pass
        found = measure()
        self.folder.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(".partial")
        partial.write_bytes(msgspec.msgpack.encode(found))
        partial.replace(path)
        return found

    def close(self) -> None:
        """Remove the folder: what it was kept for is complete."""
        if self.folder is not None:
            shutil.rmtree(self.folder, ignore_errors=True)
