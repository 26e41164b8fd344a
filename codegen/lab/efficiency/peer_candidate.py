"""Measures a peer (another integrator) for one curve of a work-precision diagram."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from codegen.lab.efficiency.equations import Equations
from codegen.lab.efficiency.work_precision import (
    BUDGET,
    Row,
    at_rounding,
    beyond_budget,
    doubled_steps,
)
from codegen.lab.peers import TOLERANCES, Peer, PeerFailed
from codegen.lab.reference import Reference
from codegen.lab.timing import Overhead, span_times, spread
from codegen.scene.problem import Problem
from orderconds.errors import InputError


@dataclass
class PeerCandidate:
    """A peer (another integrator) that is run on a scene.

    ``exact`` is the reference solution of the scene. ``budget`` is the limit of the CPU time of a run, in
    seconds. If ``equations`` is None, the peer integrates the equations of ``scene``.
    """

    scene: Problem
    peer: Peer
    exact: Reference
    budget: float = BUDGET
    target: str = "peer"
    equations: Equations | None = None

    def __post_init__(self) -> None:
        self.equations = self.equations or Equations(self.scene)
        self.label, self.form = self.peer.name, self.equations.name
        self.key = f"{self.peer.version} {self.form}".rstrip()
        self.refused = False
        self.overhead: Overhead | None = None

    def controls(self) -> Iterator[float]:
        """Yield decreasing tolerances or increasing numbers of steps for :meth:`measure`.

        If the attribute ``controlled`` of the peer is "tolerance", the values are tolerances. Otherwise the
        values are the numbers of steps 1, 2, 4, ....
        """
        return iter(TOLERANCES) if self.peer.controlled == "tolerance" else doubled_steps()

    def prepare(self) -> None:
        """Do nothing, because :meth:`measure` prepares the peer for each run."""

    def measure(self, control: float) -> Row:
        """Run the peer, and return a row with the error and the CPU time of the run.

        ``control`` is the tolerance or the number of equal steps. If the peer fails, the row contains the
        reason.
        """
        assert self.equations is not None
        start = time.perf_counter()
        try:
            prepared = self.peer.prepare(self.equations.problem, control)
            setup = time.perf_counter() - start
            outcome = prepared.run()
            error = self.equations.error(outcome.state, self.exact)
            if not math.isfinite(error):
                raise PeerFailed("the final state is not finite")
            # The overhead of a call does not depend on ``control``.
            self.overhead = self.overhead or Overhead(prepared.idle)
            times = span_times(lambda n: prepared.run(n).steps, self.overhead)
        # No exception of a peer may prevent the measurement of the remaining candidates.
        except Exception as failure:
            self.refused = not isinstance(failure, PeerFailed)
            setup = time.perf_counter() - start
            reason = str(failure)
            if not isinstance(failure, PeerFailed | InputError):
                reason = f"{type(failure).__name__}: {reason}"
            names = (self.scene.name, self.label, self.target)
            return Row(*names, control, compile_seconds=setup, failure=reason, form=self.form)
        first, last = map(float, self.scene.span)
        return Row(
            self.scene.name,
            self.label,
            self.target,
            control,
            h=(last - first) / max(outcome.steps, 1),
            steps=outcome.steps,
            error=error,
            seconds=times[0],
            spread=spread(times),
            ns_per_step=1e9 * times[0] / max(outcome.steps, 1),
            evaluations=outcome.evaluations,
            compile_seconds=setup,
            form=self.form,
        )

    def enough(self, rows: Sequence[Row]) -> bool:
        """Return True if no further run is needed. ``rows`` are the results of all earlier runs.

        The result is True in three cases:

        - The peer cannot integrate the scene.
        - The next run would take too long.
        - The peer makes equal steps, and the error has reached the size of rounding errors.
        """
        if self.refused or beyond_budget(rows, self.budget):
            return True
        return self.peer.controlled != "tolerance" and at_rounding(rows, self.exact)
