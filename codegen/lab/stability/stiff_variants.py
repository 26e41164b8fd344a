"""Stiff variants of gallery scenes: fast oscillators, thin tops and bodies, a near singularity, a stiff spin.

Each has a time scale far below its span, or passes close to a singularity.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial

from codegen import scenes
from codegen.scene.problem import Problem
from codegen.scene.run_time import with_runtime

RADIANS = 200
"""Largest angle of the fastest rotation over the span, if that motion does not decay."""


@dataclass(frozen=True)
class StiffVariant:
    """A variant of a scene: its name, the stiff feature, the problem, and its fastest rate in 1/time."""

    name: str
    about: str
    scene: Problem
    rate: float


def oscillator(omega: int) -> StiffVariant:
    """Return the oscillator with that frequency, over at most three units of time."""
    scene = with_runtime(scenes.load("linear_oscillator"), (f"omega={omega}",))
    label = f"frequency {omega:.0e}"
    span = (Fraction(0), min(Fraction(3), Fraction(RADIANS, omega)))
    return StiffVariant(f"oscillator at {label}", label, replace(scene, span=span), float(omega))


def dipole(gap: Fraction) -> StiffVariant:
    """Return the dipole above a charge that it passes at a distance of about ``gap``."""
    depth = _length_of_dipole() + gap
    scene = with_runtime(scenes.load("dipole"), (f"depth={depth}",))
    scene = replace(scene, span=(Fraction(0), Fraction(5, 2)))
    about = f"passes the charge at {float(gap):g}"
    return StiffVariant(f"dipole that {about}", about, scene, float(1 / gap) ** 1.5)


def _length_of_dipole() -> Fraction:
    """Return the distance of a charge of the dipole from the pivot, to 15 decimals."""
    from codegen.scenes.dipole import a

    return Fraction(f"{math.sqrt(1 + float(a) ** 2):.15f}")


def top(ratio: int) -> StiffVariant:
    """Return a heavy top whose moments of inertia have that ratio, spinning about its thin axis."""
    from sympy import Matrix, Rational, diag, eye

    from codegen.groups import SO3
    from codegen.scene import HamiltonianScene

    G = SO3()
    g, mu = G.point("g"), G.dual("mu")
    I = diag(1, 1, Rational(1, ratio))  # noqa: E741 (the inertia tensor's name)
    e3 = Matrix([0, 0, 1])
    T = mu.dot(g * I.inv() * g.T * mu) / 2
    V = e3.dot(g * Matrix([0, 0, 1]))
    spin = Rational(1, 2)
    scene = HamiltonianScene(
        name="thin_top",
        group=G,
        q=g,
        mu=mu,
        H=T + V,
        parts={"T": T, "V": V},
        q0=eye(3),
        mu0=Matrix([Rational(1, 10), Rational(1, 5), spin / ratio]),
        span=(0, 1),
    )
    label = f"inertia ratio {ratio:.0e}"
    return StiffVariant(f"top with {label}", label, scene, float(ratio) / 10)


def body(ratio: int) -> StiffVariant:
    """Return a free rigid body on its sphere with moments of inertia 1, 1/2 and 1/ratio."""
    from sympy import Matrix, Rational, diag

    from codegen.groups import SO3, Rotation
    from codegen.scene import FieldScene

    m = SO3().dual("m")
    I = diag(1, Rational(1, 2), Rational(1, ratio))  # noqa: E741 (the inertia tensor's name)
    scene = FieldScene(
        name="thin_body",
        group=SO3(),
        action=Rotation(),
        y=m,
        f=-I.inv() * m,
        y0=Matrix([Rational(3, 5), 0, Rational(4, 5)]),
        span=(0, min(Rational(1), Rational(RADIANS, ratio))),
        invariants={"radius": m.dot(m), "energy": m.dot(I.inv() * m) / ratio},
    )
    label = f"inertia ratio {ratio:.0e}"
    return StiffVariant(f"free body with {label}", label, scene, float(ratio))


def spin() -> StiffVariant:
    """Return the stiff driven spin of the gallery: rates 2000 and 1000."""
    return StiffVariant("stiff driven spin", "rates 2000 and 1000", scenes.load("stiff_driven_spin"), 2000.0)


VARIANTS: dict[str, tuple[Callable[[], StiffVariant], ...]] = {
    "linear_oscillator": tuple(partial(oscillator, w) for w in (10**3, 10**6)),
    "dipole": tuple(partial(dipole, Fraction(1, d)) for d in (10, 100, 1000)),
    "fast_heavy_top": tuple(partial(top, r) for r in (10**3, 10**6)),
    "free_rigid_body": tuple(partial(body, r) for r in (10**3, 10**6, 10**12)),
    "stiff_driven_spin": (spin,),
}
"""The stiff variants of gallery scenes; a scene of the user has none."""


def variants_of(scene: Problem) -> Sequence[StiffVariant]:
    """Return the stiff variants of a gallery scene, none for a scene of the user with the same name."""
    makers = VARIANTS.get(scene.name, ())
    if not makers or scene.roots is not scenes.load(scene.name).roots:
        return ()
    return [make() for make in makers]
