"""The scenes (test problems) of the strict protocol.

The scenes have no special property that could hide an error in a method. Examples of such properties are a
fixed axis of rotation, an axis of rotation that is orthogonal to the rotated vector, and a field that does
not depend on time. The scenes for splitting methods are an exception: their fields do not depend on time.

Each kind of method has its own scenes:

- Methods for general fields run on equations y' = f(t, y).y with the state y and the time t. The value
  f(t, y) is in the Lie algebra of a group, and the dot is the action of the Lie algebra on y. The function f
  is polynomial, and its values for different t and y do not commute. The groups are SO(3), GL(3) and the
  group of unipotent 4 x 4 matrices.
- Variational methods run on T*G, where G is a group. The Hamiltonians depend on time.
- Methods for linear equations run on equations y' = A(t).y. The value A(t) is in the Lie algebra of a group.
- Splitting methods run on Hamiltonians that are a sum of three terms. The exact flow of each term is known.
  The flows of different terms do not commute.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from sympy import Expr, Matrix, Rational, Symbol

from codegen.groups import (
    GL,
    SL2,
    SO3,
    Action,
    Columns,
    LeftMultiplication,
    LieGroup,
    MatrixGroup,
    RightMultiplication,
    Rn,
    Rotation,
)
from codegen.lower.base import Lowering
from codegen.lower.flow_words import FlowLowering
from codegen.lower.linear import LinearLowering
from codegen.scene import FieldScene, HamiltonianScene
from codegen.scene.problem import Problem

SPAN = (0, "1/4")
"""The time span of all scenes.

