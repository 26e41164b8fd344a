"""A lowering translates a method and a scene into the program of one step.

A method is a tableau together with a family such as ``rkmk``. Each family has one lowering, an object of a
subclass of :class:`Lowering`.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.errors import MethodError, UnclaimedTableau
from codegen.ir.program import Program
from codegen.lower.base import Lowering as Lowering
from codegen.lower.base import Objection as Objection
from codegen.lower.registry import families_for as families_for
from codegen.lower.registry import lowering as lowering
from codegen.lower.registry import names as names
from codegen.lower.registry import register as register
from codegen.lower.registry import unregister as unregister
from codegen.lower.substeps import substeps
from codegen.method import STEP, Method, family_in, method_of
from codegen.scene.problem import Problem
from orderconds.tableau import Tableau

__all__ = [
    "Lowering",
    "Objection",
    "families_for",
    "lower",
    "lower_composed",
    "lowering",
    "method_for",
    "names",
    "problem_for",
    "register",
    "unregister",
]


def problem_for(scene: Problem, method: Method) -> Problem:
    """Return the result of :meth:`Lowering.problem` for the family of the method.

    :class:`MethodError` is raised if the family does not accept the scene.
    """
    own = lowering(method.family)
    _check(scene, own)
    # ``problem`` raises MethodError if the method cannot be used on this scene.
    return own.problem(scene, method)


def method_for(scene: Problem, given: Method | Tableau | str, family: str = "") -> Method:
    """Return ``given`` as a method for a scene (:func:`codegen.method.method_of`).

    The argument ``family`` can name the family of the method. If ``given`` is a text such as ``cf:cf4``, the
    text can also name the family (``cf``). :class:`MethodError` is raised if the family does not accept the
    scene.
    """
    stated = _stated_step(scene, given)
    if stated is not None:
        return stated
    # A text such as ``cf:cf4`` names the family ``cf``. A Tableau names no family.
    named = family if isinstance(given, Tableau) or family else family_in(given)
    # A name such as ``rkmk(2)`` consists of the family ``rkmk`` and the cut-off 2.
    known = named.partition("(")[0]
    # If the family does not accept the scene, ``_check`` raises an error with the reason.
    if known in names():
        _check(scene, lowering(known))
    try:
        return method_of(given, families_for(scene), family)
    except UnclaimedTableau as error:
        # ``error.claimed`` lists the families for which the tableau file gives an order. If such a family
        # does not accept the scene, _check raises an error with the reason.
        for claimed in () if named else error.claimed:
            if claimed in names():
                _check(scene, lowering(claimed))
        raise


def _stated_step(scene: Problem, given: Method | Tableau | str) -> Method | None:
    """Return the method for a text ``step:NAME``, or None if ``given`` is not such a text.

    :class:`MethodError` is raised if the scene does not define the step NAME.
    """
    word, colon, name = given.strip().partition(":") if isinstance(given, str) else ("", "", "")
    if word != STEP or not colon:
        return None
    if name not in scene.steps:
        raise MethodError(
            f"the scene defines no step {name!r}",
            where=scene.name,
            expected=f"one of {', '.join(scene.steps)}" if scene.steps else "a scene that defines steps",
            hint='define the step in the argument "steps" of LinearScene',
        )
    # ``name`` is the name of a step y1 = M y0. The scene defines this step by a formula for the matrix M.
    # The compiler of the family ``magnus`` also compiles such steps.
    return Method("magnus", None, step=name)


def _check(scene: Problem, own: Lowering) -> None:
    """Raise :class:`MethodError` if the family of the lowering ``own`` does not accept a scene."""
    objection = own.objection(scene)
    if objection is not None:
        raise MethodError(
            f"the family {own.family} cannot be used on {scene.name}{objection.reason}",
            expected=objection.expected,
            hint=objection.hint or f"use one of {', '.join(families_for(scene))}",
        )


def lower(scene: Problem, method: Method) -> Program:
    """Return the step program of a method on a scene (:meth:`Lowering.lower`)."""
    return lowering(method.family).lower(problem_for(scene, method), method)


def lower_composed(scene: Problem, method: Method) -> Program | None:
    """Return the program of one substep of a composition, or None if a step cannot be divided into substeps.

    The program is the same for all substeps. Its attribute ``substeps`` contains the length and the initial
    time of each substep.
    """
    # The steps of some families have no substeps. A step of a VRKMK method, for example, is one exponential.
    if not lowering(method.family).repeats_substeps:
        return None
    # The function substeps() recognises compositions, even if they are given as Butcher tableaux.
    repetition = substeps(method)
    if repetition is None:
        return None
    base, steps = repetition
    # All substeps use one program, because the program does not depend on the length of the substep.
    return replace(lower(scene, base), substeps=steps)
