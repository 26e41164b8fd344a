"""The command ``orderconds solve``. The command first tries to prove that no method exists. If this proof
fails, the command searches for a method and proves the order of the method."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from orderconds.errors import InputError, ZeroWeight
from orderconds.proof.krawczyk import NotProved
from orderconds.solve.abscissae import WHERE
from orderconds.solve.certify_solution import Solution, certify_solution
from orderconds.solve.elimination import Infeasible, infeasible
from orderconds.solve.parametrise import structures
from orderconds.solve.problem import Problem, find_problem
from orderconds.solve.search import BATCH, Batch, Checkpoint, Search, batches
from orderconds.solve.spec import Spec

PLAIN, MINIMISED = 4096, 1024
"""The default number of random starts is MINIMISED if the search minimises the principal error, and PLAIN in
all other cases."""


DIVISION = "the formulas of the family divide by a weight or another number that is zero at the solution"
"""The message to the user if the proof of a solution fails with a ZeroDivisionError."""


@dataclass
class Outcome:
    """The outcome of a search: a method (``solution``), a proof that no method exists (``none``), or neither.

    ``best`` is the least residual norm of all random starts. ``tried`` contains one line of text about each
    parametrisation of the coefficients. ``structure`` is the name of the last parametrisation.
    """

    solution: Solution | None = None
    none: Infeasible | None = None
    best: float = float("inf")
    tried: list[str] = field(default_factory=list)
    structure: str = ""


@dataclass(frozen=True)
class Order:
    """A request to find a method. The attributes are the options of the command ``orderconds solve``."""

    family: str
    order: int
    spec: Spec
    seed: int = 0
    minimised: bool = False
    starts: int | None = None
    processes: int = 1
    cluster: str | None = None
    checkpoint: Path | None = None
    name: str = "found"

    def command(self) -> str:
        """Return the command line that repeats the search.

        >>> Order("cg", 3, Spec(stages=3, explicit=True)).command()
        'orderconds solve cg --stages 3 --order 3 --explicit'
        """
        stages, order = str(self.spec.stages), str(self.order)
        words = ["orderconds", "solve", self.family, "--stages", stages, "--order", order]
        words += self._restrictions()
        words += ["--minimise", "error"] if self.minimised else []
        words += ["--starts", str(self.starts)] if self.starts is not None else []
        words += ["--seed", str(self.seed)] if self.seed else []
        return shlex.join(words)

    def restrictions(self) -> str:
        """Return the options that restrict the methods of the search, except the number of stages.

        >>> Order("rk", 4, Spec(stages=3, dirk=True, fix=("a21=1/2",))).restrictions()
        '--dirk --fix a21=1/2'
        """
        return shlex.join(self._restrictions())

    def _restrictions(self) -> list[str]:
        w = self.spec
        words = ["--low-storage"] if w.low_storage else []
        words += [f"--{key}" for key in ("explicit", "dirk", "symmetric", "fsal", "rkn") if getattr(w, key)]
        for option, values in (("--fix", w.fix), ("--positive", w.positive)):
            for value in values:
                words += [option, value]
        if w.size is not None:
            words += ["--size", str(w.size)]
        for option, number, usual in (("--exponentials", w.exponentials, 2), ("--inner", w.inner, 2)):
            if number != usual:
                words += [option, str(number)]
        return words


def solve(order: Order, report: Callable[[str], object] = str) -> Outcome:
    """Run a search. The function ``report`` is called with lines of text about the progress.

    Raises :class:`~orderconds.errors.InputError` if the options contradict each other.

    >>> outcome = solve(Order("cg", 3, Spec(stages=3, explicit=True)))
    >>> outcome.solution.certificate
    'exact'
    """
    outcome = Outcome()
    applicable = list(_applicable(order))
    full = find_problem(order.family, order.order, order.spec, applicable[-1])
    report("eliminating")
    outcome.none = infeasible(full)
    if outcome.none is not None:
        return outcome
    for structure in applicable:
        _search(order, structure, outcome, report)
        if outcome.solution is not None:
            return outcome
    return outcome


def _applicable(order: Order) -> list[str]:
    """Return the names of the parametrisations that the options of the search allow. Raises InputError if the
    options allow no parametrisation, or if the options contradict each other."""
    applicable, refusal = [], None
    for structure in structures(order.family, order.spec):
        try:
            problem = find_problem(order.family, order.order, order.spec, structure)
            _ = problem.ansatz.symbolic()
            _ = problem.positive
        except InputError as problem:
            if problem.where != WHERE:
                raise
            refusal = problem
        else:
            applicable.append(structure)
    if not applicable and refusal is not None:
        raise refusal
    return applicable


def _search(order: Order, structure: str, outcome: Outcome, report: Callable[[str], object]) -> None:
    problem = find_problem(order.family, order.order, order.spec, structure)
    search = Search(order.family, order.order, order.spec, structure, order.seed, order.minimised)
    path = order.checkpoint
    if path is not None and structure != structures(order.family, order.spec)[0]:
        path = path.with_name(f"{path.name}.{structure}")
    checkpoint = Checkpoint(path, search)
    checkpoint.load()
    starts = order.starts or (MINIMISED if order.minimised else PLAIN)
    count = -(-starts // BATCH)
    seen: list[Batch] = []
    source = order.command()
    refused = ""
    for batch in batches(search, count, checkpoint, order.processes, order.cluster):
        seen.append(batch)
        outcome.best = min(outcome.best, batch.best)
        least = min((s for b in seen for s, _ in b.solutions), default=None)
        shown = f", least score {least:.4g}" if least is not None else ""
        done = f"structure {structure}: {len(seen) * BATCH} of {count * BATCH} random starts completed"
        report(f"{done}, least residual norm {outcome.best:.1e}{shown}")
        if order.minimised:
            continue
        outcome.solution, refused = _finished(problem, [batch], order, source, refused)
        if outcome.solution is not None:
            break
    if order.minimised:
        outcome.solution, refused = _finished(problem, seen, order, source, refused)
    outcome.tried.append(
        f"structure {structure}: {len(problem.ansatz.free)} free coefficients, "
        f"{problem.tape.size} conditions, {len(seen) * BATCH} random starts"
        + (f"; solutions not proved: {refused}" if refused else "")
    )
    outcome.structure = structure
    # The search with this parametrisation has ended. The checkpoint is no longer needed.
    checkpoint.remove()


def _finished(
    problem: Problem, seen: list[Batch], order: Order, source: str, refused: str
) -> tuple[Solution | None, str]:
    """Return the first solution whose order can be proved, and the message of the last failed proof.

    ``refused`` is the message of the last failed proof in earlier calls.
    """
    solutions = sorted((s for batch in seen for s in batch.solutions), key=lambda pair: pair[0])
    for _, point in solutions[:8]:
        try:
            return certify_solution(problem, point, order.name, source, minimised=order.minimised), refused
        except (NotProved, ZeroWeight) as problem_met:
            refused = str(problem_met)
        except ZeroDivisionError:
            refused = DIVISION
    return None, refused
