"""Sums of a base and two small corrections."""

import re

from codegen.emitter import emit
from codegen.groups.so3 import SO3
from codegen.ir.domain import ExprDomain, FloatDomain
from codegen.ir.expr import walk
from codegen.ir.summation import ShortChains, corrected


class Short(ExprDomain, ShortChains):
    """Expressions with short chains."""


def test_small_terms_are_added_first():
    # 2^-53 is half the distance of 1 to the next double, so 1 + 2^-53 is rounded to 1.
    tiny = 2.0**-53
    assert corrected(FloatDomain(0.1), 1.0, (1.0, tiny), (1.0, tiny)) == 1 + 2.0**-52
    assert 1.0 + tiny + tiny == 1.0


def test_short_chains_add_the_corrections_one_after_the_other():
    for domain, early in ((Short(), True), (ExprDomain(), False)):
        a, b, c, d, e = map(domain.space.sym, "abcde")
        total = corrected(domain, a, (b, c), (d, e))
        assert ((a + b * c) in total.args) is early
        assert ((b * c + d * e) in total.args) is not early


def test_a_rotation_has_one_addition_less_after_its_last_function_value():
    chains = []
    for domain in (Short(), ExprDomain()):
        x, y = (tuple(domain.space.sym(f"{s}{i}") for i in range(3)) for s in "xy")
        # The number of operations on the longest path from c_2 to the result.
        depth: dict[int, int] = {}
        for node in walk(SO3().rotate(domain, x, y)):
            known = [depth[a.id] for a in node.args if a.id in depth]
            if node.op == "call" and node.payload == "stumpff2":
                depth[node.id] = 0
            elif known:
                depth[node.id] = 1 + max(known)
        chains.append(max(depth.values()))
    assert chains == [2, 3]


def test_emitted_steps_have_short_chains():
    text = emit("free_rigid_body", "cf4").files["free_rigid_body_cf4.c"]
    # In m - (a * c1 + b * c2) and a * c1 - b * c2 + m, the last addition must wait for c1 and c2.
    assert re.search(r"\(\w+ \* c1_\d [+-] ", text) is None
    assert re.search(r"\* c2_\d \+ m\d", text) is None
    assert re.search(r"\* c1_\d [+-] \([^()]*\) \* c2_\d;", text)
