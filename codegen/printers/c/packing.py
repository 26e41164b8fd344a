"""Arguments of function calls in C: a private function with many scalar parameters gets them in an array."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from codegen.run.language import Function
from codegen.run.terms import Kind, Term

WIDE = 64
"""The largest number of scalar parameters that a private function receives one by one.

The compile time of gcc 12 grows with the square of the number of arguments on the stack. For example, the
step of the method ``ambient:verner9_efficient`` for the scene ``wilson_flow`` contains calls with up to 658
arguments. gcc -O2 compiles this step in 21 s if each argument is passed separately, and in 4 s if arrays are
passed. For a step with step-size control, the times are 75 s and 7 s. Arrays make the step 1 % slower.
"""

PACKED = "arguments"
"""The name of the array parameter that replaces the scalar parameters of a function."""


def packed(function: Function, changed: Collection[str]) -> tuple[Term, ...]:
    """Return the parameters that a function receives in one array, or an empty tuple.

    ``changed`` contains the names of the parameters that the function changes. The array contains only
    parameters that the function does not change.
    """
    # The parameters of a public function are documented, and its callers pass each one separately.
    if function.public or function.returns is not None:
        return ()
    scalars = [p for p in function.parameters if p.kind is Kind.REAL and not p.shape and not p.cell]
    # The array is ``const`` in C, so it cannot contain parameters that the function changes.
    scalars = [p for p in scalars if not p.optional and p.text not in changed]
    return tuple(scalars) if len(scalars) > WIDE else ()


def whole(values: Sequence[str], others: Collection[str]) -> str:
    """Return the name of the array whose first entries are ``values``, or an empty text if there is none.

    A function call can pass this array, so the values need not be copied into a new array. ``others`` are the
    arguments of the call that are not in ``values``. The called function may change them, so the result is
    never one of ``others``.

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
