"""Integrators take states in the forms that people have, and return results in the same form."""

from __future__ import annotations

import pickle
from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest

import codegen
from codegen.integrator import Integrator
from orderconds import Tableau

START = [0.6, 0.0, 0.8]
TARGETS = ("python", "c")


@cache
def rigid(target: str, adaptive: bool = False) -> Integrator:
    method = "cf43" if adaptive else "cf4"
    return codegen.load(codegen.emit("free_rigid_body", method, target=target, adaptive=adaptive))


@cache
def top(target: str) -> Integrator:
    return codegen.load(codegen.emit("heavy_top", "vcg:midpoint", target=target))


def flat(q: np.ndarray, mu: np.ndarray) -> list[float]:
    return [*map(float, q.ravel()), *map(float, mu)]


Q = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
MU = np.array([0.1, 0.5, 2.0])


@pytest.mark.parametrize("target", TARGETS)
def test_a_pair_gives_the_numbers_of_the_flat_state(target: str) -> None:
    q, mu = top(target).run((Q, MU), 0.01, 20)
    assert flat(q, mu) == top(target).run(flat(Q, MU), 0.01, 20)
    lists = top(target).run((Q.tolist(), MU.tolist()), 0.01, 20)
    assert lists == (q.tolist(), mu.tolist())


@pytest.mark.parametrize("target", TARGETS)
def test_the_trajectory_of_a_pair_is_a_pair_of_trajectories(target: str) -> None:
    qs, mus = top(target).trajectory((Q, MU), 0.01, 4)
    rows = top(target).trajectory(flat(Q, MU), 0.01, 4)
    assert (qs.shape, mus.shape) == ((5, 3, 3), (5, 3))
    assert [flat(q, mu) for q, mu in zip(qs, mus, strict=True)] == rows


@pytest.mark.parametrize("target", TARGETS)
def test_a_batch_gives_the_results_of_its_states(target: str) -> None:
    states = np.array([START, [0.0, 0.6, 0.8], [0.0, 0.0, 1.0]])
    ends = rigid(target).run(states, 0.1, 10)
    assert np.array_equal(ends, [rigid(target).run(state, 0.1, 10) for state in states])
    assert rigid(target).trajectory(states, 0.1, 10, 5).shape == (3, 3, 3)
    q, mu = top(target).run((np.array([Q, Q]), np.array([MU, 2 * MU])), 0.01, 5)
    assert (q.shape, mu.shape) == ((2, 3, 3), (2, 3))
    assert flat(q[1], mu[1]) == top(target).run(flat(Q, 2 * MU), 0.01, 5)


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("sign", [1, -1])
def test_states_at_times_are_those_of_equal_steps_between_the_times(target: str, sign: int) -> None:
    times = [sign * t for t in (0.0, 0.3, 0.35, 0.35, 1.0)]
    found = rigid(target).trajectory(np.array(START), 0.1, t_eval=times)
    assert found.shape == (5, 3)
    expected: Sequence[float] = START
    assert np.array_equal(found[0], START)
    for k, (steps, h) in enumerate(((3, 0.1), (1, 0.05), (0, 0.1), (7, 0.65 / 7)), start=1):
        expected = rigid(target).run(list(expected), sign * h, steps)
        assert np.allclose(found[k], expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("target", TARGETS)
def test_an_adaptive_run_through_times_ends_at_the_last_time(target: str) -> None:
    times = [0.0, 0.5, 1.0, 2.0]
    arrival = rigid(target, True).adaptive(np.array(START), t_eval=times, rtol=1e-9, atol=1e-9)
    whole = rigid(target, True).adaptive(START, t=0, end=2.0, rtol=1e-9, atol=1e-9)
    assert (arrival.t, arrival.states.shape) == (2.0, (4, 3))
    assert np.allclose(arrival.state, whole.state, rtol=0, atol=1e-7)
    assert np.array_equal(arrival.states[-1], arrival.state)
    batch = rigid(target, True).adaptive(np.array([START, START]), end=2.0, rtol=1e-9, atol=1e-9)
    assert np.array_equal(batch.state[0], whole.state)
    assert batch.accepted == 2 * whole.accepted


@pytest.mark.parametrize("target", TARGETS)
def test_a_pickled_integrator_gives_the_same_numbers(target: str) -> None:
    again = pickle.loads(pickle.dumps(rigid(target)))
    assert again.run(START, 0.1, 10) == rigid(target).run(START, 0.1, 10)
    assert (again.initial, again.span, repr(again)) == (
        rigid(target).initial,
        rigid(target).span,
        repr(rigid(target)),
    )


@pytest.mark.parametrize(
    ("state", "message"),
    [
        ([0.6, 0.8], "expected 3 numbers in state, found 2"),
        (np.zeros(4), "expected 3 numbers in state, found 4"),
        ([[0.6, 0.0], [0.8]], "rows of equal lengths"),
        (np.array([0.6, 0.0, 0.8j]), "expected real numbers in state, found an array of type complex128"),
        ([0.6, 0.0, 0.8j], "expected real numbers in state, found 0.8j"),
        (np.zeros((2, 4)), "expected 3 numbers in state, found 8"),
    ],
)
def test_a_wrong_state_has_a_message(state: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        rigid("python").run(state, 0.1, 1)


def test_wrong_times_have_a_message() -> None:
    with pytest.raises(ValueError, match="increase or decrease"):
        rigid("python").trajectory(START, 0.1, t_eval=[0, 1, 0.5])
    with pytest.raises(TypeError, match="either steps or t_eval"):
        rigid("python").trajectory(START, 0.1)
    with pytest.raises(TypeError, match="expected end"):
        rigid("python", True).adaptive(START)


@pytest.mark.parametrize(("family", "order"), [("", 4), ("cg", 2), ("rkmk(1)", 3)])
def test_a_tableau_of_floats_is_emitted_in_the_family_of_choice(family: str, order: int) -> None:
    weights = np.array([1, 2, 2, 1]) / 6
    rows = [[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1, 0]]
    artifact = codegen.emit("free_rigid_body", Tableau.rk(rows, weights), target="python", family=family)
    assert artifact.manifest["order"] == order
    exact = codegen.emit("free_rigid_body", f"{family or 'rkmk(2)'}:rk4", target="python")
    ends = [codegen.load(x).run(START, 0.1, 10) for x in (artifact, exact)]
    assert np.allclose(*ends, rtol=0, atol=1e-14)
