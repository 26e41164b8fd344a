"""The Legendre transform: compute the momentum of a stage from the velocity.

The pass is exact. Let P be the momentum of a stage. The velocity must be w = W P with a constant invertible
matrix W. A block of implicit equations computes an unknown v of the stage in three steps:
1. Invertible linear maps compute P from a momentum M. If there are no such maps, M is P.
2. The velocity is w = W P.
3. Further invertible linear maps compute v from w.

The pass keeps these three steps. It adds assignments for the inverse steps, which compute w from v, P from w,
and M from P.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from codegen.ir.number import Number
from codegen.ir.operations import Adjoint, AdSeries, Exp, InverseDexp
from codegen.ir.program import Assign, Builder, Program, Solve, Statement
from codegen.ir.scene_operations import BodyVelocity, Legendre
from codegen.ir.values import MINUS_ONE, ONE, Coefficient, Kind, Var
from codegen.passes.functions import ratio
from codegen.passes.rewrite import defined
from codegen.passes.tearing import ordered
from codegen.scene.problem import Problem

INVERTIBLE = (Adjoint, InverseDexp, AdSeries)
"""Operations that apply an invertible linear map to their last argument.

InverseDexp and AdSeries apply functions of ad_x. These functions are invertible if x is small.
"""


@dataclass(frozen=True)
class Path:
    """The assignments that compute an unknown from a momentum. This momentum is called the base.

    - ``inward`` contains the invertible maps that compute the momentum P of a stage from the base.
    - ``velocity`` is the assignment that computes the velocity w of the stage from P.
    - ``outward`` contains the invertible maps that compute the unknown from w.

    The maps are in order of application.
    """

    unknown: Var
    outward: tuple[Assign, ...]
    velocity: Assign
    inward: tuple[Assign, ...]

    @property
    def base(self) -> Var:
        """The momentum at the beginning of the path."""
        return self.inward[0].args[-1] if self.inward else self.velocity.args[1]


def run(program: Program, scene: Problem) -> Program:
    """Return the program in which momenta and forces of stages are computed from velocities.

    If no inverse of the map from momentum to velocity is known, the program is returned unchanged.
    """
    # If the velocity is w = W P with a constant invertible matrix W, ``scene.body.inverse`` contains the
    # matrix W^{-1}. Otherwise ``scene.body.inverse`` is None.
    if scene.body is None or scene.body.inverse is None:
        return program
    build = Builder({v.name for v in defined(program)})
    body: list[Statement] = []
    names: dict[Var, Var] = {}
    for statement in program.body:
        if isinstance(statement, Assign):
            body.append(replace(statement, args=tuple(names.get(a, a) for a in statement.args)))
            continue
        block = replace(statement, starts=tuple(names.get(a, a) for a in statement.starts))
        # The function ``path`` must read the original block, so all calls come before the loop that changes
        # the block.
        paths = [p for p in (path(block, u) for u in block.unknowns) if p is not None]
        for route in paths:
            block = _turned(block, route, build)
        image = dict(zip(block.unknowns, block.images, strict=True))
        # The equation of an unknown u is u = g(u), and ``image[u]`` is the variable for g(u). After the block
        # is solved, u and g(u) are equal. Therefore later statements can read u instead of ``image[u]``.
        names |= {image[p.unknown]: p.unknown for p in paths}
        body.append(block)
    outputs = tuple((name, names.get(var, var)) for name, var in program.outputs)
    return replace(program, body=tuple(body), outputs=outputs)


def residuals(program: Program, scene: Problem) -> Program:
    """Return the program with residuals added to its blocks of implicit equations.

    Each unknown gets one residual. A block is unchanged if :func:`path` returns None for at least one
    unknown. If no inverse of the map from momentum to velocity is known, the program is returned unchanged.
    """
    if scene.body is None or scene.body.inverse is None:
        return program
    build = Builder({v.name for v in defined(program)})
    body: list[Statement] = []
    for statement in program.body:
        if isinstance(statement, Solve):
            paths = [path(statement, u) for u in statement.unknowns]
            # If ``path`` returns None for an unknown, the unknown has no residual. Newton's method needs a
            # residual for every unknown, so a block with such an unknown is not changed.
            if all(p is not None for p in paths):
                compared = [_residual(statement, p, build) for p in paths if p is not None]
                statement = replace(
                    statement, body=(*statement.body, *build.take()), residuals=tuple(compared)
                )
        body.append(statement)
    return replace(program, body=tuple(body))


def path(block: Solve, unknown: Var) -> Path | None:
    """Return the :class:`Path` that computes ``unknown`` from a momentum, or None if no path exists."""
    maker = {target: assign for assign in block.body for target in assign.targets}
    image = dict(zip(block.unknowns, block.images, strict=True))[unknown]
    outward, velocity = _chain(maker, image)
    if velocity is None or not isinstance(velocity.operation, BodyVelocity):
        return None
    # ``velocity.args[1]`` is the momentum P.
    inward, _ = _chain(maker, velocity.args[1])
    return Path(unknown, outward, velocity, inward)


def _chain(maker: dict[Var, Assign], var: Var) -> tuple[tuple[Assign, ...], Assign | None]:
    """Write ``var`` as A_n ... A_1 u with as many invertible linear maps A_k as possible.

    Return the assignments that apply A_1, ..., A_n, and the assignment that computes u. If ``maker`` contains
    no assignment for u, the second result is None.
    """
    maps: list[Assign] = []
    while True:
        source = maker.get(var)
        if source is None or not _invertible(source):
            return tuple(reversed(maps)), source
        maps.append(source)
        var = source.args[-1]


def _invertible(assign: Assign) -> bool:
    # Multiplication by h is not invertible, because h can be 0.
    number = assign.is_multiple and assign.terms[0][0].power == 0
    return number or isinstance(assign.operation, INVERTIBLE)


def _undone(build: Builder, assign: Assign, value: Var) -> Var:
    """Return a new variable for A^{-1} ``value``. A is the linear map in ``assign``."""
    operation = assign.operation
    if isinstance(operation, Adjoint):
        return build.add(operation.opposite(), "a", assign.args[0], value)
    if isinstance(operation, InverseDexp | AdSeries):
        # The inverse of f(ad_x) is also a function of ad_x: (1/f)(ad_x).
        opposite = tuple(factor.inverse() for factor in operation.word)
        return build.add(AdSeries(opposite, value.kind is Kind.DUAL), "a", assign.args[0], value)
    # The coefficient is not zero, because an earlier pass has removed terms with coefficient zero.
    ((c, _),) = assign.terms
    return build.lin("s", value.kind, [(Coefficient(Number.rational(1) / c.value), value)])


def _values(build: Builder, route: Path) -> tuple[dict[Var, Var], Var]:
    """Append assignments that compute the momentum ``route.base`` from the unknown ``route.unknown``.

    For example, ``route`` computes v = A m from the base m, and z = B v. The equation of the unknown u is
    u = z. The new assignments compute v* = B^{-1} u and m* = A^{-1} v*. The results are the dictionary
    {z: u, v: v*, m: m*} and the variable m*. If u satisfies the equation, then v* = v and m* = m.
    """
    replaced: dict[Var, Var] = {}
    value = route.unknown
    replaced[(route.outward[-1] if route.outward else route.velocity).targets[0]] = value
    # Because (A B)^{-1} = B^{-1} A^{-1}, the last map is inverted first.
    for assign in reversed(route.outward):
        value = _undone(build, assign, value)
        replaced[assign.args[-1]] = value
    value = build.add(Legendre(), "p", value)
    replaced[route.velocity.args[1]] = value
    for assign in reversed(route.inward):
        value = _undone(build, assign, value)
        replaced[assign.args[-1]] = value
    return replaced, value


def _residual(block: Solve, route: Path, build: Builder) -> Var:
    """Append the residual of the equation for ``route.unknown``, and return the variable of the residual.

    The residual is m - n. The momenta m and n are equal at the solution. The block computes m, and
    :func:`_values` computes n from the unknown.
    """
    replaced, computed = _values(build, route)
    given = route.base
    if _function_of_one(block, route):
        # The residual compares two values of the momentum P of the stage. A comparison of two values of
        # ``route.base`` would need one more map: the inverse of the map in ``route.inward``.
        given = route.velocity.args[1]
    elif route.inward and route.inward[0].terms:
        given = route.inward[0].targets[0]
    return build.lin("residual", Kind.DUAL, [(ONE, given), (MINUS_ONE, replaced.get(given, computed))])


def _function_of_one(block: Solve, route: Path) -> bool:
    """Return True if the momentum P of the stage is Ad*_{exp x} applied to a sum of terms f(ad*_y) v.

    P is ``route.velocity.args[1]``. The terms can differ in the function f, in the element y of the Lie
    algebra, and in the covector v. In every term, x must be a rational multiple of y.
    """
    maker = {target: assign for assign in block.body for target in assign.targets}
    if len(route.inward) != 1 or route.inward[0].operation != Adjoint(dual=True):
        return False
    element, total = (maker.get(v) for v in route.inward[0].args)
    if element is None or total is None or not (isinstance(element.operation, Exp) and total.terms):
        return False
    terms = [maker.get(v) for v in total.args]
    x = element.args[0]
    return all(
        t is not None and isinstance(t.operation, AdSeries) and ratio(maker, x, t.args[0]) is not None
        for t in terms
    )


def _turned(block: Solve, route: Path, build: Builder) -> Solve:
    """Return ``block`` with additional assignments that compute a momentum from an unknown.

    In ``block``, the maps of ``route`` compute the unknown ``route.unknown`` from the momentum
    ``route.base``. The additional assignments apply the inverses of these maps.
    """
    # A later pass removes the new variables that no statement reads.
    replaced, _ = _values(build, route)
    fresh = build.take()
    if route.inward and route.base not in block.unknowns:
        del replaced[route.base]
    # The assignments of ``route`` keep their old arguments.
    own = {a.targets[0] for a in (*route.outward, route.velocity, *route.inward)}
    body = [
        a if a.targets[0] in own else replace(a, args=tuple(replaced.get(x, x) for x in a.args))
        for a in block.body
    ]
    sorted_body = ordered((*body, *fresh))
    # If the statements read each other in a cycle, no order exists, and the block is not changed.
    return block if sorted_body is None else replace(block, body=sorted_body)
