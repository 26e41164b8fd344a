"""Normal forms equal what they came from wherever the relations hold."""

from __future__ import annotations

import random
from fractions import Fraction

from codegen.groups import SO3
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import Space, evaluate, walk
from codegen.ir.normal_form import MOST_TERMS, NormalForms

NAMES = [f"g{i}{j}" for i in range(3) for j in range(3)]


def normal():
    space = Space()
    return space, NormalForms(space, SO3().relations(NAMES))


def test_the_length_of_a_turned_vector_is_its_length():
    space, form = normal()
    rows = [sum((space.sym(f"g{i}{j}") * (j + 2) for j in range(3)), space.zero) for i in range(3)]
    assert form(sum((r * r for r in rows), space.zero)) is space.coerce(4 + 9 + 16)


def test_arguments_of_roots_and_divisors_are_brought_to_normal_form():
    space, form = normal()
    square = sum((space.sym(f"g{i}0") ** 2 for i in range(3)), space.zero)
    assert form(space.one / space.call("sqrt", square + space.sym("x"))) is space.one / space.call(
        "sqrt", space.sym("x") + 1
    )


def test_a_random_polynomial_keeps_its_value_at_rotations():
    space, form = normal()
    rng = random.Random(3)
    d, group = FloatDomain(0.0), SO3()
    for _ in range(20):
        total = space.zero
        for _ in range(6):
            term = space.coerce(rng.randint(-5, 5))
            for _ in range(rng.randint(1, 4)):
                term = term * space.sym(rng.choice([*NAMES, "x"]))
            total = total + term
        g = group.exp(d, tuple(rng.uniform(-2, 2) for _ in range(3)))
        values = dict(zip(NAMES, g, strict=True)) | {"x": rng.uniform(-1, 1)}
        before, after = evaluate([total, form(total)], d, values)
        assert abs(before - after) < 1e-12


def test_without_relations_equal_polynomials_become_the_same_node():
    space = Space()
    form, x, y = NormalForms(space), space.sym("x"), space.sym("y")
    assert form((x + y) * (x - y)) is form(x * x - y * y)
    assert form((x + y) ** 3 - (x + y) * (x + y) * (x + y)) is space.zero


def test_what_is_too_long_is_left_alone():
    space = Space()
    total = sum((space.sym(f"x{k}") for k in range(12)), space.zero)
    long = total * total * total * total * total
    assert NormalForms(space)(long) is long
    assert len([n for n in walk([long]) if n.args]) < MOST_TERMS < 12**3


def test_constants_are_exact():
    space = Space()
    form, x = NormalForms(space), space.sym("x")
    third = space.one / 3
    assert form(third * x + third * x + third * x) is x
    assert Fraction(1, 3) * 3 == 1
