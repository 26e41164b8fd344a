"""The graph of snippets: nothing is emitted that nothing calls."""

from __future__ import annotations

import builtins
import re

import networkx as nx
import pytest

from codegen.ir.ieee import OVERFLOWING, UNDEFINED
from codegen.snippets.graph import LIBRARY, graph, needed, snippets
from codegen.snippets.stumpff import SETS

TARGETS = ("c", "python")


EXCEPTIONS = tuple(f"ieee_{name}" for name in (*OVERFLOWING, *UNDEFINED))
"""Helpers for Python. The functions of C raise no exceptions."""

ONE_TARGET = ("greater", "largest", "all_finite", "power", "divided", *EXCEPTIONS)
"""Helpers that the other target has built in."""


def test_no_helper_calls_itself():
    assert nx.is_directed_acyclic_graph(graph())


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("snippet", [s for s in snippets() if s.name not in ONE_TARGET], ids=lambda s: s.name)
def test_the_edges_are_the_calls_in_the_text(target, snippet):
    text = needed(target, [snippet.name]).texts[-1]
    body = text.split("\n", 1)[1]
    called = set(re.findall(r"([a-z]\w*)\(", re.sub(r'""".*?"""|/\*.*?\*/', "", body, flags=re.S)))
    own = {"float", *dir(builtins)} if target == "python" else {"float"}
    assert called - own - {snippet.name} == set(snippet.calls)


def test_callees_come_first():
    for target in TARGETS:
        texts = needed(target, ["stumpff_123"]).texts
        assert len(texts) == 8
        assert "stumpff_123" in texts[-1]


def test_library_functions_need_no_text():
    assert needed("c", LIBRARY).texts == ()
    assert needed("python", ["cos", "sin"]).library == ("cos", "sin")


def test_every_set_of_orders_has_a_helper():
    assert len(SETS) == 15
    assert all("stumpff_" + "".join(map(str, orders)) in graph() for orders in SETS)
