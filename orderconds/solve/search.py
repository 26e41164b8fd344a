"""The search for methods from many random starting points, in batches.

The result of a batch depends only on the problem, the seed and the number of the batch. The result of a
search depends neither on the number of processes nor on interruptions.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from orderconds.errors import InputError
from orderconds.input_file import MAX_WRITTEN_BYTES, content_of, reason
from orderconds.output_file import write_files
from orderconds.processes import in_processes
from orderconds.solve.cluster import on_cluster
from orderconds.solve.least_squares import least_squares, rank
from orderconds.solve.minimise import minimise
from orderconds.solve.problem import Problem, find_problem
from orderconds.solve.spec import Spec
from orderconds.solve.tape import Floats

BATCH = 64
"""The number of random starting points in a batch."""

POLISHED = 1e-11
"""A point counts as a solution if the residual norm is below this number."""

KEPT = 4
"""A batch of random starts returns at most KEPT solutions."""


CHEAP = 4
"""If the required order is at most this number, the score of a solution is its principal error. For
higher orders, computing the principal error of every solution is too expensive."""


SINGULAR = 1e6
"""This number is added to the score of a solution if the gradients of the conditions are linearly
dependent."""


@dataclass(frozen=True)
class Search:
    """All options that determine the result of a search."""

    family: str
    order: int
    spec: Spec
    structure: str
    seed: int = 0
    minimised: bool = False

    def described(self) -> dict[str, object]:
        """Return the options as a JSON object for the checkpoint file."""
        record = asdict(self)
        record["spec"] = {key: str(x) if key == "size" else x for key, x in record["spec"].items()}
        return dict(json.loads(json.dumps(record)))


BatchRecord = tuple[int, str, list[tuple[str, list[str]]]]
"""The fields of a :class:`Batch`, as stored in a JSON file. Floating-point numbers are hexadecimal texts."""


@dataclass(frozen=True)
class Batch:
    """The result of a batch of random starts. ``solutions`` contains pairs (score, values of the free
    coefficients), in ascending order of the score.

    If the search minimises the principal error, or if the required order is at most :data:`CHEAP`, the score
    is the principal error. In all other searches, the score is the largest absolute value of a coefficient.
    The score increases by :data:`SINGULAR` if the gradients of the conditions at the solution are linearly
    dependent.

    ``best`` is the least residual norm of all starts of the batch.
    """

    number: int
    best: float
    solutions: tuple[tuple[float, tuple[float, ...]], ...] = ()

    def as_json(self) -> BatchRecord:
        """Return the batch as JSON, with floating-point numbers as exact hexadecimal texts."""
        solutions = [(s.hex(), [x.hex() for x in p]) for s, p in self.solutions]
        return self.number, self.best.hex(), solutions

    @staticmethod
    def read(record: BatchRecord) -> Batch:
        """Return the batch from the output of :meth:`as_json`."""
        number, best, solutions = record
        read = tuple((float.fromhex(s), tuple(map(float.fromhex, p))) for s, p in solutions)
        return Batch(int(number), float.fromhex(best), read)


def run_batch(search: Search, number: int) -> Batch:
    """Search from the random starting points of batch ``number``. The result contains at most :data:`KEPT`
    solutions: the ones with the lowest scores.

    >>> search = Search("rk", 2, Spec(stages=2, explicit=True), "full")
    >>> found = run_batch(search, 0)
    >>> len(found.solutions) > 0, found == run_batch(search, 0)
    (True, True)
    """
    problem = find_problem(search.family, search.order, search.spec, search.structure)
    generator = np.random.default_rng([search.seed, number])
    points, norms = least_squares(problem.system, problem.starts(generator, BATCH))
    solved = np.flatnonzero(norms < POLISHED)
    regular = [
        i for i in solved if rank(problem.tape.jacobians(points[i : i + 1])[1][0]) == problem.tape.size
    ]
    late = 0.0 if regular else SINGULAR
    chosen = [(late + _score(problem, points[i]), points[i]) for i in regular or solved]
    if search.minimised:
        nearest = sorted(chosen, key=lambda pair: pair[0])[:KEPT]
        chosen = [(late + size, x) for x, size in (minimise(problem, x) for _, x in nearest)]
    best = sorted(chosen, key=lambda pair: pair[0])[:KEPT]
    solutions = tuple((score, tuple(map(float, x))) for score, x in best)
    return Batch(number, float(norms.min()), solutions)


def _score(problem: Problem, point: Floats) -> float:
    """Return the score of a solution, without the penalty :data:`SINGULAR`."""
    if problem.order <= CHEAP:
        return float(np.linalg.norm(problem.error.values(point[None])[0]))
    return float(np.abs(problem.coefficients.values(point[None])).max())


@dataclass
class Checkpoint:
    """The file in which a search saves the finished batches. If ``path`` is None, no file is written."""

    path: Path | None
    search: Search
    batches: dict[int, Batch] = field(default_factory=dict)

    def load(self) -> None:
        """If the checkpoint file exists, read the finished batches. Raises InputError if the file is
        unreadable, is not a checkpoint, or belongs to another search."""
        if self.path is None or not self.path.exists():
            return
        try:
            record = json.loads(content_of(self.path, limit=MAX_WRITTEN_BYTES, own=True))
            same = record["search"] == self.search.described()
            batches = [Batch.read(x) for x in record["batches"]] if same else []
        except OSError as problem:
            raise InputError(
                f"a checkpoint that cannot be used: {reason(problem)}",
                where=str(self.path),
                expected="a readable checkpoint file of the current user",
                hint="delete this file, or choose another file",
            ) from None
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            raise InputError(
                "not a checkpoint of a search",
                where=str(self.path),
                expected="the file of an interrupted search",
            ) from None
        if not same:
            raise InputError(
                "the checkpoint of another search",
                where=str(self.path),
                expected="the same family, order, constraints and seed",
                hint="delete this file, or choose another file",
            )
        self.batches = {batch.number: batch for batch in batches}

    def add(self, batch: Batch) -> None:
        """Add a finished batch, and write all finished batches to the checkpoint file."""
        if batch.number in self.batches:
            return
        self.batches[batch.number] = batch
        if self.path is not None:
            batches = [self.batches[k].as_json() for k in sorted(self.batches)]
            record = {"search": self.search.described(), "batches": batches}
            write_whole(self.path, json.dumps(record) + "\n")

    def remove(self) -> None:
        """Delete the checkpoint file."""
        if self.path is not None:
            self.path.unlink(missing_ok=True)


def write_whole(path: Path, text: str) -> None:
    """Write a file atomically. Raises InputError if the file cannot be written.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_whole(Path(folder) / "x", "text")
    ...     (Path(folder) / "x").read_text()
    'text'
    """
    if path.is_symlink() or (path.exists() and not path.is_file()):
        raise InputError("not a regular file", where=str(path), expected="a file that can be written")
    try:
        write_files({path: text.encode()})
    except OSError as problem:
        raise InputError(reason(problem), where=str(path), expected="a file that can be written") from None


def batches(
    search: Search, count: int, checkpoint: Checkpoint, processes: int = 1, cluster: str | None = None
) -> Iterator[Batch]:
    """Yield the batches 0, ..., ``count`` - 1 in ascending order. A batch is computed only if the
    checkpoint does not contain it. Each new batch is added to the checkpoint.

    ``cluster`` is the address of a dask cluster. Raises :class:`~orderconds.errors.InputError` if there is no
    connection to the cluster.

    >>> search = Search("rk", 2, Spec(stages=2, explicit=True), "full")
    >>> [batch.number for batch in batches(search, 2, Checkpoint(None, search))]
    [0, 1]
    """
    waiting = [number for number in range(count) if number not in checkpoint.batches]
    alone = count if processes < 2 and cluster is None else 1 if cluster is None else 0
    fresh = _computed(search, waiting, alone, processes, cluster)
    for number in range(count):
        batch = checkpoint.batches.get(number) or next(fresh)
        checkpoint.add(batch)
        yield batch


def _computed(
    search: Search, numbers: Sequence[int], alone: int, processes: int, cluster: str | None
) -> Iterator[Batch]:
    for number in numbers[:alone]:
        yield run_batch(search, number)
    rest = numbers[alone:]
    if not rest:
        return
    work = partial(run_batch, search)
    yield from in_processes(work, rest, processes) if cluster is None else on_cluster(work, rest, cluster)


Reported = Callable[[str], object]
"""A function that receives lines of text about the progress of a search."""
