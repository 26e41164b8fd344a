"""The strict protocol: a method against a battery of scenes, in fifty digits, from below and above.

What is held against the slopes is the order that somebody states: the claim of the tableau's file for the
family, or a number. A method passes when on every scene of the battery its slopes settle within a quarter of
that order, divided by the true ratio of the steps. So a method that is better than stated fails as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import Optimised, optimise_method
from codegen.lab.battery import battery
from codegen.lab.converge import Convergence, converge
from codegen.lab.remembered import remembered
from codegen.lab.runner import Interpreted
from codegen.lower import lowering
from codegen.method import Method

DIGITS = 50
Spoil = Callable[[Optimised], Optimised]


def stated_order(method: Method, stated: int | None = None) -> CertifiedOrder:
    """Return the order to hold a method to: ``stated``, its file's claim, or else what is computed."""
    if stated is not None:
        return CertifiedOrder(stated, "stated")
    for claim in method.tableau.claims.orders:
        if claim.family == method.family and (claim.cutoff is None or claim.cutoff == method.cutoff):
            return CertifiedOrder(claim.order, "claimed")
    return certified_order(method)


def strict(
    method: Method, stated: CertifiedOrder, tell: Callable[[str], object] = str, spoil: Spoil = lambda c: c
) -> Iterator[Convergence]:
    """Yield what a method shows on each scene of the battery; ``spoil`` puts a fault into its program."""
    for scene in battery(lowering(method.family).hamiltonian):
        tell(f"{method.label} on {scene.name}")
        compiled = spoil(optimise_method(scene, method))
        yield converge(Interpreted(compiled, DIGITS), stated, remembered(scene))
