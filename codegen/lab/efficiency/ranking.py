"""Ranks methods and other integrators by the CPU time that they need to reach an error.

The time to reach an error is interpolated between measured runs. If an integrator was run on several forms of
the equations, the ranking uses the fastest form.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from codegen.lab.efficiency.work_precision import Row


@dataclass(frozen=True)
class Place:
    """The fastest and the second fastest candidate for an error of 10^-``decade``.

    - ``winner``: the label of the fastest candidate.
    - ``seconds``: the CPU time of the fastest candidate in seconds.
    - ``second``: the label of the second fastest candidate, or '' if only one candidate reaches the error.
    - ``behind``: the CPU time of the second fastest candidate in seconds, or None if only one candidate
      reaches the error.

    If the scene has several forms of the equations, a label ends with the name of the form.
    """

    decade: int
    winner: str
    seconds: float
    second: str = ""
    behind: float | None = None


def by_form(rows: Sequence[Row]) -> dict[str, list[Row]]:
    """Group runs by the form of the equations, for example the form ``quaternion``.

    A row contains the results of one run. The returned dictionary maps the name of each form to the rows of
    the runs with this form.
    """
    return {form: [row for row in rows if row.form == form] for form in dict.fromkeys(r.form for r in rows)}


def fastest_form(rows: Sequence[Row], error: float) -> tuple[float, str] | None:
    """Return the fastest form of the equations as a pair (seconds, form).

    ``seconds`` is the CPU time to reach ``error`` with this form. The result is None if no run reaches the
    error.
    """
    times = [(_seconds_to(own, error), form) for form, own in by_form(rows).items()]
    return min(((t, form) for t, form in times if t is not None), default=None, key=lambda pair: pair[0])


def seconds_to(rows: Sequence[Row], error: float) -> float | None:
    """Return the CPU time in seconds that a candidate needs to reach ``error``, or None if no run reaches it.

    The runs must be sorted from coarse to fine. Runs after the most accurate run are not used. Let a be the
    last run whose error is above ``error``, and let b be the run after a. The result is the smaller of two
    times:

    - the time that is interpolated between a and b, linearly in the logarithms of time and error;
    - the least CPU time of b and of all runs after b.

    If the error of b is 0, its logarithm does not exist, and the result is the second time. If the errors of
    all runs are at most ``error``, the result is the least CPU time of all runs.

    >>> from codegen.lab.efficiency.work_precision import Row
    >>> row = lambda e, s: Row("", "", "", 0, None, None, e, s, None, None, None, None, None, 0.0, 0.0)
    >>> round(seconds_to([row(1e-2, 1.0), row(1e-4, 4.0)], 1e-3), 9)
    2.0
    >>> seconds_to([row(1e-2, 1.0)], 1e-3) is None
    True
    >>> seconds_to([row(1e-2, 8.0), row(1e-4, 4.0), row(1e-5, 3.0)], 1e-3)
    3.0
    """
    fastest = fastest_form(rows, error)
    return None if fastest is None else fastest[0]


def _seconds_to(rows: Sequence[Row], error: float) -> float | None:
    """Compute the CPU time as described at :func:`seconds_to`.

    All ``rows`` must use the same form of the equations.
    """
    good = [r for r in rows if r.error is not None and r.seconds]
    if not good or _error(min(good, key=_error)) > error:
        return None
    finest = k = good.index(min(good, key=_error))
    while k > 0 and _error(good[k - 1]) <= error:
        k -= 1
    least = min(_time(r) for r in good[k : finest + 1])
    if k == 0 or _error(good[k]) == 0:
        return least
    a, b = good[k - 1], good[k]
    part = math.log(_error(a) / error) / math.log(_error(a) / _error(b))
    return min(least, float(_time(a) * (_time(b) / _time(a)) ** part))


def in_form(label: str, form: str) -> str:
    """Return the label of a candidate, followed by ``form`` in brackets.

    If ``form`` is empty, return only the label.

    >>> in_form("heyoka", "as printed"), in_form("cf:cf4", "")
    ('heyoka (as printed)', 'cf:cf4')
    """
    return f"{label} ({form})" if form else label


def frontier(rows: Sequence[Row]) -> list[Row]:
    """Return the successful runs of one integrator, without slow runs.

    A run is slow if the integrator reaches the same error in less CPU time with another form of the
    equations. If ``rows`` contains runs with several forms, the result is sorted by error, from large to
    small. If all runs in ``rows`` have the same form, the result has the same order as ``rows``.
    """
    forms = by_form(rows)
    good = [r for r in rows if r.error and r.seconds]
    if len(forms) == 1:
        return good

    def beaten(row: Row) -> bool:
        others = (_seconds_to(own, _error(row)) for form, own in forms.items() if form != row.form)
        return any(t is not None and t < _time(row) for t in others)

    return sorted((r for r in good if not beaten(r)), key=lambda r: (-_error(r), _time(r)))


def prevailing_form(rows: Sequence[Row]) -> list[Row]:
    """Return the rows of one form of the equations: the form that is most often the fastest.

    The fastest form is determined for each error 10^-k with k in :data:`DECADES`.
    """
    best = [reached[1] for d in DECADES if (reached := fastest_form(rows, 10.0**-d)) is not None]
    forms = by_form(rows)
    return forms[max(forms, key=best.count)]


def _error(row: Row) -> float:
    assert row.error is not None
    return row.error


def _time(row: Row) -> float:
    assert row.seconds is not None
    return row.seconds


DECADES = range(2, 15)
"""The exponents k of the errors 10^-k for which the candidates are ranked."""


def places(entries: Mapping[str, Sequence[Row]], decades: Sequence[int] = DECADES) -> tuple[Place, ...]:
    """Return the fastest and the second fastest candidate for each error 10^-k with k in ``decades``.

    ``entries`` maps the label of each candidate to its rows. An error that no candidate reaches is omitted.
    """
    result = []
    for decade in decades:
        fastest = {label: fastest_form(rows, 10.0**-decade) for label, rows in entries.items()}
        ordered = sorted((f[0], in_form(label, f[1])) for label, f in fastest.items() if f is not None)
        if ordered:
            (best, winner), *others = ordered
            behind, second = others[0] if others else (None, "")
            result.append(Place(decade, winner, best, second, behind))
    return tuple(result)
