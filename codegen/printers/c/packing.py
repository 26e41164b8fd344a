"""Private functions with many scalar parameters. In C they receive these parameters in one array."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from codegen.run.language import Function
from codegen.run.terms import Kind, Term

WIDE = 64
"""The largest number of scalar parameters that a private function receives one by one.

The time of gcc 12 grows with the square of the number of arguments on the stack. A step of
``ambient:verner9_efficient`` on wilson_flow contains calls with up to 658 arguments. gcc -O2 compiles this
step in 21 s, and in 4 s with arrays (with step-size control in 75 s and 7 s). The step becomes 1 % slower.
"""

PACKED = "arguments"
"""The name of the array."""


def packed(function: Function, changed: Collection[str]) -> tuple[Term, ...]:
    """Return the parameters that a function receives in one array, or an empty tuple.

    ``changed`` contains the names of the parameters that the function changes. These are not in the array.
    """
    if function.public or function.returns is not None:
        return ()
    scalars = [p for p in function.parameters if p.kind is Kind.REAL and not p.shape and not p.cell]
    scalars = [p for p in scalars if not p.optional and p.text not in changed]
    return tuple(scalars) if len(scalars) > WIDE else ()


def whole(values: Sequence[str], others: Collection[str]) -> str:
    """Return the array that begins with the given values, or an empty text.

    A call passes this array instead of a copy. The array must not be one of the ``others``, the further
    arguments of the call, because the function may change these.

    >>> whole(("v[0]", "v[1]"), ["w"])
    'v'
    >>> whole(("v[0]", "v[2]"), ["w"])
    ''
    """
    name = values[0].partition("[")[0]
    same = name not in others and all(value == f"{name}[{k}]" for k, value in enumerate(values))
    return name if same else ""
