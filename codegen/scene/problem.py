"""Problems: the data of a scene for the interpreter and the compiler.

The sympy formulas of a scene are converted to exact expressions that share equal subexpressions. Derivatives
are computed by reverse differentiation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import Action, LeftMultiplication
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import (
    BodyFrame,
    ClosedFormSeries,
    Coadjoint,
    DirectProduct,
    MatrixElements,
)
from codegen.groups.coordinate_maps import CoordinateMap
from codegen.groups.cotangent import Cotangent
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.ad_series import Word
from codegen.ir.domain import Domain, ExprDomain, Values
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.formulas import Formulas
from codegen.ir.number import Number
from codegen.ir.values import Kind
from codegen.scene import energy
from codegen.scene.body_frame import BodyField, body_field
from codegen.scene.flow import Flow
from codegen.scene.operations import BY_ACTION, ON_COORDINATES, ON_GROUP, TRUNCATED
from codegen.scene.values import Bindings

if TYPE_CHECKING:
    from codegen.scene.evolution import Evolution
    from codegen.scene.figure import Figure
    from codegen.scene.matrix_field import MatrixField
    from codegen.scene.matrix_step import MatrixStep
    from codegen.scene.semilinear import Semilinear
    from codegen.scene.sites import Sites

TIME = "t"
"""The symbol of the time in formulas."""


@dataclass(frozen=True)
class StateField:
    """A block of the state: a point, a group element or a dual vector.

    ``symbols`` are the coordinates, and ``initial`` are the expressions for their initial values.
    """

    name: str
    kind: Kind
    symbols: tuple[str, ...]
    initial: tuple[Expr, ...]


@dataclass(frozen=True)
class Problem:
    """The internal form of a scene: a group, an action, a state, and a field or a Hamiltonian.

    The equation of a field scene is y' = f(y).y. The equations of a Hamiltonian scene are q' = xi.q and
    mu' = n - ad*_xi mu, where xi is the velocity in the Lie algebra, and n is the force in its dual space.

    - ``roots``: the components of f, or of xi and n, as expressions in the coordinates, the parameters and
      ``t``; empty for large matrices and semilinear equations.
    - ``paired``: True if the state is (q, mu).
    - ``parts``: summands of the Hamiltonian, by name.
    - ``flows``: the exact flows that a step of a splitting method uses, by name.
    - ``stated``: maps names of ``parts`` to formulas for exact flows. The scene defines these formulas, which
      give (q, mu) after the time ``tau``. The flows of other parts are derived by :mod:`codegen.flows`.
    - ``runtime``: the parameters that are arguments of emitted code.
    - ``fixed``: pairs (name, value) of the parameters that the user has set.
    - ``signals``: the formula of each signal, by the name of the signal.
    - ``open_roots``: like ``roots``, but with the names of signals in place of the formulas of signals.
    - ``inputs``: the signals that emitted code reads at run time.
    - ``forced``: True if n contains a force that is not a derivative of the Hamiltonian.
    - ``body_group``: the group if emitted code uses momenta in the body frame, otherwise None.
    - ``evolution``: the coordinates in which Taylor's method computes a step.
    - ``coordinates``: the map with which Runge-Kutta-Munthe-Kaas methods parametrise the group. None means
      the exponential map.
    - ``matrices``: the field as formulas of matrices, or None (:mod:`codegen.scene.matrix_formula`).
    - ``carries_momentum``: True for a linear problem whose last coordinate is the momentum conjugate to the
      time (:mod:`codegen.scene.linear_extension`).
    - ``steps``: the methods that the scene defines by formulas (:mod:`codegen.scene.matrix_step`).
    - ``sites``: the lattice of a lattice problem, otherwise None (:mod:`codegen.scene.sites`). On a lattice,
      ``roots`` also contain the coordinates of neighbours.
    - ``semilinear``: the formulas of u' = L u + N(u) (:mod:`codegen.scene.semilinear`).
    - ``figures``: the figures in the file of the scene (:mod:`codegen.scene.figure`).
    - ``derived``: a cache of problems that are derived from this problem.
    """

    name: str
    title: str
    group: LieGroup
    action: Action
    state: tuple[StateField, ...]
    roots: tuple[Expr, ...]
    hamiltonian: Expr | None
    invariants: Mapping[str, Expr]
    span: tuple[Fraction, Fraction]
    parameters: Mapping[str, Number]
    runtime: tuple[str, ...] = ()
    paired: bool = False
    fixed: tuple[tuple[str, str], ...] = ()
    signals: Mapping[str, Expr] = field(default_factory=dict)
    open_roots: tuple[Expr, ...] = ()
    inputs: tuple[str, ...] = ()
    forced: bool = False
    body_group: Coadjoint | None = None
    evolution: Evolution | None = None
    coordinates: CoordinateMap | None = None
    matrices: MatrixField | None = None
    carries_momentum: bool = False
    parts: Mapping[str, Expr] = field(default_factory=dict)
    flows: Mapping[str, Flow] = field(default_factory=dict)
    stated: Mapping[str, tuple[Expr, ...]] = field(default_factory=dict)
    steps: Mapping[str, MatrixStep] = field(default_factory=dict)
    sites: Sites | None = None
    semilinear: Semilinear | None = None
    figures: tuple[Figure, ...] = field(default=(), repr=False, compare=False)
    derived: dict[str, Problem] = field(default_factory=dict, init=False, repr=False, compare=False)

    @property
    def symbols(self) -> tuple[str, ...]:
        """The symbols of all coordinates of the state."""
        return tuple(s for block in self.state for s in block.symbols)

    @property
    def autonomous(self) -> bool:
        """True if the field depends neither on the time nor on signals that are read at run time.

        The value is also False if a formula in ``sites.outside`` depends on the time.
        """
        if self.matrices is not None:
            return not self.matrices.reads(TIME)
        if self.semilinear is not None:
            return not self.semilinear.timed
        ends = () if self.sites is None else [x for column in self.sites.outside for x in column]
        timed = any(n.op == "sym" and n.payload == TIME for n in walk([*self.roots, *ends]))
        return not self.inputs and not timed

    @property
    def linear(self) -> bool:
        """True if the field f in y' = f.y does not depend on the state y.

        On a lattice, the field of a site must not depend on the states of neighbours either.
        """
        # For large matrices, ``roots`` is empty, and ``matrices`` contains the field.
        if self.matrices is not None:
            return self.matrices.linear
        if self.semilinear is not None:
            return False
        state = {*self.symbols, *(() if self.sites is None else self.sites.names)}
        return not any(n.op == "sym" and n.payload in state for n in walk(self.roots))

    @property
    def is_hamiltonian(self) -> bool:
        """True if the state is (q, mu)."""
        return self.paired

    def dimension(self) -> int:
        """Return the dimension of the Lie algebra of the group."""
        return self.group.dim

    def require_formulas(self) -> None:
        """Raise :class:`codegen.errors.SceneError` if the field has no formulas in coordinates.

        Two cases have no such formulas: semilinear equations, and matrices with more than eight rows.
        """
        if self.semilinear is not None:
            raise SceneError(
                "a semilinear equation, which has no formulas in coordinates",
                where=self.name,
                expected="a scene with formulas in coordinates",
                hint="emit the scene, and run the emitted module with codegen.load_spectral",
            )
        if not self.roots:
            raise SceneError(
                f"the field has no formulas in coordinates, because the dimension {self.group.dim} of "
                f"{self.group.name} is too large",
                where=self.name,
                expected="a matrix with at most eight rows",
                hint='use a smaller matrix, or the commands "emit" and "converge", which accept every size',
            )

    def as_field(self) -> Problem:
        """Convert a problem with the state (q, mu) to an equivalent problem on the group T*G.

        The state of the returned problem is the element y = (q, mu) of T*G. The equation of the returned
        problem is y' = f(y).y, where f is (velocity, force). In the returned problem, the group T*G acts on
        itself by left multiplication. The dot denotes the left multiplication.
        A problem with another state is returned unchanged.
        """
        if not self.paired:
            return self
        q, mu = self.state
        point = StateField("y", Kind.POINT, q.symbols + mu.symbols, q.initial + mu.initial)
        group, action = Cotangent(self.group), LeftMultiplication()
        return replace(self, group=group, action=action, state=(point,), paired=False)

    def values(self, domain: Domain, state: Sequence[S], t: S | None = None) -> Bindings:
        """Return the values of all symbols: the coordinates of the state, the parameters and the time t.

        The default of t is 0. In an :class:`ExprDomain`, run-time parameters stay symbols.
        """
        return {**dict(zip(self.symbols, state, strict=True)), **self.scalars(domain, t)}

    def scalars(self, domain: Domain, t: S | None = None) -> Bindings:
        """Return the values of the parameters and of the time t.

        The default of t is 0. In an :class:`ExprDomain`, run-time parameters stay symbols.
        """
        values: Bindings = {}
        for name, number in self.parameters.items():
            if isinstance(domain, ExprDomain) and name in self.runtime:
                values[name] = domain.space.sym(name)
            else:
                values[name] = domain.number(number)
        values[TIME] = t if t is not None else domain.rational(0)
        return values

    def apply(self, domain: Domain, name: str, order: int | None, args: Values) -> Values:
        """Return the results of the operation ``name`` of a step program.

        If the operation truncates a series, ``order`` is the truncation order.
        """
        if name in TRUNCATED:
            return (TRUNCATED[name](self.group, domain, *args, order),)
        if name in ON_GROUP:
            return (ON_GROUP[name](self.group, domain, *args),)
        if name in BY_ACTION:
            return (BY_ACTION[name](self.action, domain, self.group, *args),)
        if name in ON_COORDINATES:
            assert self.coordinates is not None
            return (ON_COORDINATES[name](self.coordinates, domain, self.group, *args),)
        if name in energy.OPERATIONS:
            return (energy.apply(self, domain, name, args),)
        match name:
            case "taylor_polynomial":
                return (self._evolution().step(domain, order or 0, *args),)
            case "to_orbit":
                return (self._evolution().leave(domain, *args),)
            case "legendre":
                return (self._require_body().momentum(domain, *args),)
            case "velocity" | "velocityt":
                return (self._in_body(domain, self._require_body().velocity, args),)
            case "force" | "forcet":
                return (self._in_body(domain, self._require_body().force, args),)
            case _:
                return self._field(domain, args)

    def _evolution(self) -> Evolution:
        assert self.evolution is not None
        return self.evolution

    def flow(self, domain: Domain, part: str, tau: S, args: Values) -> Values:
        """Apply the exact flow of one summand of the Hamiltonian for the time ``tau``, and return (q, mu).

        ``part`` is the name of the summand. ``args`` are the initial q and mu, followed by t if the summand
        depends on t.
        """
        q, mu, *time = args
        values = self.values(domain, (*q, *mu), *time)
        return self.flows[part].advance(domain, self.group.require(Coadjoint), values, tau, q, mu)

    def series(self, domain: Domain, word: Word, dual: bool, x: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return W(ad_x) v, where W(t) is the product of the factors in ``word``.

        If ``dual`` is true, return W(ad*_x) v.
        """
        return self.group.require(ClosedFormSeries).series(domain, word, dual, x, v)

    @property
    def has_body(self) -> bool:
        """True if the problem has formulas for the field in the body frame."""
        return self.body is not None

    @cached_property
    def body(self) -> BodyField | None:
        """The field in the body frame, or None.

        The value is None in four cases:

        - The problem has no Hamiltonian.
        - The group has no body frame.
        - Emitted code reads signals at run time.
        - The equations contain a force that is not a derivative of the Hamiltonian.
        """
        group = self.group.offers(BodyFrame)
        if group is None or not self.paired or self.inputs or self.forced or self.hamiltonian is None:
            return None
        q, mu = (block.symbols for block in self.state)
        return body_field(group, q, mu, self.hamiltonian)

    def _require_body(self) -> BodyField:
        assert self.body is not None
        return self.body

    def _in_body(self, domain: Domain, roots: Sequence[Expr], args: Values) -> Values:
        q, P, *time = args
        return tuple(evaluate(roots, domain, self.values(domain, (*q, *P), *time)))

    def _field(self, domain: Domain, args: Values) -> Values:
        """Return the pair (xi, n) if the state is (q, mu), otherwise f (see :class:`Problem`).

        ``args`` contains the blocks of the state, and optionally the time, which is 0 by default.
        """
        blocks, time = args[: len(self.state)], args[len(self.state) :]
        values = self.values(domain, tuple(x for block in blocks for x in block), *time)
        roots = self.roots
        if self.inputs and isinstance(domain, ExprDomain):
            # The signals in ``inputs`` stay symbols, because the caller of emitted code passes their values.
            roots = self.open_roots
            formulas = evaluate(list(self.signals.values()), domain, values)
            samples = domain.sample(self.inputs, values[TIME])
            values |= dict(zip(self.signals, formulas, strict=True)) | samples
        result = tuple(evaluate(roots, domain, values))
        return (result[: self.group.dim], result[self.group.dim :]) if self.paired else (result,)

    def stated_step(self, domain: Domain, name: str, y: Vector[S], t: S) -> Vector[S]:
        """Return the state after one step of the method ``name`` in :attr:`steps`, from y at the time t."""
        from codegen.scene.matrix_step import Evaluation

        product = self.group.offers(DirectProduct) if self.carries_momentum else None
        group = self.group if product is None else product.factors[0]
        roots = self.roots[: group.dim]

        def generator(c: Fraction) -> Vector[S]:
            time = t + domain.rational(*c.as_integer_ratio()) * domain.h if c else t
            return tuple(evaluate(roots, domain, self.scalars(domain, time)))

        matrices = group.require(MatrixElements)
        matrix = self.steps[name].formula.value(Evaluation(matrices, domain, generator))
        if product is None:
            return self.action.act(domain, group, matrix, y)
        return self.action.act(domain, self.group, (*matrix, domain.rational(0)), y)

    def velocity(self, domain: Domain, state: Sequence[S], t: S | None = None) -> Vector[S]:
        """Return the time derivatives of the state's coordinates: f(y).y."""
        if self.matrices is not None:
            return self.matrices.velocity(domain, tuple(state), self.scalars(domain, t))
        if self.semilinear is not None:
            self.require_formulas()
        problem = self.as_field()
        f: Vector[S] = tuple(evaluate(problem.roots, domain, problem.values(domain, state, t)))
        if isinstance(domain, ExprDomain):
            domain = Formulas(domain)
        return problem.action.velocity(domain, problem.group, f, tuple(state))

    def initial(self, domain: Domain) -> Values:
        """Return the initial values of all coordinates of the state."""
        roots = [e for block in self.state for e in block.initial]
        values = {name: domain.number(number) for name, number in self.parameters.items()}
        return tuple(evaluate(roots, domain, values))

    def invariant(self, domain: Domain, name: str, state: Sequence[S], t: S | None = None) -> S:
        """Return the value of the invariant ``name`` at a state and a time.

        The default of t is 0. If the problem has a Hamiltonian, the invariant ``energy`` is the Hamiltonian.
        """
        value: S = evaluate([self.invariants[name]], domain, self.values(domain, state, t))[0]
        return value
