"""heyoka: the Taylor series method with compiled recurrences, adaptive order and adaptive step size.

The code of the default mode is about twice as fast as the code of heyoka's compact mode. The compilation of
the default mode can take minutes.
"""

from __future__ import annotations

from codegen.ir.domain import FloatDomain
from codegen.ir.elementary import MATHEMATICAL
from codegen.lab.peers import Outcome, Peer, PeerFailed, Prepared
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem

LONG = 1000
"""If a vector field has more than LONG operations, heyoka's compact mode is used, which compiles faster."""


def peer(name: str) -> Peer:
    """Return the peer (an integrator for comparison) ``heyoka``."""
    import heyoka

    return Peer(name, "tolerance", _prepare, f"heyoka {heyoka.__version__}")


def _prepare(scene: Problem, tolerance: float) -> Prepared:
    import heyoka

    field = velocity(scene)
    compact = len(field.lines) > LONG
    variables = heyoka.make_vars(*scene.symbols)
    functions = {name: getattr(heyoka, name) for name in MATHEMATICAL}
    constants = lambda x: heyoka.expression(float(x))  # noqa: E731
    roots = field.python(constants, functions)(list(variables), heyoka.time)
    start = list(scene.initial(FloatDomain(0.0)))
    first, last = map(float, scene.span)
    solver = heyoka.taylor_adaptive(
        list(zip(variables, roots, strict=True)), start, time=first, tol=tolerance, compact_mode=compact
    )

    def run(spans: int = 1) -> Outcome:
        solver.time = first
        solver.state[:] = start
        outcome, _, _, steps, *_ = solver.propagate_until(first + spans * (last - first))
        if outcome != heyoka.taylor_outcome.time_limit:
            raise PeerFailed(f"heyoka: {outcome}")
        return Outcome(tuple(solver.state.tolist()), int(steps), None)

    # The measured overhead is slightly too large, because heyoka makes a step even in an empty interval.
    return Prepared(run, lambda: run(0))
