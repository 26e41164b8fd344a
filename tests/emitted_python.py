"""Emitted Python executed over Taylor series in h: the whole text, with its digits as printed.

Three things of the text are replaced. Functions of the mathematical library and its Stumpff functions,
which approximate values and not Taylor coefficients, are exact. A solver stops after a fixed number of
sweeps, because one tolerance cannot judge all coefficients. The rest of the text is executed as it is.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from functools import partial

from tests.taylor_numbers import ELEMENTARY, Real, Taylor, is_finite, quotient, stumpff, sweeps

DECISIONS = {"converged": "enough_sweeps(sweep)", "astray": "False"}
"""The flags by which a solver of emitted text stops, and what they are in an execution over series."""


class _Adapted(ast.NodeTransformer):
    """The text without its imports from math, and with sweeps that are counted."""

    def visit_ImportFrom(self, node: ast.ImportFrom) -> ast.stmt:
        return ast.Pass() if node.module == "math" else node

    def visit_Assign(self, node: ast.Assign) -> ast.stmt:
        (target,) = node.targets
        if isinstance(target, ast.Name) and target.id in DECISIONS:
            node.value = ast.parse(DECISIONS[target.id], mode="eval").body
        return node


def exact_functions(separator: str = "_") -> dict[str, Callable[..., object]]:
    """Return exact Stumpff functions by the names of emitted text: ``_stumpff_12(z)`` returns c_1 and c_2."""

    def several(names: str, z: Real) -> object:
        found = tuple(stumpff(int(k), z) for k in names)
        return found if len(found) > 1 else found[0]

    kinds = ["0", "1", "2", "3", "01", "12", "23", "02", "03", "13", "012", "123", "013", "023", "0123"]
    return {f"{separator}{kind}stumpff_{k}": partial(several, k) for k in kinds for kind in ("", "signed_")}


def no_continuation(*_: object) -> None:
    """Stand for the continuation in h, which an execution over series must not need."""
    raise AssertionError("the solver of the emitted step failed")


def step(text: str, values: Mapping[str, Sequence[Real] | Real]) -> list[Taylor]:
    """Return the state after one step; ``values`` has state, h and, if the step takes it, t."""
    tree = ast.fix_missing_locations(_Adapted().visit(ast.parse(text)))
    functions = {**exact_functions(), "quotient": quotient, "_continued": no_continuation}
    # The functions replace those of the text, so their definitions are left out.
    tree.body = [s for s in tree.body if not (isinstance(s, ast.FunctionDef) and s.name in functions)]
    scope: dict[str, object] = {
        "float": _number,
        "isfinite": is_finite,
        "fabs": abs,
        "nan": float("nan"),
        "enough_sweeps": lambda sweep: sweep >= sweeps(),
        **ELEMENTARY,
        **functions,
    }
    exec(compile(tree, "<emitted>", "exec"), scope)
    made = scope["step"]
    assert callable(made)
    wanted = [
        a.arg for s in tree.body if isinstance(s, ast.FunctionDef) and s.name == "step" for a in s.args.args
    ]
    return list(map(Taylor.of, made(*(values[name] for name in wanted))))


def _number(x: Real | str) -> Real:
    return x if isinstance(x, Taylor) else float(x)
