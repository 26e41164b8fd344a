"""The functions of a batch, executed with forty digits: each system makes the steps of a scalar run."""

import pytest

from codegen.emitter import compile_method, with_batch
from codegen.ir.domain import PreciseDomain
from codegen.ir.precision import DOUBLE
from codegen.run.execute import Machine
from codegen.run.plan import Plan
from codegen.run.unit import unit_of
from codegen.scene.momentum_frame import start_of


@pytest.mark.parametrize(
    ("scene", "method", "time", "parameters"),
    [("driven_spin", "cf:cf4", True, ("nu",)), ("free_rigid_body", "rkmk:gauss2", False, ())],
)
def test_each_system_makes_the_steps_of_the_scalar_run(scene, method, time, parameters):
    compiled = with_batch(compile_method(scene, method, parameters))
    plan, domain = Plan(compiled.kernel, DOUBLE), PreciseDomain(0, 40)
    machine = Machine(unit_of(plan), domain)
    start, lanes, stride, steps = start_of(compiled.scene), 3, 4, 2
    moment = (domain.rational(1, 2),) if time else ()
    h = domain.rational(1, 20)
    systems = [[machine.number(x) + domain.rational(k, 100) for x in start] for k in range(lanes)]
    # Each row has one more entry than there are systems; nothing reads or writes it.
    rows = [entry for values in zip(*systems, strict=True) for entry in (*values, None)]
    values = [*(domain.rational(2 + k, 1) for k in range(lanes)), None] if parameters else []
    statuses, completed = [7] * lanes, [7] * lanes
    data = (values,) if parameters else ()
    status = machine.call("run_batch", lanes, stride, rows, *moment, h, steps, *data, statuses, completed)
    assert (status, statuses, completed) == (0, [0] * lanes, [steps] * lanes)
    for k, state in enumerate(systems):
        own = (values[k],) if parameters else ()
        rest = (None, 0, *((None,) if plan.counting else ()), [0])
        assert machine.call("run", state, *moment, h, steps, *own, *rest) == 0
        assert rows[k::stride] == state
