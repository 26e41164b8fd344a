"""The equations of a scene in one of several classical forms.

For example, a rotation can be given by a rotation matrix or by a unit quaternion. Methods that treat the
state as a vector in R^n can solve each form of the equations.
"""

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
    """The equations of a scene in one form, for example with unit quaternions.

    If ``form`` is None, the equations are those of the scene itself. ``alone`` is True if the scene has only
    one form of its equations.
    """

    scene: Problem
    form: ClassicalForm | None = None
    alone: bool = True

    @property
    def printed(self) -> bool:
        """True for the original equations of the scene, and False for another form of the equations."""
        return self.form is None or self.form.printed

    @property
    def problem(self) -> Problem:
        """The initial value problem to integrate: the scene itself, or its equations in another form."""
        return self.scene if self.form is None or self.form.printed else self.form.problem

    @property
    def name(self) -> str:
        """The name of the form of the equations, or '' if the scene has only one form."""
        return "" if self.alone or self.form is None else self.form.name

    def error(self, state: Sequence[float], exact: Reference) -> float:
        """Return the distance of a state from the reference solution ``exact``, in the norm of the scene.

        ``state`` lists the coordinates of ``self.problem``.
        """
        if self.form is not None and not self.form.printed:
            state = self.form.scene_state(FloatDomain(0.0), state)
        return distance(self.scene, state, exact.state)


def all_equations(scene: Problem, keys: Sequence[str] = ()) -> tuple[Equations, ...]:
    """Return the equations of a scene, once for each requested form.

    The function uses the forms with the given ``keys``, such as ``quaternion``, or all forms by default.
    :class:`SceneError` is raised if a key is unknown.
    """
    forms = classical_forms(scene)
    chosen = {find_form(scene, key).key for key in keys}
    return tuple(
        Equations(scene, form, alone=len(forms) == 1) for form in forms if not keys or form.key in chosen
    )
