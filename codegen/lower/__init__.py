"""Lowering: one file a family says how (tableau, scene) becomes a step program with one block of stages."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from typing import Any

from codegen.errors import MethodError
from codegen.flows.field_by_parts import simplified
from codegen.ir.program import Program
from codegen.lower.discrete_gradient import keeps_energy
from codegen.lower.splitting import problem_for as with_flows
from codegen.lower.substeps import substeps as repeated
from codegen.method import Method
from codegen.scene.problem import Problem

LOWERINGS = {
    "rk": "rkmk",
    "rkmk": "rkmk",
    "cg": "cf",
    "cf": "cf",
    "vcg": "vcg",
    "vrkmk": "vrkmk",
    "vcf": "vcf",
    "vrkmk_pade": "vrkmk_pade",
    "slgi": "slgi",
    "discrete_gradient": "discrete_gradient",
    "splitting": "splitting",
    "composition": "splitting",
    "ambient": "rkmk",
}
"""Family name to module."""

ON_COTANGENT = frozenset({"vcg", "vrkmk", "vcf", "vrkmk_pade", "slgi"})
"""Families that need a Hamiltonian scene; all others see it as a field on the group T*G."""


OF_PARTS = frozenset({"splitting", "composition"})
"""Families that compose exact flows of a Hamiltonian's parts."""


def families_for(scene: Problem) -> tuple[str, ...]:
    """Return the families that can be lowered onto a scene, in the order of preference where none is named.

    Variational families need a Hamiltonian and come first where there is one; ``rk`` needs R^n, splittings
    need a Hamiltonian in parts, discrete gradients an energy.
    """
    able = dict.fromkeys(LOWERINGS, True)
    able |= dict.fromkeys(sorted(ON_COTANGENT), scene.is_hamiltonian)
    able |= dict.fromkeys(sorted(OF_PARTS), scene.is_hamiltonian and bool(scene.parts))
    able["rk"] = scene.as_field().group.abelian
    able["discrete_gradient"] = keeps_energy(scene)
    return tuple(sorted((f for f in LOWERINGS if able[f]), key=lambda f: f not in ON_COTANGENT))


def problem_for(scene: Problem, method: Method) -> Problem:
    """Return the scene as the method's family sees it; :class:`MethodError` where it cannot serve."""
    family = method.family
    if family in ON_COTANGENT | OF_PARTS:
        if not scene.is_hamiltonian:
            hint = f"use one of {', '.join(sorted(set(LOWERINGS) - ON_COTANGENT - OF_PARTS))}"
            raise MethodError(f"{family} on {scene.name}", expected="a Hamiltonian scene", hint=hint)
        if family in OF_PARTS and (scene.forced or scene.inputs):
            what = "a wrench" if scene.forced else "run-time inputs"
            raise MethodError(
                f"{family} on {scene.name}, which is driven by {what}",
                expected="a Hamiltonian that is the sum of parts with exact flows",
                hint="use one of " + ", ".join(sorted(set(LOWERINGS) - OF_PARTS)),
            )
        return with_flows(scene, method) if family in OF_PARTS else scene
    if family == "ambient":
        return scene.as_ambient()
    view = simplified(scene).as_field()
    if family == "rk" and not view.group.abelian:
        group = view.group.name
        raise MethodError(
            f"rk on {scene.name}, whose group is {group}",
            expected="R^n",
            hint="use rkmk, cg or cf, or ambient to leave the manifold",
        )
    return view


def lower(scene: Problem, method: Method) -> Program:
    """Return the verified step program of a method on a scene, all its stages in one block."""
    if method.family not in LOWERINGS:
        known = ", ".join(LOWERINGS)
        raise MethodError(f"family {method.family} cannot be lowered yet", expected=f"one of {known}")
    module: Any = import_module(f"codegen.lower.{LOWERINGS[method.family]}")
    program: Program = module.lower(problem_for(scene, method), method)
    return program


def lower_composed(scene: Problem, method: Method) -> Program | None:
    """Return the verified program of a step made of shorter ones that are alike, None where it is not."""
    found = repeated(method)
    if found is None:
        return None
    base, steps = found
    return replace(lower(scene, base), substeps=steps)
