"""The Galilean group: its exponential, its action on events, and the order of emitted code."""

from __future__ import annotations

import pytest
from sympy import Matrix, Rational

from codegen.certify import certified_order
from codegen.emitter import compile_method
from codegen.groups import Galilean, Motion
from codegen.groups.linear_algebra import matmul
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.scene import FieldScene
from tests.strategies import sampler


@pytest.mark.parametrize("sample", ["exact, series", "40 digits, uniform"])
def test_the_matrix_of_the_exponential_is_the_exponential_of_the_matrix(sample):
    s = sampler(Galilean(), sample)
    d, x = s.domain, s.vector()
    term = total = s.group.matrix(d, s.group.identity(d))
    for k in range(1, 60):
        term = tuple(d.rational(1, k) * a for a in matmul(s.group.hat(d, x), term, 5))
        total = tuple(a + b for a, b in zip(total, term, strict=True))
    assert s.equal(s.group.matrix(d, s.group.exp(d, x)), total)


def test_a_boost_and_a_delay_move_an_event():
    s = sampler(Galilean(), "exact, series")
    d = s.domain
    one, zero = d.rational(1), d.rational(0)
    boost = (*s.group.identity(d)[:9], one, zero, zero, zero, zero, zero, one)
    event = (zero, zero, zero, d.rational(3))
    assert s.equal(s.group.move(d, boost, event), (d.rational(3), zero, zero, d.rational(4)))


@pytest.mark.parametrize("target", [pytest.param("c", marks=pytest.mark.slow), "python"])
def test_emitted_code_on_events_has_order_four(target):
    group = Galilean()
    y = group.dual("y")[:4]
    turn, boost, shift = [y[1], -y[0], 1], [0, y[3], -y[2]], [y[2], 1, y[0] / 2, 1]
    scene = FieldScene(
        group=group,
        action=Motion(),
        y=Matrix(y),
        f=Matrix([*turn, *boost, *shift]),
        y0=[1, Rational(1, 2), -1, 0],
        span=(0, 1),
        name="events",
    )
    made = compile_method(scene, "rkmk:rk4")
    stated = certified_order(made.method, made.scene)
    assert stated.order == 4
    convergence = converge(Emitted(made, target, stated), stated, reference(scene))
    assert convergence.verdict == "holds", convergence.sentence()
