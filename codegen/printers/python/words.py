"""Reserved words of emitted Python."""

from __future__ import annotations

import keyword

from codegen.ir.ieee import OVERFLOWING, UNDEFINED
from codegen.snippets.graph import LIBRARY

_WORDS = """
    abs all max range float len list map reversed tuple zip ArithmeticError TypeError ValueError sqrt sin
    cos exp log sinh cosh inf nan isfinite copysign quotient choose signed_stumpff0 signed_stumpff1
    signed_stumpff2 signed_stumpff3 invert fabs slope2 slope3 curvature2 curvature3 signed_slope1
    signed_slope2 signed_slope3 float32 errstate self OK NOT_CONVERGED NOT_FINITE BAD_STEP LIMIT TOO_FAR
    SINGULAR TOO_SHORT StepFailed Statistics step run run_adaptive jacobian index
"""

_HELPERS = frozenset(f"_{name}" for name in (*OVERFLOWING, *UNDEFINED, "divided"))

# Builtins are reserved, because a parameter ``max`` would hide the builtin function ``max``.
RESERVED = frozenset(keyword.kwlist) | frozenset(_WORDS.split()) | frozenset(LIBRARY) | _HELPERS
"""Keywords of Python, and other names that the variables of an emitted module must not have."""

_PUBLIC = """
    state steps stride statistics counted rows completed status rtol atol limit end now size accepted rejected
    matrix inputs failure given
"""

PUBLIC = frozenset(_PUBLIC.split())
"""Names of the arguments and local variables of the public functions in a module.

A run-time parameter with such a name gets another identifier in the module.
"""

_INTEGRATION = """
    EVENT BAD_TIMES LEAST_STEP BAD_EVENT Arrival integrate times written event stops room event_times
    event_rows event_numbers event_count events arrival least greatest _Rows
"""

INTEGRATION = frozenset(_INTEGRATION.split())
"""Names that a module needs for its function ``integrate``.

Modules without ``integrate`` do not reserve these names.
"""
