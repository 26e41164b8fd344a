"""Settings: a scene as programs see it, evaluated over any domain.

A scene is read once: its sympy formulas become expressions (exact, hash-consed), derivatives are taken by
reverse differentiation, and from then on the scene can be evaluated over any domain. It is the *problem* in
which a step program is interpreted and compiled.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from codegen.errors import SceneError
from codegen.flows.flow import Flow, Stated
from codegen.groups.actions import LeftMultiplication
from codegen.groups.cotangent import Cotangent
from codegen.groups.euclidean import Rn
from codegen.ir.domain import Domain, ExprDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number
from codegen.ir.program import CUT_OFF, Factor, Kind
from codegen.scene import energy
from codegen.scene.body_frame import BodyFrame, applied, body_frame
from codegen.scene.consistency import Orbit, check_equal, check_invariants, check_start
from orderconds.errors import UnknownName

GROUP_OPERATIONS = frozenset(
    {"identity", "exp", "mul", "mulexp", "Ad", "Adinv", "Adt", "Adtinv", "ad", "adt", "dexpt"}
)
BODY = frozenset({"velocity", "velocityt", "force", "forcet", "legendre"})
TIME = "t"
FRAMES = ("space", "body")
"""Where momenta of emitted code are taken: right- or left-trivialised."""


@dataclass(frozen=True)
class StateField:
    """A block of the state: its name, kind, coordinates, and initial value as expressions."""

    name: str
    kind: Kind
    symbols: tuple[str, ...]
    initial: tuple[Expr, ...]


@dataclass(frozen=True)
class Problem:
    """A scene as programs see it: group, action, state, and either a field or a Hamiltonian.

    ``roots`` are the components of f (field scenes) or of xi and n (Hamiltonian scenes) as expressions in the
    state's symbols, the parameters and ``t``; ``parts`` are named summands of the Hamiltonian, and ``flows``
    the exact flows that a splitting composes. ``open_roots`` are the roots with the symbols of ``signals``
    where ``roots`` have their formulas, and ``inputs`` those signals that emitted code takes at run time;
    ``forced`` says that n is not a derivative of the Hamiltonian alone; ``body_group`` is the group where
    emitted code takes and returns momenta of the body. Values are flat tuples of scalars of a domain.
    """

    name: str
    title: str
    group: Any
    action: Any
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
    body_group: Any = None
    parts: Mapping[str, Expr] = field(default_factory=dict)
    flows: Mapping[str, Flow] = field(default_factory=dict)
    stated: Mapping[str, Stated] = field(default_factory=dict)

    @property
    def symbols(self) -> tuple[str, ...]:
        """All coordinates of the state in order."""
        return tuple(s for block in self.state for s in block.symbols)

    @property
    def autonomous(self) -> bool:
        """Whether the time does not occur in the field or Hamiltonian, nor in what is put in at run time."""
        return not self.inputs and not any(n.op == "sym" and n.payload == TIME for n in walk(self.roots))

    @property
    def is_hamiltonian(self) -> bool:
        """Whether programs see (q, mu) and the operation ``hamilton``."""
        return self.paired

    def dimension(self) -> int:
        """Return the dimension of the Lie algebra."""
        return int(self.group.dim)

    def with_runtime(self, names: Sequence[str]) -> Problem:
        """Return this scene with those parameters kept as run-time inputs, or folded at another value.

        ``alpha`` keeps alpha an input, ``alpha=1/2`` folds it at 1/2; the scene is then checked anew.
        """
        values = dict(self.parameters)
        runtime, fixed, folded = set(self.runtime), dict(self.fixed), set[str]()
        for spelled in names:
            name, given, text = spelled.partition("=")
            if name not in self.parameters:
                known = ", ".join(sorted(self.parameters)) or "none"
                raise SceneError(f"unknown parameter {name!r}", where=self.name, expected=f"one of: {known}")
            if not given:
                runtime.add(name)
                continue
            if name in folded:
                raise SceneError(f"two values of the parameter {name}", where=self.name, expected="one")
            try:
                values[name] = Number.read(text)
            except ValueError as problem:
                raise SceneError(
                    f"the value {text[:40]!r} of the parameter {name}",
                    where=self.name,
                    expected=str(problem),
                ) from None
            folded.add(name)
            fixed[name] = values[name].text()
        changed = replace(
            self, parameters=values, runtime=tuple(sorted(runtime)), fixed=tuple(sorted(fixed.items()))
        )
        if fixed:
            check_problem(changed, {})
        return changed

    def with_inputs(self, names: Sequence[str]) -> Problem:
        """Return this scene with those signals taken at run time, in that order."""
        for name in names:
            if name not in self.signals:
                known = ", ".join(self.signals) or "none: the scene has no signal"
                raise SceneError(f"unknown signal {name!r}", where=self.name, expected=f"one of: {known}")
        return replace(self, inputs=tuple(dict.fromkeys(names)))

    def with_frame(self, frame: str) -> Problem:
        """Return this scene with momenta of emitted code in that frame: ``space`` or ``body``.

        The momentum in the body is Ad*_q mu, left-trivialised; programs compute with mu in either case.
        """
        if frame not in FRAMES:
            raise UnknownName(f"unknown frame {frame}", expected=" or ".join(FRAMES))
        if frame == "body" and (not self.paired or self.group.abelian):
            raise SceneError(
                f"{self.name} has no momentum in a body",
                expected="a Hamiltonian scene on a group that is not abelian",
                hint="leave --frame out",
            )
        return replace(self, body_group=self.group if frame == "body" else None)

    def as_field(self) -> Problem:
        """Return a Hamiltonian scene as the field f = (xi, n) on the group T*G acting on itself."""
        if not self.paired:
            return self
        q, mu = self.state
        point = StateField("y", Kind.POINT, q.symbols + mu.symbols, q.initial + mu.initial)
        group, action = Cotangent(self.group), LeftMultiplication()
        return replace(self, group=group, action=action, state=(point,), paired=False)

    def as_ambient(self) -> Problem:
        """Return the scene as y' = F(y) in the coordinates of its state: a field on R^n, the group forgotten.

        What integrates it is of no group and leaves the manifold by as much as it errs.
        """
        field, domain = self.as_field(), ExprDomain(self.roots[0].space)
        state = tuple(domain.space.sym(s) for s in self.symbols)
        values = field.values(domain, state, domain.space.sym(TIME))
        values |= {name: domain.space.sym(name) for name in self.signals}

        def ambient(roots: tuple[Expr, ...]) -> tuple[Expr, ...]:
            f = tuple(evaluate(roots, domain, values))
            return tuple(field.action.velocity(domain, field.group, f, state))

        initial = tuple(x for block in self.state for x in block.initial)
        point = StateField("y", Kind.POINT, self.symbols, initial)
        return replace(
            self,
            group=Rn(len(self.symbols)),
            action=LeftMultiplication(),
            state=(point,),
            roots=ambient(self.roots),
            open_roots=ambient(self.open_roots),
            paired=False,
        )

    def values(self, domain: Domain, state: Sequence[Any], t: Any = None) -> dict[str, Any]:
        """Return the values of all symbols and parameters; run-time ones stay symbols in expressions."""
        values = dict(zip(self.symbols, state, strict=True))
        for name, number in self.parameters.items():
            symbolic = isinstance(domain, ExprDomain) and name in self.runtime
            values[name] = domain.space.sym(name) if symbolic else domain.number(number)  # type: ignore[attr-defined]
        values[TIME] = t if t is not None else domain.rational(0)
        return values

    def apply(self, domain: Domain, name: str, order: int | None, args: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return the results of a group, action or scene operation of a program."""
        if name in CUT_OFF:
            return (getattr(self.group, name)(domain, *args, order),)
        if name in GROUP_OPERATIONS:
            return (getattr(self.group, name)(domain, *args),)
        if name in ("act", "actexp"):
            return (getattr(self.action, name)(domain, self.group, *args),)
        if name in energy.OPERATIONS:
            return (energy.apply(self, domain, name, args),)
        if name in BODY:
            return (self._in_body(domain, name, args),)
        return self._evaluate(domain, args)

    def flow(self, domain: Domain, part: str, tau: Any, args: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return (q, mu) after the exact flow of a part for the time tau; ``args``: q, mu, perhaps t."""
        q, mu, *time = args
        values = self.values(domain, (*q, *mu), *time)
        return self.flows[part].advance(domain, self.group, values, tau, q, mu)

    def series(self, domain: Domain, word: tuple[Factor, ...], dual: bool, x: Any, v: Any) -> tuple[Any, ...]:
        """Return the product of a word's functions of ad_x, of ad*_x where ``dual``, applied to v."""
        return tuple(self.group.series(domain, word, dual, x, v))

    @property
    def has_body(self) -> bool:
        """Whether there is a body frame to see the field from."""
        return self.body is not None

    @cached_property
    def body(self) -> BodyFrame | None:
        """The field in the body frame; None where no Hamiltonian gives it all, or the group has none."""
        closed = not self.inputs and not self.forced and self.hamiltonian is not None
        if not self.paired or not closed or not hasattr(self.group, "relations"):
            return None
        assert self.hamiltonian is not None
        q, mu = (block.symbols for block in self.state)
        return body_frame(self.group, q, mu, self.hamiltonian, self.group.relations(q))

    def _in_body(self, domain: Domain, name: str, args: tuple[Any, ...]) -> tuple[Any, ...]:
        assert self.body is not None
        if name == "legendre":
            return applied(self.body, name, domain, {}, args[0])
        t = args[2] if len(args) > 2 else None
        return applied(self.body, name, domain, self.values(domain, (*args[0], *args[1]), t))

    def _evaluate(self, domain: Domain, args: tuple[Any, ...]) -> tuple[Any, ...]:
        blocks = args[: len(self.state)]
        t = args[len(self.state)] if len(args) > len(self.state) else None
        state = tuple(x for block in blocks for x in block)
        values = self.values(domain, state, t)
        roots = self.roots
        if self.inputs and isinstance(domain, ExprDomain):
            roots = self.open_roots
            formulas = evaluate(list(self.signals.values()), domain, values)
            samples = domain.sample(self.inputs, values[TIME])
            values |= dict(zip(self.signals, formulas, strict=True)) | samples
        result = tuple(evaluate(roots, domain, values))
        if not self.paired:
            return (result,)
        return result[: self.group.dim], result[self.group.dim :]

    def velocity(self, domain: Domain, state: tuple[Any, ...], t: Any = None) -> tuple[Any, ...]:
        """Return the ambient time derivative of the state's coordinates: f(y).y."""
        field = self.as_field()
        f = tuple(evaluate(field.roots, domain, field.values(domain, state, t)))
        return tuple(field.action.velocity(domain, field.group, f, state))

    def initial(self, domain: Domain) -> tuple[Any, ...]:
        """Return the initial coordinates in order."""
        roots = [e for block in self.state for e in block.initial]
        values = {name: domain.number(number) for name, number in self.parameters.items()}
        return tuple(evaluate(roots, domain, values))

    def invariant(self, domain: Domain, name: str, state: Sequence[Any]) -> Any:
        """Return the value of a declared invariant; ``energy`` is the Hamiltonian where there is one."""
        root = self.invariants[name]
        return evaluate([root], domain, self.values(domain, state))[0]


def check_problem(
    problem: Problem, stated: Mapping[str, tuple[tuple[Expr, ...], tuple[Expr, ...] | None]]
) -> None:
    """Raise :class:`SceneError` where the scene contradicts itself (:mod:`codegen.scene.consistency`)."""
    orbit = orbit_of(problem)
    check_start(orbit)
    for what, (formulas, derived) in stated.items():
        check_equal(orbit, formulas, what, derived)
    check_invariants(orbit, problem.invariants)


def orbit_of(problem: Problem) -> Orbit:
    """Return the points of the scene at which formulas are compared."""
    view = problem.as_field()
    start = tuple(e for block in view.state for e in block.initial)
    return Orbit(
        *(view.name, view.group, view.action, view.symbols, start, view.roots, view.span, view.parameters)
    )
