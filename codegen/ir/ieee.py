"""Functions of doubles with the results of IEEE arithmetic.

Where C returns an infinity or a NaN, the functions of the module :mod:`math` often raise an exception. But a
formula such as 1/cosh(x) or atan(exp(x)) can have a finite value although a part of the formula is infinite.
"""

from __future__ import annotations

import math

OVERFLOWING = ("cosh", "exp", "log", "sinh")
"""Functions whose result may be infinite at a finite argument.

The module :mod:`math` raises an exception if cosh(x) is infinite. But a formula such as 1/cosh(x) can still
be finite. Therefore Python modules in double precision call helpers that return the infinity.
"""

UNDEFINED = ("acos", "asin", "cos", "sin", "sqrt", "tan")
"""Functions whose result may be NaN at a number that is not NaN. The logarithm is in :data:`OVERFLOWING`.

If a part of a formula is NaN, the value of the formula is usually NaN. There are two exceptions: the function
``choose`` can ignore a NaN, and a solver of implicit equations can return an error status in place of a NaN.
Therefore, if a Python module in double precision contains ``choose`` or a solver, the module calls helpers
that return the NaN. Other modules in double precision call :mod:`math`, which raises an exception.
"""


def divided(a: float, b: float) -> float:
    """Return a/b. For b = 0, return the infinity or NaN that C returns.

    >>> divided(1.0, -0.0), divided(0.0, 0.0)
    (-inf, nan)
    """
    try:
        return a / b
    except ZeroDivisionError:
        return a * math.copysign(math.inf, b)


def ieee(function: str, *args: float) -> float:
    """Return the value of a function of the module :mod:`math`.

    If :mod:`math` raises OverflowError or ValueError, return the infinity or NaN that C returns.

    >>> ieee("exp", 1000.0), ieee("sinh", -1000.0), ieee("log", 0.0), ieee("sin", math.inf)
    (inf, -inf, -inf, nan)
    """
    try:
        result: float = getattr(math, function)(*args)
    except OverflowError:
        # exp and cosh are positive. sinh has the sign of its argument.
        return math.copysign(math.inf, args[0]) if function == "sinh" else math.inf
    except ValueError:
        return -math.inf if function == "log" and args[0] == 0.0 else math.nan
    return result
