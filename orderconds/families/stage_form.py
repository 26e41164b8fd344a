"""A description of methods with a fixed number of stages: the names of the coefficients, and a function
that builds a method from values."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from msgspec import Struct

from orderconds.errors import InputError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.methods import RungeKutta
from orderconds.tableau.products import Method

Name = tuple[str, tuple[str, ...]]
"""The name of a coefficient: a letter and indices. The name of a_21 is ``("a", ("2", "1"))``."""


class StageForm(Struct, frozen=True):
    """The coefficients of a method with a fixed number of stages.

    ``names`` contains the names of the coefficients. The function ``method`` builds the method from the
    values of the coefficients.

    ``divides`` is true if the left-hand sides of the order conditions contain divisions by weights b_i.
    """

    names: tuple[Name, ...]
    method: Callable[[Sequence[Element], Ring], Method]
    divides: bool = False


def tableau_form(stages: int, explicit: bool = False, divides: bool = False) -> StageForm:
    """Return the :class:`StageForm` of a Butcher tableau (A, b) with ``stages`` stages. The matrix A is
    strictly lower triangular if ``explicit`` is true, otherwise full. ``divides`` must be true if the
    left-hand sides of the order conditions contain divisions by weights b_i.

    >>> tableau_form(2, explicit=True).names
    (('b', ('1',)), ('b', ('2',)), ('a', ('2', '1')))
    """
    rows = range(1, stages + 1)
    entries = [(i, j) for i in rows for j in (range(1, i) if explicit else rows)]
    names: list[Name] = [("b", (str(i),)) for i in rows] + [("a", (str(i), str(j))) for i, j in entries]

    def method(values: Sequence[Element], ring: Ring) -> RungeKutta:
        a = dict(zip(entries, values[stages:], strict=True))
        A = tuple(tuple(a.get((i, j), ring.zero) for j in rows) for i in rows)
        return RungeKutta(A, tuple(values[:stages]))

    return StageForm(tuple(names), method, divides)


def refuse_explicit(label: str, explicit: bool) -> None:
    """Raise :class:`~orderconds.errors.InputError` if ``explicit`` is true.

    The message states that the family ``label`` has no explicit methods.

    >>> refuse_explicit("splitting", False)
    """
    if explicit:
        raise InputError(
            f"family {label} has no explicit methods",
            where="explicit",
            expected="a family whose coefficients are a_ij and b_i",
            hint="leave the option out",
        )
