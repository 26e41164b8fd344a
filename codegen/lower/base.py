"""The base class of lowerings, which turn a tableau and a problem into a step program.

A :class:`orderconds.families.Family` defines the order conditions of a family of methods. A :class:`Lowering`
decides which scenes the family accepts, and makes the step programs.
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

    In the error message, ``reason`` follows the words "the family FAMILY cannot be used on SCENE".
    ``expected`` describes the scenes that the family accepts. If ``hint`` (a suggestion for the user) is
    empty, the error message lists the families that accept the scene.
    """

    reason: str
    expected: str
    hint: str = ""


def without_formulas(scene: Problem) -> Objection | None:
    """Return None if the field of a scene has formulas in coordinates, and an objection otherwise.

    Scenes with large matrices and semilinear scenes have no formulas in coordinates.
    """
    # The list ``scene.roots`` contains the formulas of the vector field.
    if scene.roots:
        return None
    # The state of a semilinear equation is a function of space, not a list of coordinates.
    if scene.semilinear is not None:
        return Objection(", a semilinear equation", "a scene with formulas in coordinates")
    # The families in the hint compute with whole matrices, so they need no formulas in coordinates.
    families = "magnus, cf_magnus or fer" if scene.linear else "rkmk, cf or cg"
    return Objection(
        ": the field is given by formulas with large matrices as operands",
        "a scene with formulas in coordinates",
        f"use {families}, or matrices with fewer rows",
    )


class Lowering(ABC):
    """The translation of the methods of one family to step programs.

    A subclass sets :attr:`family` and implements :meth:`problem` and :meth:`lower`. Usually the subclass
    derives from a class that implements :meth:`problem`:

    - :class:`codegen.lower.field.FieldLowering` (vector fields),
    - :class:`codegen.lower.linear.LinearLowering` (y' = A(t).y),
    - :class:`codegen.lower.variational.VariationalLowering` (Hamiltonians on T*G),
    - :class:`codegen.lower.flow_words.FlowLowering` (Hamiltonians that are sums of parts).
    """

    family: ClassVar[str] = ""
    """The name of the family in :mod:`orderconds.families` and in method names such as ``vcg:midpoint``."""
    hamiltonian: ClassVar[bool] = False
    """True if the methods compute the position q and the momentum mu of a Hamiltonian scene."""
    preference: ClassVar[int] = 0
    """The preference for this family, used if the user names a tableau without a family.

    The tableau file gives the order of the method in each family. The family with the highest order is
    chosen. If several families have this order, the largest preference decides.
    """
    repeats_substeps: ClassVar[bool] = False
    """True if emitted code may compute a step of a composition by a loop over its substeps."""

    reads_coordinates: ClassVar[bool] = False
    """True if the methods use the coordinate map of the scene (:mod:`codegen.groups.coordinate_maps`)."""

    in_coordinates: ClassVar[bool] = False
    """True if the methods solve an equation in R^n for the coordinates of the state."""

    def keeps_manifold(self, scene: Problem) -> bool:
        """Return True if the computed states are on the manifold of the scene, up to rounding errors.

        By default the result is :attr:`orderconds.families.Family.keeps_manifold`.
        """
        from orderconds.families import family_class

        return family_class(self.family).keeps_manifold

    def objection(self, scene: Problem) -> Objection | None:
        """Return the reason why the family does not accept a scene, or None if the family accepts it."""
        return None

    def storage(self, method: Method) -> str:
        """Return a header line for the emitted file. The line lists the values that a step stores.

        By default the result is ''.
        """
        return ""

    @abstractmethod
    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene, or a modified copy of the scene, from which :meth:`lower` makes the step program.

        For example, splitting methods need a copy that contains the exact flows of the parts of the
        Hamiltonian. The result is the argument ``problem`` of :meth:`lower`.

        The family must accept the scene (:meth:`objection`). If ``method`` cannot be used on the scene,
        :class:`codegen.errors.MethodError` is raised.
        """

    @abstractmethod
    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the step program of a method, checked with :func:`codegen.ir.verify.verify`.

        ``problem`` is the result of :meth:`problem`. The program contains the equations of implicit stages
        as one block.

        :class:`codegen.errors.MethodError` is raised if the family cannot use the tableau of ``method``.
        :class:`orderconds.errors.ZeroWeight` is raised if the program would divide by a weight b_i = 0.
        """

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return True if a step of constant size is a symplectic map on a Hamiltonian scene.

        By default the result is True if the group is abelian and the tableau is symplectic.
        """
        from orderconds.tableau.method_properties import symplectic

        tableau = method.tableau
        # The function symplectic() returns None if it cannot decide whether the tableau is symplectic.
        return bool(scene.group.abelian) and symplectic(tableau.abelian(), tableau.ring) is True

    def degree(self, method: Method) -> int:
        """Return the degree of a Taylor method, or 0 for all other methods.

        :class:`codegen.errors.MethodError` is raised if the method has step-size control, and the degree is
        too low for the computation of step sizes.
        """
        return 0

    def extension(self, problem: Problem, method: Method) -> Program | None:
        """Return a program for the continuous extension of a method, or None if the method has none.

        In a step of size h from the state y at time t, the solution at the time t + theta h is
        exp(sigma(theta)).y. Here sigma is a polynomial with values in the Lie algebra. The program returns
        the coefficients of theta, theta^2, ... in sigma.
        """
        return None

    def conditions(self, method: Method, scene: Problem | None = None) -> Family:
        """Return the :class:`Family` with the order conditions of a method.

        If ``scene`` is None, return the conditions for a general scene.
        """
        from orderconds import families

        # The order conditions of ``rkmk(2)``, for example, depend on the number 2, the highest power of ad
        # in the truncated series of dexp^{-1}.
        return families.get(method.family_label)

    def order(self, method: Method, scene: Problem | None = None) -> FamilyOrder:
        """Return the order of a method according to :meth:`conditions`."""
        from orderconds.checking import check

        # Only one family is checked, so ``orders`` contains one order.
        (order,) = check(method.tableau, family=self.conditions(method, scene).label()).orders
        return order
