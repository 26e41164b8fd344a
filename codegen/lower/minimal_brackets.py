"""Explicit Runge-Kutta-Munthe-Kaas methods with the smallest number of brackets.

A step of size h from y0 to y1 for the field f is k_i = f(exp(u_i).y0), y1 = exp(u).y0. The exponents u_i and
u are linear combinations of the values h k_j and of brackets. The function
:func:`orderconds.series.brackets.fewest_brackets` searches for the smallest number of brackets. The order of
the tableau is preserved.
"""

from __future__ import annotations

from codegen.errors import MethodError
from codegen.ir.program import Program
from codegen.ir.values import Coefficient, Kind, Var
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Ring
from orderconds.series.brackets import BracketProgram, Row

_KNOWN: dict[tuple[Ring, tuple[str, ...]], BracketProgram] = {}
"""The bracket programs of earlier searches.

A key is a pair (ring, texts). The coefficients of the tableau are elements of ``ring``, and ``texts``
contains each coefficient as a string.
"""


def bracket_program(method: Method) -> BracketProgram:
    """Return the brackets and exponents of the Runge-Kutta-Munthe-Kaas method ``rkmk:NAME``.

    NAME is the name of the tableau. The order of the method on a Lie group equals the order of the
    Runge-Kutta method on R^n. The method uses as few brackets as possible.

    :class:`codegen.errors.MethodError` is raised for an implicit tableau, for coefficients that are known
    only as balls (enclosing intervals), and for a tableau whose order is too high for the search.
    """
    from orderconds import families
    from orderconds.checking import family_order
    from orderconds.series.bracket_rows import with_fewer_terms
    from orderconds.series.brackets import fewest_brackets

    name = method.tableau.name
    tableau = method.runge_kutta()
    if not method.can_reduce_brackets():
        raise MethodError(
            f"rkmk:{name} needs a cut-off, because its tableau is implicit or its coefficients are inexact",
            expected="an explicit tableau with exact coefficients, or a cut-off (the number of brackets)",
            hint=f"write rkmk(2):{name}",
        )
    # ``order`` is the order of the tableau on R^n. The search finds brackets with which the method has the
    # same order on the group.
    order = family_order(method.tableau, families.get("rk")).order
    highest = method.kind.minimal_brackets
    if order > highest:
        raise MethodError(
            f"the search for the fewest brackets does not support the order {order} of {name}",
            expected=f"an order of at most {highest}, or a cut-off for the series of dexp^(-1)",
            # In the series, terms with more than ``order - 2`` brackets do not change the order.
            hint=f"write rkmk({order - 2}):{name}",
        )
    # The search takes a long time, so its result is stored.
    ring = method.ring
    # The key contains the exact coefficients as strings, because elements of a ring may be unhashable.
    key = (ring, tuple(ring.text(x) for row in (*tableau.A, tableau.b) for x in row))
    if key not in _KNOWN:
        _KNOWN[key] = with_fewer_terms(ring, fewest_brackets(ring, tableau.A, tableau.b, order))
    return _KNOWN[key]


def lower(scene: Problem, method: Method) -> Program:
    """Return the program of an RKMK method with the brackets from :func:`bracket_program`.

    The function raises the errors of :func:`bracket_program`.
    """
    tableau, written = method.runge_kutta(), bracket_program(method)
    y = Var("y", Kind.POINT)
    stages = Stages(scene, method, (y,))
    build = stages.builder
    # The function ``combination`` adds multiples of stage values and of brackets. Therefore stage values and
    # brackets are in one dictionary.
    values = {("k", i): build.fresh(f"k{i + 1}", Kind.ALG) for i in range(tableau.s)}

    def combination(name: str, row: Row) -> Var:
        terms = [
            # Stage values are multiplied by h. Brackets already contain powers of h.
            (stages.times_h(x) if key[0] == "k" else Coefficient(stages.number(x)), values[key])
            for key, x in row.items()
        ]
        return build.lin(name, Kind.ALG, terms)

    def images() -> list[Var]:
        # The order of the brackets is kept, because earlier brackets may be arguments of later brackets.
        for r, (left, right) in enumerate(written.brackets):
            # Both arguments are summed before the bracket: [a + b, c] takes one bracket, but [a, c] + [b, c]
            # takes two.
            x, z = combination(f"x{r + 1}", left), combination(f"z{r + 1}", right)
            values["B", r] = build.bracket(f"B{r + 1}", x, z)
        result = []
        for i, row in enumerate(written.stages):
            point = build.act(f"Y{i + 1}", build.exp(f"g{i + 1}", combination(f"u{i + 1}", row)), y)
            result.append(stages.f(f"f{i + 1}", point, tableau.c[i]))
        return result

    def update() -> dict[str, Var]:
        # As in every RKMK method, the update is a single exponential, applied to y0.
        return {"y": build.act("y1", build.exp("g", combination("u", written.update)), y)}

    # The brackets are not unknowns, because brackets are functions of the stage values.
    unknowns = [values["k", i] for i in range(tableau.s)]
    return stages.program(unknowns, images, lambda: [stages.f("k0", y, None)] * tableau.s, update)
