"""Private functions with many scalar parameters. In C they receive the parameters in one array."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from codegen.run.language import Function
from codegen.run.terms import Kind, Term

WIDE = 64
"""The largest number of scalar parameters that a private function receives one by one.

The compile time of gcc 12 grows with the square of the number of arguments on the stack. A step of
``ambient:verner9_efficient`` on wilson_flow contains calls with up to 658 arguments. gcc -O2 compiles this
step in 21 s if each argument is passed separately, and in 4 s if they are passed in arrays. With step-size
control the times are 75 s and 7 s. With arrays, the compiled step is 1 % slower.
"""

PACKED = "arguments"
"""The name of the array parameter that replaces the scalar parameters of a function."""


def packed(function: Function, changed: Collection[str]) -> tuple[Term, ...]:
    """Return the parameters that a function receives in one array, or an empty tuple.

    ``changed`` contains the names of the parameters that the function changes. The array does not include
    them.
    """
    # Callers outside the module pass the documented parameters of a public function, so these are not packed.
    if function.public or function.returns is not None:
        return ()
    scalars = [p for p in function.parameters if p.kind is Kind.REAL and not p.shape and not p.cell]
    # The array is constant, so a parameter that the function changes cannot be part of it.
    scalars = [p for p in scalars if not p.optional and p.text not in changed]
    return tuple(scalars) if len(scalars) > WIDE else ()


def whole(values: Sequence[str], others: Collection[str]) -> str:
    """Return the name of the array whose first entries are ``values``, or an empty text if there is none.

    A call can pass this array instead of a new array that contains copies. ``others`` are the further
    arguments of the call. The called function may change them, so no array in ``others`` is returned.

    >>> whole(("v[0]", "v[1]"), ["w"])
    'v'
    >>> whole(("v[0]", "v[2]"), ["w"])
    ''
    """
    # The values are texts. For the entry ``v[0]`` the array is ``v``.
    name = values[0].partition("[")[0]
    # Entry k must be the k-th argument, because the callee reads its parameters by position.
    same = name not in others and all(value == f"{name}[{k}]" for k, value in enumerate(values))
    return name if same else ""
