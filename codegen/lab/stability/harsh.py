"""Harsh variants of scenes: fast oscillators, thin tops and bodies, a charge within reach, a stiff spin.

Each has a time scale far below the span of its solution, or comes near a singularity.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction

from codegen import scenes
from codegen.scene.problem import Problem
from codegen.scene.run_time import with_runtime

RADIANS = 200
"""Angle that the fastest motion turns through at most, where that motion does not decay."""


@dataclass(frozen=True)
class Harsh:
    """A variant: what is harsh about it, the scene, and its fastest rate in 1/time."""

    name: str
    about: str
    scene: Problem
    rate: float


def oscillator(omega: int) -> Harsh:
    """Return the oscillator with that frequency over three units of time."""
    scene = with_runtime(scenes.load("linear_oscillator"), (f"omega={omega}",))
    label = f"frequency {omega:.0e}"
    span = (Fraction(0), min(Fraction(3), Fraction(RADIANS, omega)))
    return Harsh(f"oscillator at {label}", label, replace(scene, span=span), float(omega))


def dipole(gap: Fraction) -> Harsh:
    """Return the dipole with the charge so deep that it passes it at about ``gap``."""
    depth = Fraction("1.004987562112089") + gap
    scene = with_runtime(scenes.load("dipole"), (f"depth={depth}",))
    scene = replace(scene, span=(Fraction(0), Fraction(5, 2)))
    about = f"passes the charge at {float(gap):g}"
    return Harsh(f"dipole that {about}", about, scene, float(1 / gap) ** 1.5)


def top(ratio: int) -> Harsh:
    """Return a heavy top whose moments of inertia differ by that ratio, spinning about its thin axis."""
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
    return Harsh(f"top with {label}", label, scene, float(ratio) / 10)


def body(ratio: int) -> Harsh:
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
    return Harsh(f"free body with {label}", label, scene, float(ratio))


def spin() -> Harsh:
    """Return the stiff driven spin of the gallery: rates 2000 and 1000."""
    return Harsh("stiff driven spin", "rates 2000 and 1000", scenes.load("stiff_driven_spin"), 2000.0)


VARIANTS: dict[str, tuple[Callable[[], Harsh], ...]] = {
    "linear_oscillator": tuple(lambda w=w: oscillator(w) for w in (10**3, 10**6)),  # type: ignore[misc]
    "dipole": tuple(lambda d=d: dipole(Fraction(d)) for d in ("1/10", "1/100", "1/1000")),  # type: ignore[misc]
    "fast_heavy_top": tuple(lambda r=r: top(r) for r in (10**3, 10**6)),  # type: ignore[misc]
    "free_rigid_body": tuple(lambda r=r: body(r) for r in (10**3, 10**6, 10**12)),  # type: ignore[misc]
    "stiff_driven_spin": (spin,),
}
"""Scene of the gallery to its harsh variants."""
