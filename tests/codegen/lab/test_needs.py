"""Advice follows needs: what a method has is derived, and the fastest that has it is named."""

from __future__ import annotations

import pytest

from codegen.emitter import compile_method, emit_compiled
from codegen.lab.contest import Row
from codegen.lab.needs import DECADES, NEEDS, Features, advise, features, is_symplectic
from codegen.lab.survey import OF_FIELDS, usual
from codegen.scenes import load


def rung(label: str, error: float, seconds: float, target: str = "c") -> Row:
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
    ],
)
def test_what_is_symplectic_follows_from_family_group_and_tableau(scene, method, expected):
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


def test_the_fastest_that_has_what_is_needed_is_named():
    flat = Features("flat", False, False, True, False, 100, 10)
    kept = Features("kept", True, True, False, False, 100, 10)
    entries = {
        "flat": [rung("flat", 1e-7, 1.0)],
        "kept": [rung("kept", 1e-10, 5.0)],
        "peer": [rung("peer", 1e-13, 0.1, "peer")],
    }
    found = {a.need: a.best for a in advise(entries, (flat, kept))}
    nothing = (None,) * len(DECADES)
    assert found["any emitted method"] == (("flat", 1.0), ("flat", 1.0), ("kept", 5.0), None)
    assert found["on the manifold"] == (("kept", 5.0),) * 3 + (None,)
    assert found["symplectic"] == found["on the manifold"]
    assert found["explicit"] == (("flat", 1.0), ("flat", 1.0), None, None)
    assert found["embedded target"] == found["explicit"]
    assert found["adaptive"] == nothing
    assert found["a peer, to compare"] == (("peer", 0.1),) * 4
    assert [a.need for a in advise({}, ())] == [need.name for need in NEEDS]


def test_what_is_usual_has_its_order_on_the_scene():
    methods, choosing = usual(load("free_rigid_body"))
    assert [m.label for m in methods] == list(OF_FIELDS)
    assert all(m.adaptive and m.embedded() is not None for m in choosing)
