"""The coordinates in which Taylor polynomials of a scene are computed.

Each product of two power series costs a convolution. Therefore this module chooses the coordinates whose
equations contain the fewest products.

In a Hamiltonian scene with the group element q, the momentum mu can be replaced by P = Ad*_q mu, the momentum
in the body frame. The equations are then q' = q.W and P' = N with the velocity W and the force N in the body
frame (:mod:`codegen.scene.body_frame`).

A coordinate c of q can be omitted if c is a function of the remaining coordinates and if the equations of the
remaining coordinates do not contain c.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from codegen.groups.actions import LeftMultiplication
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import (
    BodyFrame,
    Coadjoint,
    CotangentBundle,
    DependentCoordinates,
    Projection,
)
from codegen.groups.linear_algebra import S, Vector
from codegen.groups.rn import Rn
from codegen.ir.collect_constants import gathered
from codegen.ir.domain import Domain, ExprDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.taylor_loop import order_loop
from codegen.ir.taylor_recurrence import Recurrence
from codegen.ir.taylor_series import Coefficient
from codegen.ir.values import Kind
from codegen.scene.ambient import ambient
from codegen.scene.problem import TIME, Problem, StateField


@dataclass(frozen=True)
class Evolution:
    """The coordinates for the Taylor polynomials of a scene, and the equations in these coordinates.

    - ``inner``: the equations, as a problem on R^m for m coordinates.
    - ``outer``: the scene as a field y' = f(y).y.
    - ``body``: the group of the configuration if the coordinates contain the momentum in the body frame,
      otherwise None.
    - ``missing``: the indices of coordinates of the state that the equations omit, because they follow from
      the other coordinates.
    """

    inner: Problem
    outer: Problem
    body: BodyFrame | None = None
    missing: tuple[int, ...] = ()

    def enter(self, domain: Domain, y: Vector[S], frame: Coadjoint | None = None) -> Vector[S]:
        """Convert the state y to these coordinates.

        If y contains the momentum in the body frame, pass the group of the configuration as ``frame``.
        """
        if self.body is not None and frame is None:
            q, mu = self._split(y)
            y = (*q, *self.body.Adt(domain, q, mu))
        if self.body is None and frame is not None:
            y = in_space(domain, frame, y)
        return tuple(x for i, x in enumerate(y) if i not in self.missing)

    def leave(
        self, domain: Domain, moved: Vector[S], y: Vector[S], frame: Coadjoint | None = None
    ) -> Vector[S]:
        """Convert coordinates to a state, and project the state onto the manifold.

        - ``moved``: the coordinates after a step.
        - ``y``: the state before the step.
        - ``frame``: the group of the configuration q if states contain the momentum in the body frame,
          otherwise None.
        """
        z = self._completed(domain, moved)
        if self.body is None:
            start = y if frame is None else in_space(domain, frame, y)
            z = self.outer.action.to_orbit(domain, self.outer.group, z, start)
            return z if frame is None else in_body(domain, frame, z)
        (q, mu), (end, momentum) = self._split(y), self._split(z)
        projection = self.body.offers(Projection)
        end = end if projection is None else projection.project(domain, end)
        if frame is not None:
            return (*end, *momentum)
        before = self.body.Adtinv(domain, q, self.body.Adt(domain, q, mu))
        after = self.body.Adtinv(domain, end, momentum)
        # In exact arithmetic, ``before`` is equal to ``mu``, and ``after`` is the new momentum. The sum
        # ``mu`` + (``after`` - ``before``) is more accurate than ``after``, because the rounding errors of
        # ``after`` and ``before`` nearly cancel.
        return (*end, *(m + (b - a) for m, a, b in zip(mu, before, after, strict=True)))

    def step(self, domain: Domain, degree: int, y: Vector[S], t: S | None = None) -> Vector[S]:
        """Return the coordinates after a step of size ``domain.h`` from the state y at the time t.

        The coordinates are the values of Taylor polynomials of degree ``degree``.
        """
        # The coefficient of degree k includes the factor h^k.
        rows = self.coefficients(domain, degree, self.enter(domain, y), t, domain.h)
        result = []
        for first, *further in rows:
            # The term ``first`` is the old value. The terms in ``further`` have a higher degree in h. To
            # reduce rounding errors, the sum ``change`` of the terms in ``further`` is computed before the
            # old value is added.
            change = None
            for x in further:
                change = x if change is None else change if x is None else change + x
            result.append(first if change is None else first + change)
        return tuple(result)

    def coefficients(
        self, domain: Domain, degree: int, start: Sequence[S], t: S | None, scale: S
    ) -> list[list[Coefficient]]:
        """Return the Taylor coefficients of the degrees 0 to ``degree``, as one list for each coordinate.

        The coefficient of degree k is the k-th time derivative of the coordinate at the time t, multiplied by
        ``scale``^k / k!. A coefficient that is zero for all states is returned as ``None``.
        """
        return self.recurrence(domain, start, t, scale).extend(degree)

    def recurrence(self, domain: Domain, start: Sequence[S], t: S | None, scale: S) -> Recurrence:
        """Return the recurrence that computes the result of :meth:`coefficients`."""
        inner = self.inner
        values = inner.values(domain, start, t)
        return Recurrence(inner.roots, domain, inner.symbols, start, values, scale)

    def products(self) -> int:
        """Return the number of multiplications of power series in the recurrence."""
        domain = ExprDomain()
        start = tuple(map(domain.space.sym, self.inner.symbols))
        recurrence = self.recurrence(domain, start, domain.space.sym(TIME), domain.space.one)
        return len(order_loop(recurrence, domain.space).sums)

    def _split(self, y: Vector[S]) -> tuple[Vector[S], Vector[S]]:
        assert self.body is not None
        return tuple(y[: self.body.size]), tuple(y[self.body.size :])

    def _completed(self, domain: Domain, moved: Vector[S]) -> Vector[S]:
        """Compute the omitted coordinates from the coordinates ``moved``, and return all coordinates."""
        if not self.missing:
            return moved
        group, own = _of_element(self.outer.group), iter(moved)
        zero = domain.rational(0)
        z = [zero if i in self.missing else next(own) for i in range(len(moved) + len(self.missing))]
        q = group.require(DependentCoordinates).complete(domain, tuple(z[: group.size]), self.missing)
        return (*q, *z[group.size :])


def in_space(domain: Domain, group: Coadjoint, y: Vector[S]) -> Vector[S]:
    """Return a state with its momentum converted from the body frame to the space frame."""
    q, momentum = tuple(y[: group.size]), tuple(y[group.size :])
    return (*q, *group.Adtinv(domain, q, momentum))


def in_body(domain: Domain, group: Coadjoint, y: Vector[S]) -> Vector[S]:
    """Return a state with its momentum converted from the space frame to the body frame."""
    q, mu = tuple(y[: group.size]), tuple(y[group.size :])
    return (*q, *group.Adt(domain, q, mu))


def evolution(scene: Problem) -> Evolution:
    """Return the :class:`Evolution` whose equations contain the fewest products of two power series.

    If ``scene`` describes one site of a lattice, the result always uses the coordinates of the scene, even if
    the equations in other coordinates contain fewer products.
    """
    outer = scene.as_field()
    forms = [_flat(scene, outer, None, ambient(scene).roots)]
    if scene.sites is not None:
        # The equations of the neighbours may contain all coordinates of this site. Therefore a step must
        # compute all coordinates of this site.
        return forms[0]
    group = scene.group.offers(BodyFrame)
    if scene.body is not None and group is not None:
        forms.append(_flat(scene, outer, group, _in_body(scene, group)))
    # If several forms have the smallest number of products, min returns the first of these forms.
    return min((each for form in forms for each in (form, *_shorter(form))), key=lambda e: e.products())


def _flat(scene: Problem, outer: Problem, body: BodyFrame | None, roots: Sequence[Expr]) -> Evolution:
    """Return the :class:`Evolution` that computes all coordinates.

    ``roots`` are the time derivatives of all coordinates.
    """
    return Evolution(_problem(scene, outer.symbols, gathered(roots)), outer, body)


def _problem(scene: Problem, symbols: tuple[str, ...], roots: tuple[Expr, ...]) -> Problem:
    space = roots[0].space
    # A problem needs initial values. Zeros suffice, because each step begins with the current values of the
    # coordinates.
    start = tuple(space.zero for _ in symbols)
    return replace(
        scene,
        group=Rn(len(symbols)),
        action=LeftMultiplication(),
        state=(StateField("y", Kind.POINT, symbols, start),),
        roots=roots,
        open_roots=(),
        paired=False,
    )


def _in_body(scene: Problem, group: BodyFrame) -> tuple[Expr, ...]:
    """Return formulas for the time derivatives of q and P, where P is the momentum in the body frame.

    P_a has the same symbol as the component mu_a of the momentum of the scene.
    """
    body = scene.body
    assert body is not None
    domain = ExprDomain()
    state = tuple(map(domain.space.sym, scene.symbols))
    values = scene.values(domain, state, domain.space.sym(TIME))
    W, N = (tuple(evaluate(roots, domain, values)) for roots in (body.velocity, body.force))
    return (*group.left_velocity(domain, state[: group.size], W), *N)


def _shorter(form: Evolution) -> Iterator[Evolution]:
    """Yield variants of ``form`` with fewer coordinates. The omitted coordinates depend on the others."""
    on_itself = form.outer.action.on_itself
    group = _of_element(form.outer.group).offers(DependentCoordinates) if on_itself else None
    inner = form.inner
    for missing in () if group is None else group.determined():
        kept = [i for i in range(len(inner.symbols)) if i not in missing]
        roots = tuple(inner.roots[i] for i in kept)
        read = {node.payload for node in walk(roots) if node.op == "sym"}
        if not read.intersection(inner.symbols[i] for i in missing):
            symbols = tuple(inner.symbols[i] for i in kept)
            yield replace(form, inner=_problem(inner, symbols, roots), missing=missing)


def _of_element(group: LieGroup) -> LieGroup:
    """Return the group of q: G if ``group`` is a cotangent bundle T*G, otherwise ``group``."""
    bundle = group.offers(CotangentBundle)
    return group if bundle is None else bundle.base
