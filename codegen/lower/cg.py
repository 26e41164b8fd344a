"""Crouch-Grossman methods for vector fields.

A Crouch-Grossman method is a commutator-free method with one exponential for each coefficient of a Butcher
tableau. Equation (1.4) of H. Marthinsen's thesis *On symplectic integration in Lie groups and manifolds*
defines the method.
"""

from __future__ import annotations

from codegen.ir.program import Program
from codegen.lower.cf import products
from codegen.lower.field import FieldLowering
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.tableau import CommutatorFree


class CrouchGrossman(FieldLowering):
    """Crouch-Grossman methods, given by Butcher tableaux."""

    family = "cg"
    repeats_substeps = True

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program for one step of a Crouch-Grossman method."""
        embedded = method.embedded()
        # The embedded method differs from ``method`` only in the update.
        lower = None if embedded is None else _exponentials(embedded).update
        # A Crouch-Grossman method is a commutator-free method in which each exponent has one term.
        return products(problem, method, _exponentials(method), lower)


def _exponentials(method: Method) -> CommutatorFree:
    # Each coefficient of the Butcher tableau becomes one exponential.
    return method.runge_kutta().as_crouch_grossman(method.ring)
