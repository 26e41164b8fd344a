"""Integrators that execute emitted Python modules."""

from __future__ import annotations

import types
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from codegen.arrival import Arrival, Begun, Reached
from codegen.event import EventValues
from codegen.integrator import Integrator
from codegen.printers.interface import Interface


class InterpretedIntegrator(Integrator):
    """An integrator that executes an emitted Python module. ``source`` is the text of the module."""

    def __init__(self, interface: Interface, defaults: Mapping[str, float], source: str) -> None:
        super().__init__(interface, defaults)
        self.module = types.ModuleType(interface.module)
        exec(compile(source, f"{interface.module}.py", "exec"), self.module.__dict__)

    def _call(
        self, begun: Begun, t: float, h: float, steps: int, stride: int
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        time, sampled = [t] if self.interface.time else [], [] if begun.inputs is None else [begun.inputs]
        with self._observed(begun) as counted:
            arguments = [begun.numbers, *time, h, steps, *sampled, *begun.values]
            answer = self.module.run(*arguments, stride=stride, **counted)
        return (answer[-1], answer) if stride else (answer, [])

    def _adapt(
        self, begun: Begun, span: tuple[float, float, float], tolerances: tuple[float, float], limit: int
    ) -> Arrival:
        t, end, h = span
        sampled = [] if begun.inputs is None else [begun.inputs]
        keywords: dict[str, Any] = dict(zip(("rtol", "atol"), tolerances, strict=True)) | {"limit": limit}
        keywords |= dict(zip(self.interface.parameters, begun.values, strict=True))
        with self._observed(begun) as counted:
            return Arrival(
                *self.module.run_adaptive(begun.numbers, t, end, *sampled, h, **keywords, **counted)
            )

    def _integrate(
        self,
        begun: Begun,
        values: EventValues,
        span: tuple[float, float, float],
        bounds: tuple[float, ...],
        limit: int,
        times: Sequence[float],
    ) -> Reached:
        interface, (t, end, h) = self.interface, span
        sampled = [] if begun.inputs is None else [begun.inputs]
        keywords: dict[str, Any] = dict(zip(interface.parameters, begun.values, strict=True))
        keywords |= {"limit": limit, "times": times}
        if interface.controlled:
            keywords |= dict(zip(("rtol", "atol", "least", "greatest"), bounds, strict=True))
        if interface.events:
            keywords |= {"event": values, "stops": [event.stops for event in values.events]}
        counts = self.module.Statistics() if interface.blocks else None
        if counts is not None:
            keywords["statistics"] = counts
        why = ""
        try:
            done = self.module.integrate(begun.numbers, t, end, *sampled, h, **keywords)
        except self.module.StepFailed as failure:
            done, why = failure.arrival, failure.reason
        finally:
            self._count(counts, begun.statistics)
        events = [(k, time, direction, state) for time, k, direction, state in done.events]
        return Reached(
            *(done.status, done.state, done.t, done.h, done.rows, events),
            *(done.accepted, done.rejected, why),
        )

    def _derive(self, begun: Begun, t: float, h: float, held: list[float] | None) -> list[list[float]]:
        time, inputs = [t] if self.interface.time else [], [] if held is None else [held]
        try:
            return list(self.module.jacobian(begun.numbers, *time, h, *inputs, *begun.values))
        except self.module.StepFailed as failure:
            raise begun.failed(failure.status, 0, begun.numbers, failure.reason) from None

    @contextmanager
    def _observed(self, begun: Begun) -> Iterator[dict[str, Any]]:
        """Yield the keyword arguments for a call of the emitted module. This function is a context manager,
        and the call must be in its ``with`` block.

        At the end of the block, the numbers of iterations are added to ``begun.statistics``. If the emitted
        module raises its exception ``StepFailed``, this function raises :class:`codegen.arrival.StepFailed`.
        """
        counts = self.module.Statistics() if self.interface.blocks else None
        try:
            yield {} if counts is None else {"statistics": counts}
        except self.module.StepFailed as failure:
            failed = begun.failed(failure.status, failure.step, failure.state, failure.reason)
            if hasattr(failure, "t"):
                failed.arrival = Arrival(
                    *(failed.state, failure.t, failure.h, failure.step, failure.rejected),
                    status=failed.status,
                )
            raise failed from None
        finally:
            self._count(counts, begun.statistics)
