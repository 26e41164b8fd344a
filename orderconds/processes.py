"""Parallel execution of jobs in worker processes. The workers end when the process that started them ends.

Jobs and results are pickled. Numbers of the library python-flint cannot be pickled.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, TypeVar

from orderconds.errors import InputError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.process import BaseProcess

Job = TypeVar("Job")
Result = TypeVar("Result")

_is_worker = False
"""True in a worker process."""


def in_processes(
    work: Callable[[Job], Result], jobs: Sequence[Job], processes: int | None = None
) -> Iterator[Result]:
    """Yield ``work(job)`` for each job, in the order of the jobs.

    ``processes`` is the maximal number of workers. The default is the number of processors. This
    function starts no workers if ``processes`` is 1, if there is only one job, or if the caller runs in a
    worker of another call. Then the calling process runs the jobs.

    If a job raises an error, this function raises the error. Raises InputError if a worker was killed.

    >>> list(in_processes(len, ["one"]))
    [3]
    """
    count = 1 if _is_worker else min(len(jobs), processes or os.cpu_count() or 1)
    if count < 2:
        yield from map(work, jobs)
        return
    workers: dict[Connection, BaseProcess] = {}
    try:
        for _ in range(count):
            connection, worker = _start(work)
            workers[connection] = worker
        yield from _distribute(list(workers), jobs)
        for connection in workers:
            # If the worker has already ended, ``send`` raises ConnectionError.
            with suppress(ConnectionError):
                connection.send(())
    except BaseException:
        for worker in workers.values():
            worker.terminate()
        raise
    finally:
        for worker in workers.values():
            worker.join()


def _start(work: Callable[[Job], Result]) -> tuple[Connection, BaseProcess]:
    import multiprocessing

    ours, theirs = multiprocessing.Pipe()
    # The interpreter terminates daemon processes when it exits.
    worker = multiprocessing.Process(target=_serve, args=(theirs, work), daemon=True)
    worker.start()
    theirs.close()
    return ours, worker


def _distribute(idle: list[Connection], jobs: Sequence[Job]) -> Iterator[Result]:
    """Send the next job to each idle worker, and yield the results in the order of the jobs."""
    from multiprocessing import connection

    count, given = len(idle), 0
    working: dict[Connection, int] = {}
    results: dict[int, Result] = {}
    try:
        for number in range(len(jobs)):
            while number not in results:
                while idle and given < len(jobs):
                    worker = idle.pop()
                    worker.send((jobs[given],))
                    working[worker] = given
                    given += 1
                for ready in connection.wait(list(working)):
                    worker = next(w for w in working if w is ready)
                    result, error = worker.recv()
                    if error is not None:
                        raise error
                    results[working.pop(worker)] = result
                    idle.append(worker)
            yield results.pop(number)
    except (EOFError, ConnectionError):
        raise InputError(
            "a worker process was killed",
            expected=f"enough memory for {count} processes",
            hint="free some memory, or use fewer processes",
        ) from None


def _serve(connection: Connection, work: Callable[[Job], Result]) -> None:
    """Receive jobs from the parent process and run them until an empty tuple arrives. The worker ignores
    Ctrl-C, because the parent process terminates its workers."""
    import threading

    global _is_worker
    _is_worker = True
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    threading.Thread(target=_follow_parent, daemon=True).start()
    while job := connection.recv():
        answer: tuple[Result | None, Exception | None]
        try:
            answer = work(*job), None
        except Exception as error:
            answer = None, _portable(error)
        connection.send(answer)


def _portable(error: Exception) -> Exception:
    """Return ``error`` if it can be pickled. Otherwise return a RuntimeError with the type and message of
    ``error``. A note in the result contains the traceback."""
    import pickle
    import traceback

    note = "in a worker process:\n" + traceback.format_exc()
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        error = RuntimeError(f"{type(error).__name__}: {error}")
    error.add_note(note)
    return error


def _follow_parent() -> None:
    """End this process as soon as the parent process has ended."""
    from multiprocessing import connection, parent_process

    parent = parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os._exit(1)
