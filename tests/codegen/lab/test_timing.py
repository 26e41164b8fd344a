"""What timing does with the clock, shown with a clock of our own; no real time is asserted."""

from __future__ import annotations

import pytest

from codegen.lab import timing


class Clock:
    """CPU time that passes only when a run says so; ``disturb`` makes the first calls take longer.

    ``tick`` is the resolution of the clock of the process. The time of other threads is added to ``others``.
    """

    def __init__(self) -> None:
        self.now, self.disturb, self.others = 0.0, 0, 0.0
        self.tick: float | None = None

    def process_time(self) -> float:
        return self.now if self.tick is None else self.now // self.tick * self.tick

    def thread_time(self) -> float:
        return self.now - self.others

    def run(self, steps: int) -> None:
        self.now += 2e-6 + 50e-9 * steps + (40e-6 if self.disturb > 0 else 0.0)
        self.disturb -= 1


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    made = Clock()
    monkeypatch.setattr(timing, "time", made)
    return made


def test_what_a_call_costs_before_its_first_step_is_taken_off(clock: Clock) -> None:
    for found in timing.timings(clock.run, (10, 1000), batch=1e-3):
        assert found.ns_per_step == pytest.approx(50, rel=1e-6)


def test_a_disturbed_batch_does_not_count(clock: Clock) -> None:
    clock.disturb = 100
    assert timing.cost(lambda: clock.run(0), batch=1e-3) == pytest.approx(2e-6, rel=1e-6)


def test_a_batch_lasts_long_enough_for_the_clock(clock: Clock) -> None:
    timing.cost(lambda: clock.run(0), batch=1e-2, batches=3)
    assert clock.now >= 3e-2


def test_a_coarse_clock_of_the_process_makes_no_batch_last_nothing(clock: Clock) -> None:
    clock.tick = 4e-3
    found = timing.samples(lambda: clock.run(0), batch=1e-3)
    assert found[0] == pytest.approx(2e-6, rel=1e-6)


def test_the_time_of_other_threads_counts(clock: Clock) -> None:
    def call() -> None:
        clock.now += 1e-3
        clock.others += 1e-3

    assert timing.cost(call, batch=1e-2) == pytest.approx(1e-3)


def test_no_time_is_negative(clock: Clock) -> None:
    (found,) = timing.timings(lambda n: clock.run(0), (7,), batch=1e-4)
    assert found.seconds >= 0


def test_batches_are_repeated_until_two_agree_on_the_least_time(clock: Clock) -> None:
    times = iter([9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.01, 1.0, 0.5])

    def call() -> None:
        clock.now += next(times)

    found = timing.samples(call, batch=1e-3)
    assert len(found) == timing.FEWER  # a call that is longer than LONG is not repeated
    times = iter([1e-3 * x for x in (9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.01, 1.0, 0.5)])
    assert timing.samples(call, batch=1e-3)[:2] == pytest.approx((1e-3, 1.01e-3))


def test_batches_that_never_agree_end(clock: Clock) -> None:
    times = iter(0.1 / 2**k for k in range(100))

    def call() -> None:
        clock.now += next(times)

    assert len(timing.samples(call, batch=1e-30)) == timing.MOST


def test_a_short_run_is_timed_over_as_many_spans_as_the_clock_needs(clock: Clock) -> None:
    assert timing.spans(lambda n: clock.run(4 * n), 4) == 32  # 64 spans would have more than 200 steps
    clock.disturb = 1
    assert timing.spans(lambda n: clock.run(4000 * n), 4) == 1
    assert timing.spans(lambda n: clock.run(250 * n), 4) == 8  # 8 spans take 0.1 ms, 4 spans take half


def test_a_long_run_of_few_steps_is_never_timed_over_several_spans(clock: Clock) -> None:
    """A single step of many equations may take a second."""
    asked: list[int] = []

    def run(spans: int) -> None:
        asked.append(spans)
        clock.now += float(spans)

    assert timing.spans(run, 1) == 1
    assert set(asked) == {1}


def test_a_solution_that_ends_soon_after_the_span_is_timed_over_the_spans_that_it_has(clock: Clock) -> None:
    def run(spans: int) -> None:
        if spans > 3:
            raise ArithmeticError
        clock.run(spans)

    assert timing.spans(run, 1) == 2


def overhead_of(*times: float) -> timing.Overhead:
    """An overhead that was measured before, and that is not measured again."""
    known = timing.Overhead(None)
    known.times = times
    return known


def test_a_short_run_is_measured_until_its_time_without_the_overhead_is_resolved() -> None:
    batches = iter([(1.2e-6, 1.9e-6), (1.5e-6, 1.3e-6), (1.105e-6, 1.1e-6), (9.0, 9.0)])
    found = timing.net_times(lambda: next(batches), overhead_of(9e-7))
    assert found[:2] == pytest.approx([2e-7, 2.05e-7])
    assert next(batches) == (9.0, 9.0)


def test_an_uncertain_overhead_leaves_a_short_run_unresolved(clock: Clock) -> None:
    """The run is resolved only when both of its fastest batches and both of the overhead agree."""
    measured = iter([(2e-6, 2.5e-6), (2e-6, 2.01e-6)])
    overhead = timing.Overhead(lambda: clock.run(0))
    overhead.times = next(measured)
    asked = 0

    def sample() -> tuple[float, float]:
        nonlocal asked
        asked += 1
        return (3e-6, 3.01e-6)

    assert timing.net_times(sample, overhead)[0] == pytest.approx(1e-6)
    assert asked == 2  # the refined overhead is certain: its two fastest batches take 2 µs each
    assert overhead.uncertainty < 1e-9


def test_a_run_that_is_never_resolved_and_a_long_run_end() -> None:
    noisy = iter([(2.0 ** -(20 + k), 1e-5) for k in range(10)])
    assert len(timing.net_times(lambda: next(noisy), overhead_of(0.0))) == 2 * (1 + timing.AGAIN)
    assert timing.net_times(lambda: (1.0, 2.0), overhead_of(0.5)) == [0.5, 1.5]
    assert set(timing.net_times(lambda: (1e-6,), overhead_of(1e-5))) == {1e-7}  # no run has the time zero


def test_the_overhead_of_a_module_is_measured_once(clock: Clock) -> None:
    idle = 0

    def run(spans: int) -> int:
        nonlocal idle
        idle += spans == 0
        clock.run(100 * spans)
        return 100 * spans

    overhead = timing.Overhead(lambda: run(0))
    assert timing.span_times(run, overhead)[0] == pytest.approx(5e-6, rel=1e-6)
    known = idle
    for _ in range(3):
        timing.span_times(run, overhead)
    assert idle == known > 0


@pytest.mark.parametrize("overhead", [1e-7, 1e-6, 2e-5])
def test_the_time_of_a_span_depends_neither_on_the_overhead_nor_on_the_number_of_spans(
    monkeypatch: pytest.MonkeyPatch, overhead: float
) -> None:
    """A run of 8 steps on its first span and of 12 on each later one; a step takes 50 ns."""
    clock = Clock()
    monkeypatch.setattr(timing, "time", clock)

    def run(spans: int) -> int:
        steps = 12 * spans - 4 * (spans > 0)
        clock.now += overhead + 50e-9 * steps
        return steps

    assert timing.spans(run, run(1)) > 1
    assert timing.span_times(run, timing.Overhead(lambda: run(0)))[0] == pytest.approx(8 * 50e-9, rel=1e-6)
