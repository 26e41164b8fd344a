"""The execution of jobs on a dask cluster."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import Any, TypeVar

from orderconds.errors import InputError

Job = TypeVar("Job")
Result = TypeVar("Result")

TIMEOUT = 3
"""Seconds to wait for the scheduler when a connection is opened or closed."""


def on_cluster(work: Callable[[Job], Result], jobs: Sequence[Job], address: str) -> Iterator[Result]:
    """Yield ``work(job)`` for each job, in the order of the jobs. ``address`` is the address of the
    scheduler.

    Raises InputError if there is no connection to the scheduler, or if workers die repeatedly during one job.
    """
    level = logging.root.manager.disable
    # With logging enabled, dask would log a traceback for each lost connection.
    logging.disable(logging.CRITICAL)
    try:
        yield from _results(work, jobs, address)
    finally:
        logging.disable(level)


def _results(work: Callable[[Job], Result], jobs: Sequence[Job], address: str) -> Iterator[Result]:
    from concurrent.futures import CancelledError

    client = _client(address)
    from distributed import KilledWorker

    try:
        for future in client.map(work, jobs, pure=False):
            try:
                yield future.result()
            except (OSError, CancelledError, TimeoutError, KilledWorker) as problem:
                killed = isinstance(problem, KilledWorker)
                raise InputError(
                    "worker processes of the cluster died" if killed else "the scheduler no longer answers",
                    where=f"--dask {address}",
                    expected="a cluster that runs until the search ends",
                    hint="restart the cluster and repeat the command; a checkpoint file saves the finished "
                    "batches of random starts",
                ) from None
    finally:
        with suppress(Exception):  # ``close`` fails if the scheduler no longer exists.
            client.close(timeout=TIMEOUT)


def _client(address: str) -> Any:
    """Connect to the dask scheduler at ``address``. Raises InputError if dask is missing or the scheduler
    does not answer."""
    try:
        from distributed import Client
    except ImportError:
        raise InputError(
            "the Python package 'distributed' (dask) is not installed",
            where="--dask",
            expected="pip install 'orderconds[cluster]'",
        ) from None
    try:
        return Client(address, timeout=TIMEOUT)
    except (OSError, ValueError, TimeoutError, TypeError) as problem:
        # dask raises TypeError for a tls address without a certificate.
        raise InputError(
            f"no scheduler answers at this address ({_words(problem)})",
            where=f"--dask {address}",
            expected="the address tcp://host:port of a scheduler",
        ) from None


def _words(problem: BaseException) -> str:
    return str(problem).partition("\n")[0] or type(problem).__name__
