"""Work on many inputs at a time in worker processes that never outlive the process that started them.

Exact numbers stay in their process: they neither pickle nor share their precision. Jobs and results are
strings, numbers and records of them.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from orderconds.errors import InputError

Job = TypeVar("Job")
Result = TypeVar("Result")


def in_processes(
    work: Callable[[Job], Result], jobs: Sequence[Job], processes: int | None = None
) -> Iterator[Result]:
    """Yield ``work(job)`` for each job, in order.

    ``processes`` is the number of worker processes, by default that of the processors. A single job runs in
    this process. When the iteration ends early, for whatever reason, the workers are terminated. InputError
    if a worker was killed.

    >>> list(in_processes(len, ["one"]))
    [3]
    """
    workers = min(len(jobs), processes or os.cpu_count() or 1)
    if workers < 2:
        yield from map(work, jobs)
        return
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor
    from concurrent.futures.process import BrokenProcessPool

    others = multiprocessing.active_children()
    pool = ProcessPoolExecutor(workers, initializer=_start_worker)
    try:
        yield from pool.map(work, jobs)
    except BrokenProcessPool:
        raise InputError(
            "a worker process was killed",
            expected=f"enough memory for {workers} processes",
            hint="free some, or ask for less at a time",
        ) from None
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for child in multiprocessing.active_children():
            if child not in others:
                child.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def terminate_children() -> None:
    """Terminate the worker processes of an iteration that nobody has closed; else the exit waits for them."""
    multiprocessing = sys.modules.get("multiprocessing")
    if multiprocessing is not None:
        for child in multiprocessing.active_children():
            child.terminate()


def _start_worker() -> None:
    """Leave Ctrl-C to the parent, and end when the parent ends, however it does."""
    import threading

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    threading.Thread(target=_follow_parent, daemon=True).start()


def _follow_parent() -> None:
    from multiprocessing import connection, parent_process

    parent = parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os._exit(1)
