"""Newton's matrix 1 - g'(u), and the test for numerators that consist of rounding errors only."""

from __future__ import annotations

from codegen.ir.domain import FloatDomain
from codegen.ir.expr import Space, evaluate, walk
from codegen.kernel.newton import _size, matrix


def test_the_size_of_a_sum_is_the_sum_of_the_sizes_of_its_terms():
    s = Space()
    a, b, c = map(s.sym, "abc")
    root = -((a - b) - (c - a * b))
    (value,) = evaluate([_size(root)], FloatDomain(0.1), {"a": 2.0, "b": -3.0, "c": 5.0})
    assert value == 2 + 3 + 5 + 6


def test_a_sum_that_contains_a_sum_twice_is_measured_once():
    """Each level contains the level below it twice, so the tree of level 60 has 2^60 terms."""
    s = Space()
    u, h, total = s.sym("u"), s.sym("h"), s.sym("a")
    for k in range(60):
        total = (total + s.sym(f"b{k}")) - (total + s.sym(f"c{k}"))
    assert sum(1 for _ in walk([_size(total)])) < 10 * 60
    ((entry,),) = matrix([s.call("quotient", total + u, h * h)], ["u"])
    assert entry.op == "sub"


def test_a_sum_of_thousands_of_terms_is_measured():
    s = Space()
    terms = [s.sym(f"a{k}") for k in range(3000)]
    size = _size(sum(terms[1:], terms[0]))
    assert evaluate([size], FloatDomain(0.1), {t.payload: -1.0 for t in terms}) == [3000.0]
