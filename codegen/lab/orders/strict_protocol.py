"""The strict protocol: a test of the order of a method on demanding scenes, in arithmetic with 50 digits.

The slopes of log(error) against log(step size) are compared with a stated order. Usually, a method passes
on a scene if the slopes settle and the last slope differs from the stated order by at most 0.25. All rules
are in :meth:`codegen.lab.orders.step_sizes.Refinement.verdict`.
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
    """Return the order that the strict protocol tests.

    The result is the first order in this list that exists:

    - the order ``stated``,
    - the order that the tableau file claims for the family of the method,
    - the order computed from the order conditions.
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
    """Test the order of the method on each scene, and yield the results.

    By default, the scenes are those of :func:`strict_scenes` for the family of the method. Before each test,
    ``tell`` is called with a text that names the method and the scene. ``alter`` changes the compiled method
    before the test.
    """
    for scene in strict_scenes(lowering(method.family)) if scenes is None else scenes:
        tell(f"{method.label} on {scene.name}")
        compiled = alter(optimise_method(scene, method))
        yield converge(Interpreted(compiled, DIGITS), stated, cached_reference(scene))
