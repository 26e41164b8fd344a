"""The depth of angles is the longest chain of Stumpff functions, and it sets the largest angle of a step."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from codegen.emitter import compile_method, emit_compiled
from codegen.ir.angle_depth import chain
from codegen.ir.expr import Expr, Space
from codegen.ir.kernel import Deferred, Kernel, Let, Loop
from codegen.ir.number import Number
from codegen.snippets.stumpff import limit

LARGEST = 2.0**42
"""The bound on z for angles of depth 1: 2^(2 * 53/5) with whole exponents, 4.4e12."""

LEAST = 65536.0
"""The bound on z for angles of depth 4 and more: 2^(2 * 53/6) with whole exponents."""


def kernel(*lets: Let, outputs: tuple[Expr, ...] = ()) -> Kernel:
    """Return a kernel without equations."""
    return Kernel("step", (), ("h",), lets, outputs)


def nested(depth: int, function: str = "stumpff1") -> Kernel:
    """Return a kernel with functions of angles, each angle computed from the function before it."""
    space = Space()
    lets, angle = [], space.sym("h")
    for k in range(depth):
        lets.append(Let(f"c{k}", space.call(function, angle * angle)))
        angle = space.sym(f"c{k}") + space.sym("h")
    return kernel(*lets, outputs=(angle,))


@pytest.mark.parametrize(
    ("depth", "bound"),
    [(1, LARGEST), (2, 2.0**40), (3, 2.0**24), (4, LEAST), (9, LEAST)],
)
def test_a_chain_of_angles_has_its_length_and_its_bound(depth, bound):
    step = nested(depth)
    assert chain(step) == depth
    assert limit(chain=chain(step)) == bound


@pytest.mark.parametrize("function", ["stumpff0", "stumpff2", "stumpff3", "signed_stumpff0"])
def test_every_function_of_an_angle_counts(function):
    assert chain(nested(3, function)) == 3


@pytest.mark.parametrize("function", ["sin", "cos", "sqrt", "exp", "slope2"])
def test_other_functions_do_not_count(function):
    assert chain(nested(3, function)) == 1


def test_a_step_without_angles_has_depth_one():
    space = Space()
    step = kernel(outputs=(space.sym("h") * space.sym("h"),))
    assert chain(step) == 1
    assert limit(chain=chain(step)) == LARGEST


def test_functions_of_one_angle_are_one_link():
    space = Space()
    z = space.sym("h") * space.sym("h")
    both = space.call("stumpff1", z) + space.call("stumpff2", z)
    assert chain(kernel(Let("x", both), outputs=(space.sym("x"),))) == 1


def test_nesting_counts_within_one_expression_and_across_assignments():
    space = Space()
    h, x = space.sym("h"), space.sym("x")
    two = space.call("stumpff1", space.call("stumpff0", h) + h)
    assert chain(kernel(outputs=(two,))) == 2
    assert chain(kernel(Let("x", two), outputs=(space.call("stumpff2", x * x),))) == 3


def test_the_longest_chain_counts_in_whatever_order_the_outputs_are():
    space = Space()
    h = space.sym("h")
    short = space.call("stumpff1", h)
    long = space.call("stumpff1", space.call("stumpff1", short))
    assert chain(kernel(outputs=(short, long))) == chain(kernel(outputs=(long, short))) == 3


def test_a_value_that_no_output_reads_does_not_count():
    space = Space()
    unread = space.call("stumpff1", space.call("stumpff1", space.sym("h")))
    assert chain(kernel(Let("x", unread), outputs=(space.sym("h"),))) == 1


def test_steps_with_equations_or_deferred_flows_have_depth_one():
    step = nested(5)
    space = step.outputs[0].space
    loop = Loop("stage", ("u",), (space.zero,), (), (space.sym("u"),))
    assert chain(replace(step, body=(loop, *step.body))) == 1
    flows = Deferred(None, None, Number.rational(1), Number.rational(1))
    assert chain(replace(step, deferred=flows)) == 1


@pytest.mark.parametrize(
    ("scene", "method", "depth", "bound"),
    [
        ("free_rigid_body", "rkmk(2):rk4", 4, LEAST),
        ("free_rigid_body", "rkmk(2):midpoint", 1, LARGEST),
        ("duffing_sl2", "cf4", 4, LEAST),
    ],
)
@pytest.mark.parametrize("target", ["c", "python"])
def test_compiled_steps_keep_their_depth_and_emitted_bound(scene, method, depth, bound, target):
    compiled = compile_method(scene, method)
    assert chain(compiled.kernel) == depth
    text = "".join(emit_compiled(compiled, target).files.values())
    bounds = [float(x) for x in re.findall(r"z <= ([0-9.]+) (?:\? z : \(double\)NAN|else float)", text)]
    assert set(bounds) == {bound}
