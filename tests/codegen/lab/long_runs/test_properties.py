"""The measured properties of methods: Table 2.1 of Marthinsen's thesis."""

from __future__ import annotations

from functools import cache

import pytest

from codegen.emitter import Compiled, compile_method
from codegen.groups import Rn
from codegen.lab.long_runs.long_run import long_run
from codegen.lab.long_runs.properties import properties, reversal
from codegen.scene import HamiltonianScene

PRINTED = {
    "rkmk(0):euler": (False, False, False),
    "rkmk(0):midpoint": (False, True, True),
    "slgi:euler": (True, False, True),
    "slgi:midpoint": (True, True, True),
}
"""Symplectic, symmetric, no drift of the energy."""


def test_a_symmetric_step_returns_and_euler_does_not():
    assert reversal(compile_method("free_rigid_body", "rkmk:midpoint"), 0.1) < 1e-40
    assert reversal(compile_method("free_rigid_body", "rkmk(0):euler"), 0.1) > 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("method", PRINTED)
def test_the_properties_of_the_theta_methods_are_those_of_table_2_1(method):
    compiled = compile_method("heavy_top", method)
    row = properties(compiled, long_run(compiled, 0.05, 100_000, back=False))
    assert (row.symplectic, row.symmetric, row.steady) == PRINTED[method]
    assert row.quantity == "energy"


@cache
def on_the_oscillator(method: str) -> Compiled:
    G = Rn(1)
    q, p = G.point("q"), G.dual("p")
    T, V = p[0] ** 2 / 2, q[0] ** 2 / 2
    parts = {"T": T, "V": V}
    scene = HamiltonianScene(group=G, q=q, mu=p, H=T + V, parts=parts, q0=[1], mu0=[0], span=(0, 10))
    return compile_method(scene, method)


@pytest.mark.parametrize(
    ("method", "expected"),
    [
        ("taylor(12)", (False, False, None)),
        ("taylor(40)", (False, False, None)),
        ("ambient:gauss2", (True, True, True)),
        ("splitting:strang", (True, True, None)),
    ],
)
def test_short_steps_of_accurate_methods_have_no_property_of_the_exact_flow(method, expected):
    """The run has a sixth of a period. Its defects are far below the limits, also if the order is only 12."""
    made = on_the_oscillator(method)
    row = properties(made, long_run(made, 1e-3, 1000, back=False))
    assert (row.symplectic, row.symmetric, row.steady) == expected


def test_a_symmetric_method_with_rounded_coefficients_is_symmetric(monkeypatch):
    made = on_the_oscillator("ambient:gauss2")
    run = long_run(made, 0.1, 100, back=False)
    monkeypatch.setattr("codegen.lab.long_runs.properties.reversal", lambda compiled, h: 1e-17)
    assert properties(made, run).symmetric is False
    monkeypatch.setattr("codegen.lab.long_runs.properties._is_rounded", lambda method: True)
    assert properties(made, run).symmetric is True
