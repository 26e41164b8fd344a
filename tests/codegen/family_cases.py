"""The methods that tests try for each family, each with its order and two scenes.

These two tables are the only lists in the tests of the compiler that must contain every family.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction

from sympy import diag

from codegen.scene.problem import Problem
from tests.codegen.four_bodies import (
    bent_springs,
    clamped_bodies,
    conservative_spins,
    detuned_spins,
    driven_qubits,
    driven_springs,
    frames,
    paired_spins,
    plane_states,
    pushed_spins,
    quartic_springs,
    turning_bodies,
    unit_spins,
)
from tests.strategies import field_scene, hamiltonian_scene, linear_scene, top_scene


@dataclass(frozen=True)
class Case:
    """A method, a polynomial scene and one of the gallery that it is tried on, and the order it has."""

    method: str
    order: int
    polynomial: Callable[[], Problem]
    gallery: str


SHORT = (Fraction(0), Fraction(1, 4))
"""The span of polynomial scenes: their solutions may reach infinity soon after."""


def place(name: str) -> Callable[[], Problem]:
    return lambda: replace(field_scene(name), span=SHORT)


def cotangent(name: str = "SO(3)") -> Callable[[], Problem]:
    return lambda: replace(hamiltonian_scene(name), span=SHORT)


def linear(name: str = "SO(3)") -> Callable[[], Problem]:
    return lambda: replace(linear_scene(name), span=SHORT)


def top(name: str) -> Callable[[], Problem]:
    inertia = {"symmetric": (2, 3, 2), "asymmetric": (1, 2, 4)}[name]
    return lambda: replace(top_scene(diag(*inertia)), span=SHORT)


CASES = {
    "rk": (
        Case("rk:kutta3", 3, place("R^3"), "linear_oscillator"),
        Case("rk:gauss2", 4, place("R^3"), "linear_oscillator"),
    ),
    "rkmk": (
        Case("rkmk:rk4", 4, place("S^2"), "driven_spin"),
        Case("rkmk(1):kutta3", 3, place("SO(3)"), "dipole"),
        Case("rkmk(2):gauss2", 4, place("S^2"), "driven_spin"),
    ),
    "cg": (
        Case("cg:cg3", 3, place("S^2"), "driven_spin"),
        Case("cg:gauss1", 2, place("SO(3)"), "driven_spin"),
    ),
    "cf": (
        Case("cf:cf4", 4, place("S^2"), "driven_spin"),
        Case("cf:gauss1", 2, place("SO(3)"), "driven_spin"),
    ),
    "vcg": (
        Case("vcg:midpoint", 2, cotangent(), "dipole"),
        Case("vcg:triple_jump", 4, cotangent(), "dipole"),
    ),
    "vrkmk": (
        Case("vrkmk(1):kutta3", 3, cotangent(), "dipole"),
        Case("vrkmk(2):gauss2", 4, cotangent(), "dipole"),
    ),
    "vcf": (
        Case("vcf:midpoint", 2, cotangent(), "dipole"),
        Case("vcf:cf4", 4, cotangent(), "dipole"),
    ),
    "vrkmk_pade": (
        Case("vrkmk_pade(1):kutta3", 3, cotangent(), "dipole"),
        Case("vrkmk_pade(2):gauss2", 4, cotangent(), "dipole"),
    ),
    "slgi": (
        Case("slgi:euler", 1, cotangent(), "dipole"),
        Case("slgi:midpoint", 2, cotangent(), "dipole"),
        Case("slgi:gauss2", 2, cotangent(), "dipole"),
    ),
    "discrete_gradient": (
        Case("discrete_gradient:euler", 1, cotangent(), "dipole"),
        Case("discrete_gradient:midpoint", 2, cotangent(), "free_rigid_body_s3"),
        Case("discrete_gradient:gauss2", 2, cotangent(), "dipole"),
    ),
    "splitting": (
        Case("splitting:forest_ruth4", 4, top("symmetric"), "fast_heavy_top"),
        Case("splitting:ruth3", 3, top("asymmetric"), "dipole"),
    ),
    "prk": (
        Case("prk:stormer_verlet", 2, cotangent("R^3"), "linear_oscillator"),
        Case("prk:lobatto3ab3", 4, cotangent("R^3"), "linear_oscillator"),
    ),
    "ambient": (
        Case("ambient:rk4", 4, place("S^2"), "driven_spin"),
        Case("ambient:gauss2", 4, cotangent(), "dipole"),
    ),
    "taylor": (
        Case("taylor(3)", 3, place("S^2"), "driven_spin"),
        Case("taylor(4)", 4, cotangent(), "dipole"),
        Case("taylor(5)", 5, place("R^3"), "linear_oscillator"),
    ),
    "composition": (
        Case("composition:triple_jump", 4, top("asymmetric"), "linear_oscillator"),
        Case("composition:mclachlan4", 4, top("symmetric"), "dipole"),
    ),
    "magnus": (
        Case("magnus:magnus4", 4, linear(), "linear_oscillator_sl2"),
        Case("magnus:magnus6", 6, linear("SL(2)"), "linear_oscillator_sl2"),
    ),
    "cf_magnus": (
        Case("cf_magnus:cf_magnus4", 4, linear(), "linear_oscillator_sl2"),
        Case("cf_magnus:lie_midpoint_triple_jump", 4, linear("GL(2)"), "linear_oscillator_sl2"),
    ),
    "fer": (
        Case("fer:fer4", 4, linear(), "linear_oscillator_sl2"),
        Case("fer:fer6", 6, linear("SL(2)"), "linear_oscillator_sl2"),
    ),
    "cayley": (
        Case("cayley:cayley4", 4, linear(), "linear_oscillator_sl2"),
        Case("cayley:cayley6", 6, linear("SL(2)"), "linear_oscillator_sl2"),
    ),
}
"""The cases by the name of the family. The first case of a family is tried in every run of the tests."""


@dataclass(frozen=True)
class LatticeCase:
    """A method, its order, a chain, and rational states of four sites."""

    method: str
    order: int
    chain: Callable[[], Problem]
    states: Callable[[], list[list[Fraction]]]


LATTICE_CASES = {
    "rk": (
        LatticeCase("rk:kutta3", 3, quartic_springs, plane_states),
        LatticeCase("rk:gauss2", 4, quartic_springs, plane_states),
    ),
    "rkmk": (
        LatticeCase("rkmk:rk4", 4, pushed_spins, unit_spins),
        LatticeCase("rkmk:gauss1", 2, turning_bodies, frames),
    ),
    "cg": (LatticeCase("cg:cg3", 3, pushed_spins, unit_spins),),
    "cf": (
        LatticeCase("cf:cf4", 4, pushed_spins, unit_spins),
        LatticeCase("cf:cf3", 3, turning_bodies, frames),
    ),
    "ambient": (LatticeCase("ambient:kutta3", 3, pushed_spins, unit_spins),),
    "taylor": (
        LatticeCase("taylor(3)", 3, pushed_spins, unit_spins),
        LatticeCase("taylor(2)", 2, turning_bodies, frames),
        LatticeCase("taylor(5)", 5, quartic_springs, plane_states),
        # The detuning of a spin is constant, but the detuning outside the open end is not.
        LatticeCase("taylor(4)", 4, driven_qubits, detuned_spins),
    ),
    "discrete_gradient": (
        LatticeCase("discrete_gradient:midpoint", 2, quartic_springs, plane_states),
        LatticeCase("discrete_gradient:gauss2", 2, conservative_spins, unit_spins),
        LatticeCase("discrete_gradient:euler", 1, clamped_bodies, frames),
        LatticeCase("discrete_gradient:gauss2", 2, clamped_bodies, frames),
    ),
    "vcg": (
        LatticeCase("vcg:midpoint", 2, turning_bodies, frames),
        LatticeCase("vcg:triple_jump", 4, quartic_springs, plane_states),
    ),
    "vrkmk": (LatticeCase("vrkmk(1):kutta3", 3, clamped_bodies, frames),),
    "vcf": (
        LatticeCase("vcf:midpoint", 2, clamped_bodies, frames),
        LatticeCase("vcf:cf4", 4, quartic_springs, plane_states),
    ),
    "vrkmk_pade": (LatticeCase("vrkmk_pade(1):kutta3", 3, clamped_bodies, frames),),
    "slgi": (
        LatticeCase("slgi:euler", 1, turning_bodies, frames),
        LatticeCase("slgi:gauss2", 2, clamped_bodies, frames),
    ),
    "prk": (
        LatticeCase("prk:stormer_verlet", 2, quartic_springs, plane_states),
        LatticeCase("prk:ruth3_pair", 3, quartic_springs, plane_states),
        LatticeCase("prk:lobatto3ab3", 4, quartic_springs, plane_states),
        LatticeCase("prk:lobatto3ab3", 4, bent_springs, plane_states),
    ),
    "splitting": (
        LatticeCase("splitting:strang", 2, quartic_springs, plane_states),
        LatticeCase("splitting:ruth3", 3, paired_spins, unit_spins),
        LatticeCase("splitting:strang", 2, turning_bodies, frames),
        LatticeCase("splitting:forest_ruth4", 4, driven_springs, plane_states),
        LatticeCase("splitting:forest_ruth4", 4, quartic_springs, plane_states),
        LatticeCase("splitting:ruth3", 3, quartic_springs, plane_states),
        LatticeCase("splitting:mclachlan_atela4", 4, quartic_springs, plane_states),
        LatticeCase("splitting:blanes_moan_rkn6a", 6, quartic_springs, plane_states),
    ),
    "composition": (
        LatticeCase("composition:triple_jump", 4, quartic_springs, plane_states),
        LatticeCase("composition:triple_jump", 4, paired_spins, unit_spins),
        LatticeCase("composition:triple_jump", 4, driven_springs, plane_states),
        LatticeCase("composition:mclachlan4", 4, quartic_springs, plane_states),
    ),
    "magnus": (
        LatticeCase("magnus:magnus4", 4, driven_qubits, detuned_spins),
        LatticeCase("magnus:magnus6", 6, driven_qubits, detuned_spins),
    ),
    "cf_magnus": (LatticeCase("cf_magnus:cf_magnus4", 4, driven_qubits, detuned_spins),),
    "fer": (LatticeCase("fer:fer4", 4, driven_qubits, detuned_spins),),
    "cayley": (LatticeCase("cayley:cayley4", 4, driven_qubits, detuned_spins),),
}
"""The cases on lattices by the name of the family. The order of the first case is computed in every run."""
