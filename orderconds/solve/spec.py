"""The specification of the method that a search must find."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from orderconds.errors import InputError


@dataclass(frozen=True)
class Spec:
    """The required properties of a method. Each property is an option of ``orderconds solve``.

    - ``dirk``: whether the method is diagonally implicit
    - ``fsal``: whether the last stage equals the result of the step (first same as last)
    - ``fix``: linear equations between coefficients
    - ``positive``: the names of coefficients that must be positive; the name ``b`` denotes all weights
    - ``size``: a bound on the absolute values of all coefficients
    - ``exponentials``: the number of exponentials in the update of a commutator-free method
    - ``inner``: the number of exponentials in each stage of a commutator-free method
    - ``rkn``: whether the method is a Runge-Kutta-Nystrom method
    - ``low_storage``: whether the method is a scheme with two registers (2N)
    """

    stages: int
    explicit: bool = False
    dirk: bool = False
    symmetric: bool = False
    fsal: bool = False
    fix: tuple[str, ...] = ()
    positive: tuple[str, ...] = ()
    size: Fraction | None = None
    exponentials: int = 2
    inner: int = 2
    rkn: bool = False
    low_storage: bool = False


def refuse(family: str, spec: Spec, options: Sequence[str]) -> None:
    """Raise :class:`~orderconds.errors.InputError` if ``spec`` sets an option that is not available for
    ``family``. ``options`` contains the names of the options that are not available.

    >>> refuse("rk", Spec(stages=2), ("rkn",))
    """
    plain = Spec(spec.stages)
    for option in options:
        if getattr(spec, option) != getattr(plain, option):
            written = option.replace("_", "-")
            raise InputError(
                f"--{written} is not available for family {family}", where="solve", expected=f"no --{written}"
            )
