"""Packs many scalar arguments of a private C function into one array."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from codegen.run.language import Function
from codegen.run.terms import Kind, Term

WIDE = 64
"""A private function with more scalar parameters than this receives them in one array (see :func:`packed`).

The compile time of gcc 12 grows with the square of the number of arguments on the stack. For example, the
method ``ambient:verner9_efficient`` for the scene ``wilson_flow`` has calls with up to 658 arguments. With
separate arguments, gcc -O2 compiles one step of this method in 21 s. With arrays, it needs 4 s. For a step
with step-size control, the times are 75 s and 7 s. The compiled step with arrays is 1 % slower.
"""

PACKED = "arguments"
"""The name of the array parameter that replaces the scalar parameters of a function."""


def packed(function: Function, changed: Collection[str]) -> tuple[Term, ...]:
    """Return the scalar parameters that a function receives in one array.

    The result is empty if all parameters are passed separately. ``changed`` contains the names of the
    parameters that the function changes. These parameters are not in the array.
    """
    # Users pass each argument of a public function separately. A call with an array is printed without an
    # assignment, so functions that return a value are excluded.
    if function.public or function.returns is not None:
        return ()
    scalars = [p for p in function.parameters if p.kind is Kind.REAL and not p.shape and not p.cell]
    # The array is ``const`` in C, so it cannot contain parameters that the function changes.
    scalars = [p for p in scalars if not p.optional and p.text not in changed]
    return tuple(scalars) if len(scalars) > WIDE else ()


def whole(values: Sequence[str], others: Collection[str]) -> str:
    """Return the name of the array whose first entries are ``values``.

    A call can pass this array instead of a copy of the values. ``others`` contains the remaining arguments of
    the call. The called function may change arrays in ``others``, so the result is none of them. Without a
    suitable array, the result is an empty text.

    >>> whole(("v[0]", "v[1]"), ["w"])
    'v'
    >>> whole(("v[0]", "v[2]"), ["w"])
    ''
    """
    # The name of the array is the text in front of the bracket. For ``v[0]`` it is ``v``.
    name = values[0].partition("[")[0]
    # Entry k must be the k-th argument, because the callee reads its parameters by position.
    same = name not in others and all(value == f"{name}[{k}]" for k, value in enumerate(values))
    return name if same else ""
