"""Every group in emitted code: fields and Hamiltonians without symmetry, of exact order, as interpreted."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest

from codegen.emitter import compile_method, emit_compiled
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.lab.orders.local_error import local_error, valuation
from codegen.loader import load
from orderconds.ring import QQ
from tests.promises import ulps
from tests.strategies import field_scene, hamiltonian_scene

FIELDS = [
    (place, method, order)
    for place in ("S^3", "SL(2)", "SE(2)", "SO(3) x R^2")
    for method, order in (("rkmk:rk4", 4), ("cg:cg3", 3), ("rkmk(0):midpoint", 2))
]
HAMILTONIANS = [
    (group, method, order)
    for group in ("S^3", "SE(2)", "SO(3) x R^2")
    for method, order in (("vcg:midpoint", 2), ("vrkmk(1):kutta3", 3), ("cf:cf4", 4), ("slgi:midpoint", 2))
]


def tried(kind, prefix, cases):
    """Return the parameters of the tests: every second pair of a group and a method is for the slow run."""
    places, methods = (list(dict.fromkeys(case[k] for case in cases)) for k in (0, 1))
    return [
        pytest.param(
            *(kind, place, method, order),
            id=f"{prefix}{place}-{method}-{order}",
            marks=pytest.mark.slow if (places.index(place) + methods.index(method)) % 2 else (),
        )
        for place, method, order in cases
    ]


ALL = [*tried("field", "", FIELDS), *tried("hamiltonian", "T*", HAMILTONIANS)]
"""Every run tries each group and each method."""


@cache
def compiled(kind, place, method):
    scene = field_scene(place) if kind == "field" else hamiltonian_scene(place)
    return compile_method(replace(scene, span=(Fraction(0), Fraction(1, 8))), method)


@pytest.mark.parametrize(("kind", "place", "method", "order"), ALL)
def test_the_order_is_exact(kind, place, method, order):
    made = compiled(kind, place, method)
    assert valuation(local_error(made.program, made.problem, QQ, order + 1)) == order + 1


@pytest.mark.parametrize(("kind", "place", "method", "order"), ALL)
def test_emitted_steps_are_those_of_the_interpreter(kind, place, method, order):
    made = compiled(kind, place, method)
    allowed = 64 if emit_compiled(made, "c").manifest["interface"]["blocks"] else 16
    state = list(made.problem.initial(FloatDomain(0.0)))
    values, first = {"t": 0.0}, 0
    for block in made.problem.state:
        values[block.name] = tuple(state[first : first + len(block.symbols)])
        first += len(block.symbols)
    after = interpret(made.lowered, made.problem, FloatDomain(1 / 64), values)
    expected = [x for block in made.problem.state for x in after[block.name]]
    for target in ("c", "python"):
        found = load(emit_compiled(made, target)).step(state, 1 / 64)
        assert ulps(found, expected) <= allowed


def test_the_order_of_a_quaternions_coordinates_is_stated():
    manifest = emit_compiled(compiled("hamiltonian", "S^3", "vcg:midpoint"), "c").manifest
    assert [f["meaning"] for f in manifest["state"]] == [
        "element of S^3, real part first",
        "right-trivialised momentum in the dual of the Lie algebra of S^3",
    ]
    product = emit_compiled(compiled("hamiltonian", "SO(3) x R^2", "cf:cf4"), "c").manifest["state"][0]
    assert product["meaning"] == (
        "element of T*(SO(3) x R^2): SO(3), row by row; R^2; the right-trivialised momentum"
    )
