"""Linear scenes: y' = A(t).y. The formulas in A contain the time and parameters, but not the state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import Action, Columns, Linear
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import MatrixElements
from codegen.groups.linear_algebra import Vector, units
from codegen.ir.domain import FloatDomain
from codegen.scene.arguments import check_group
from codegen.scene.field_scene import FieldScene
from codegen.scene.matrix_step import MatrixFormula, MatrixStep
from codegen.scene.problem import Problem

if TYPE_CHECKING:
    import sympy


def LinearScene(
    *,
    group: LieGroup,
    action: Action,
    A: sympy.Matrix | Sequence[sympy.Expr],
    y0: Sequence[sympy.Expr],
    span: tuple[sympy.Expr, sympy.Expr],
    y: Sequence[sympy.Symbol] | None = None,
    velocity: Sequence[sympy.Expr] | None = None,
    invariants: Mapping[str, sympy.Expr] | None = None,
    steps: Mapping[str, tuple[MatrixFormula, int]] | None = None,
    name: str = "scene",
    title: str = "",
) -> Problem:
    """Return the scene y' = A(t).y, where the dot is the action of the Lie algebra on y.

    - ``A``: a column of ``group.dim`` formulas in ``t`` and in parameters. For a group of n x n matrices,
      ``A`` can also be an n x n matrix of formulas.
    - ``y``: the symbols of the coordinates; by default, the real symbols y0, y1 and so on.
    - ``steps``: a map from names to methods y1 = M y0 with a matrix M. Each value is a pair: a formula
      for M (:mod:`codegen.scene.matrix_step`) and the order of the method. In commands, the option
      ``--method step:NAME`` chooses one of these methods.

    :func:`codegen.scene.FieldScene` describes the other arguments. With the action ``RightMultiplication()``,
    the equation is y' = -y A(t). :class:`SceneError` is raised if ``A`` depends on the state, if a matrix
    ``A`` is not in the Lie algebra, and for the errors that ``FieldScene`` lists.

    >>> from sympy import Matrix, Symbol
    >>> from codegen.groups import SL2, Linear
    >>> A = Matrix([[0, 1], [-1 - Symbol("t"), 0]])
    >>> LinearScene(group=SL2(), action=Linear(), A=A, y0=[1, 0], span=(0, 1)).linear
    True
    """
    from sympy import Matrix, Symbol

    check_group(name, group)
    points = [Symbol(f"y{k}", real=True) for k in range(len(y0))] if y is None else y
    entries = A if isinstance(A, Matrix) else Matrix(list(A))
    square = entries.rows == entries.cols > 1
    scene = FieldScene(
        group=group,
        action=action,
        y=points,
        f=_components(name, group, entries) if square else list(entries),
        y0=y0,
        span=span,
        velocity=velocity,
        invariants=invariants,
        name=name,
        title=title,
    )
    if not scene.linear:
        raise SceneError(
            "A depends on the state",
            where=name,
            expected="formulas in t and parameters",
            hint="use FieldScene",
        )
    return replace(scene, steps=_steps(scene, steps or {}))


def _steps(scene: Problem, steps: Mapping[str, tuple[MatrixFormula, int]]) -> dict[str, MatrixStep]:
    """Return a :class:`MatrixStep` for each name in ``steps``.

    SceneError is raised if the scene does not permit a formula, or if the order of accuracy of a step is
    not a positive integer.
    """
    matrices = scene.group.offers(MatrixElements)
    for name, (formula, order) in steps.items():
        where = f"{scene.name}, step {name}"
        if matrices is None or not isinstance(scene.action, Columns | Linear):
            raise SceneError(
                f"the action {scene.action.name} of {scene.group.name}",
                where=where,
                expected="a group of matrices that acts by Linear() or Columns(k)",
            )
        long = next(formula.closed_forms(), None)
        if matrices.order > 2 and long is not None:
            raise SceneError(
                f"{long.text()} for {matrices.order} x {matrices.order} matrices has no closed form",
                where=where,
                expected="2 x 2 matrices, or exp of an element of the Lie algebra",
                hint="a logarithm is permitted only for 2 x 2 matrices",
            )
        if not isinstance(order, int) or order < 1:
            raise SceneError(f"the order {order!r}", where=where, expected="a positive integer")
        if scene.autonomous:
            raise SceneError("A does not depend on the time", where=where, expected="formulas in t")
    return {name: MatrixStep(*step) for name, step in steps.items()}


def _components(name: str, group: LieGroup, matrix: sympy.Matrix) -> list[sympy.Expr]:
    """Return the coordinates of ``matrix`` in the basis of the Lie algebra of ``group``.

    SceneError is raised if ``matrix`` is not in the Lie algebra.
    """
    from sympy import Matrix, Rational, simplify

    matrices = group.offers(MatrixElements)
    if matrices is None or matrices.order != matrix.rows:
        raise SceneError(
            f"A is a {matrix.rows} x {matrix.rows} matrix",
            where=name,
            expected=f"a column of {group.dim} formulas"
            + (f", or a {matrices.order} x {matrices.order} matrix" if matrices is not None else ""),
        )
    d = FloatDomain(0.0)
    elements: tuple[Vector[float], ...] = units(d, group.dim)
    basis = Matrix([[Rational(entry) for entry in matrices.hat(d, e)] for e in elements]).T
    column = matrix.reshape(matrix.rows**2, 1)
    result = (basis.T * basis).LUsolve(basis.T * column)
    if any(simplify(x) != 0 for x in basis * result - column):
        raise SceneError(
            "A is not in the Lie algebra", where=name, expected=f"a matrix of the Lie algebra of {group.name}"
        )
    return list(result)
