"""The measured properties of methods: Table 2.1 of Marthinsen's thesis."""

from __future__ import annotations

import pytest

from codegen.emitter import compile_method
from codegen.lab.long_runs.long_run import long_run
from codegen.lab.long_runs.properties import properties, reversal

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
