"""Chains are shortened, values are not changed, and what is off the longest chain is left alone."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from sympy import diag

from codegen import scenes
from codegen.emitter import compile_method
from codegen.groups import SO3
from codegen.ir.expr import Space, evaluate, walk
from codegen.ir.kernel import Field, Kernel, Let
from codegen.kernel.column_choice import fastest, time
from codegen.kernel.critical_path import chain, ordered, run
from codegen.kernel.deferred_flows import part
from codegen.kernel.translate import SHORTENED, to_kernel
from tests.strategies import top_scene


class Fractions:
    """Exact evaluation; a function of x is some rational function of it that no other is."""

    def number(self, value):
        return value.fraction()

    def call(self, function, x):
        return (x + len(function)) / (x * x + 2)


def values_of(roots, symbols, seed=1):
    rng = random.Random(seed)
    given = {s: Fraction(rng.randint(-30, 30), rng.randint(1, 9)) for s in symbols}
    return evaluate(roots, Fractions(), given)


def kicked_after_a_turn():
    """k (m - g (d + c_1 v + c_2 w)) in a further angle."""
    s = Space()
    k, g, m, d, v, w, z = (s.sym(n) for n in "kgmdvwz")
    c1, c2 = s.call("stumpff1", z * z), s.call("stumpff2", z * z)
    x = k * (m - g * (d + c1 * v + c2 * w))
    return s, s.call("stumpff0", x * x), "kgmdvwz"


def length(root):
    return chain(Kernel("chain", (Field("x", ("x",), ""),), (), (), (root,)))


def test_the_longest_chain_is_three_operations_shorter_and_the_value_is_the_same():
    _, root, symbols = kicked_after_a_turn()
    (new,) = run([root], frozenset("kg"))
    assert length(root) - length(new) == 3
    for seed in range(5):
        assert values_of([new], symbols, seed) == values_of([root], symbols, seed)


def test_factors_that_no_step_changes_are_multiplied_first():
    """k g is one product for v and w; without knowing that g is fixed it is not."""
    s, root, _ = kicked_after_a_turn()
    product = s.sym("k") * s.sym("g")
    assert any(n is product for n in walk(run([root], frozenset("kg"))))
    assert not any(n is product for n in walk(run([root], frozenset("k"))))


def test_what_is_off_the_longest_chain_stays_as_it_is():
    s, root, _ = kicked_after_a_turn()
    c1 = s.call("stumpff1", s.sym("z") * s.sym("z"))
    aside = s.sym("k") * (s.sym("m") - s.sym("g") * (s.sym("d") + c1 * s.sym("v")))
    assert run([root, aside], frozenset("kg"))[1] is aside


@pytest.mark.parametrize("seed", range(20))
def test_random_expressions_keep_their_values(seed):
    rng = random.Random(seed)
    s = Space()
    names = [f"x{k}" for k in range(5)]
    pool = [s.sym(n) for n in names]
    for _ in range(60):
        a, b = rng.choice(pool[-12:]), rng.choice(pool)
        kind = rng.choice(("add", "sub", "mul", "mul", "call", "neg"))
        pool.append(
            s.call("stumpff1", a * a) if kind == "call" else -a if kind == "neg" else getattr(s, kind)(a, b)
        )
    roots = pool[-3:]
    new = run(roots, frozenset({"x0"}))
    assert values_of(new, names) == values_of(roots, names)
    assert max(map(length, new)) <= max(map(length, roots))


def test_assignments_stand_in_the_order_in_which_they_can_be_ready():
    s = Space()
    x, a, b, c = (s.sym(n) for n in "xabc")
    lets = (Let("a", s.call("sin", x)), Let("b", a + 1), Let("c", x + 1), Let("d", c * b))
    assert [let.name for let in ordered(lets)] == ["c", "a", "b", "d"]


def test_the_fast_top_spares_a_column_that_gravity_does_not_read():
    """Of the first column and the third one is turned: the second is read by every kick."""
    made = compile_method("fast_heavy_top", "splitting:blanes_moan_rkn4")
    core = part(made.program, made.problem).core
    times = {
        spare: time(to_kernel(core, replace(made.problem, group=SO3(spare)), chains=SHORTENED))
        for spare in (None, 0, 1, 2)
    }
    assert time(made.kernel) == min(times.values()) == times[0] == times[2]
    assert times[0] < times[None]
    assert times[0] < times[1]


def test_methods_without_flows_are_compiled_as_they_were():
    made = compile_method(scenes.load("dipole"), "vcg:midpoint")
    kernels = fastest(made.program, made.problem), to_kernel(made.program, made.problem)
    assert str(kernels[0]) == str(kernels[1])


@pytest.mark.parametrize("spare", [0, 1, 2])
def test_a_column_is_the_cross_product_of_the_others(spare):
    from codegen.ir.domain import PreciseDomain

    d = PreciseDomain(0, 40)
    view = compile_method(top_scene(diag(2, 3, 2)), "splitting:strang").problem
    g, x = view.initial(d)[:9], tuple(d.rational(k, 7) for k in (1, -2, 3))
    found, expected = SO3(spare).expmul(d, x, g), SO3().expmul(d, x, g)
    assert max(abs(a - b) for a, b in zip(found, expected, strict=True)) < 1e-38
