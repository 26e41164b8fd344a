"""The equations of a scene in one of its classical forms, for the candidates of a work-precision diagram."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from codegen.ir.domain import FloatDomain
from codegen.lab.distance import distance
from codegen.lab.reference import Reference
from codegen.scene.classical_forms import ClassicalForm, classical_forms, find_form
from codegen.scene.problem import Problem


@dataclass(frozen=True)
class Equations:
    """The equations of a scene in one form, for example in Euler angles or as the scene states them.

    ``form`` is None for the equations on the manifold. ``alone`` is True if the scene has only one form.
    Tables then omit the name of the form.
    """

    scene: Problem
    form: ClassicalForm | None = None
    alone: bool = True

    @property
    def printed(self) -> bool:
        """True if the equations are in the coordinates of the scene."""
        return self.form is None or self.form.printed

    @property
    def problem(self) -> Problem:
        """The problem to integrate: the scene itself, or the problem of the form."""
        return self.scene if self.form is None or self.form.printed else self.form.problem

    @property
    def name(self) -> str:
        """The name of the form, or '' if the scene has no other form."""
        return "" if self.alone or self.form is None else self.form.name

    def error(self, state: Sequence[float], exact: Reference) -> float:
        """Return the distance of a state in this form from the reference, in the norm of the scene."""
        if self.form is not None and not self.form.printed:
            state = self.form.scene_state(FloatDomain(0.0), state)
        return distance(self.scene, state, exact.state)


def all_equations(scene: Problem, keys: Sequence[str] = ()) -> tuple[Equations, ...]:
    """Return the equations of a scene in all its forms, or in the forms with the given keys.

    :class:`SceneError` is raised for a key that the scene does not have.
    """
    forms = classical_forms(scene)
    chosen = {find_form(scene, key).key for key in keys}
    return tuple(
        Equations(scene, form, alone=len(forms) == 1) for form in forms if not keys or form.key in chosen
    )
