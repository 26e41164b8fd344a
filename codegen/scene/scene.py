"""Scenes, as a user writes them: group, action, a field or a Hamiltonian, parameters, start and span."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from codegen.errors import SceneError
from codegen.flows.flow import TAU, Stated
from codegen.groups.actions import LeftMultiplication
from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, walk
from codegen.ir.number import is_normal
from codegen.ir.program import Kind
from codegen.scene.canonical_equations import force, velocity
from codegen.scene.consistency import check_flow
from codegen.scene.formulas import Reader
from codegen.scene.problem import TIME, Problem, StateField, check_problem, orbit_of


def param(name: str, default: Any) -> Any:
    """Return a sympy symbol for a parameter with a rational default.

    The default is folded into emitted code unless the parameter is asked for at run time.
    :class:`SceneError` for a default that is not rational.
    """
    import sympy

    from codegen.scene.parameters import Parameter

    try:
        value = sympy.Rational(default)
    except TypeError:
        value = None
    if value is None or not value.is_Rational:
        raise SceneError(f"the default {default}", where=f"parameter {name}", expected="a rational number")
    if not is_normal(Fraction(int(value.p), int(value.q))):
        raise SceneError(
            f"the default {sympy.N(value, 3)}",
            where=f"parameter {name}",
            expected="0, or between 1e-307 and 1e308 in size",
        )
    return Parameter(name, int(value.p), int(value.q))


def signal(name: str, formula: Any = 0) -> Any:
    """Return a sympy symbol for a function of time: a control, a measured load.

    It is folded into emitted code as its ``formula``, in t and parameters, unless it is asked for as a
    run-time input (``emit --input NAME``). :class:`SceneError` for a formula that is none.
    """
    import sympy

    from codegen.scene.parameters import Signal

    try:
        return Signal(name, sympy.sympify(formula, strict=True))
    except sympy.SympifyError:
        raise SceneError(
            f"the formula {formula!r}", where=f"signal {name}", expected="a sympy formula in t"
        ) from None


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
) -> Problem:
    """Return the scene y' = f(y).y for a group acting on a manifold.

    ``y`` is a sympy column of coordinate symbols, ``f`` a column of ``group.dim`` components in them, in
    the symbol ``t`` and parameters, ``y0`` the exact initial point, ``span`` the rational time interval,
    ``invariants`` a mapping from names to scalar formulas. ``velocity``, where it is given, is y' as an
    ambient formula; f must generate it. :class:`SceneError` for a wrong shape or symbol, a start that is not
    on the group, an f that does not generate the velocity, an invariant that is none.
    """
    _made(name, "group", group, "dim", "SO3()")
    _made(name, "action", action, "velocity", "Rotation()")
    reader = Reader(name, list(y))
    _acts(reader, group, action)
    open_roots = reader.column(f, group.dim, "f")
    roots = reader.closed(open_roots)
    start = reader.column(y0, len(y), "y0", constant=True)
    state = (StateField("y", Kind.POINT, tuple(reader.coordinates), start),)
    known = {key: reader.scalar(value, f"invariant {key}") for key, value in (invariants or {}).items()}
    stated = () if velocity is None else reader.closed(reader.column(velocity, len(y), "velocity"))
    problem = Problem(
        *(name, title or name, group, action, state, roots, None, known, _span(name, span)),
        reader.parameters(),
        signals=reader.signals,
        open_roots=open_roots,
    )
    check_problem(problem, {"velocity": (stated, None)} if stated else {})
    return problem


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
) -> Problem:
    """Return the scene of a right-trivialised Hamiltonian H(q, mu) on T*G.

    ``q`` and ``mu`` are sympy matrices of symbols (``group.point``, ``group.dual``), ``q0`` and ``mu0`` exact
    initial values, ``parts`` named summands of H, ``flows`` the exact flows of those that the compiler does
    not recognise, as formulas (q, mu) after the time ``Symbol("tau")``. xi = D_2 H and n = -(D_1 H).q^-1
    (:mod:`codegen.scene.canonical_equations`) are found by differentiation; where ``xi`` or ``n``
    is given by hand it must agree. ``wrench``, where it is given, is a column of ``group.dim`` components
    that no H has:
    mu' = n + wrench - ad*_xi mu, in the same trivialisation (space); n given by hand is without it. Such a
    scene has no energy and no parts. The energy is an invariant of a Hamiltonian without time.
    :class:`SceneError` as for :func:`FieldScene`.
    """
    _made(name, "group", group, "dim", "SO3()")
    reader = Reader(name, [*q, *mu])
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
    problem = Problem(
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
    check_problem(problem, stated)
    for key, flow in problem.stated.items():
        rates = velocity(group, qs, mus, problem.parts[key])
        check_flow(orbit_of(problem), key, flow.formulas, rates, TAU)
    return problem


def _stated(
    reader: Reader, group: Any, flows: Mapping[str, tuple[Any, Any]], summands: Mapping[str, Expr]
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


def _made(name: str, what: str, value: Any, has: str, example: str) -> None:
    """Raise :class:`SceneError` for what is no group or action, as a name, or a class that is not called."""
    if isinstance(value, type) or not hasattr(value, has):
        found = value.__name__ if isinstance(value, type) else repr(value)
        raise SceneError(f"the {what} {found}", where=name, expected=f"one of codegen.groups, as {example}")


def _acts(reader: Reader, group: Any, action: Any) -> None:
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
