"""The function ``solve`` of the Python interface: the search for a method of a given order."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Literal

from orderconds import families
from orderconds.argument import (
    EXPONENTIALS,
    PROCESSES,
    SEED,
    SOLVED_ORDER,
    SOLVED_STAGES,
    STARTS,
    described,
    integer,
    named_as_arguments,
    text,
    texts,
)
from orderconds.errors import InputError
from orderconds.explain.kinds import refuse_too_many_trees
from orderconds.solve import solver
from orderconds.solve.elimination import Infeasible
from orderconds.solve.solver import Order, Outcome
from orderconds.solve.spec import Spec
from orderconds.tableau import Tableau


@dataclass(frozen=True, repr=False)
class SearchResult:
    """The result of a search. ``bool(result)`` is True if a method was found.

    - ``tableau``: the method, or None
    - ``certificate``: ``exact`` if the order is proved in exact arithmetic, ``ball`` if it is proved in
      interval arithmetic, ``none`` if no method was found
    - ``error_norm``: the principal error of the method, or None if it was not computed
    - ``impossible``: a proof that no method exists, or None
    - ``best_residual``: the least residual norm of all random starts
    - ``tried``: one line of text about each parametrisation that was tried
    - ``command``: the command line that repeats the search
    """

    tableau: Tableau | None
    certificate: str
    error_norm: float | None
    impossible: Infeasible | None
    best_residual: float
    tried: tuple[str, ...]
    command: str

    @classmethod
    def of(cls, request: Order, outcome: Outcome) -> SearchResult:
        """Convert ``outcome`` to a search result. ``request`` contains the options of the search."""
        solution = outcome.solution
        return cls(
            tableau=None if solution is None else Tableau.loads(solution.text, request.name),
            certificate="none" if solution is None else solution.certificate,
            error_norm=None if solution is None else solution.error,
            impossible=outcome.none,
            best_residual=outcome.best,
            tried=tuple(outcome.tried),
            command=request.command(),
        )

    def __bool__(self) -> bool:
        return self.tableau is not None

    def __repr__(self) -> str:
        if self.tableau is not None:
            return f"<found {self.tableau!r}, certificate {self.certificate}>"
        if self.impossible is not None:
            return f"<no method exists: {self.impossible.reason}>"
        return f"<nothing found; least residual norm {self.best_residual:.3g}>"

    def _repr_html_(self) -> str | None:
        from orderconds.tableau.butcher import tableau_html

        return None if self.tableau is None else tableau_html(self.tableau)


def solve(
    family: str,
    stages: int,
    order: int,
    *,
    explicit: bool = False,
    dirk: bool = False,
    symmetric: bool = False,
    fsal: bool = False,
    fix: Sequence[str] = (),
    positive: Sequence[str] = (),
    size: Fraction | None = None,
    exponentials: int = 2,
    inner: int = 2,
    rkn: bool = False,
    low_storage: bool = False,
    minimise: Literal["error"] | None = None,
    starts: int | None = None,
    seed: int = 0,
    processes: int = 1,
    checkpoint: str | os.PathLike[str] | None = None,
    name: str = "found",
    report: Callable[[str], object] = str,
) -> SearchResult:
    """Find a method of ``family`` with the given number of stages and the given order, and prove the order.

    The arguments are the options of ``orderconds solve``. ``fix`` contains equations such as ``"a21=1/2"``.
    ``report`` receives lines about the progress. Raises InputError if constraints contradict each other.

    >>> solve("rk", stages=2, order=2, explicit=True, fix=["a21=1"]).tableau.b
    (Fraction(1, 2), Fraction(1, 2))
    """
    order = integer(order, "order", SOLVED_ORDER)
    refuse_too_many_trees(families.get(family), order - 1)  # All searches need the trees up to order - 1.
    spec = Spec(
        stages=integer(stages, "stages", SOLVED_STAGES),
        explicit=explicit,
        dirk=dirk,
        symmetric=symmetric,
        fsal=fsal,
        fix=texts(fix, "fix", "a21=1/2"),
        positive=texts(positive, "positive", "b1"),
        size=_size(size),
        **{k: integer(n, k, EXPONENTIALS) for k, n in (("exponentials", exponentials), ("inner", inner))},
        rkn=rkn,
        low_storage=low_storage,
    )
    request = Order(
        family,
        order,
        spec,
        seed=integer(seed, "seed", SEED),
        minimised=_minimised(minimise),
        starts=None if starts is None else integer(starts, "starts", STARTS),
        processes=integer(processes, "processes", PROCESSES),
        checkpoint=_path(checkpoint),
        name=text(name, "name", "a name as a str"),
    )
    with named_as_arguments():
        return SearchResult.of(request, solver.solve(request, _function(report)))


def _function(report: Callable[[str], object]) -> Callable[[str], object]:
    if callable(report):
        return report
    raise InputError(
        described(report), where="report", expected="a function that takes one str, such as print"
    )


def _path(checkpoint: object) -> Path | None:
    """Return the argument ``checkpoint`` as a path, or None."""
    if checkpoint is None:
        return None
    if not isinstance(checkpoint, str | os.PathLike):
        raise InputError(described(checkpoint), where="checkpoint", expected="the path of a file")
    return Path(checkpoint)


def _minimised(minimise: object) -> bool:
    if minimise not in (None, "error"):
        raise InputError(described(minimise), where="minimise", expected='"error" or None')
    return minimise is not None


def _size(size: object) -> Fraction | None:
    """Convert the argument ``size`` of :func:`solve` to a fraction."""
    if size is None:
        return None
    try:
        bound = Fraction(size)  # type: ignore[call-overload]
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        bound = Fraction(0)
    if bound <= 0:
        raise InputError(described(size), where="size", expected="a positive rational number, such as 2")
    return Fraction(bound)
