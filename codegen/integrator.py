"""Integrators: Python objects whose methods call the code of an emitted module.

A state is a flat sequence of numbers, a NumPy array, or a tuple such as (q, mu). A batch of states is an
array with one state in each row (:mod:`codegen.state_form`). The method ``run_batch`` always returns the
states as an array. The other methods return states of the type that the caller passed.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

from codegen import lanes
from codegen.argument import count, described, end_of_run, input_values, monotone, real, real_array
from codegen.arrival import Arrival as Arrival
from codegen.arrival import Begun, joined
from codegen.arrival import Signals as Signals
from codegen.arrival import Statistics as Statistics
from codegen.arrival import Status as Status
from codegen.arrival import StepFailed as StepFailed
from codegen.artifact import Artifact
from codegen.lanes import BatchRun
from codegen.printers import target as known_target
from codegen.printers.interface import Interface
from codegen.run_to_end import RunToEnd
from codegen.state_form import Fields, State, batch_of, read


class Integrator(RunToEnd):
    """An emitted module that is loaded into Python.

    ``interface`` describes the functions of the module and their arguments. ``defaults`` contains the
    default values of the parameters.
    """

    def __init__(self, interface: Interface, defaults: Mapping[str, float]) -> None:
        self.interface, self.defaults = interface, dict(defaults)
        self.artifact: Artifact | None = None

    @cached_property
    def fields(self) -> Fields:
        """The name and the size of each part of a state, for example of the parts q and mu.

        A state may be given as a tuple of its parts, in the order of ``fields``. If the integrator was not
        loaded from emitted files, ``fields`` is empty.
        """
        entries = () if self.artifact is None else self.artifact.manifest.get("state", ())
        return tuple((entry["name"], len(entry["symbols"])) for entry in entries)

    @property
    def initial(self) -> list[float]:
        """The initial state of the scene.

        TypeError is raised if the integrator was not loaded from emitted files.
        """
        return [float(x) for x in self._manifest("initial")]

    @property
    def span(self) -> tuple[float, float]:
        """The time interval of the scene.

        TypeError is raised if the integrator was not loaded from emitted files.
        """
        first, last = self._manifest("span")
        return float(first), float(last)

    def _manifest(self, key: str) -> Sequence[float]:
        if self.artifact is None or key not in self.artifact.manifest:
            raise TypeError(f"this integrator was not loaded from emitted files, so it has no {key}")
        value: Sequence[float] = self.artifact.manifest[key]
        return value

    def __repr__(self) -> str:
        parameters = ", ".join(self.interface.parameters)
        return f"<integrator {self.interface.module}: {self.interface.size} numbers" + (
            f", parameters {parameters}>" if parameters else ">"
        )

    def __reduce__(self) -> tuple[Callable[..., Integrator], tuple[object, ...]]:
        # A loaded library or module cannot be pickled, so the pickle contains the emitted files.
        if self.artifact is None:
            raise TypeError("only integrators that codegen.load has returned can be pickled")
        interface = self.interface.as_json()
        return _loaded, (self.artifact.manifest["target"], interface, self.defaults, self.artifact)

    def step(
        self,
        state: State,
        h: float,
        t: float = 0.0,
        statistics: Statistics | None = None,
        inputs: Sequence[float] | None = None,
        **parameters: float,
    ) -> State:
        """Return the state after one step of size h. StepFailed is raised if the step fails.

        ``inputs`` are the values of the run-time inputs, in the order of ``interface.inputs``.
        """
        names = self.interface.inputs
        held = input_values(inputs, len(names)) if names and inputs is not None else inputs
        function = None if held is None else lambda t: held
        return self.run(state, h, 1, t, statistics, function, **parameters)

    def run(
        self,
        state: State,
        h: float,
        steps: int,
        t: float = 0.0,
        statistics: Statistics | None = None,
        inputs: Signals | None = None,
        **parameters: float,
    ) -> State:
        """Return the state after ``steps`` steps of size h from time t. StepFailed is raised if a step fails.

        ``inputs`` maps the time to the values of the run-time inputs, in the order of ``interface.inputs``.
        """
        if (batch := batch_of(state, self.interface.size, self.fields)) is not None:
            return batch.joined(
                [self.run(x, h, steps, t, statistics, inputs, **parameters) for x in batch.states]
            )
        begun = self._begin(state, parameters, inputs, statistics)
        final, _ = self._call(begun, real(t, "t"), real(h, "h"), count(steps, "steps"), 0)
        return begun.form.restore(final)

    def trajectory(
        self,
        state: State,
        h: float,
        steps: int | None = None,
        stride: int = 1,
        t: float = 0.0,
        statistics: Statistics | None = None,
        inputs: Signals | None = None,
        *,
        t_eval: Sequence[float] | None = None,
        **parameters: float,
    ) -> State:
        """Return a list of states. Exactly one of the arguments ``steps`` and ``t_eval`` must be given.

        If ``steps`` is given, the list contains the initial state and every ``stride``-th state after it.

        ``t_eval`` is a monotone sequence of times, and ``t`` is the time of the initial state. If ``t_eval``
        is given, the list contains the states at these times. Between two successive times, the steps have
        equal sizes of at most abs(h).
        """
        if (batch := batch_of(state, self.interface.size, self.fields)) is not None:
            rows = [
                self.trajectory(x, h, steps, stride, t, statistics, inputs, t_eval=t_eval, **parameters)
                for x in batch.states
            ]
            return batch.joined(rows)
        if (steps is None) is (t_eval is None):
            raise TypeError("expected exactly one of the arguments steps and t_eval")
        stride, t, h = count(stride, "stride", 1), real(t, "t"), real(h, "h")
        begun = self._begin(state, parameters, inputs, statistics)
        if t_eval is not None:
            return begun.form.restore(self._sampled(begun, t, h, t_eval))
        _, states = self._call(begun, t, h, count(steps, "steps"), stride)
        return begun.form.restore(states)

    def _sampled(self, begun: Begun, t: float, h: float, times: Sequence[float]) -> list[Sequence[float]]:
        """Return the states at ``times``.

        Between two successive times, the steps have equal sizes of at most abs(h).
        """
        if not math.isfinite(h) or h == 0:
            raise ValueError(f"expected a finite step size other than 0, found {h}")
        rows: list[Sequence[float]] = []
        completed = 0
        for time in monotone(t, times):
            # If the exact quotient is an integer n, the computed quotient can be slightly larger than n. With
            # the factor 1 - 1e-12, ``math.ceil`` still returns n, and not n + 1.
            quotient = abs((time - t) / h) * (1 - 1e-12)
            if not math.isfinite(quotient):
                raise ValueError(
                    f"expected a larger step size, found {h}: the number of steps would be infinite"
                )
            steps = count(math.ceil(quotient), "steps")
            if steps:
                try:
                    final, _ = self._call(begun, t, (time - t) / steps, steps, 0)
                except StepFailed as failure:
                    # ``failure`` counts only the steps after the last output time.
                    step = completed + failure.step
                    raise StepFailed(failure.status, step, failure.state, failure.reason) from None
                completed += steps
                begun = replace(begun, numbers=list(final))
            rows.append(begun.numbers)
            t = time
        return rows

    def adaptive(
        self,
        state: State,
        t: float = 0.0,
        end: float | None = None,
        h: float = 0.0,
        *,
        rtol: float = 1e-6,
        atol: float = 1e-9,
        limit: int = 100_000,
        statistics: Statistics | None = None,
        inputs: Signals | None = None,
        t_eval: Sequence[float] | None = None,
        **parameters: float,
    ) -> Arrival:
        """Integrate from t to end with steps as large as the tolerances allow.

        - ``h`` is the size of the first step.
        - ``t_eval`` are times at which a step ends. The result contains the states at these times.
        - ``end`` is the end of the run, by default the last time in ``t_eval``.
        - ``limit`` is the largest number of steps, rejected steps included.

        If ``state`` is a batch, the result contains an array of states, and the total numbers of accepted and
        rejected steps.

        TypeError is raised if the module was emitted without ``adaptive=True``. StepFailed is raised if a
        step fails. If ``limit`` steps are too few, StepFailed is raised with the status ``LIMIT``. If
        ``t_eval`` is given, the attribute ``arrival.states`` of a StepFailed error contains the states at
        those times in ``t_eval`` that the run reached.
        """
        if not self.interface.adaptive:
            raise TypeError("this module has no adaptive run; emit it with adaptive=True")
        t, h, limit = real(t, "t"), real(h, "h"), count(limit, "limit")
        times = None if t_eval is None else monotone(t, t_eval)
        end = end_of_run(t, end, times or ())
        if (batch := batch_of(state, self.interface.size, self.fields)) is not None:
            options = {"rtol": rtol, "atol": atol, "limit": limit, "statistics": statistics}
            arrivals = [
                self.adaptive(x, t, end, h, inputs=inputs, t_eval=t_eval, **options, **parameters)  # type: ignore[arg-type]
                for x in batch.states
            ]
            return joined(arrivals, batch)
        tolerances = (real(rtol, "rtol"), real(atol, "atol"))
        begun = self._begin(state, parameters, inputs, statistics)
        if times is None:
            arrival = self._adapt(begun, (t, end, h), tolerances, limit)
            return replace(arrival, state=begun.form.restore(arrival.state))
        return self._adapt_through(begun, t, [*times, end], h, tolerances, limit)

    def _adapt_through(
        self,
        begun: Begun,
        t: float,
        times: Sequence[float],
        h: float,
        tolerances: tuple[float, float],
        limit: int,
    ) -> Arrival:
        """Integrate with step-size control to the last time in ``times``.

        The result contains the states at all ``times``.
        """
        rows: list[Sequence[float]] = []
        accepted = rejected = 0
        restore = begun.form.restore
        for time in times:
            left = limit - accepted - rejected
            try:
                arrival = self._adapt(begun, (float(t), time, float(h)), tolerances, left)
            except StepFailed as failure:
                # ``failure`` counts only the steps after the last output time.
                failed = StepFailed(failure.status, accepted + failure.step, failure.state, failure.reason)
                if (last := failure.arrival) is not None:
                    accepted, rejected = accepted + last.accepted, rejected + last.rejected
                    failed.arrival = replace(last, accepted=accepted, rejected=rejected, states=restore(rows))
                raise failed from None
            accepted, rejected = accepted + arrival.accepted, rejected + arrival.rejected
            # If only one step led to ``time``, this step may have been shortened to end at ``time``. Then
            # ``arrival.h``, the proposed size of the next step, may be too small, and the larger of ``h`` and
            # ``arrival.h`` is used.
            t, h = time, arrival.h if arrival.accepted > 1 or not h else max(h, arrival.h, key=abs)
            begun = replace(begun, numbers=list(arrival.state))
            rows.append(begun.numbers)
        return Arrival(restore(rows[-1]), t, h, accepted, rejected, restore(rows[:-1]))

    def run_batch(
        self,
        states: State,
        h: float,
        steps: int,
        t: float = 0.0,
        inputs: object = None,
        *,
        out: object = None,
        **parameters: object,
    ) -> BatchRun:
        """Return the states of many independent systems after ``steps`` steps of size h from time t.

        - ``states`` is an array of shape (N, size), or a tuple with an array for each part of the state.
        - ``inputs`` are the values of the M run-time inputs, of shape (M,) or (N, M).
        - ``out`` is an array for the new states, of shape (N, size) in Fortran order. If the array ``states``
          itself is passed as ``out``, the new states replace the old states without a copy.
        - A parameter is a number, or an array of N numbers.

        If a step of a system fails, no error is raised. The result contains the status of each system
        (:class:`Status`), its number of completed steps, and its state after these steps. A module emitted
        with ``batch=True`` uses vector instructions for several systems at once.
        """
        size, real_type, names = self.interface.size, self.interface.format.c_type, self.interface.inputs
        t, h, steps = real(t, "t"), real(h, "h"), count(steps, "steps")
        if bool(names) != (inputs is not None):
            raise TypeError(f"expected {'values for ' + ', '.join(names) if names else 'no inputs'}")
        if out is not None:
            table = lanes.in_place(out, size, real_type)
            if out is not states:
                given = lanes.columns(states, size, real_type, self.fields)
                if given.shape != table.shape:
                    raise ValueError(
                        f"expected {given.shape[1]} states in the argument out, found {table.shape[1]}"
                    )
                table[...] = given
        else:
            table = lanes.columns(states, size, real_type, self.fields)
        number = table.shape[1]
        pairs = lanes.chosen(self.interface.parameters, self.defaults, parameters)
        values = lanes.rows_of(pairs, number, real_type)
        held = lanes.rows_of(_held(names, inputs, number), number, real_type)
        statuses, completed = self._call_batch(table, (t, h, steps), values, held)
        return BatchRun(table.T, statuses, completed)

    def _call_batch(self, table: Any, moment: tuple[float, float, int], values: Any, held: Any) -> Any:
        """Integrate all systems, and replace the states in ``table`` by the new states.

        Return two arrays: the status of each system, and the number of completed steps of each system.
        The arrays ``table``, ``values`` (parameters) and ``held`` (run-time inputs) have one column for each
        system.
        """
        import numpy as np

        (t, h, steps), number = moment, table.shape[1]
        statuses, completed = np.zeros(number, np.int32), np.full(number, steps, np.uintp)
        form, _ = read([0.0] * self.interface.size, self.interface.size)
        for i in range(number):
            inputs = held[:, i].tolist()
            signal = (lambda t, inputs=inputs: inputs) if self.interface.inputs else None
            begun = Begun(form, table[:, i].tolist(), values[:, i].tolist(), signal)
            try:
                table[:, i], _ = self._call(begun, t, h, steps, 0)
            except StepFailed as failure:
                statuses[i], completed[i] = failure.status, failure.step
                table[:, i] = failure.state
        return statuses, completed

    def jacobian(
        self,
        state: State,
        h: float,
        t: float = 0.0,
        inputs: Sequence[float] | None = None,
        **parameters: float,
    ) -> State:
        """Return the derivative of the new state of one step with respect to the old state, as a matrix.

        The header of the emitted module describes the rows and columns of the matrix.

        TypeError is raised if the module was emitted without ``jacobian=True``. StepFailed is raised if the
        step fails.
        """
        if not self.interface.variations:
            raise TypeError("this module has no derivative of its step; emit it with jacobian=True")
        if bool(self.interface.inputs) != (inputs is not None):
            raise TypeError(f"expected values for {', '.join(self.interface.inputs) or 'no inputs'}")
        # C reads one number for each input, so a shorter list would be read beyond its end.
        held = None if inputs is None else list(input_values(inputs, len(self.interface.inputs)))
        form, values = read(state, self.interface.size, self.fields)
        begun = Begun(form, values, self._values(parameters), solvers=self.interface.solvers)
        return form.matrix(self._derive(begun, real(t, "t"), real(h, "h"), held))

    def _begin(
        self,
        state: State,
        parameters: Mapping[str, float],
        inputs: Signals | None,
        statistics: Statistics | None,
    ) -> Begun:
        """Check the arguments of a run, and return an object that contains them.

        TypeError is raised for wrong parameters, ``inputs`` or ``statistics``, and ValueError for a wrong
        state.
        """
        names = self.interface.inputs
        if bool(names) != (inputs is not None):
            raise TypeError(f"expected {'a function for ' + ', '.join(names) if names else 'no inputs'}")
        if inputs is not None and not callable(inputs):
            raise TypeError(
                f"expected a function of time as the argument 'inputs', found {described(inputs)}"
            )
        if statistics is not None and not isinstance(statistics, Statistics):
            raise TypeError(
                f"expected a Statistics object for the argument statistics, found {described(statistics)}"
            )
        form, values = read(state, self.interface.size, self.fields)
        return Begun(
            form,
            values,
            self._values(parameters),
            None if inputs is None else lambda t: input_values(inputs(t), len(names)),
            statistics,
            self.interface.solvers,
        )

    def _values(self, parameters: Mapping[str, float]) -> list[float]:
        known = self.interface.parameters
        for name in parameters:
            if name not in known:
                raise TypeError(f"unknown parameter {name}; the parameters are: {', '.join(known) or 'none'}")
        values = {**self.defaults, **parameters}
        for name in known:
            if name not in values:
                raise TypeError(f"the parameter {name} has no value")
        return [real(values[name], name) for name in known]

    def _count(self, counts: Any, statistics: Statistics | None) -> None:
        """Update ``statistics`` with ``counts``, the numbers of iterations in one call of emitted code."""
        if counts is not None and statistics is not None:
            before = statistics.sweeps or [0] * len(self.interface.blocks)
            statistics.sweeps = [a + b for a, b in zip(before, counts.sweeps, strict=True)]
            statistics.most = max(statistics.most, counts.most)
            statistics.failed = counts.failed
            statistics.matrices += counts.matrices if self.interface.newton else 0

    @abstractmethod
    def _call(
        self, begun: Begun, t: float, h: float, steps: int, stride: int
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        """Return the state after ``steps`` steps of size h, and a sequence of states.

        The sequence contains the initial state and every ``stride``-th state after it. If ``stride`` is 0,
        the sequence is empty.
        """

    @abstractmethod
    def _derive(self, begun: Begun, t: float, h: float, held: list[float] | None) -> list[list[float]]:
        """Return the rows of the Jacobian matrix of one step. ``held`` contains the run-time inputs."""

    @abstractmethod
    def _adapt(
        self, begun: Begun, span: tuple[float, float, float], tolerances: tuple[float, float], limit: int
    ) -> Arrival:
        """Integrate with step-size control. ``span`` is (t, end, h)."""


def _held(names: Sequence[str], inputs: object, number: int) -> list[tuple[str, object]]:
    """Return pairs (name, value) for the run-time inputs.

    M is the length of ``names``, and N is ``number``, the number of systems. If the shape of ``inputs`` is
    neither (M,) nor (N, M), ValueError is raised. TypeError is raised for entries that are not real numbers.
    """
    if not names:
        return []
    table = real_array(inputs, "inputs")
    if table.shape not in ((len(names),), (number, len(names))):
        raise ValueError(
            f"expected inputs of shape ({len(names)},) or ({number}, {len(names)}), found {table.shape}"
        )
    return [(name, table[..., k]) for k, name in enumerate(names)]


def _loaded(
    target: str, interface: dict[str, Any], defaults: Mapping[str, float], artifact: Artifact
) -> Integrator:
    """Load the emitted files in ``artifact``, and return the integrator."""
    integrator = known_target(target).load(Interface.from_json(interface), defaults, artifact.files)
    integrator.artifact = artifact
    return integrator
