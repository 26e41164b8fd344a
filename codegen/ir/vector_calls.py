"""The names of vector functions (functions whose result is an array).

The functions compute with square matrices. The first number in a name is the number of rows of these
matrices. The following names are examples:
- ``expm3`` is the matrix exponential, and ``expm3_d1`` is the exponential together with its derivative.
- ``inverse5`` is the inverse of a matrix.
- ``product5`` is the product of two matrices, and ``commutator5`` is the commutator of two matrices.
- ``expmv5`` is the matrix exponential applied to a vector.
- ``expsu3`` is the exponential of a matrix of su(3).

The suffix ``.k`` denotes entry k of the result.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING

from codegen.ir.exponential_action import ExponentialAction
from codegen.ir.matrix_functions import MatrixExponential, MatrixInverse
from codegen.ir.matrix_product import MatrixCommutator, MatrixProduct
from codegen.ir.unitary_exponential import SpecialUnitaryExponential
from codegen.ir.vector_function import VectorFunction

if TYPE_CHECKING:
    from codegen.ir.expr import Expr

_OF_MATRICES: dict[str, Callable[[int], VectorFunction]] = {
    "inverse": MatrixInverse,
    "product": MatrixProduct,
    "commutator": MatrixCommutator,
    "expsu": SpecialUnitaryExponential,
}
# In ``expmv5_1f``, 1f is a hexadecimal number. If its bit k is 0, entry k of the matrix (row by row) is zero.
_ACTION = re.compile(r"expmv(\d+)(?:_([0-9a-f]+))?")
# In ``expm3_d1``, the number after ``_d`` is the level: the highest order of the derivatives in the result.
_NAME = re.compile(r"(expm|expsu|inverse|product|commutator)(\d+)(?:_d(\d+))?")


@cache
def vector_function(name: str) -> VectorFunction | None:
    """Return the vector function called ``name``, or None if ``name`` is not the name of a vector function.

    >>> vector_function("expm3_d1"), vector_function("sin")
    (MatrixExponential(n=3, level=1), None)
    """
    action = _ACTION.fullmatch(name)
    if action is not None:
        return ExponentialAction(int(action[1]), int(action[2] or "0", 16))
    match = _NAME.fullmatch(name)
    if match is None:
        return None
    kind, n, level = match.groups(default="0")
    # For the name ``expm3_d1``, ``n`` is 3 and ``level`` is 1.
    return _OF_MATRICES[kind](int(n)) if kind in _OF_MATRICES else MatrixExponential(int(n), int(level))


def named(name: str) -> VectorFunction:
    """Return the vector function called ``name``. ValueError is raised if there is no such function."""
    function = vector_function(name)
    if function is None:
        raise ValueError(f"unknown vector function {name}")
    return function


@cache
def component(payload: str) -> tuple[VectorFunction, int] | None:
    """Split ``payload``, the name of one result of a vector function, into the function and an index.

    If ``payload`` is not such a name, the result is None.

    >>> component("inverse5.7"), component("sin")
    ((MatrixInverse(n=5), 7), None)
    """
    # In ``inverse5.7``, the name of the function precedes the dot, and 7 is the index.
    name, dot, index = payload.partition(".")
    function = vector_function(name) if dot else None
    return None if function is None else (function, int(index))


def partial(node: Expr, function: VectorFunction, index: int, argument: int) -> Expr:
    """Return the derivative of result ``index`` of a vector function with respect to argument ``argument``.

    ``node`` is the call of ``function``.
    """
    # The derivatives of all results with respect to one argument are computed together and stored.
    key = function.name, tuple(a.id for a in node.args), argument
    known = node.space.derivatives
    if key not in known:
        known[key] = function.derivative(node.args, argument)
    return known[key][index]
