"""heyoka: the Taylor series method with compiled recurrences, adaptive order and adaptive step size."""

from __future__ import annotations

from codegen.ir.domain import FloatDomain
from codegen.ir.elementary import MATHEMATICAL
from codegen.lab.peers import Outcome, Peer, PeerFailed, Prepared
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem


def peer(name: str) -> Peer:
    """Return heyoka."""
    import heyoka

    return Peer(name, "tolerance", _prepare, f"heyoka {heyoka.__version__}")


def _prepare(scene: Problem, tolerance: float) -> Prepared:
    import heyoka

    variables = heyoka.make_vars(*scene.symbols)
    functions = {name: getattr(heyoka, name) for name in MATHEMATICAL}
    constants = lambda x: heyoka.expression(float(x))  # noqa: E731
    roots = velocity(scene).python(constants, functions)(list(variables), heyoka.time)
    start = list(scene.initial(FloatDomain(0.0)))
    first, last = map(float, scene.span)
    solver = heyoka.taylor_adaptive(
        list(zip(variables, roots, strict=True)), start, time=first, tol=tolerance
    )

    def run(spans: int = 1) -> Outcome:
        solver.time = first
        solver.state[:] = start
        outcome, _, _, steps, *_ = solver.propagate_until(first + spans * (last - first))
        if outcome != heyoka.taylor_outcome.time_limit:
            raise PeerFailed(f"heyoka: {outcome}")
        return Outcome(tuple(solver.state.tolist()), int(steps), None)

    # An empty run takes longer than the overhead of a call, by about the time of one step. Therefore the time
    # of a short run is measured over several spans, as for all other integrators.
    return Prepared(run, lambda: run(0))
