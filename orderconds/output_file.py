"""Atomic writing of files: a file is written under a temporary name and then renamed.

A process that is killed may leave temporary files; :func:`is_temporary` recognises their names.
"""

from __future__ import annotations

import os
import re
import secrets
from collections.abc import Mapping
from pathlib import Path

SUFFIX = ".orderconds-part"
"""The suffix of temporary files."""

_TEMPORARY = re.compile(rf"\..*\.\w{{8}}{re.escape(SUFFIX)}", re.DOTALL)


def write_files(contents: Mapping[Path, bytes], *, private: bool = False) -> None:
    """Write files under temporary names, and rename the files when all are on the disk.

    The files are renamed in the order of ``contents``. If ``private`` is true, only the user can read the
    files. Otherwise, a new file has the permissions of the file that it replaces. If a path is a symbolic
    link, the new file replaces the link, not its target.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_files({Path(folder) / "x": b"text"})
    ...     os.listdir(folder)
    ['x']
    """
    written: dict[Path, Path] = {}
    try:
        for path, content in contents.items():
            # The temporary name contains only 40 characters of ``path.name``. File systems limit the length
            # of names.
            name = f".{path.name[:40]}.{secrets.token_hex(4)}{SUFFIX}"
            # The name is recorded before the file is created, because a signal may arrive between the
            # creation of the file and the next statement.
            written[path] = path.parent / name
            with open(written[path], "xb", opener=_open_private) as stream:
                stream.write(content)
                stream.flush()
                os.fsync(stream.fileno())  # without fsync, the file could be empty after a power failure
            if not private:
                os.chmod(written[path], _mode(path))
        for path, temporary in written.items():
            os.replace(temporary, path)
    except BaseException:
        for temporary in written.values():
            temporary.unlink(missing_ok=True)
        raise


def is_temporary(name: str) -> bool:
    """Return True if ``name`` has the form of the temporary file names that :func:`write_files` creates.

    >>> is_temporary(".rigid.c.k3_x91ab" + SUFFIX), is_temporary(".rigid.c")
    (True, False)
    """
    return _TEMPORARY.fullmatch(name) is not None


def _open_private(name: str, flags: int) -> int:
    return os.open(name, flags, 0o600)


def _mode(path: Path) -> int:
    if path.is_file() and not path.is_symlink():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
