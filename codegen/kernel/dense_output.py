"""Kernels of a continuous extension. The extension gives the state at any time inside a step.

Let y be the state at the beginning of a step from t to t + h. For 0 <= theta <= 1, the solution at the time t
+ theta h is exp(sigma(theta)).y, where sigma is a polynomial with values in the Lie algebra.
"""

from __future__ import annotations

from codegen.ir.expr import Expr
from codegen.ir.interpret import flatten
from codegen.ir.kernel import Continuous, Field, Kernel, Let
from codegen.ir.operations import ActExp
from codegen.ir.program import Program
from codegen.kernel.assignments import Assignments
from codegen.kernel.shared_angles import SharedArguments
from codegen.kernel.translate import COMBINED, to_kernel
from codegen.passes import abelian, blocks, dead, fold_zeros, fuse, value_numbering
from codegen.scene.problem import Problem

COORDINATES = "coordinates"
"""The name for the coordinates of the algebra element x in the kernel that computes exp(x).y."""


def continuous(program: Program, problem: Problem, order: int) -> Continuous:
    """Return the kernels that give the state at any time inside a step (continuous extension).

    The outputs of ``program`` are the coefficients of the polynomial sigma(theta) with values in the Lie
    algebra. One kernel computes these coefficients. The other kernel computes exp(x).y for x = sigma(theta).
    """
    program = fold_zeros.run(abelian.run(program, problem.group.abelian))
    program = dead.run(blocks.run(value_numbering.run(program)))
    # Outlined functions of this kernel could have the same names as outlined functions of the step. The
    # argument ``chains=COMBINED`` prevents outlining.
    coefficients = to_kernel(dead.run(fuse.run(program)), problem, chains=COMBINED)
    # The outputs are the coefficients of theta^1, ..., theta^degree. These are all coefficients of the
    # polynomial sigma(theta), because sigma(0) = 0.
    degree = len(program.outputs)
    return Continuous(coefficients, _moved(coefficients, problem), degree, order)


def _moved(kernel: Kernel, problem: Problem) -> Kernel:
    """Return the kernel that computes the point exp(x).y from y and the coordinates of x."""
    domain = SharedArguments()
    # A name in a scene contains no dot, so these names are new.
    names = tuple(f"{COORDINATES}.{k}" for k in range(problem.group.dim))
    x, y = (tuple(map(domain.space.sym, symbols)) for symbols in (names, problem.symbols))
    # The group action maps the manifold to itself, so the result lies on the manifold for every x.
    (point,) = ActExp().evaluate(problem, domain, (x, y))
    ends: list[Expr] = list(flatten(problem.state[0].kind, point))
    taken = {*names, *problem.symbols, *kernel.scalars}

    def name(base: str) -> str:
        while base in taken:
            base += "_"
        taken.add(base)
        return base

    schedule = Assignments((), ends, {}, name)
    body = tuple(s for s in schedule.run() if isinstance(s, Let))
    # The kernel has the coordinates in the Lie algebra as additional inputs.
    fields = (*kernel.state, Field(COORDINATES, names, "coordinates in the Lie algebra"))
    return Kernel(kernel.name, fields, kernel.scalars, body, schedule.outputs)
