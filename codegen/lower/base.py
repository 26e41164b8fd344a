"""The base class of lowerings: one class for each family turns a tableau and a problem into a program.

Two classes define a family of methods. :class:`orderconds.families.Family` defines its order conditions.
:class:`Lowering` decides which scenes the family accepts, and writes the step program.
:func:`codegen.lower.register` makes a lowering available in every command.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from codegen.ir.program import Program
from codegen.method import Method
from codegen.scene.problem import Problem

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder
    from orderconds.families import Family


@dataclass(frozen=True)
class Objection:
    """The reason why a family does not accept a scene.

    ``reason`` follows "the family FAMILY cannot be used on SCENE" in the message. ``expected`` names the
    scenes that the family accepts. Without a ``hint`` the message lists the families that accept the scene.
    """

    reason: str
    expected: str
    hint: str = ""


def without_formulas(scene: Problem) -> Objection | None:
    """Return an objection to a scene whose field has no formulas in coordinates, and None for other scenes.

    Scenes with large matrices and semilinear scenes have no such formulas.
    """
    # ``roots`` are the formulas of the field in coordinates.
    if scene.roots:
        return None
    # The state of a semilinear equation is a function of space. Its field has no formulas in coordinates.
    if scene.semilinear is not None:
        return Objection(", a semilinear equation", "a scene with formulas in coordinates")
    # The families named here compute with large matrices in loops, and need no formulas in coordinates.
    families = "magnus, cf_magnus or fer" if scene.linear else "rkmk, cf or cg"
    return Objection(
        ", whose field is given by formulas whose operands are large matrices",
        "a scene with formulas in coordinates",
        f"use {families}, or matrices with fewer rows",
    )


class Lowering(ABC):
    """The translation of the methods of one family to step programs.

    A subclass sets :attr:`family` and implements :meth:`problem` and :meth:`lower`. All other members have
    defaults. Usually the subclass derives from a class that implements :meth:`problem`:

    - :class:`codegen.lower.field.FieldLowering` (vector fields),
    - :class:`codegen.lower.linear.LinearLowering` (y' = A(t).y),
    - :class:`codegen.lower.variational.VariationalLowering` (Hamiltonians on T*G),
    - :class:`codegen.lower.flow_words.FlowLowering` (Hamiltonians in parts).
    """

    family: ClassVar[str] = ""
    """The name of the family in :mod:`orderconds.families` and in method names such as ``vcg:midpoint``."""
    hamiltonian: ClassVar[bool] = False
    """True if the state of a program is the state (q, mu) of a Hamiltonian scene.

    False if the state of a program is the point y of a vector field.
    """
    preference: ClassVar[int] = 0
    """The rank of the family, for the case that the user names a tableau without a family.

    The compiler then chooses among the families in which the tableau claims an order. If several of these
    families have the same order, the family with the largest rank is chosen.
    """
    repeats_substeps: ClassVar[bool] = False
    """True if the step of a composition consists of substeps in this family.

    It is False, for example, for VRKMK methods, which compute the whole step with one exponential.
    """

    reads_coordinates: ClassVar[bool] = False
    """True if the methods use the coordinate map of the scene (:mod:`codegen.groups.coordinate_maps`).

    Other families use the exponential map.
    """

    in_coordinates: ClassVar[bool] = False
    """True if the methods solve the equation in R^n for the coordinates of the state.

    Such methods accept every classical form of a scene (:mod:`codegen.scene.classical_forms`).
    """

    def keeps_manifold(self, scene: Problem) -> bool:
        """Return True if the computed states are on the manifold of the scene, up to rounding errors.

        A step that moves the point by group elements stays on the manifold. If the group is abelian, the
        steps of every method stay on the manifold, because a vector space parametrises the manifold.
        """
        from orderconds.families import family_class

        # The property belongs to the family, so the class of the family states it.
        return family_class(self.family).keeps_manifold or scene.group.abelian

    def objection(self, scene: Problem) -> Objection | None:
        """Return the reason why the family does not accept a scene, or None if the family accepts it."""
        return None

    def storage(self, method: Method) -> str:
        """Return the line of the emitted header that says how many values a step stores.

        The result '' means that the header has no such line.
        """
        return ""

    @abstractmethod
    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene in the form from which programs of this family are made.

        The family must accept the scene (:meth:`objection`). :class:`codegen.errors.MethodError` is raised if
        this method cannot be used on the scene.
        """

    @abstractmethod
    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the verified step program of a method, with all stages in one block.

        ``problem`` is the result of :meth:`problem`. :class:`codegen.errors.MethodError` is raised if the
        family cannot use the format of the tableau. :class:`orderconds.errors.ZeroWeight` is raised if the
        formulas divide by a weight that is zero.
        """

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return True if steps of constant size are symplectic maps on a Hamiltonian scene.

        By default the result is True if T*G is a vector space and the tableau is symplectic.
        """
        from orderconds.tableau.method_properties import symplectic

        tableau = method.tableau
        # A tableau is symplectic if b_i a_ij + b_j a_ji = b_i b_j for all i, j. The function symplectic()
        # returns None if it cannot decide this. The result is True only if the equations are proved.
        return bool(scene.group.abelian) and symplectic(tableau.abelian(), tableau.ring) is True

    def degree(self, method: Method) -> int:
        """Return the degree of the Taylor polynomial that a step evaluates, or 0 if there is none.

        :class:`codegen.errors.MethodError` is raised for an adaptive method whose degree is too low for
        step-size control.
        """
        return 0

    def extension(self, problem: Problem, method: Method) -> Program | None:
        """Return a program for the solution inside a step, or None if the method has no continuous extension.

        The solution at the time t + theta h is exp(sigma(theta)).y, where sigma is a polynomial with values
        in the Lie algebra. The outputs of the program are the coefficients of theta, theta^2, ... in sigma.
        """
        return None

    def conditions(self, method: Method, scene: Problem | None = None) -> Family:
        """Return the :class:`Family` whose order conditions apply to the method on a scene."""
        from orderconds import families

        # A label such as ``rkmk(2)`` contains the number of brackets in the series of dexp^{-1}, because the
        # order conditions depend on this number.
        return families.get(method.family_label)

    def order(self, method: Method, scene: Problem | None = None) -> FamilyOrder:
        """Return the order of a method, computed from :meth:`conditions`. The order may be undecided."""
        from orderconds.checking import check

        # The tableau is checked in one family only, so the result has a single entry.
        (order,) = check(method.tableau, family=self.conditions(method, scene).label()).orders
        return order