The span is short, because the solutions of polynomial equations can become infinite after a short time.
"""


@cache
def fields() -> tuple[Problem, ...]:
    """Return the scenes on which methods for equations y' = f(t, y).y are tested.

    The functions f have no symmetry.
    """
    return _rotations(), _sphere(), _linear(), _nilpotent()


def _span() -> tuple[Rational, ...]:
    return tuple(Rational(x) for x in SPAN)


def _rotations() -> Problem:
    """Return a scene in which SO(3) acts on itself from the left."""
    t, half, g = Symbol("t", real=True), Rational(1, 2), SO3().point("g")
    return FieldScene(
        name="SO(3) acting on itself",
        group=SO3(),
        action=LeftMultiplication(),
        y=Matrix(list(g)),
        f=Matrix(
            [g[0, 1] * g[1, 2] + t * g[2, 0] + 1, g[1, 1] - t + g[0, 0] * g[2, 2], g[2, 1] + t**2 - half]
        ),
        y0=list(_turn()),
        span=_span(),
    )


def _turn() -> Matrix:
    """Return a rotation matrix with rational entries."""
    a, b = Rational(3, 5), Rational(4, 5)
    return Matrix(3, 3, [0, -1, 0, a, 0, -b, b, 0, a])


def _sphere() -> Problem:
    """Return a scene in which SO(3) acts on a sphere.

    The axis f(t, y) of the rotation is not orthogonal to the state y, because an orthogonal axis can hide
    errors.
    """
    t, m = Symbol("t", real=True), SO3().dual("m")
    return FieldScene(
        name="SO(3) acting on a sphere",
        group=SO3(),
        action=Rotation(),
        y=m,
        f=Matrix([m[1] * m[2] + t + m[0], m[0] - t * m[1] + 1, m[2] * m[2] - m[0] * t + 2]),
        y0=Matrix([Rational(2, 3), -Rational(1, 3), Rational(2, 3)]),
        span=_span(),
    )


def _linear() -> Problem:
    """Return a scene in which GL(3) acts on itself from the left."""
    t, half, a = Symbol("t", real=True), Rational(1, 2), GL(3).point("a")
    entries = [
        a[(i + 1) % 3, j] * (half + t) - a[j, i] * a[i, (j + 2) % 3] / 3 + (t if i == j else half * (i - j))
        for i in range(3)
        for j in range(3)
    ]
    return FieldScene(
        name="GL(3) acting on itself",
        group=GL(3),
        action=LeftMultiplication(),
        y=Matrix(list(a)),
        f=Matrix(entries),
        y0=[1, half, 0, -half, 1, Rational(1, 3), 0, 0, 1],
        span=_span(),
    )


def _nilpotent() -> Problem:
    """Return a scene in which the unipotent 4 x 4 matrices act on vectors."""
    t = Symbol("t", real=True)
    places = ((0, 1), (1, 2), (2, 3), (0, 2), (1, 3), (0, 3))
    basis = [[[int((i, j) == p) for j in range(4)] for i in range(4)] for p in places]
    x = [Symbol(f"x{k}", real=True) for k in range(4)]
    return FieldScene(
        name="unipotent matrices acting on vectors",
        group=MatrixGroup("U(4)", basis),
        action=Rotation(),
        y=Matrix(x),
        f=Matrix(
            [
                *(3 * x[2] * x[1] + 5 * t, 2 * x[0] - 4 * t * x[2] + x[1], x[1] * x[3] - 6 * t),
                *(x[2] + x[0] * x[0], t - x[1] * x[0], x[2] * x[1]),
            ]
        ),
        y0=Matrix([Rational(1, 2), -1, Rational(3, 2), 1]),
        span=_span(),
    )


@cache
def hamiltonians() -> tuple[Problem, ...]:
    """Return the scenes on which variational methods on T*G are tested.

    The Hamiltonians have no symmetry.
    """
    t, half = Symbol("t", real=True), Rational(1, 2)
    places = ((0, 1), (1, 2), (0, 2))
    basis = [[[int((i, j) == p) for j in range(3)] for i in range(3)] for p in places]
    upper = Matrix(3, 3, [1, half, 2, 0, 1, -Rational(1, 3), 0, 0, 1])
    spaces: tuple[tuple[str, SO3 | MatrixGroup, Matrix], ...] = (
        ("T*SO(3)", SO3(), _turn()),
        ("T*GL(2)", GL(2), Matrix(2, 2, [1, half, -Rational(1, 3), 1])),
        ("T*Heisenberg", MatrixGroup("Heisenberg", basis), upper),
    )
    problems = []
    for name, group, start in spaces:
        q, mu = group.point("q"), group.dual("p")
        moved = q.T * Matrix(list(mu)[: q.shape[0]])
        H = mu.dot(mu) / 2 + mu[0] * mu[1] / 3 + moved.dot(moved) / 2
        H += q[0, 1] * q[1, 0] + q[0, 0] * mu[1] + t * (q[0, 1] + mu[0] * mu[0] / 2) + q[0, 0] * q[1, 1]
        momentum = [1, Rational(-1, 2), Rational(2, 3), half][: group.dim]
        scene = HamiltonianScene(
            name=name, group=group, q=q, mu=mu, H=H, q0=start, mu0=Matrix(momentum), span=_span()
        )
        problems.append(scene)
    return tuple(problems)


@cache
def split_hamiltonians() -> tuple[Problem, ...]:
    """Return the scenes on which splitting methods are tested.

    Each Hamiltonian is the sum of the kinetic energy T, the gyroscopic term G of a rotating frame, and the
    potential energy V.
    """
    return _rotating_plane(), _rotating_top()


def _rotating_plane() -> Problem:
    """Return the scene of a particle in a rotating plane."""
    q, p = Rn(2).point("q"), Rn(2).dual("p")
    parts = {
        "T": p.dot(p) / 2,
        "G": Rational(3, 2) * (q[1] * p[0] - q[0] * p[1]),
        "V": q[0] ** 2 + q[0] * q[1] ** 2 / 2 + q[1] ** 4 / 3 + q[0] * q[1] / 2,
    }
    return HamiltonianScene(
        name="T*R^2, rotating frame",
        group=Rn(2),
        q=q,
        mu=p,
        H=sum(parts.values()),
        parts=parts,
        q0=[1, Rational(-1, 2)],
        mu0=Matrix([Rational(2, 3), Rational(1, 3)]),
        span=_span(),
    )


def _rotating_top() -> Problem:
    """Return the scene of a rigid body in a rotating frame."""
    group = SO3()
    q, mu = group.point("q"), group.dual("p")
    inverse = Matrix.diag(1, 1, Rational(5, 2))
    rate = Matrix([Rational(1, 2), -1, Rational(3, 2)])
    parts = {
        "T": mu.dot(q * inverse * q.T * mu) / 2,
        "G": rate.dot(mu),
        "V": q[0, 1] + q[1, 2] * q[2, 0] / 2 - q[2, 2] ** 2,
    }
    return HamiltonianScene(
        name="T*SO(3), rotating frame",
        group=group,
        q=q,
        mu=mu,
        H=sum(parts.values()),
        parts=parts,
        q0=_turn(),
        mu0=Matrix([1, Rational(-1, 2), Rational(2, 3)]),
        span=_span(),
    )


@cache
def linear_fields() -> tuple[Problem, ...]:
    """Return the scenes on which methods for linear equations y' = A(t).y are tested.

    A(t) is in the Lie algebra of a group. The group acts from the right in one scene, and from the left in
    the other scenes.
    """
    t, half = Symbol("t", real=True), Rational(1, 2)
    turns = Matrix([1 - 2 * t + 3 * t**4, 2 * t - half + t**5, 1 + t**2 - t**3 + 2 * t**6])
    maps = Matrix([1 + t - 2 * t**5, -2 + 3 * t**2 + t**6, half - t + t**3 - 2 * t**4])
    turn = list(_turn())
    return (
        _of_time("linear equation, SO(3) acting on itself", SO3(), LeftMultiplication(), turns, turn),
        _of_time(
            "linear equation, SO(3) acting on itself from the right",
            SO3(),
            RightMultiplication(),
            turns,
            turn,
        ),
        _of_time(
            "linear equation, SL(2) acting on three columns",
            SL2(),
            Columns(3),
            maps,
            [1, half, -1, 2, 1, -half],
        ),
    )


def _of_time(name: str, group: LieGroup, action: Action, f: Matrix, start: Sequence[Expr]) -> Problem:
    y = Matrix([Symbol(f"y{k}", real=True) for k in range(len(start))])
    return FieldScene(name=name, group=group, action=action, y=y, f=f, y0=start, span=_span())


def strict_scenes(family: Lowering) -> tuple[Problem, ...]:
    """Return the scenes on which the methods of a family are tested."""
    if isinstance(family, LinearLowering):
        return linear_fields()
    if isinstance(family, FlowLowering):
        return split_hamiltonians()
    return hamiltonians() if family.hamiltonian else fields()
