"""Derivatives in the space variable of a semilinear equation, as formulas of SymPy."""

from __future__ import annotations

from typing import Any

import sympy

from codegen.errors import SceneError

MOST_DERIVATIVES = 8
"""The largest order m of a derivative ``Dx(formula, m)``."""


class Dx(sympy.Function):  # type: ignore[misc]
    """The derivative of a formula with respect to x. ``Dx(formula, m)`` is the derivative of order m.

    >>> u = sympy.Symbol("u", real=True)
    >>> Dx(Dx(u**2)), Dx(3)
    (Dx(u**2, 2), 0)
    """

    nargs = (1, 2)

    @classmethod
    def eval(cls, formula: sympy.Expr, order: object = 1) -> Any:
        """Return the simplified derivative, or None if SymPy must keep ``Dx(formula, order)`` as it is.

        For example, Dx(Dx(u, 2), 1) is Dx(u, 3).
        """
        number = next((m for m in range(1, MOST_DERIVATIVES + 1) if m == order), 0)
        if not number:
            raise SceneError(
                f"Dx of order {order}", expected=f"an integer order from 1 to {MOST_DERIVATIVES}"
            )
        if formula.is_number:
            return sympy.Integer(0)
        if isinstance(formula, Dx):
            return cls(formula.args[0], formula.order + number)
        return None

    @property
    def order(self) -> int:
        """The order of the derivative."""
        return int(self.args[1]) if len(self.args) > 1 else 1
