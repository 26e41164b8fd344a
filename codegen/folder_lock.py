"""A lock on a folder.

There is no lock file: the operating system locks the folder itself.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def locked(folder: Path, *, shared: bool = False, wait: bool = True) -> Iterator[bool]:
    """Lock an existing folder during a ``with`` block. Yield True if the folder was locked, otherwise False.

    The lock is exclusive. With ``shared=True``, the folder can have other shared locks at the same time. If
    the folder has a conflicting lock, the function waits. With ``wait=False``, it yields False instead. It
    also yields False if the file system has no locks.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as name, locked(Path(name)) as held:
    ...     with locked(Path(name), wait=False) as again:
    ...         held, again
    (True, False)
    """
    # The function flock is not available on Windows, so the folder is not locked there.
    if sys.platform == "win32":
        yield False
        return
    import fcntl

    descriptor = os.open(folder, os.O_RDONLY)
    try:
        held = True
        try:
            how = fcntl.LOCK_SH if shared else fcntl.LOCK_EX
            fcntl.flock(descriptor, how if wait else how | fcntl.LOCK_NB)
        except OSError:
            held = False
        yield held
    finally:
        os.close(descriptor)
