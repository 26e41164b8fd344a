"""Finds the library functions and the helper functions (snippets) that an emitted module calls."""

from __future__ import annotations

from codegen.ir.expr import walk
from codegen.run.language import LANGUAGE, Call, Unit, statements, terms


def functions_of(unit: Unit) -> tuple[str, ...]:
    """Return the sorted names of functions that a module calls, but does not define.

    The names are collected from two places: from statements of the class :class:`Call`, and from calls inside
    the expression ``term.value`` of a term.
    """
    names: set[str] = set()
    for function in unit.functions:
        for term in terms(function.body):
            if term.value is not None:
                # If ``n`` is a function call, ``n.payload`` is the name of the function.
                names |= {n.payload for n in walk([term.value]) if n.op == "call"}
        # The caller of the emitted code supplies the functions in ``LANGUAGE``.
        calls = (s.function for s in statements(function.body) if isinstance(s, Call))
        names |= {name for name in calls if name not in unit.parts and name not in LANGUAGE}
    # The names are sorted, because the order of a set varies between runs.
    return tuple(sorted(names))
