"""Counts the operations and function calls of a step.

The operations outside loops are counted separately. For each loop, the operations of one sweep (one
iteration) are counted.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Kernel
from codegen.ir.site_step import SiteStep
from codegen.ir.vector_calls import vector_function
from codegen.kernel.schedule import (
    Arrangement,
    Beginning,
    Invocation,
    Iteration,
    SharedCall,
    Simple,
    arrange,
)

STEP = "step"
"""In dictionaries of operation counts, this key denotes the operations outside loops."""

START = "start"
"""In dictionaries of operation counts, this key denotes the operations that compute the starting values of
implicit equations in the first step of a run.
"""


def operations(arrangement: Arrangement) -> dict[str, dict[str, int]]:
    """Count the operations of a step: ``add`` (also for subtractions), ``mul``, ``div``, and function calls.

    The result has separate counts for the following keys:

    - ``step``: the operations outside loops.
    - ``start``: the additional operations of the first step of a run.
    - The label of a block of implicit equations: the operations of one sweep (one iteration) of its loop.
    - The key that :func:`matrix_of` returns: the operations that compute the entries of a Newton matrix.

    The inversion of a Newton matrix, changes of sign, comparisons, extrapolation and the stopping rule are
    not counted.
    """
    # ``inside`` maps the name of an outlined function to the operation counts for one call.
    inside = {function.name: operations(inner)[STEP] for function, inner in arrangement.outlined}

    def count(statements: Iterable[Simple], more: Iterable[Expr]) -> dict[str, int]:
        return _counted(statements, more, inside)

    total = {STEP: count([], (*arrangement.outputs, *arrangement.errors))}
    for statement in arrangement.statements:
        match statement:
            case Iteration():
                # The starting values of a loop are computed before the loop, once in each step.
                total[STEP] = _plus(total[STEP], count([], statement.starts))
                sweep, label = count(statement.body, statement.images), statement.loop.label
                if statement.matrix:
                    n = len(statement.loop.unknowns)
                    # Each sweep multiplies the stored inverse of the n x n matrix by the residual.
                    sweep = _plus(sweep, {"add": n * (n - 1), "mul": n * n})
                    total[matrix_of(label)] = count(statement.newton, statement.matrix)
                total[label] = sweep
            case Beginning():
                total[START] = count(statement.body, statement.values)
            case _:
                total[STEP] = _plus(total[STEP], count([statement], ()))
    for key in (STEP, START):
        # The counts for ``key`` were made for one substep. A step has ``arrangement.repeated`` substeps.
        # All other counts are for one sweep of a loop or for one matrix.
        if key in total:
            total[key] = {name: n * arrangement.repeated for name, n in total[key].items()}
    return total


def step_operations(kernel: Kernel) -> dict[str, dict[str, int]]:
    """Count the operations of a kernel by name, as :func:`operations` does.

    For some kinds of kernels, the following operations are counted instead:

    - Taylor polynomial: the computation of the coefficients, and the evaluation of the polynomial.
    - Step with large matrices: the operations of the whole step, with a typical number of series terms in an
      exponential.
    - Step on a lattice: the operations for one site or for one pair of sites.
    - Step on Fourier modes: only the Fourier transforms.
    """
    if kernel.arrays is not None:
        return {STEP: kernel.arrays.operations()}
    if kernel.sites is not None:
        return _site_operations(kernel.sites)
    if kernel.modes is not None:
        return {STEP: {"transform": kernel.modes.transforms}}
    expansion = kernel.expansion
    if kernel.outputs or expansion is None:
        return operations(arrange(kernel))
    total = operations(arrange(expansion.coefficients))[STEP]
    # Horner's rule takes ``degree`` additions and products for each component of the state.
    number = expansion.degree * sum(len(f.symbols) for f in expansion.coefficients.state)
    if expansion.following is not None:
        # The kernel ``following`` is called once for each order greater than 1.
        last = expansion.degree - 1
        each = operations(arrange(expansion.following))[STEP]
        total = _plus(total, {name: n * last for name, n in each.items()})
        # The loop runs over n = 1, ..., ``last``, and each sum has n - 1 terms.
        number += expansion.sums * (last * (last - 1) // 2)
    total = _plus(total, {"add": number, "mul": number})
    # ``enter`` and ``leave`` change the coordinates before and after the Taylor expansion.
    for part in (expansion.enter, expansion.leave):
        total = total if part is None else _plus(total, operations(arrange(part))[STEP])
    return {STEP: total}


def _site_operations(step: SiteStep) -> dict[str, dict[str, int]]:
    """Return the operation counts for one site of a lattice."""
    parts = {STEP: step.unrepeated, **{block.label: step.repeated(block) for block in step.blocks}}
    counted: dict[str, dict[str, int]] = {}
    for key, sweeps in parts.items():
        counted[key] = {}
        for sweep in sweeps:
            counted[key] = _plus(counted[key], operations(arrange(sweep.kernel))[STEP])
    for block in step.blocks:
        if block.newton is not None:
            counted[matrix_of(block.label)] = operations(arrange(block.newton.kernel))[STEP]
    return counted


def matrix_of(label: str) -> str:
    """Return the key that :func:`operations` uses for the Newton matrix of the block ``label``."""
    return f"matrix of {label}"


def sentences(counts: dict[str, dict[str, int]]) -> list[str]:
    """Format operation counts as text: one line for the step, and one line for each block.

    >>> sentences({"step": {"add": 2, "stumpff_12": 1}, "stage 1": {"mul": 3}})
    ['2 add, 1 stumpff_12 a step', '3 mul for each sweep of stage 1']
    """
    lines = []
    for block, numbers in counts.items():
        each = ", ".join(f"{n} {name}" for name, n in numbers.items()) or "none"
        if block == START:
            lines.append(f"{each} once in each run, for the initial guess of the first step")
        elif block == STEP:
            lines.append(f"{each} a step")
        elif block.startswith("matrix of "):
            lines.append(f"{each} for each {block}")
        else:
            lines.append(f"{each} for each sweep of {block}")
    return lines


def costs(kernel: Kernel) -> list[str]:
    """Return lines with operation counts: for a step, and for the beginning and the end of a run."""
    lines = sentences(step_operations(kernel))
    if kernel.carried is not None:
        turned = (kernel.carried.inward, kernel.carried.outward)
        there, back = (operations(arrange(each_kernel))[STEP] for each_kernel in turned)
        # At the start, a run converts the caller's space momentum m to the body momentum, and then converts
        # the body momentum to the space momentum m_0. At the end, the run converts the new body momentum to
        # the space momentum m_1. The caller receives m + (m_1 - m_0) instead of m_1, because the errors of
        # m_0 and m_1 nearly cancel. The sum m + (m_1 - m_0) needs two additions for each component.
        added = {"add": 2 * len(turned[1].outputs)}
        # The first text counts the operations at the start of a run, and the second text those at the end.
        texts = [sentences({STEP: n})[0] for n in (_plus(there, back), _plus(back, added))]
        first, last = (line.removesuffix(" a step") for line in texts)
        lines.append(f"{first} at the start of a run, {last} at the end of a run")
    for each_kernel in kernel.deferred.kernels if kernel.deferred is not None else ():
        # For a kernel without loops, ``sentences`` returns exactly one line. The kernels in
        # ``kernel.deferred`` have no loops.
        (line,) = sentences(operations(arrange(each_kernel)))
        lines.append(f"{line.removesuffix(' a step')} once in each run")
    return lines


def _counted(
    statements: Iterable[Simple], more: Iterable[Expr], functions: Mapping[str, dict[str, int]]
) -> dict[str, int]:
    total: dict[str, int] = {}
    roots = list(more)
    for statement in statements:
        if isinstance(statement, Invocation):
            vector = vector_function(statement.function)
            inner = functions[statement.function] if vector is None else vector.operations
            total = _plus(total, inner)
            roots += statement.arguments
        elif isinstance(statement, SharedCall):
            total = _plus(total, {statement.function: 1})
            # A call that returns several Stumpff functions counts as one call.
            roots.append(statement.argument)
        else:
            roots.append(statement.value)
    for root in roots:
        total = _plus(total, _operations_in_text(root))
    # Arithmetic operations come first, then calls in alphabetical order.
    first = ("add", "mul", "div")
    return {k: total[k] for k in (*first, *sorted(set(total) - set(first))) if k in total}


def _operations_in_text(root: Expr) -> dict[str, int]:
    """Count the operations in the text of one expression. Repeated subexpressions are counted again."""
    counts: dict[int, dict[str, int]] = {}
    for node in walk([root]):
        match node.op:
            case "const" | "sym" | "neg":
                own = {}
            case "pow":
                # x^n is printed as a product of n factors.
                own = {"mul": node.payload - 1}
            case "call":
                own = {node.payload: 1}
            case "sub":
                own = {"add": 1}
            case op:
                own = {op: 1}
        # The text of a node contains the texts of all its arguments.
        for arg in node.args:
            own = _plus(own, counts[arg.id])
        counts[node.id] = own
    return counts[root.id]


def _plus(a: dict[str, int], b: dict[str, int]) -> dict[str, int]:
    return a | {k: a.get(k, 0) + n for k, n in b.items()}
