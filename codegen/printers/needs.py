"""Finds the library functions and the helper functions (snippets) that an emitted module calls."""

from __future__ import annotations

from codegen.ir.expr import walk
from codegen.run.language import LANGUAGE, Call, Unit, statements, terms


def functions_of(unit: Unit) -> tuple[str, ...]:
    """Return the sorted names of functions that a module calls, but does not define.

    The function finds calls in kernel expressions and in call statements. It ignores calls in other terms.
    """
    names: set[str] = set()
    for function in unit.functions:
        for term in terms(function.body):
            if term.value is not None:
                # If a node is a function call, the payload of the node is the function name.
                names |= {n.payload for n in walk([term.value]) if n.op == "call"}
        # The module defines the functions in ``unit.parts``. The user of the module passes the functions in
        # ``LANGUAGE`` as arguments.
        calls = (s.function for s in statements(function.body) if isinstance(s, Call))
        names |= {name for name in calls if name not in unit.parts and name not in LANGUAGE}
    # The names are sorted, so that emitted text does not depend on the order of a set.
    return tuple(sorted(names))
