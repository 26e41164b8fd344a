"""Packs many scalar arguments of a private C function into one array."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from codegen.run.language import Function
from codegen.run.terms import Kind, Term

WIDE = 64
"""If a private function has more than WIDE scalar parameters, it receives them in one array (:func:`packed`).

The compile time of gcc 12 grows with the square of the number of arguments on the stack. For
``ambient:verner9_efficient`` and the scene ``wilson_flow``, arrays reduce the compile time of a step (gcc
-O2) from 21 s to 4 s. The compiled step with arrays is 1 % slower.
"""

PACKED = "arguments"
"""The name of the array parameter that replaces the scalar parameters of a function."""


def packed(function: Function, changed: Collection[str]) -> tuple[Term, ...]:
    """Return the scalar parameters that a function receives in one array.

    The result is empty if all parameters are passed separately. The array does not contain the parameters
    that the function changes (``changed``).
    """
    # Users pass each argument of a public function separately. For a function with a return value, the
    # emitted code also passes each argument separately.
    if function.public or function.returns is not None:
        return ()
    scalars = [p for p in function.parameters if p.kind is Kind.REAL and not p.shape and not p.cell]
    # The array is ``const`` in C, so it cannot contain parameters that the function changes.
    scalars = [p for p in scalars if not p.optional and p.text not in changed]
    return tuple(scalars) if len(scalars) > WIDE else ()


def whole(values: Sequence[str], others: Collection[str]) -> str:
    """Return the name of the array whose first entries are ``values``, or an empty text.

    The arrays in ``others`` (the other arguments of the call) are excluded, because the callee may change
    them.

    >>> whole(("v[0]", "v[1]"), ["w"])
    'v'
    >>> whole(("v[0]", "v[2]"), ["w"])
    ''
    """
    # The name of the array is the text in front of the bracket.
    name = values[0].partition("[")[0]
    # The callee reads parameter k from entry k of an array. Therefore the caller can pass the array ``name``
    # only if ``values[k]`` is entry k of this array for every k.
    same = name not in others and all(value == f"{name}[{k}]" for k, value in enumerate(values))
    return name if same else ""
