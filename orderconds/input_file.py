"""Reading of files that a user names. Large files, pipes and devices are refused.

Reading from a pipe or device could take for ever or fill the memory.
"""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

from orderconds.errors import InputError

MAX_BYTES = 1_000_000
"""Default limit for the size of an input file, in bytes."""

MAX_WRITTEN_BYTES = 100_000_000
"""Maximal size in bytes of a file that a program of this project has written."""


def read_bytes(
    path: str | Path,
    expected: str = "a file that can be read",
    *,
    limit: int = MAX_BYTES,
    error: type[InputError] = InputError,
) -> bytes:
    """Return the content of a regular file of at most ``limit`` bytes.

    Raises ``error``, a subclass of InputError, for any other file.

    >>> read_bytes(os.devnull)
    Traceback (most recent call last):
    orderconds.errors.InputError: /dev/null: not a regular file; expected a file that can be read
    """
    try:
        return content_of(path, limit=limit)
    except OSError as problem:
        raise error(reason(problem), where=str(path), expected=expected) from None
    except ValueError:  # the path contains a null character or an unpaired surrogate
        raise error("not a valid file name", where=ascii(str(path)), expected=expected) from None


def read_text(
    path: str | Path,
    expected: str = "a text file",
    *,
    limit: int = MAX_BYTES,
    error: type[InputError] = InputError,
) -> str:
    """Return the text in a regular file. The file is encoded in UTF-8.

    Raises an exception of the class ``error`` if the content is not UTF-8, or if :func:`read_bytes` fails.

    >>> read_text(__file__).partition(".")[0]
    '\"\"\"Reading of files that a user names'
    """
    try:
        return read_bytes(path, expected, limit=limit, error=error).decode("utf-8")
    except UnicodeDecodeError:
        raise error("bytes that are not UTF-8", where=str(path), expected=expected) from None


def content_of(path: str | Path, *, limit: int = MAX_BYTES, own: bool = False) -> bytes:
    """Return the content of a regular file of at most ``limit`` bytes. Raises OSError for any other file.

    If ``own`` is true, the file must belong to the user and must not be a symbolic link.

    >>> len(content_of(__file__)) > 1000
    True
    """
    # The type is tested before the file is opened, because opening a device may have side effects.
    _require_regular(os.stat(path, follow_symlinks=not own), own)
    # O_NONBLOCK keeps ``open`` from blocking if another process has replaced the file by a pipe.
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    descriptor = os.open(path, flags | (getattr(os, "O_NOFOLLOW", 0) if own else 0))
    with open(descriptor, "rb") as stream:
        _require_regular(os.fstat(descriptor), own)
        content = stream.read(limit + 1)
    if len(content) > limit:
        raise OSError(errno.EFBIG, f"a file of more than {limit} bytes")
    return content


def _require_regular(status: os.stat_result, own: bool) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(status.st_mode):
        raise OSError(errno.EINVAL, "not a regular file")
    if own and hasattr(os, "geteuid") and status.st_uid != os.geteuid():
        raise PermissionError(errno.EPERM, "the file belongs to another user")


def reason(problem: OSError) -> str:
    """Return the operating system's description of an error, with the first letter in lower case.

    >>> reason(FileNotFoundError(errno.ENOENT, "No such file or directory"))
    'no such file or directory'
    """
    text = problem.strerror or str(problem) or "unreadable"
    return text[:1].lower() + text[1:]
