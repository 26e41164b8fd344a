"""Work on many files at a time: strings go to processes and strings come back, in the order of the files.

Exact numbers stay where they were made: they neither pickle nor share their precision.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

Job = TypeVar("Job")
Result = TypeVar("Result")


def in_processes(work: Callable[[Job], Result], jobs: Sequence[Job]) -> Iterator[Result]:
    """Yield ``work(job)`` for each job, in order; one process a processor, none for a single job.

    >>> list(in_processes(len, ["one"]))
    [3]
    """
    workers = min(len(jobs), os.cpu_count() or 1)
    if workers < 2:
        yield from map(work, jobs)
        return
    from concurrent.futures import ProcessPoolExecutor

    with ProcessPoolExecutor(workers) as pool:
        yield from pool.map(work, jobs)
