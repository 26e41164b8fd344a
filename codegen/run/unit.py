"""Build the unit of a kernel: the functions, records and tables of the emitted module."""

from __future__ import annotations

from codegen.ir.linear_array_step import LinearArrayStep
from codegen.run import (
    batch,
    deferred_flows,
    integration,
    jacobian,
    site_flows,
    sites,
    step_control,
    taylor_control,
)
from codegen.run.arithmetic import outlined
from codegen.run.array_step import array_functions, array_tables
from codegen.run.cause import cause, is_searched, step_arguments
from codegen.run.continuation import continued
from codegen.run.language import Function, Record, Table, Unit
from codegen.run.linear_array_step import linear_array_functions, linear_array_tables
from codegen.run.matrix_functions import matrix_functions, matrix_tables, used
from codegen.run.momentum import turning
from codegen.run.plan import Plan
from codegen.run.statistics import counters, statistics_record
from codegen.run.step import ADVANCE, composed_step, core, kernel_step, substep_tables
from codegen.run.trajectory import is_looped, looped_runs, run, step
from codegen.run.warm_start import WarmStart, differences, memory_record


def unit_of(plan: Plan) -> Unit:
    """Return all functions, records and tables of the emitted module."""
    # Each function comes after the functions that it calls, because C needs a declaration before a call.
    if plan.kernel.sites is not None:
        scalars = ("t", "h", *(p.text for p in plan.parameters))
        step = plan.kernel.sites
        # If the step is a composition of flows, :mod:`codegen.run.site_flows` builds the functions.
        of_sites = site_flows.functions if step.flows else sites.functions
        listed = of_sites(plan, step)
        # The functions for matrix exponentials and inverses come before the functions that call them.
        vectors = used(listed)
        listed = [*matrix_functions(vectors, plan.format), *listed]
        return Unit(scalars, (), matrix_tables(vectors, plan.format), tuple(listed))
    functions = [outlined(function, arranged) for function, arranged in plan.arrangement.outlined]
    # For deferred flows, the module :mod:`codegen.run.deferred_flows` builds the functions.
    if plan.kernel.deferred is not None:
        functions += deferred_flows.functions(plan)
    else:
        functions += _steps(plan)
    functions += (*step_control.functions(plan), *taylor_control.functions(plan), *jacobian.functions(plan))
    functions += integration.functions(plan)
    functions += batch.functions(plan)
    # The names t and h are reserved, even if the kernel does not use them.
    scalars = ("t", "h", *(p.text for p in plan.parameters))
    # The functions for matrix exponentials and inverses are added only if other functions call them.
    vectors = used(functions)
    functions = [*matrix_functions(vectors, plan.format), *functions]
    tables = (*_tables(plan), *matrix_tables(vectors, plan.format))
    return Unit(scalars, _records(plan), tables, tuple(functions))


def _steps(plan: Plan) -> list[Function]:
    """Return the functions for a step and a run, each after the functions that it calls."""
    listed: list[Function] = []
    if plan.counting:
        listed += counters(plan)
    if plan.start is not None:
        listed += WarmStart(plan).functions()
    # If ``is_looped(plan)`` is true, ``step`` calls ``run``. Therefore ``step`` comes last.
    if is_looped(plan):
        return [*listed, *turning(plan), *looped_runs(plan), step(plan)]
    if plan.kernel.arrays is not None:
        return [*listed, *_array_functions(plan), *_causes(plan), step(plan), run(plan)]
    if not plan.kernel.outputs:
        return [*listed, *taylor_control.polynomial_step(plan), *_causes(plan), step(plan), run(plan)]
    listed.append(kernel_step(plan))
    if plan.start is not None:
        # The function ``continued`` repeats a failed step. ``continued`` calls the function that contains the
        # kernel, so ``continued`` comes later in the list.
        listed.append(continued(plan, core(plan)))
    if plan.parts:
        listed.append(composed_step(plan))
    return [*listed, *_causes(plan), *turning(plan), step(plan), run(plan)]


def _array_functions(plan: Plan) -> tuple[Function, ...]:
    """Return the functions of a step that is computed by loops over arrays."""
    arrays = plan.kernel.arrays
    assert arrays is not None
    if isinstance(arrays, LinearArrayStep):
        return linear_array_functions(plan, arrays)
    return array_functions(plan, arrays)


def _causes(plan: Plan) -> list[Function]:
    """Return a list with the function that finds the cause of a failed step.

    If the kernel has a warm start or run-time inputs, the list is empty (reasons:
    :func:`codegen.run.cause.is_searched`).
    """
    return [cause(plan, ADVANCE, step_arguments(plan))] if is_searched(plan) else []


def _records(plan: Plan) -> tuple[Record, ...]:
    listed = [statistics_record(plan)] if plan.counting else []
    return (*listed, *([memory_record(plan)] if plan.remembers else []))


def _tables(plan: Plan) -> tuple[Table, ...]:
    listed = [differences(plan.start)] if plan.start is not None else []
    arrays = plan.kernel.arrays
    own: tuple[Table, ...] = ()
    if isinstance(arrays, LinearArrayStep):
        own = linear_array_tables(arrays, plan.format)
    elif arrays is not None:
        own = array_tables(arrays, plan.format)
    return (*listed, *substep_tables(plan), *own)
