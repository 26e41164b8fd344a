"""Maps from one ring to another:

- from Q to every ring,
- from a number field to balls or to a larger number field,
- from a ring R to the ring of power series with coefficients in R.
"""

from __future__ import annotations

from collections.abc import Callable

from orderconds.ring.balls import Balls
from orderconds.ring.power_series import PowerSeries
from orderconds.ring.protocol import Element, Ring
from orderconds.ring.rationals import Rationals


def embedding(source: Ring, target: Ring) -> Callable[[Element], Element]:
    """Return the function that maps each element of ``source`` to the corresponding element of ``target``.

    Raises TypeError if no such function is known.

    >>> from orderconds.ring import QQ, PowerSeries
    >>> R = PowerSeries(QQ, 2)
    >>> R.text(embedding(QQ, R)(QQ.rational(1, 2)))
    '1/2'
    """
    if source == target:
        return lambda x: x
    if isinstance(target, PowerSeries):
        inner, series = embedding(source, target.base), target
        return lambda x: series.constant(inner(x))
    if isinstance(source, Rationals):
        return lambda x: target.rational(int(x.p), int(x.q))
    if isinstance(target, Balls):
        balls = target
        return lambda x: balls.enclose(_ball(source, x, balls.bits))
    if hasattr(target, "lift"):
        lift: Callable[[Element], Element] = target.lift
        return lift
    raise TypeError(f"no map from {source.name} to {target.name}")


def _ball(source: Ring, x: Element, bits: int) -> Element:
    if not hasattr(source, "ball"):
        raise TypeError(f"cannot enclose elements of {source.name} in balls")
    return source.ball(x, bits)
