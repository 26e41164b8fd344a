"""Reference solutions: Gragg-Bulirsch-Stoer extrapolation of a scene's ambient equations, to 30 digits.

No Lie group enters: the modified midpoint rule is applied to y' = f(y).y in the coordinates of the state and
extrapolated in the squared step (Hairer, Norsett and Wanner I, section II.9). So a mistake in a group's
exponential or in a family cannot hide in the reference as well. Two runs of different order and tolerance
must agree, and their distance is the stated uncertainty.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from codegen.errors import SceneError
from codegen.ir.domain import PreciseDomain
from codegen.scene import Setting

DIGITS = 50
"""Working precision: the harmonic step sequence loses up to ten digits at 16 columns."""

RUNS = ((14, -33), (16, -36))
"""Columns of the extrapolation and decimal exponent of the tolerance, of the check and of the answer."""

AGREEMENT = 1e-30
"""The two runs must agree to this, relative to the size of the state."""

LEAST_STEP = 5e-4
"""Part of the span below which a step says that the scene is too stiff, or runs into a singularity: two
thousand steps of extrapolation take minutes."""


@dataclass(frozen=True)
class Reference:
    """The state of a scene at the end of its span.

    ``state`` holds mpmath numbers of :data:`DIGITS` digits in the order of ``scene.symbols``;
    ``uncertainty`` is the largest difference of two runs that share neither order nor tolerance.
    """

    scene: str
    state: tuple[Any, ...]
    uncertainty: float

    def digits(self, count: int = 30) -> tuple[str, ...]:
        """Return the state as decimal strings of ``count`` significant digits."""
        import mpmath

        return tuple(mpmath.nstr(x, count) for x in self.state)


def reference(scene: Setting) -> Reference:
    """Return the reference of a scene at the end of its span, with its measured uncertainty.

    :class:`codegen.errors.SceneError` where the equations cannot be evaluated along the way, or where two
    runs do not agree to 30 digits.
    """
    checked, answer = (_end(scene, columns, exponent) for columns, exponent in RUNS)
    size = max(1.0, *(float(abs(x)) for x in answer))
    gap = max(float(abs(a - b)) for a, b in zip(checked, answer, strict=True))
    if not gap <= AGREEMENT * size:
        raise SceneError(
            f"two references differ by {gap:.1e}",
            where=scene.name,
            expected=f"agreement to {AGREEMENT:g}",
            hint="shorten the span, or look for a jump in the field",
        )
    return Reference(scene.name, answer, gap)


def _end(scene: Setting, columns: int, exponent: int) -> tuple[Any, ...]:
    """Return the final state, by steps as long as the difference of the last two columns permits."""
    domain = PreciseDomain(0, DIGITS)
    number = domain.rational
    t, end = (number(*x.as_integer_ratio()) for x in scene.span)
    tolerance = number(10) ** exponent
    step, shortest = (end - t) / 8, (end - t) * LEAST_STEP
    y = scene.initial(domain)
    reason = "extrapolation does not converge"
    while step > shortest:
        step = min(step, end - t)
        try:
            new, error = _extrapolate(scene, domain, y, t, step, columns)
        except ArithmeticError as failure:  # a trial step may be long enough to leave the field's domain
            reason, step = str(failure), step / 5
            continue
        size = max(1, *(abs(x) for x in new))
        if error <= tolerance * size:
            t, y = t + step, new
        if t >= end:
            return y
        # The difference of the last two columns is O(step^(2 columns - 1)).
        ratio = (error / (tolerance * size)) ** (-number(1, 2 * columns - 1)) if error else 4
        step = step * max(number(1, 5), min(4, number(9, 10) * ratio))
    raise SceneError(
        f"no reference solution beyond t = {float(t):.6g}: {reason}",
        where=scene.name,
        expected="a field that is smooth and not stiff over the span",
        hint="end the span before that time",
    )


def _extrapolate(
    scene: Setting, domain: PreciseDomain, y: tuple[Any, ...], t: Any, step: Any, columns: int
) -> tuple[tuple[Any, ...], Any]:
    """Return the diagonal entry of the table after ``columns`` rows, and its distance to its neighbour.

    ArithmeticError where the field cannot be evaluated on the way.
    """
    slope = scene.velocity(domain, y, t)
    row: list[tuple[Any, ...]] = []
    for j in range(1, columns + 1):
        new = [_midpoint(scene, domain, y, slope, t, step, 2 * j)]
        for k in range(1, j):
            factor = domain.rational((j - k) ** 2, j * j - (j - k) ** 2)
            better, worse = new[k - 1], row[k - 1]
            new.append(tuple(a + (a - b) * factor for a, b in zip(better, worse, strict=True)))
        row = new
    if not all(isinstance(x, domain.context.mpf) and domain.context.isfinite(x) for x in row[-1]):
        raise ArithmeticError("a coordinate is not a finite real number")
    error = max(abs(a - b) for a, b in zip(row[-1], row[-2], strict=True))
    return row[-1], error


def _midpoint(
    scene: Setting, domain: PreciseDomain, y: Sequence[Any], slope: Sequence[Any], t: Any, step: Any, n: int
) -> tuple[Any, ...]:
    """Return n steps (n even) of the explicit midpoint rule, started by an Euler step."""
    h = step / n
    old, new = tuple(y), tuple(a + h * b for a, b in zip(y, slope, strict=True))
    for k in range(1, n):
        f = scene.velocity(domain, new, t + k * h)
        old, new = new, tuple(a + 2 * h * b for a, b in zip(old, f, strict=True))
    return new
