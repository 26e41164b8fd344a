"""Stumpff functions of arguments that are equal as polynomials are called with one of them."""

from __future__ import annotations

from codegen.emitter import compile_method
from codegen.ir.expr import walk
from codegen.kernel.shared_angles import SharedArguments


def test_multiples_of_one_vector_have_one_angle():
    domain = SharedArguments()
    x, y = (domain.space.sym(name) for name in "xy")
    half = domain.rational(1, 2) * domain.h

    def square(factor):
        return (factor * x) * (factor * x) + (factor * y) * (factor * y)

    first = domain.call("stumpff1", square(half))
    assert domain.call("stumpff1", domain.rational(1, 4) * square(domain.h)) is first
    assert domain.call("stumpff2", square(-half)).args[0] is first.args[0]
    assert domain.call("stumpff1", square(domain.h)) is not first


def test_arguments_that_read_earlier_calls_are_compared_too():
    domain = SharedArguments()
    x = domain.space.sym("x")
    c = domain.call("stumpff2", x * x)
    first = domain.call("stumpff1", (c * x) * (c * x))
    assert domain.call("stumpff3", (c * c) * (x * x)).args[0] is first.args[0]


def test_what_is_long_is_not_expanded():
    domain = SharedArguments()
    x = domain.space.sym("x")
    total = x
    for k in range(40):
        total = total * (x + domain.rational(k))
    assert domain.call("stumpff1", total).args[0] is total


def test_a_sweep_of_vcg_has_one_angle():
    """h xi/2 for the attitude, h xi and -h xi/2 for the momenta."""
    loop = compile_method("dipole", "vcg:midpoint").kernel.loops[0]
    values = [*(let.value for let in loop.body), *loop.images]
    calls = [n for n in walk(values) if n.op == "call" and n.payload.startswith("stumpff")]
    assert sorted(n.payload for n in calls) == ["stumpff1", "stumpff2", "stumpff3"]
    assert len({n.args[0].id for n in calls}) == 1
