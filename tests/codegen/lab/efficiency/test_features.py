"""Properties of emitted methods are derived."""

from __future__ import annotations

import pytest

from codegen.emitter import compile_method, emit_compiled
from codegen.lab.default_methods import REPORT_FIELDS, report_methods
from codegen.lab.efficiency.features import features, is_symplectic
from codegen.scenes import load


@pytest.mark.parametrize(
    ("scene", "method", "expected"),
    [
        ("dipole", "vcg:midpoint", True),
        ("dipole", "cf:cf4", False),
        ("linear_oscillator", "rk:gauss2", True),
        ("linear_oscillator", "rk:rk4", False),
        ("linear_oscillator", "splitting:strang", True),
        ("free_rigid_body", "cf:cf4", False),
        ("duffing", "rk:gauss1", False),
        ("duffing", "discrete_gradient:midpoint", False),
    ],
)
def test_symplecticity_follows_from_family_group_and_tableau(scene, method, expected):
    assert is_symplectic(compile_method(scene, method)) is expected


@pytest.mark.parametrize(
    ("method", "on_manifold", "explicit"),
    [("cf:cf4", True, True), ("ambient:rk4", False, True), ("rkmk(1):gauss1", True, False)],
)
def test_features_are_those_of_the_emitted_step(method, on_manifold, explicit):
    compiled = compile_method("free_rigid_body", method)
    emission = emit_compiled(compiled, "c")
    found = features(compiled, emission)
    assert (found.on_manifold, found.explicit, found.symplectic) == (on_manifold, explicit, False)
    assert found.stack > 8 * 3
    assert found.lines == emission.files[f"{emission.manifest['module']}.c"].count("\n")


def test_default_methods_have_their_order_on_the_scene():
    methods, controlled = report_methods(load("free_rigid_body"))
    assert [m.label for m in methods] == list(REPORT_FIELDS)
    assert all(m.adaptive and m.embedded() is not None for m in controlled)
