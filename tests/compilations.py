"""Compilations that tests share: in one process, a method on a scene of the gallery is compiled once.

A test that patches the compiler, or checks that it repeats itself, calls :mod:`codegen.emitter` directly.
"""

from __future__ import annotations

from functools import cache

from codegen.artifact import Artifact
from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import Compiled, compile_method, emit_compiled

_ORDERS: dict[tuple[str, str], CertifiedOrder] = {}
"""Certified orders by scene and method: they depend on neither target nor solver nor frame."""


def compiled(
    scene: str,
    method: str,
    solver: str = "auto",
    frame: str = "space",
    inputs: tuple[str, ...] = (),
    jacobian: bool = False,
) -> Compiled:
    """Return the shared result of ``compile_method``; the arguments are those of ``compile_method``."""
    return _compiled(scene, method, solver, frame, inputs, jacobian)


@cache
def _compiled(
    scene: str, method: str, solver: str, frame: str, inputs: tuple[str, ...], jacobian: bool
) -> Compiled:
    return compile_method(scene, method, (), inputs, frame, solver=solver, jacobian=jacobian)


@cache
def emitted(
    scene: str,
    method: str,
    target: str = "c",
    solver: str = "auto",
    frame: str = "space",
    precision: str = "double",
) -> Artifact:
    """Return the shared module of a target under its default prefix."""
    shared = compiled(scene, method, solver, frame)
    label = (shared.scene.name, shared.method.label)
    if label not in _ORDERS:
        _ORDERS[label] = certified_order(shared.method, shared.scene)
    return emit_compiled(shared, target, order=_ORDERS[label], precision=precision)
