"""Scenes: what a user writes. A group, its action, a field or a Hamiltonian, parameters, initial state, span.

A scene is read once: its sympy formulas become expressions (exact, hash-consed), derivatives are taken by
reverse differentiation, and from then on the scene can be evaluated over any domain. It is the *setting* in
which a step program is interpreted and compiled.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from codegen import conserved
from codegen.body import BodyFrame, applied, body_frame
from codegen.canonical import force, velocity
from codegen.consistency import Orbit, check_equal, check_flow, check_invariants, check_start
from codegen.errors import SceneError
from codegen.flow import TAU, Flow, Stated
from codegen.groups.actions import LeftMultiplication
from codegen.groups.cotangent import Cotangent
from codegen.groups.euclidean import Rn
from codegen.ir.differentiate import gradient
from codegen.ir.domain import Domain, ExprDomain
from codegen.ir.expr import Expr, Space, evaluate, walk
from codegen.ir.from_sympy import read
from codegen.ir.number import Number
from codegen.ir.program import CUT_OFF, Factor, Kind
from orderconds.errors import UnknownName

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
RESERVED = {
    "t": "t is the time; it may stand in formulas, but it is no coordinate and no parameter",
    "h": "h is the step size",
}
"""Names that programs use themselves, and why."""

GROUP_OPERATIONS = frozenset(
    {"identity", "exp", "mul", "mulexp", "Ad", "Adinv", "Adt", "Adtinv", "ad", "adt", "dexpt"}
)
BODY = frozenset({"velocity", "velocityt", "force", "forcet", "legendre"})
TIME = "t"
FRAMES = ("space", "body")
"""Where momenta of emitted code are taken: right- or left-trivialised."""


def param(name: str, default: Any) -> Any:
    """Return a sympy symbol for a parameter with a rational default.

    The default is folded into emitted code unless the parameter is asked for at run time.
    :class:`SceneError` for a default that is not rational.
    """
    import sympy

    from codegen.parameter import Parameter

    try:
        value = sympy.Rational(default)
    except TypeError:
        value = None
    if value is None or not value.is_Rational:
        raise SceneError(f"the default {default}", where=f"parameter {name}", expected="a rational number")
    return Parameter(name, int(value.p), int(value.q))


def signal(name: str, formula: Any = 0) -> Any:
    """Return a sympy symbol for a function of time: a control, a measured load.

    It is folded into emitted code as its ``formula``, in t and parameters, unless it is asked for as a
    run-time input (``emit --input NAME``). :class:`SceneError` for a formula that is none.
    """
    import sympy

    from codegen.parameter import Signal

    try:
        return Signal(name, sympy.sympify(formula, strict=True))
    except sympy.SympifyError:
        raise SceneError(
            f"the formula {formula!r}", where=f"signal {name}", expected="a sympy formula in t"
        ) from None


@dataclass(frozen=True)
class StateField:
    """A block of the state: its name, kind, coordinates, and initial value as expressions."""

    name: str
    kind: Kind
    symbols: tuple[str, ...]
    initial: tuple[Expr, ...]


@dataclass(frozen=True)
class Setting:
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

    def with_runtime(self, names: Sequence[str]) -> Setting:
        """Return this scene with those parameters kept as run-time inputs, or folded at another value.

        ``alpha`` keeps alpha an input, ``alpha=1/2`` folds it at 1/2; the scene is then checked anew.
        """
        values = dict(self.parameters)
        runtime, fixed = set(self.runtime), dict(self.fixed)
        for spelled in names:
            name, given, text = spelled.partition("=")
            if name not in self.parameters:
                known = ", ".join(sorted(self.parameters)) or "none"
                raise SceneError(f"unknown parameter {name!r}", where=self.name, expected=f"one of: {known}")
            if not given:
                runtime.add(name)
                continue
            try:
                values[name] = Number.rational(*Fraction(text).as_integer_ratio())
            except (ValueError, ZeroDivisionError):
                raise SceneError(
                    f"the value {text!r} of the parameter {name}",
                    where=self.name,
                    expected="a rational number, as 1/2 or 0.25",
                ) from None
            fixed[name] = values[name].text()
        changed = replace(
            self, parameters=values, runtime=tuple(sorted(runtime)), fixed=tuple(sorted(fixed.items()))
        )
        if fixed:
            _check(changed, {})
        return changed

    def with_inputs(self, names: Sequence[str]) -> Setting:
        """Return this scene with those signals taken at run time, in that order."""
        for name in names:
            if name not in self.signals:
                known = ", ".join(self.signals) or "none: the scene has no signal"
                raise SceneError(f"unknown signal {name!r}", where=self.name, expected=f"one of: {known}")
        return replace(self, inputs=tuple(dict.fromkeys(names)))

    def with_frame(self, frame: str) -> Setting:
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

    def as_field(self) -> Setting:
        """Return a Hamiltonian scene as the field f = (xi, n) on the group T*G acting on itself."""
        if not self.paired:
            return self
        q, mu = self.state
        point = StateField("y", Kind.POINT, q.symbols + mu.symbols, q.initial + mu.initial)
        group, action = Cotangent(self.group), LeftMultiplication()
        return replace(self, group=group, action=action, state=(point,), paired=False)

    def as_ambient(self) -> Setting:
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
        if name in conserved.OPERATIONS:
            return (conserved.apply(self, domain, name, args),)
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


def FieldScene(
    *,
    group: Any,
    action: Any,
    y: Any,
    f: Any,
    y0: Any,
    span: tuple[Any, Any],
    velocity: Any = None,
    invariants: Mapping[str, Any] | None = None,
    name: str = "scene",
    title: str = "",
) -> Setting:
    """Return the scene y' = f(y).y for a group acting on a manifold.

    ``y`` is a sympy column of coordinate symbols, ``f`` a column of ``group.dim`` components in them, in
    the symbol ``t`` and parameters, ``y0`` the exact initial point, ``span`` the rational time interval,
    ``invariants`` a mapping from names to scalar formulas. ``velocity``, where it is given, is y' as an
    ambient formula; f must generate it. :class:`SceneError` for a wrong shape or symbol, a start that is not
    on the group, an f that does not generate the velocity, an invariant that is none.
    """
    reader = _Reader(name, list(y))
    _acts(reader, group, action)
    open_roots = reader.column(f, group.dim, "f")
    roots = reader.closed(open_roots)
    start = reader.column(y0, len(y), "y0", constant=True)
    state = (StateField("y", Kind.POINT, tuple(reader.coordinates), start),)
    known = {key: reader.scalar(value, f"invariant {key}") for key, value in (invariants or {}).items()}
    stated = () if velocity is None else reader.closed(reader.column(velocity, len(y), "velocity"))
    setting = Setting(
        *(name, title or name, group, action, state, roots, None, known, _span(name, span)),
        reader.parameters(),
        signals=reader.signals,
        open_roots=open_roots,
    )
    _check(setting, {"velocity": (stated, None)} if stated else {})
    return setting


def HamiltonianScene(
    *,
    group: Any,
    q: Any,
    mu: Any,
    H: Any,
    q0: Any,
    mu0: Any,
    span: tuple[Any, Any],
    parts: Mapping[str, Any] | None = None,
    flows: Mapping[str, tuple[Any, Any]] | None = None,
    xi: Any = None,
    n: Any = None,
    wrench: Any = None,
    invariants: Mapping[str, Any] | None = None,
    name: str = "scene",
    title: str = "",
) -> Setting:
    """Return the scene of a right-trivialised Hamiltonian H(q, mu) on T*G.

    ``q`` and ``mu`` are sympy matrices of symbols (``group.point``, ``group.dual``), ``q0`` and ``mu0`` exact
    initial values, ``parts`` named summands of H, ``flows`` the exact flows of those that the compiler does
    not recognise, as formulas (q, mu) after the time ``Symbol("tau")``. xi = D_2 H and n = -(D_1 H).q^-1
    (:mod:`codegen.canonical`) are found by differentiation; where ``xi`` or ``n`` is given by hand it must
    agree. ``wrench``, where it is given, is a column of ``group.dim`` components that no H has:
    mu' = n + wrench - ad*_xi mu, in the same trivialisation (space); n given by hand is without it. Such a
    scene has no energy and no parts. The energy is an invariant of a Hamiltonian without time.
    :class:`SceneError` as for :func:`FieldScene`.
    """
    reader = _Reader(name, [*q, *mu])
    if (len(q), len(mu)) != (group.size, group.dim):
        raise SceneError(
            f"{len(q)} coordinates of q and {len(mu)} of mu",
            where=name,
            expected=f"{group.size} and {group.dim}, those of {group.name}",
            hint='take group.point("q") and group.dual("mu")',
        )
    hamiltonian = reader.scalar(H, "H")
    summands = {key: reader.scalar(part, f"part {key}") for key, part in (parts or {}).items()}
    qs, mus = tuple(s.name for s in q), tuple(s.name for s in mu)
    derivatives = gradient(hamiltonian, qs + mus)
    roots = tuple(derivatives[len(qs) :]) + force(reader.space, group, qs, derivatives[: len(qs)])
    loads = () if wrench is None else reader.column(wrench, group.dim, "wrench")
    open_roots = roots
    if loads:
        pairs = zip(roots[group.dim :], loads, strict=True)
        open_roots = roots[: group.dim] + tuple(x + y for x, y in pairs)
    state = (
        StateField("q", Kind.GROUP, qs, reader.column(q0, len(qs), "q0", constant=True)),
        StateField("mu", Kind.DUAL, mus, reader.column(mu0, len(mus), "mu0", constant=True)),
    )
    (closed,) = reader.closed((hamiltonian,))
    timeless = not any(node.op == "sym" and node.payload == TIME for node in walk([closed]))
    known = {"energy": closed} if timeless and not loads else {}
    known |= {key: reader.scalar(value, f"invariant {key}") for key, value in (invariants or {}).items()}
    stated = {
        key: (reader.closed(reader.column(column, group.dim, key)), reader.closed(derived))
        for key, column, derived in (("xi", xi, roots[: group.dim]), ("n", n, roots[group.dim :]))
        if column is not None
    }
    setting = Setting(
        *(name, title or name, group, LeftMultiplication(), state, reader.closed(open_roots)),
        *(None if loads else closed, known),
        *(_span(name, span), reader.parameters()),
        paired=True,
        parts={} if loads else {key: reader.closed((part,))[0] for key, part in summands.items()},
        signals=reader.signals,
        open_roots=open_roots,
        forced=bool(loads),
        stated=_stated(reader, group, flows or {}, summands),
    )
    _check(setting, stated)
    for key, flow in setting.stated.items():
        rates = velocity(group, qs, mus, setting.parts[key])
        check_flow(orbit_of(setting), key, flow.formulas, rates, TAU)
    return setting


def _check(setting: Setting, stated: Mapping[str, tuple[tuple[Expr, ...], tuple[Expr, ...] | None]]) -> None:
    """Raise :class:`SceneError` where the scene does not hold what it says (:mod:`codegen.consistency`)."""
    orbit = orbit_of(setting)
    check_start(orbit)
    for what, (formulas, derived) in stated.items():
        check_equal(orbit, formulas, what, derived)
    check_invariants(orbit, setting.invariants)


def _stated(
    reader: _Reader, group: Any, flows: Mapping[str, tuple[Any, Any]], summands: Mapping[str, Expr]
) -> dict[str, Stated]:
    """Read the flows that a scene states for its parts."""
    found: dict[str, Stated] = {}
    reader.more = (TAU,)
    for key, (q, mu) in flows.items():
        if key not in summands:
            known = ", ".join(summands) or "none: the scene names no parts"
            raise SceneError(f"a flow of {key!r}", where=reader.name, expected=f"that of a part: {known}")
        element = reader.column(q, group.size, f"q of the flow of {key}")
        found[key] = Stated((*element, *reader.column(mu, group.dim, f"mu of the flow of {key}")))
    reader.more = ()
    return found


def orbit_of(setting: Setting) -> Orbit:
    """Return the points of the scene at which formulas are compared."""
    view = setting.as_field()
    start = tuple(e for block in view.state for e in block.initial)
    return Orbit(
        *(view.name, view.group, view.action, view.symbols, start, view.roots, view.span, view.parameters)
    )


def _acts(reader: _Reader, group: Any, action: Any) -> None:
    """Raise :class:`SceneError` where the group acts on points of another number of coordinates."""
    domain = ExprDomain(reader.space)
    y = tuple(domain.space.sym(s) for s in reader.coordinates)
    zero = (domain.rational(0),) * group.dim
    try:
        width = len(action.velocity(domain, group, zero, y))
    except (ValueError, IndexError):  # a product of tuples of different lengths
        width = -1
    if width != len(y):
        raise SceneError(
            f"a point with {len(y)} coordinates",
            where=reader.name,
            expected=f"one that {group.name} acts on by {action.name}",
        )


def _span(name: str, span: tuple[Any, Any]) -> tuple[Fraction, Fraction]:
    import sympy

    try:
        first, last = (Fraction(int(r.p), int(r.q)) for r in map(sympy.Rational, span))
    except (TypeError, ValueError, AttributeError):
        raise SceneError(f"the span {span}", where=name, expected="two rational times") from None
    if not last > first:
        raise SceneError(f"the span ({first}, {last})", where=name, expected="an end after the beginning")
    return first, last


class _Reader:
    """Reads a scene's formulas into one space and remembers which parameters occur."""

    def __init__(self, name: str, coordinates: Sequence[Any]) -> None:
        self.name = name
        self.coordinates = [str(getattr(symbol, "name", "")) for symbol in coordinates]
        for symbol, spelled in zip(coordinates, self.coordinates, strict=True):
            if not spelled:
                raise SceneError(f"the coordinate {symbol}", where=name, expected="symbols")
            self._allowed(spelled)
        if len(set(self.coordinates)) != len(self.coordinates):
            raise SceneError("a coordinate symbol twice", where=name, expected="distinct symbols")
        self.more: tuple[str, ...] = ()
        self.space = Space()
        self.defaults: dict[str, Number] = {}
        self.signals: dict[str, Expr] = {}

    def _allowed(self, symbol: str) -> None:
        if symbol in RESERVED:
            raise SceneError(
                f"a symbol called {symbol}", where=self.name, expected="another name", hint=RESERVED[symbol]
            )
        if not NAME.fullmatch(symbol):
            raise SceneError(
                f"a symbol called {symbol!r}", where=self.name, expected="a letter, then letters, digits or _"
            )

    def parameters(self) -> dict[str, Number]:
        """Return the defaults of the parameters that occur, by name."""
        return dict(sorted(self.defaults.items()))

    def _admit(self, symbol: Any) -> None:
        """Note a parameter's default."""
        self._allowed(symbol.name)
        value = Number.rational(*symbol.default)
        if symbol.name in self.coordinates or self.defaults.setdefault(symbol.name, value) != value:
            raise SceneError(
                f"the parameter {symbol.name} has the name of a coordinate, or two defaults",
                where=self.name,
                expected="one meaning for each name",
            )

    def _admit_signal(self, symbol: Any) -> None:
        """Note a signal's formula, which holds the time and parameters and no coordinate."""
        self._allowed(symbol.name)
        what = f"signal {symbol.name}"
        for inner in getattr(symbol.formula, "free_symbols", ()):
            if inner.name != TIME and not hasattr(inner, "default"):
                raise SceneError(f"{what} holds {inner.name}", where=self.name, expected="t and parameters")
        formula = self.scalar(symbol.formula, what)
        taken = symbol.name in self.coordinates or symbol.name in self.defaults
        if taken or self.signals.setdefault(symbol.name, formula) is not formula:
            raise SceneError(
                f"the {what} has the name of another symbol, or two formulas",
                where=self.name,
                expected="one meaning for each name",
            )

    def closed(self, roots: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return formulas with every signal replaced by its own."""
        if not self.signals:
            return tuple(roots)
        names = {n.payload for n in walk(roots) if n.op == "sym"}
        values = {name: self.space.sym(name) for name in sorted(names)} | self.signals
        return tuple(evaluate(list(roots), ExprDomain(self.space), values))

    def scalar(self, formula: Any, what: str, constant: bool = False) -> Expr:
        """Return one formula; its symbols must be coordinates, t, parameters or signals."""
        if getattr(formula, "shape", None) == (1, 1):
            formula = formula[0]
        if hasattr(formula, "shape"):
            raise SceneError(f"{what} has shape {formula.shape}", where=self.name, expected="a scalar")
        root = read(self.space, formula, f"{self.name}, {what}")
        known = () if constant else (*self.coordinates, *self.more, TIME)
        for symbol in sorted(getattr(formula, "free_symbols", ()), key=lambda s: str(s.name)):
            if hasattr(symbol, "default"):
                self._admit(symbol)
            elif hasattr(symbol, "formula") and not constant:
                self._admit_signal(symbol)
            elif symbol.name not in known:
                raise SceneError(
                    f"the symbol {symbol.name} in {what} has no value",
                    where=self.name,
                    expected="numbers and parameters" if constant else "coordinates, t and parameters",
                    hint=f'write {symbol.name} = param("{symbol.name}", 1) to make it a parameter',
                )
        return root

    def column(self, formulas: Any, n: int, what: str, constant: bool = False) -> tuple[Expr, ...]:
        """Return n formulas."""
        entries = list(formulas)
        if len(entries) != n:
            raise SceneError(f"{what} has {len(entries)} components", where=self.name, expected=str(n))
        return tuple(self.scalar(e, f"{what}[{k}]", constant) for k, e in enumerate(entries))
