"""The default methods and scenes of the commands that measure methods.

A name such as ``cf:cf4`` contains the name of a family of methods and the name of a tableau. The command
``report`` omits default methods whose family cannot be used for the scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from codegen.certify import certified_order
from codegen.errors import MethodError
from codegen.lower import families_for, method_for
from codegen.method import Method, parse
from codegen.scene.problem import Problem
from orderconds.tableau import Tableau

FIELD_METHODS = ("rkmk(0):euler", "cg:cg3", "rkmk(2):rk4", "cf:cf4")
HAMILTONIAN_METHODS = ("vcg:midpoint", "vcg:triple_jump", "cf:cf4", "vcg:triple_jump6")
"""Default methods of the commands ``bench``, ``longrun``, ``stability`` and ``localerror``.

Scenes with a Hamiltonian use HAMILTONIAN_METHODS. All other scenes use FIELD_METHODS.
"""

REPORT_SCENES = ("dipole", "free_rigid_body")
"""Default scenes of the report: ``dipole`` is given by a Hamiltonian, and ``free_rigid_body`` by a vector
field.
"""

REPORT_FIELDS = {"rkmk(0):euler": 1, "cg:cg3": 3, "rkmk(2):rk4": 4, "cf:cf4": 4, "rkmk:butcher6": 6}
REPORT_HAMILTONIANS = {
    "vcg:midpoint": 2,
    "vcg:triple_jump": 4,
    "vrkmk(2):gauss2": 4,
    "vcf:vcf_gauss2": 4,
    "cf:cf4": 4,
    "splitting:blanes_moan4": 4,
    "splitting:blanes_moan_rkn6a": 6,
}
"""The default methods that the command ``report`` runs with equal steps, and their orders.

The report of a scene omits a method if its order on the scene differs from the order in this list.
"""

REPORT_ADAPTIVE = ("ambient:dop853", "rkmk(3):dormand_prince5", "cf:cf43")
"""The default methods that the command ``report`` runs with step-size control.

The report of a Hamiltonian scene uses only the first of these methods.
"""

README_METHODS = {
    "dipole": (
        "vcg:midpoint",
        "vcg:triple_jump",
        "vcg:triple_jump6",
        "vrkmk(0):gauss1",
        "vrkmk(2):gauss2",
        "vrkmk(4):gauss3",
        "vcf:vcf4_s2",
        "rkmk:rk4",
        "splitting:blanes_moan_rkn4",
        "ambient:dop853",
    ),
    "discoveries": (
        "vcf:vcf_gauss2",
        "vcf:vcf4_s3",
        "vcf:vcf_gauss3",
        "cf:cf5_s7",
        "vcg:triple_jump",
        "vcg:vcg4_s5_dirk",
        "vcg:vcg4_s6",
        "vrkmk(2):gauss2",
        "rkmk(2):rk4",
    ),
    "discoveries_vcg": (
        "vcg:triple_jump",
        "vcg:vcg3_s3",
        "vcg:vcg4_s3",
        "vcg:vcg4_s4",
        "vcg:vcg4_s5",
        "vcg:vcg4_s5_dirk",
        "vcg:vcg4_s6",
        "vcg:vcg4_s6_dirk",
        "vrkmk(2):gauss2",
        "rkmk:rk4",
    ),
}
"""Maps the name of each work-precision diagram of the README to its methods.

Methods that are also in :data:`REPORT_ADAPTIVE` run with step-size control.
"""

PICTURED = (
    (*REPORT_FIELDS, *REPORT_ADAPTIVE),
    (*REPORT_HAMILTONIANS, REPORT_ADAPTIVE[0]),
    (*FIELD_METHODS, *REPORT_ADAPTIVE),
    HAMILTONIAN_METHODS,
    *README_METHODS.values(),
)
"""The methods of each figure; a method has the same colour and marker in all figures."""


def methods_for(scene: Problem, names: Sequence[Method | Tableau | str] = ()) -> tuple[Method, ...]:
    """Return the named methods, or the default methods for the scene if ``names`` is empty.

    For unknown names, the errors of :func:`codegen.method.parse` are raised.
    """
    defaults = HAMILTONIAN_METHODS if scene.is_hamiltonian else FIELD_METHODS
    return tuple(method_for(scene, name) for name in (names or defaults))


def report_methods(scene: Problem) -> tuple[tuple[Method, ...], tuple[Method, ...]]:
    """Return the default methods of the report: those with equal steps, and those with step-size control."""
    families, chosen = families_for(scene), []
    for name, order in (REPORT_HAMILTONIANS if scene.is_hamiltonian else REPORT_FIELDS).items():
        if name.partition(":")[0].partition("(")[0] not in families:
            continue
        try:
            method = parse(name, families)
            if certified_order(method, scene).order == order:
                chosen.append(method)
        except MethodError:
            continue
    count = 1 if scene.is_hamiltonian else len(REPORT_ADAPTIVE)
    adaptive = (replace(parse(name, families), adaptive=True) for name in REPORT_ADAPTIVE[:count])
    return tuple(chosen), tuple(adaptive)
