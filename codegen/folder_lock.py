"""One writer at a time in a folder.

The lock is on the folder itself and ends with the process, so no lock file is left by one that is killed.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def locked(folder: Path, *, shared: bool = False, wait: bool = True) -> Iterator[bool]:
    """Hold the lock of an existing folder; ``shared`` is for readers, which exclude writers only.

    Yields whether the lock is held. It is not held if the file system has no locks, nor, without ``wait``,
    if another process holds it.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as name, locked(Path(name)) as held:
    ...     with locked(Path(name), wait=False) as again:
    ...         held, again
    (True, False)
    """
    if sys.platform == "win32":  # it has no flock; renames are atomic even without locks
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
