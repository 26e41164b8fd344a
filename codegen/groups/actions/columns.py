"""The action of n x n matrices on n x k matrices by multiplication from the left."""

from __future__ import annotations

from codegen.errors import SceneError
from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import MatrixElements
from codegen.groups.linear_algebra import S, Vector, dot
from codegen.ir.domain import Domain


class Columns(Action):
    """The matrices g act on n x k matrices Y by g.Y = g Y.

    A point contains the entries of the matrix Y row by row. The number of columns is k = ``columns``.
    """

    name = "linear maps of columns"
    needs = MatrixElements

    def __init__(self, columns: int) -> None:
        if not isinstance(columns, int) or columns < 1:
            raise SceneError(f"columns = {columns!r}", where=self.name, expected="a positive integer")
        self.columns = columns

    def point_size(self, group: LieGroup) -> int:
        """Return n k, the number of entries of an n x k matrix."""
        return group.require(MatrixElements).order * self.columns

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g y."""
        n = group.require(MatrixElements).order
        columns = [y[j :: self.columns] for j in range(self.columns)]
        return tuple(dot(g[n * i : n * i + n], column) for i in range(n) for column in columns)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return A Y, where A is the matrix of x, and y contains the matrix Y row by row."""
        return self.act(d, group, group.require(MatrixElements).hat(d, x), y)
