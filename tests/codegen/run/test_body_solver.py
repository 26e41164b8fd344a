"""Equations in the body frame are solved by comparing momenta: few sweeps, and nothing lost to rounding."""

from __future__ import annotations

import math

import pytest

from codegen import scenes
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import evaluate
from codegen.ir.kernel import NEWTON, Let
from codegen.loader import load
from tests import compilations

METHODS = {"vcg:midpoint": 3, "vrkmk(2):gauss2": 6, "vcf:cf4": 12}
"""How many unknowns each method has on the dipole."""


@pytest.fixture(scope="module", params=METHODS)
def compiled(request):
    return compilations.compiled("dipole", request.param)


def test_three_unknowns_a_stage_are_corrected_by_a_matrix_to_first_order(compiled):
    (loop,) = compiled.kernel.loops
    assert len(loop.unknowns) == METHODS[compiled.method.label.replace(" ", "")]
    assert loop.solver == NEWTON
    assert loop.newton is not None
    assert loop.newton.residuals
    assert loop.images
    assert loop.newton.period == {3: 1, 6: 3, 12: 6}[len(loop.unknowns)]


def test_the_matrix_is_the_residuals_derivative_up_to_h(compiled):
    """At a small step, by central differences of the residuals as the kernel computes them."""
    kernel = compiled.kernel
    (loop,) = kernel.loops
    h = 2.0**-20
    state = [float(x) for x in compiled.problem.initial(FloatDomain(0.0))]
    known = dict(zip((s for f in kernel.state for s in f.symbols), state, strict=True)) | {"h": h}
    domain = FloatDomain(h)
    for statement in kernel.body:
        if isinstance(statement, Let):
            try:
                known[statement.name] = evaluate([statement.value], domain, known)[0]
            except KeyError:
                break  # what follows the loop

    def residuals(u):
        values = known | dict(zip(loop.unknowns, u, strict=True))
        for let in loop.body:
            values[let.name] = evaluate([let.value], domain, values)[0]
        return evaluate(loop.images, domain, values), values

    u = [0.3 + 0.1 * k for k in range(len(loop.unknowns))]
    _, values = residuals(u)
    for let in loop.newton.body:
        values[let.name] = evaluate([let.value], domain, values)[0]
    n, eps = len(u), 2.0**-12
    slopes = [[0.0] * n for _ in range(n)]
    for j in range(n):
        up, down = ([x + s * eps * (i == j) for i, x in enumerate(u)] for s in (1, -1))
        for i, (a, b) in enumerate(zip(residuals(up)[0], residuals(down)[0], strict=True)):
            slopes[i][j] = (b - a) / (2 * eps)
    matrix = [evaluate(list(row), domain, values) for row in loop.newton.matrix]
    for i in range(n):
        for j in range(n):
            product = sum(matrix[i][k] * slopes[k][j] for k in range(n))
            found, expected = (product, i == j) if loop.newton.inverted else (matrix[i][j], slopes[i][j])
            assert abs(found - expected) < 1e-8


def test_the_momentum_about_the_vertical_is_kept_to_rounding(compiled):
    module = load(compilations.emitted("dipole", compiled.method.label.replace(" ", "")))
    state = module.run(list(compiled.problem.initial(_floats())), 0.01, 2000)
    assert abs(float(state[-1])) < 2e-14


def _floats():
    return FloatDomain(0.0)


def test_a_long_step_still_converges_and_a_wild_one_says_so():
    module = load(compilations.emitted("dipole", "vcg:midpoint"))
    start = [float(x) for x in scenes.load("dipole").initial(_floats())]
    state = module.run(start, 0.1, 100)
    assert all(map(math.isfinite, map(float, state)))
