"""The peer ``diffrax``: the method Dopri8 of the library diffrax, compiled by JAX, in double precision.

Dopri8 is an explicit Runge-Kutta method of order 8.
"""

from __future__ import annotations

from codegen.ir.domain import FloatDomain
from codegen.lab.number_functions import of_arrays
from codegen.lab.number_types import Scalar
from codegen.lab.peers import Outcome, Peer, PeerFailed, Prepared
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem

MOST_STEPS = 1_000_000


def peer(name: str) -> Peer:
    """Return the peer (integrator for comparison) ``name``. The peer uses the package ``diffrax``."""
    import diffrax

    return Peer(name, "tolerance", _prepare, f"diffrax {diffrax.__version__}")


def _prepare(scene: Problem, tolerance: float) -> Prepared:
    import diffrax
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    functions = of_arrays(jnp)
    compute = velocity(scene).python(float, functions)
    start = jnp.array(scene.initial(FloatDomain(0.0)))
    first, last = map(float, scene.span)

    def field(t: Scalar, y: Scalar, _: object) -> Scalar:
        return jnp.stack([jnp.asarray(x, dtype=float) for x in compute(y, t)])

    def solve(y: Scalar, end: float) -> Scalar:
        return diffrax.diffeqsolve(
            diffrax.ODETerm(field),
            diffrax.Dopri8(),
            t0=first,
            t1=end,
            dt0=None,
            y0=y,
            stepsize_controller=diffrax.PIDController(rtol=tolerance, atol=tolerance),
            max_steps=MOST_STEPS,
            throw=False,
        )

    compiled = jax.jit(solve)

    def run(spans: int = 1) -> Outcome:
        solution = compiled(start, first + spans * (last - first))
        solution.ys.block_until_ready()
        if solution.result != diffrax.RESULTS.successful:
            raise PeerFailed(f"diffrax: the end of the time span is not reached within {MOST_STEPS} steps")
        steps = int(solution.stats["num_steps"])
        return Outcome(tuple(map(float, solution.ys[-1])), steps, 12 * steps)

    run()  # Compile ``solve`` before the timed runs.
    return Prepared(run)
