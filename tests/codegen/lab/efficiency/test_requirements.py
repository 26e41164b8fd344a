"""Recommendations: properties are derived, and the fastest method that meets a requirement is named."""

from __future__ import annotations

import pytest

from codegen.emitter import compile_method, emit_compiled
from codegen.lab.default_methods import REPORT_FIELDS, report_methods
from codegen.lab.efficiency.requirements import DECADES, NEEDS, Features, advise, features, is_symplectic
from codegen.lab.efficiency.work_precision import Row
from codegen.scenes import load


def run(label: str, error: float, seconds: float, target: str = "c") -> Row:
    counts = (None, None, None)
    return Row("", label, target, 1.0, None, None, error, seconds, None, None, *counts, 0.0, 0.0)


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


def test_the_fastest_method_that_meets_a_requirement_is_named():
    flat = Features("flat", False, False, True, False, 100, 10)
    kept = Features("kept", True, True, False, False, 100, 10)
    entries = {
        "flat": [run("flat", 1e-7, 1.0)],
        "kept": [run("kept", 1e-10, 5.0)],
        "peer": [run("peer", 1e-13, 0.1, "peer")],
    }
    found = {a.need: a.best for a in advise(entries, (flat, kept))}
    nothing = (None,) * len(DECADES)
    assert found["any emitted method"] == (("flat", 1.0), ("flat", 1.0), ("kept", 5.0), None)
    assert found["on the manifold"] == (("kept", 5.0),) * 3 + (None,)
    assert found["symplectic"] == found["on the manifold"]
    assert found["explicit"] == (("flat", 1.0), ("flat", 1.0), None, None)
    assert found["embedded target"] == found["explicit"]
    assert found["adaptive"] == nothing
    assert found["a peer, for comparison"] == (("peer", 0.1),) * 4
    assert [a.need for a in advise({}, ())] == [need.name for need in NEEDS]


def test_default_methods_have_their_order_on_the_scene():
    methods, controlled = report_methods(load("free_rigid_body"))
    assert [m.label for m in methods] == list(REPORT_FIELDS)
    assert all(m.adaptive and m.embedded() is not None for m in controlled)
