"""Statements are put in an order that holds few values: each after what it reads, and fewer than before."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from codegen.printers.narrow import narrowed


@st.composite
def straight_lines(draw):
    """Names with what each reads of those before it."""
    reads = []
    for k in range(draw(st.integers(1, 12))):
        reads.append(frozenset(f"x{i}" for i in draw(st.sets(st.integers(0, k - 1)))) if k else frozenset())
    after = frozenset(f"x{i}" for i in draw(st.sets(st.integers(0, len(reads) - 1))))
    return [(f"x{k}",) for k in range(len(reads))], reads, after


def most_held(made, reads, after, order):
    """The largest number of values that wait to be read after some statement."""
    held, most = set(), 0
    for place, k in enumerate(order):
        later = after.union(*(reads[i] for i in order[place + 1 :]))
        held = {name for name in held | set(made[k]) if name in later}
        most = max(most, len(held))
    return most


@given(straight_lines())
def test_each_statement_stands_once_and_after_those_it_reads(line):
    made, reads, after = line
    order = narrowed(made, reads, after)
    assert sorted(order) == list(range(len(made)))
    seen = {"a parameter"}
    for k in order:
        assert reads[k] <= seen
        seen |= set(made[k])


def test_chains_that_stood_side_by_side_stand_one_after_the_other():
    made = [(f"{c}{i}",) for i in range(4) for c in "abcd"]
    reads = [frozenset([f"{c}{i - 1}"] if i else []) for i in range(4) for c in "abcd"]
    after = frozenset(f"{c}3" for c in "abcd")
    order = narrowed(made, reads, after)
    assert [made[k][0] for k in order] == [f"{c}{i}" for c in "abcd" for i in range(4)]
    assert most_held(made, reads, after - {"a3"}, order) == 3
