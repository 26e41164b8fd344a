"""The cache: a folder of computed files, called entries.

For each entry, a second file contains the SHA-256 digest of the entry. An entry is computed
again if its digest is wrong, if it belongs to another user, or if it is not a regular file.

Other users have no access to the folder. Thus they cannot replace the compiled code in it.
"""

from __future__ import annotations

import atexit
import hashlib
import logging
import os
import shutil
import stat
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from codegen.folder_lock import locked
from orderconds.input_file import MAX_WRITTEN_BYTES, content_of, reason
from orderconds.output_file import is_temporary, write_files

WORKING = "building-"
"""The beginning of the names of working folders, in which modules are compiled."""

SETTLED = 60.0
"""The age in seconds after which temporary files and unlocked working folders are removed."""


def cache_directory() -> Path:
    """Return the folder of the cache: $XDG_CACHE_HOME/orderconds, else ~/.cache/orderconds.

    If the folder cannot be created or belongs to another user, a warning is logged once and a temporary
    folder is returned.
    """
    base = os.environ.get("XDG_CACHE_HOME", "")
    try:
        folder = (Path(base) if os.path.isabs(base) else Path.home() / ".cache") / "orderconds"
    except RuntimeError:  # HOME is not set, and the user has no home folder
        return temporary_directory("there is no home folder")
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        _require_private(folder)
    except OSError as problem:
        return temporary_directory(f"{folder}: {reason(problem)}")
    return folder


def _require_private(folder: Path) -> None:
    """Remove the access of other users to a folder.

    OSError is raised if another user owns the folder, or if the mode cannot be changed.
    """
    if not hasattr(os, "geteuid"):
        return
    # If the folder is a symbolic link, the link must belong to the user, too.
    for status in (folder.lstat(), folder.stat()):
        if status.st_uid != os.geteuid():
            raise PermissionError(1, "the folder belongs to another user")
    if folder.stat().st_mode & 0o077:
        folder.chmod(0o700)
    mode = stat.S_IMODE(folder.stat().st_mode)
    if mode & 0o077:
        raise PermissionError(1, f"other users have access to the folder, whose mode is {mode:o}")


@cache
def temporary_directory(why: str) -> Path:
    """Return a temporary folder that is removed when this process ends.

    ``why`` is the reason why the cache cannot be used. For each reason, one warning is logged.
    """
    logging.getLogger("orderconds").warning(
        "orderconds: the cache cannot be used (%s); compiled modules are kept in a temporary folder until "
        "the process ends; set XDG_CACHE_HOME to a folder that you own",
        why,
    )
    folder = Path(tempfile.mkdtemp(prefix="orderconds-"))
    atexit.register(_remove, folder, os.getpid())
    return folder


def _remove(folder: Path, owner: int) -> None:
    # A forked worker process must not remove the folder of its parent process.
    if os.getpid() == owner:
        shutil.rmtree(folder, ignore_errors=True)


def recall(entry: Path) -> bytes | None:
    """Return the content of an entry of the cache.

    The result is None if the file is missing, damaged or too large, or if it belongs to another user.

    >>> with tempfile.TemporaryDirectory() as folder:
    ...     entry = Path(folder) / "x"
    ...     keep(entry, b"content")
    ...     _ = entry.write_bytes(b"conten")
    ...     recall(entry) is None
    True
    """
    try:
        content = content_of(entry, limit=MAX_WRITTEN_BYTES, own=True)
        kept = content_of(_digest_file(entry), own=True)
    except OSError:
        return None
    return content if kept.strip() == _digest(content) else None


def keep(entry: Path, content: bytes) -> None:
    """Write an entry of the cache, and write its digest to a second file.

    Each of the two files is written atomically. OSError is raised if a file cannot be written.
    """
    entry.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    write_entries({_digest_file(entry): _digest(content) + b"\n", entry: content})


def write_entries(contents: Mapping[Path, bytes]) -> None:
    """Write files atomically. Only the user can read the files.

    If a path in ``contents`` is a folder, the folder is removed first.

    >>> with tempfile.TemporaryDirectory() as folder:
    ...     (Path(folder) / "x" / "y").mkdir(parents=True)
    ...     write_entries({Path(folder) / "x": b"content"})
    ...     (Path(folder) / "x").read_bytes()
    b'content'
    """
    for path in contents:
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
    write_files(contents, private=True)


def _digest_file(entry: Path) -> Path:
    return entry.with_name(f"{entry.name}.sha256")


def _digest(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode()


@contextmanager
def working_directory(folder: Path) -> Iterator[Path]:
    """Create a working folder inside the cache. The folder is removed at the end of the ``with`` block."""
    _sweep(folder)
    temporary = tempfile.TemporaryDirectory(dir=folder, prefix=WORKING, ignore_cleanup_errors=True)
    with temporary as name, locked(Path(name), wait=False):
        yield Path(name)


def _sweep(folder: Path) -> None:
    """Remove the temporary files and working folders of killed processes."""
    for path in folder.iterdir():
        with suppress(OSError):
            if path.stat(follow_symlinks=False).st_mtime > time.time() - SETTLED:
                continue  # a new folder may belong to a process that has not locked the folder yet
            if is_temporary(path.name):
                path.unlink()
            elif path.name.startswith(WORKING) and path.is_dir():
                with locked(path, wait=False) as held:
                    if held:
                        shutil.rmtree(path, ignore_errors=True)
