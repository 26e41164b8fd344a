"""Integrators take states in the forms that people have, and return results in the same form."""

from __future__ import annotations

import pickle
from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from typing import Any

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


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(
    ("state", "message"),
    [
        ((MU, Q), r"parts of 9 and 3 numbers \(in the order q, mu\), found parts of 3 and 9 numbers"),
        (
            (np.array([MU, MU]), np.array([Q, Q])),
            r"\(in the order q, mu\), found parts of 3 and 9 numbers",
        ),
        ((Q[:2], np.zeros(6)), "found parts of 6 and 6 numbers"),
        ((Q,), r"expected 12 numbers in state, found 9; a state is q \(9 numbers\), mu \(3 numbers\)"),
        ([Q, MU], "have different shapes, write one tuple of all parts"),
        ({"q": Q, "mu": MU}, "found an object of type dict"),
    ],
)
def test_parts_in_the_wrong_order_are_refused(target: str, state: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        top(target).step(state, 0.01)


def test_flat_matrices_are_parts_of_a_pair() -> None:
    q, mu = top("python").run((Q.ravel(), MU), 0.01, 5)
    assert flat(q, mu) == top("python").run(flat(Q, MU), 0.01, 5)


def test_rows_of_one_field_may_be_a_tuple() -> None:
    assert rigid("python").run(([0.6], [0.0], [0.8]), 0.1, 1) == tuple(
        [x] for x in rigid("python").run(START, 0.1, 1)
    )


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(
    "state",
    [
        np.array(START)[::-1][::-1],
        np.asfortranarray([START, START])[0],
        np.array(START, dtype=np.float64).astype(">f8"),
        tuple(START),
        [Fraction(3, 5), 0, np.float64(0.8)],
    ],
    ids=["strides", "Fortran order", "byte order", "tuple", "numbers"],
)
def test_every_form_of_the_same_numbers_gives_the_same_result(target: str, state: Any) -> None:
    before = list(state)
    assert list(rigid(target).run(state, 0.1, 5)) == rigid(target).run(START, 0.1, 5)
    assert list(state) == before


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((None, 0.1, 1), "expected real numbers in state, found an object of type NoneType"),
        (((x for x in START), 0.1, 1), "found an object of type generator; write a list"),
        ((["0.6", "0", "0.8"], 0.1, 1), "found '0.6' of type str"),
        ((np.ma.array(START, mask=[1, 0, 0]), 0.1, 1), "found an object of type MaskedArray"),
        (([np.complex64(1j), 0, 0], 0.1, 1), "found 1j of type complex64"),
        (([10**400, 0, 0], 0.1, 1), "a number between -1.8e308 and 1.8e308"),
        ((START, "0.1", 1), "expected a real number for h, found '0.1' of type str"),
        ((START, np.array([0.1]), 1), "expected a real number for h, found an object of type ndarray"),
        ((START, 0.1, 2.0), "expected an integer for steps, found 2.0 of type float"),
        ((START, 0.1, -1), "expected steps to be at least 0, found -1"),
        ((START, 0.1, 10**30), "expected steps to be at most"),
        ((START, 0.1, 1, "0"), "expected a real number for t"),
        ((START, 0.1, 1, 0.0, 3), "expected a Statistics object for the argument statistics"),
    ],
)
def test_wrong_arguments_of_a_run_have_a_message(target: str, arguments: Any, message: str) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        rigid(target).run(*arguments)


def test_no_times_give_no_states() -> None:
    assert rigid("python").trajectory(START, 0.1, t_eval=[]) == []
    assert rigid("python").trajectory(np.array(START), 0.1, t_eval=[]).shape == (0, 3)
    qs, mus = top("python").trajectory((Q, MU), 0.1, t_eval=[])
    assert (qs.shape, mus.shape) == ((0, 3, 3), (0, 3))


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ("abc", "expected a sequence of times for t_eval, found 'abc'"),
        (3.0, "expected a sequence of times for t_eval"),
        (np.array(3.0), "expected a sequence of times for t_eval"),
        ([0, np.nan], "expected finite times in t_eval"),
        ([0, np.inf], "expected finite times in t_eval"),
        ([[0, 1]], "expected a real number for t_eval"),
    ],
)
def test_times_that_are_no_times_have_a_message(times: Any, message: str) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        rigid("python").trajectory(START, 0.1, t_eval=times)


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"end": "1"}, "expected a real number for end"),
        ({"end": 1, "limit": -1}, "expected limit to be at least 0, found -1"),
        ({"end": 1, "limit": 1e5}, "expected an integer for limit"),
        ({"end": 1, "rtol": np.array([1e-3] * 3)}, "expected a real number for rtol"),
        ({"end": 0.5, "t_eval": [0, 1]}, "a run that reaches 1.0, the last time in t_eval, found end = 0.5"),
    ],
)
def test_wrong_arguments_of_an_adaptive_run_have_a_message(target: str, options: Any, message: str) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        rigid(target, True).adaptive(START, **options)


def test_messages_name_the_arguments_of_python() -> None:
    with pytest.raises(TypeError, match="emit it with adaptive=True"):
        rigid("python").adaptive(START, end=1)
    with pytest.raises(TypeError, match="emit it with jacobian=True"):
        rigid("python").jacobian(START, 0.1)


def test_wrong_times_have_a_message() -> None:
    with pytest.raises(ValueError, match="in increasing or decreasing order"):
        rigid("python").trajectory(START, 0.1, t_eval=[0, 1, 0.5])
    with pytest.raises(TypeError, match="exactly one of the arguments steps and t_eval"):
        rigid("python").trajectory(START, 0.1)
    with pytest.raises(TypeError, match="the argument 'end' is missing"):
        rigid("python", True).adaptive(START)
    module = codegen.load(codegen.emit("free_rigid_body", "cf:cf4", target="python", integrate=True))
    with pytest.raises(TypeError, match="the argument 'end' is missing"):
        module.integrate(START, 0, h=0.1)


@pytest.mark.parametrize(("family", "order"), [("", 4), ("cg", 2), ("rkmk(1)", 3)])
def test_a_tableau_of_floats_is_emitted_in_the_family_of_choice(family: str, order: int) -> None:
    weights = np.array([1, 2, 2, 1]) / 6
    rows = [[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1, 0]]
    artifact = codegen.emit("free_rigid_body", Tableau.rk(rows, weights), target="python", family=family)
    assert artifact.manifest["order"] == order
    exact = codegen.emit("free_rigid_body", f"{family or 'rkmk(2)'}:rk4", target="python")
    ends = [codegen.load(x).run(START, 0.1, 10) for x in (artifact, exact)]
    assert np.allclose(*ends, rtol=0, atol=1e-14)
