"""The strict protocol: the order of a method on demanding scenes, computed with 50 digits.

The slope of log(error) against log(step size) is compared with a stated order. A method passes if its slopes
settle within 0.25 of the stated order on every scene of :mod:`codegen.lab.orders.strict_scenes`. A method
whose order is higher than stated also fails.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import Optimised, optimise_method
from codegen.lab.orders.convergence import Convergence, converge
from codegen.lab.orders.strict_scenes import strict_scenes
from codegen.lab.reference import cached_reference
from codegen.lab.runner import Interpreted
from codegen.lower import lowering
from codegen.method import Method
from codegen.scene.problem import Problem

DIGITS = 50
Alter = Callable[[Optimised], Optimised]


def stated_order(method: Method, stated: int | None = None) -> CertifiedOrder:
    """Return the stated order. The default is the claim of the tableau file, or the certified order if the
    file has no claim.
    """
    if stated is not None:
        return CertifiedOrder(stated, "stated")
    for claim in () if method.coefficients is None else method.coefficients.claims.orders:
        if claim.family == method.family and (claim.cutoff is None or claim.cutoff == method.cutoff):
            return CertifiedOrder(claim.order, "claimed")
    return certified_order(method)


def strict(
    method: Method,
    stated: CertifiedOrder,
    tell: Callable[[str], object] = str,
    alter: Alter = lambda c: c,
    scenes: Sequence[Problem] | None = None,
) -> Iterator[Convergence]:
    """Yield the convergence of the method on each of ``scenes``, by default on each scene of the protocol.

    ``alter`` changes the step program before the runs.
    """
    for scene in strict_scenes(lowering(method.family)) if scenes is None else scenes:
        tell(f"{method.label} on {scene.name}")
        compiled = alter(optimise_method(scene, method))
        yield converge(Interpreted(compiled, DIGITS), stated, cached_reference(scene))
