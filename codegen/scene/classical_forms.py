"""Classical forms of a scene: its equations in the coordinates that are usual for a general ODE solver.

A form is a problem on R^n with a map to the state of the scene. The first form uses the coordinates of the
scene. If a nonabelian group acts on itself, there can be two more forms: a form in the body frame
(:mod:`codegen.scene.body_frame`), and a form in which covering groups replace factors of the group, for
example unit quaternions in place of rotation matrices.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from codegen.errors import SceneError
from codegen.groups.actions import LeftMultiplication
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Coadjoint, Covered, DirectProduct, LeftTranslation
from codegen.groups.linear_algebra import S, Vector
from codegen.groups.rn import Rn
from codegen.ir.domain import Domain, ExprDomain, FloatDomain, Scalar
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.normal_form import NormalForms
from codegen.ir.values import Kind
from codegen.scene.ambient import ambient
from codegen.scene.body_frame import field_in_body
from codegen.scene.problem import TIME, Problem, StateField
from codegen.scene.values import Bindings

PRINTED = "printed"
"""The key (:attr:`ClassicalForm.key`) of the form that uses the coordinates of the scene."""


@dataclass(frozen=True)
class ClassicalForm:
    """A classical form of a scene: its key, its name, and its equations as a problem on R^n.

    A *state of the form* is a vector of coordinates on this R^n.

    - ``to_scene``: formulas that compute the state of the scene from the state of the form.
    - ``from_scene``: formulas for the inverse of ``to_scene``, valid near the initial state of the scene.
    - ``state``: a text that describes the coordinates on R^n.
    - ``conversion``: a text that describes the map to the state of the scene.
    """

    key: str
    name: str
    scene: Problem
    problem: Problem
    to_scene: tuple[Expr, ...]
    from_scene: tuple[Expr, ...]
    state: str = ""
    conversion: str = ""

    @property
    def printed(self) -> bool:
        """True for the form "as printed", which has the original equations of the scene.

        False for a form that uses the body frame or the coordinates of a covering group.
        """
        return self.key == PRINTED

    def scene_state(self, domain: Domain, state: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Convert a state of this form to the state of the scene."""
        return tuple(evaluate(self.to_scene, domain, self.problem.values(domain, tuple(state))))

    def form_state(self, domain: Domain, state: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Convert a state of the scene to a state of this form. ``state`` must be near the initial state."""
        return tuple(evaluate(self.from_scene, domain, self.scene.values(domain, tuple(state))))


def classical_forms(problem: Problem) -> tuple[ClassicalForm, ...]:
    """Return the classical forms of a scene.

    The first form uses the coordinates of the scene. Later forms use the body frame, coordinates of covering
    groups, or both.
    """
    symbols = tuple(map(ExprDomain().space.sym, problem.symbols))
    printed = ClassicalForm(PRINTED, "as printed", problem, ambient(problem), symbols, symbols)
    if not isinstance(problem.action, LeftMultiplication) or problem.group.abelian:
        return (printed,)
    return (printed, *(change.form() for change in _changes(problem)))


def find_form(problem: Problem, key: str) -> ClassicalForm:
    """Return the classical form that has the key ``key``.

    :class:`SceneError` is raised if no form of the scene has this key.
    """
    forms = classical_forms(problem)
    for form in forms:
        if form.key == key:
            return form
    raise SceneError(
        f"unknown form {key!r}", where=problem.name, expected=f"one of: {', '.join(f.key for f in forms)}"
    )


def operations(roots: Sequence[Expr]) -> int:
    """Return the number of operations in the formulas ``roots``. A common subexpression counts once.

    >>> from codegen.ir.expr import Space
    >>> x, y = map(Space().sym, "xx")
    >>> operations([x * x + 1])
    2
    """
    return sum(node.op not in ("const", "sym") for node in walk(roots))


def _changes(problem: Problem) -> Iterator[_Change]:
    """Yield the changes of coordinates that define classical forms."""
    framed = problem.group.offers(LeftTranslation) is not None or not problem.paired
    for covered in (False, True):
        changes = [_Change(problem, covered, body) for body in (False, True)[: 1 + framed]]
        best = min(changes, key=lambda change: operations(change.rates(problem.roots)))
        if any(leaf.cover is not None for leaf in best.leaves) or (best.body and not covered):
            yield best


@dataclass(frozen=True)
class _Leaf:
    """A factor of the group, with its coordinates. The factor is not a product of groups.

    ``symbols`` are the coordinates of the factor in the scene. ``own`` are the coordinates of the factor in
    the classical form. ``at`` is the index of the first component of the factor in a vector of the Lie
    algebra. If ``own`` are coordinates of a covering group, ``cover`` contains this group and its covering
    map.
    """

    group: LieGroup
    symbols: tuple[str, ...]
    own: tuple[str, ...]
    at: int
    cover: Covered | None

    @property
    def noun(self) -> str:
        """A noun for the coordinates of the factor in the classical form, for example "unit quaternion"."""
        return (self.group if self.cover is None else self.cover.cover).coordinates

    def element(self, d: Domain, own: Vector[S]) -> Vector[S]:
        """Return the element of ``group`` that has the coordinates ``own``."""
        return own if self.cover is None else self.cover.covering(d, own)

    def end(self, d: Domain, own: Vector[S]) -> Vector[S]:
        """Return the element of ``group`` that has the coordinates ``own``, with a projection if necessary.

        If ``own`` are coordinates of a covering group, numerical errors may change ``own`` to a vector that
        does not represent an element of the covering group. For example, a quaternion with a norm different
        from 1 does not represent an element of the group of unit quaternions. The coordinates are projected
        onto the covering group, and the result is the image of the projected element under the covering map.
        Without a covering group, ``own`` is returned unchanged.
        """
        return own if self.cover is None else self.cover.projected_covering(d, own)

    def rate(self, d: Domain, x: Vector[S], own: Vector[S], body: bool) -> Vector[S]:
        """Return the time derivative of the coordinates ``own``.

        ``x`` is the velocity in the body if ``body`` is True, otherwise the velocity in space.
        """
        group, x = self.group, x[self.at : self.at + self.group.dim]
        if self.cover is not None:
            group, x = self.cover.cover, self.cover.lifted_velocity(d, x)
        return group.require(LeftTranslation).left_velocity(d, own, x) if body else group.velocity(d, x, own)

    def start(self, d: ExprDomain, initial: Vector[float]) -> Vector[Expr]:
        """Return formulas that compute the coordinates ``own`` from the coordinates ``symbols``.

        The formulas hold near ``initial``, the initial values of ``symbols``.
        """
        g = tuple(d.space.sym(s) for s in self.symbols)
        if self.cover is None:
            return g
        pivots = self.cover.pivots(FloatDomain(0.0), initial)
        return self.cover.lift(d, g, pivots.index(max(pivots)))


def _leaves(problem: Problem, covered: bool) -> tuple[_Leaf, ...]:
    """Return the factors of the group, each with its coordinates."""
    names = list(problem.state[0].symbols)
    taken = {*problem.symbols, *problem.parameters, *problem.signals}
    leaves: list[_Leaf] = []
    at = 0
    for group in _factors(problem.group):
        symbols, names = tuple(names[: group.size]), names[group.size :]
        cover = group.offers(Covered) if covered else None
        own = symbols if cover is None else fresh("q", cover.cover.size, taken)
        leaves.append(_Leaf(group, symbols, own, at, cover))
        at += group.dim
    return tuple(leaves)


def _factors(group: LieGroup) -> Iterator[LieGroup]:
    product = group.offers(DirectProduct)
    if product is None:
        yield group
    else:
        for factor in product.factors:
            yield from _factors(factor)


def fresh(name: str, count: int, taken: set[str]) -> tuple[str, ...]:
    """Return ``count`` indexed symbols that are not in ``taken``, and add the symbols to ``taken``.

    >>> fresh("q", 2, {"q1"})
    ('q_0', 'q_1')
    """
    while any(f"{name}{k}" in taken for k in range(count)):
        name += "_"
    symbols = tuple(f"{name}{k}" for k in range(count))
    taken |= {*symbols}
    return symbols


@dataclass(frozen=True)
class _Change:
    """A change of coordinates from a scene to a classical form.

    If ``covered`` is True, the factors of the group are replaced by their covering groups, if these exist. If
    ``body`` is True, velocities and momenta are in the body frame.
    """

    problem: Problem
    covered: bool
    body: bool

    @cached_property
    def domain(self) -> ExprDomain:
        """The number domain in which the formulas are evaluated. Its numbers are expressions."""
        return ExprDomain()

    @cached_property
    def leaves(self) -> tuple[_Leaf, ...]:
        """The factors of the group, each with its coordinates."""
        return _leaves(self.problem, self.covered)

    @cached_property
    def momenta(self) -> tuple[str, ...]:
        """The symbols of the momentum in the classical form."""
        if not self.problem.paired:
            return ()
        taken = {s for leaf in self.leaves for s in leaf.own}
        taken |= {*self.problem.symbols, *self.problem.parameters, *self.problem.signals}
        own = self.problem.state[1].symbols
        return fresh("P", len(own), taken) if self.body else own

    @cached_property
    def symbols(self) -> tuple[str, ...]:
        """The symbols of the coordinates of the classical form."""
        return (*(s for leaf in self.leaves for s in leaf.own), *self.momenta)

    def form(self) -> ClassicalForm:
        """Return the classical form that this change of coordinates defines."""
        problem, key = self.problem, self.key()
        to_scene, from_scene = self.to_scene(), self.from_scene()
        known = dict(zip(problem.symbols, to_scene, strict=True))
        # Express the invariants in the coordinates of the classical form.
        invariants = {name: self.evaluated((x,), known)[0] for name, x in problem.invariants.items()}
        constants = self.evaluated([e for block in problem.state for e in block.initial], {})
        initial = self.evaluated(from_scene, dict(zip(problem.symbols, constants, strict=True)))
        roots = self.rates(problem.roots)
        own = replace(
            problem,
            name=f"{problem.name}_{key.replace('-', '_')}",
            group=Rn(len(self.symbols)),
            action=LeftMultiplication(),
            state=(StateField("y", Kind.POINT, self.symbols, initial),),
            roots=roots,
            open_roots=self.rates(problem.open_roots) if problem.signals and problem.open_roots else roots,
            hamiltonian=None,
            invariants=invariants,
            paired=False,
            forced=False,
            parts={},
            flows={},
            stated={},
        )
        return ClassicalForm(
            key, self.name(), problem, own, to_scene, from_scene, self.state(), self.conversion()
        )

    def key(self) -> str:
        """Return the key of the classical form, for example ``quaternion`` or ``body-matrix``."""
        chosen = [leaf for leaf in self.leaves if leaf.cover is not None] or self.leaves
        short = next(leaf.noun for leaf in chosen if not leaf.group.abelian).rpartition(" ")[2]
        return short if self.covered else f"body-{short}"

    def name(self) -> str:
        """Return a name that states the coordinates and the frame of the velocity or momentum."""
        nouns = [leaf.noun for leaf in self.leaves if not leaf.group.abelian]
        frame = "body" if self.body else "space"
        what = "momentum" if self.problem.paired else "velocity"
        return " and ".join((f"{frame} {what}", *dict.fromkeys(nouns)))

    def state(self) -> str:
        """Return a text that describes the coordinates of the classical form."""
        parts = [f"{leaf.own[0]} to {leaf.own[-1]}: {leaf.noun}{self.layout(leaf)}" for leaf in self.leaves]
        if self.momenta:
            frame = "body" if self.body else "space"
            parts.append(f"{self.momenta[0]} to {self.momenta[-1]}: momentum in the {frame} frame")
        return "; ".join(parts)

    @staticmethod
    def layout(leaf: _Leaf) -> str:
        """Return a text that describes the order of the coordinates ``leaf.own``."""
        return (leaf.group if leaf.cover is None else leaf.cover.cover).layout

    def conversion(self) -> str:
        """Return a text that describes the map from the coordinates of the classical form to the state of the
        scene.
        """
        parts = [leaf.cover.covering_formula for leaf in self.leaves if leaf.cover is not None]
        if self.body and self.momenta:
            parts.append(
                "the momentum in the scene is Ad*_{g^-1} P, where g is the group element and P is the "
                "momentum in the body frame (for rotation matrices, Ad*_{g^-1} P = g P)"
            )
        return "; ".join(dict.fromkeys(parts))

    def moving(self, leaf: _Leaf) -> bool:
        """Return True if the velocity of ``leaf`` (a factor of the group) is in the body frame."""
        return self.body and leaf.group.offers(LeftTranslation) is not None and not leaf.group.abelian

    def evaluated(self, roots: Sequence[Expr], known: Bindings) -> tuple[Expr, ...]:
        """Return ``roots`` with each symbol in ``known`` replaced by its value."""
        space = self.domain.space
        values: Bindings = {n.payload: space.sym(n.payload) for n in walk(roots) if n.op == "sym"}
        return tuple(evaluate(roots, self.domain, values | known))

    def blocks(self) -> Iterator[tuple[_Leaf, Vector[Expr]]]:
        """Yield a pair for each factor of the group: the factor, and its coordinates as expressions."""
        for leaf in self.leaves:
            yield leaf, tuple(self.domain.space.sym(s) for s in leaf.own)

    def rates(self, roots: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the time derivatives of the coordinates of the classical form.

        ``roots`` are the components of the field of the scene: the velocity and, in a Hamiltonian scene, the
        force.
        """
        problem, d = self.problem, self.domain
        element = tuple(x for leaf, own in self.blocks() for x in leaf.element(d, own))
        momenta = tuple(d.space.sym(s) for s in self.momenta)
        values = problem.values(d, (*element, *momenta), d.space.sym(TIME))
        values |= {name: d.space.sym(name) for name in problem.signals}
        field = tuple(evaluate(self.field(roots), d, values))
        velocity, force = field[: problem.group.dim], field[problem.group.dim :]
        if problem.paired and not self.body:
            carried = problem.group.require(Coadjoint).adt(d, velocity, momenta)
            force = tuple(a - b for a, b in zip(force, carried, strict=True))
        return (
            *(x for leaf, own in self.blocks() for x in leaf.rate(d, velocity, own, self.moving(leaf))),
            *force,
        )

    def field(self, roots: Sequence[Expr]) -> tuple[Expr, ...]:
        """Convert the velocity and the force to the body frame if ``self.body`` is True.

        ``roots`` contains the components of the velocity and, in a Hamiltonian scene, of the force, both in
        the space frame. If ``self.body`` is False, ``roots`` is returned unchanged.

        In the body frame, the momentum is P = Ad*_q mu, and the formulas depend on P instead of mu. In these
        formulas, the component P_a is denoted by the symbol that the scene uses for the component mu_a.
        """
        problem = self.problem
        if not self.body:
            return tuple(roots)
        if not problem.paired:
            return tuple(x for leaf in self.leaves for x in self.turned(leaf, roots))
        if problem.body is not None and roots is problem.roots:
            return (*problem.body.velocity, *problem.body.force)
        q, mu = (block.symbols for block in problem.state)
        velocity, force = field_in_body(problem.group.require(LeftTranslation), q, mu, roots)
        return (*velocity, *force)

    def turned(self, leaf: _Leaf, roots: Sequence[Expr]) -> Vector[Expr]:
        """Return the velocity of the factor ``leaf`` in the body frame.

        If ``leaf.group`` is not a :class:`LeftTranslation`, the velocity in the space frame is returned.
        ``roots`` contains the velocities of all factors in the space frame.
        """
        own = tuple(roots[leaf.at : leaf.at + leaf.group.dim])
        group = leaf.group.offers(LeftTranslation)
        if group is None:
            return own
        space = roots[0].space
        normal = NormalForms(space, group.relations(leaf.symbols))
        g = tuple(space.sym(s) for s in leaf.symbols)
        return tuple(normal(x) for x in group.Adinv(ExprDomain(space), g, own))

    def to_scene(self) -> tuple[Expr, ...]:
        """Return formulas that compute the state of the scene from the coordinates of the classical form."""
        d = self.domain
        element = tuple(x for leaf, own in self.blocks() for x in leaf.end(d, own))
        momenta = tuple(d.space.sym(s) for s in self.momenta)
        if self.body and momenta:
            momenta = self.problem.group.require(LeftTranslation).Adtinv(d, element, momenta)
        return (*element, *momenta)

    def from_scene(self) -> tuple[Expr, ...]:
        """Return formulas that compute the coordinates of the classical form from the state of the scene."""
        d, problem = self.domain, self.problem
        initial = dict(zip(problem.symbols, problem.initial(FloatDomain(0.0)), strict=True))
        own = [x for leaf in self.leaves for x in leaf.start(d, tuple(initial[s] for s in leaf.symbols))]
        if not problem.paired:
            return tuple(own)
        g, mu = (tuple(d.space.sym(s) for s in block.symbols) for block in problem.state)
        return (*own, *(problem.group.require(LeftTranslation).Adt(d, g, mu) if self.body else mu))
