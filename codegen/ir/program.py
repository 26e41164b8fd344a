"""Step programs: one step of a method on a scene, in Lie group terms, before any coordinates.

Values have one of five kinds: ``Real``, ``Alg`` (the Lie algebra), ``Dual`` (its dual), ``Group`` and
``Point`` (the manifold acted on). A program is single assignment. Equations that depend on one another stand
in a :class:`Solve` block: its unknowns, the body computed from them, and the images that must equal them. A
method is lowered to *one* block holding all its stages; the passes find out what is sequential.

Not supported here: branches on data, loops other than blocks, more than one group in a program.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from fractions import Fraction
from itertools import zip_longest

from codegen.ir.number import Number


class Kind(StrEnum):
    """The type of a value."""

    REAL = "Real"
    ALG = "Alg"
    DUAL = "Dual"
    GROUP = "Group"
    POINT = "Point"


@dataclass(frozen=True)
class Var:
    """A named value; names are unique within a program."""

    name: str
    kind: Kind


@dataclass(frozen=True)
class Coefficient:
    """value * h**power."""

    value: Number
    power: int = 0

    @property
    def is_zero(self) -> bool:
        """Whether the number is provably zero."""
        return self.value.is_zero

    @property
    def is_one(self) -> bool:
        """Whether this is the constant 1, free of h."""
        return self.power == 0 and self.value.is_one

    def text(self) -> str:
        """Spell it: ``1/2 h``."""
        h = "" if self.power == 0 else " h" if self.power == 1 else f" h^{self.power}"
        return f"{self.value.text()}{h}"


ONE = Coefficient(Number.rational(1))

A, D, G, P, R = Kind.ALG, Kind.DUAL, Kind.GROUP, Kind.POINT, Kind.REAL

SIGNATURES: dict[str, tuple[tuple[Kind, ...], tuple[Kind, ...]]] = {
    "identity": ((), (G,)),
    "exp": ((A,), (G,)),
    "mulexp": ((G, A), (G,)),  # g exp(x), each row of its matrix on its own
    "mul": ((G, G), (G,)),  # the right factor acts first
    "act": ((G, P), (P,)),
    "actexp": ((A, P), (P,)),  # exp(x).y without forming exp(x)
    "Ad": ((G, A), (A,)),
    "Adinv": ((G, A), (A,)),  # Ad_{g^-1} x
    "Adt": ((G, D), (D,)),  # Ad*_g mu, the plain dual of Ad_g
    "Adtinv": ((G, D), (D,)),  # Ad*_{g^-1} mu
    "ad": ((A, A), (A,)),  # [x, y]
    "adt": ((A, D), (D,)),  # ad*_x mu
    "dexpinv": ((A, A), (A,)),  # sum over k <= order of B_k/k! ad_x^k y
    "dexpinvt": ((A, D), (D,)),  # sum over k <= order of B_k/k! (ad*_x)^k mu
    "P": ((A, A, D), (D,)),  # P*_(order)(x, y) mu: its pairing with z is mu's with d/dx dexpinv_x y along z
    "dexpt": ((A, D), (D,)),  # dexp*_x mu
    "advance": ((R,), (R,)),  # t + coefficient
    "field": ((P,), (A,)),  # f(y)
    "fieldt": ((P, R), (A,)),  # f(y, t)
    "hamilton": ((G, D), (A, D)),  # xi = D_2 H, n = -(D_1 H).q^-1
    "hamiltont": ((G, D, R), (A, D)),
    "energy": ((P,), (R,)),  # H(y)
    "differential": ((P,), (D,)),  # R*_y dH: its pairing with e is d/deps H(exp(eps e).y) at eps = 0
    "secant": ((D, A, R, R), (D,)),  # the covector nearest to g whose pairing with x is H1 - H0
    "bivector": ((P, D), (A,)),  # omega_y(alpha, .), f(y) where alpha is the differential of H
    # in the body frame (codegen.scene.body_frame): W and N of (q, P) with P = Ad*_q mu, and P of W
    "velocity": ((G, D), (A,)),
    "velocityt": ((G, D, R), (A,)),
    "force": ((G, D), (D,)),
    "forcet": ((G, D, R), (D,)),
    "legendre": ((A,), (D,)),
    # the product of a word's functions of ad_x, and of ad*_x
    "series": ((A, A), (A,)),
    "seriest": ((A, D), (D,)),
    "flow": ((G, D), (G, D)),  # the exact flow of a part, for a time coefficient
    "flowt": ((G, D, R), (G, D)),  # the same of a part that depends on t, which stands still
    "flowfor": ((G, D, R), (G, D)),  # the flow for a time that is a value
    "flowtfor": ((G, D, R, R), (G, D)),  # the same at a time t, the duration last
}
"""Argument and result kinds of every operation but ``lin`` and ``zero``, which are of any linear kind."""

CUT_OFF = frozenset({"dexpinv", "dexpinvt", "P"})
"""Operations with an ``order``, the number of brackets after which dexp^{-1} is cut off."""

FLOWS = frozenset({"flow", "flowt"})
"""Operations with a ``part``, and one coefficient: how long it flows."""

FLOWS_FOR = frozenset({"flowfor", "flowtfor"})
"""Operations with a ``part`` whose last argument says how long it flows."""

LINEAR_LAST = frozenset(
    {"Ad", "Adinv", "Adt", "Adtinv", "ad", "adt", "dexpinv", "dexpinvt", "P", "dexpt", "bivector"}
    | {"series", "seriest"}
)
"""Operations that are linear in their last argument."""


@dataclass(frozen=True, order=True)
class Factor:
    """phi(scale t)^power, where phi is exp, dexp = (e^t - 1)/t, or dexpinv cut off after t^order."""

    function: str
    scale: Fraction
    order: int = 0
    power: int = 1

    def text(self) -> str:
        """Spell it: ``exp(-t)``, ``1/dexpinv2(t)``."""
        scale = {"1": "", "-1": "-"}.get(str(self.scale), str(self.scale))
        order = str(self.order) if self.function == "dexpinv" else ""
        return f"{'1/' if self.power < 0 else ''}{self.function}{order}({scale}t)"


@dataclass(frozen=True)
class Operation:
    """What is done: a name of :data:`SIGNATURES`, ``lin`` (with coefficients) or ``zero``.

    ``coefficients`` belongs to ``lin`` (one an argument), ``advance`` and :data:`FLOWS` (one), ``order`` to
    :data:`CUT_OFF`, ``part`` to flows: which exact flow of the scene, ``word`` to ``series`` and ``seriest``.
    """

    name: str
    coefficients: tuple[Coefficient, ...] = ()
    order: int | None = None
    part: str = ""
    word: tuple[Factor, ...] = ()

    def text(self) -> str:
        """Spell it with its parameters."""
        if self.word:
            return f"{self.name}[{' '.join(factor.text() for factor in self.word)}]"
        if self.part:
            return f"{self.name}[{self.part}]"
        return self.name if self.order is None else f"{self.name}({self.order})"


@dataclass(frozen=True)
class Assign:
    """targets = operation(args)."""

    targets: tuple[Var, ...]
    operation: Operation
    args: tuple[Var, ...]

    def text(self) -> str:
        """Spell it for people."""
        left = ", ".join(t.name for t in self.targets)
        if self.operation.name == "lin":
            # The verifier spells wrong programs too: coefficients and arguments may differ in number.
            terms = zip_longest([f"({c.text()})" for c in self.operation.coefficients], self.args)
            return f"{left} = " + " + ".join(f"{c or '?'} {a.name if a else '?'}" for c, a in terms)
        extra = [c.text() for c in self.operation.coefficients]
        return f"{left} = {self.operation.text()}({', '.join([a.name for a in self.args] + extra)})"


@dataclass(frozen=True)
class Solve:
    """Find unknowns = images, where the body computes the images from the unknowns.

    Values of the body may be used after the block; they are those at the solution. ``starts`` are
    values of the same kinds, known before the block. ``residuals``, where there are any, are values that
    vanish together exactly where unknowns and images agree: one an unknown, of the same size.
    """

    label: str
    unknowns: tuple[Var, ...]
    starts: tuple[Var, ...]
    body: tuple[Assign, ...]
    images: tuple[Var, ...]
    residuals: tuple[Var, ...] = ()


Statement = Assign | Solve


EMBEDDED = "embedded"
"""The output of a program that is a second new state y, of lower order, for an estimate of the error."""


SPACE, BODY = "space", "body"
"""Whose momentum it is that a program's statements take and give."""


@dataclass(frozen=True)
class Substep:
    """A part of a step: it is ``fraction`` h long and begins at t + ``offset`` h."""

    fraction: Number
    offset: Number


@dataclass(frozen=True)
class Program:
    """One step: inputs, statements, and the new state, named as the inputs that it replaces.

    With ``substeps`` a step is the statements made for each of them, one after the other. In the ``frame``
    :data:`BODY` the statements take m = Ad*_q mu for mu and give the new m: a step begins with that, and
    ends with mu + Ad*_{q'^-1} m' - Ad*_{q^-1} m, where q', m' are the new q and m.
    """

    name: str
    inputs: tuple[Var, ...]
    body: tuple[Statement, ...]
    outputs: tuple[tuple[str, Var], ...]
    substeps: tuple[Substep, ...] = ()
    frame: str = SPACE

    def assigns(self) -> Iterator[Assign]:
        """Yield every assignment in order, those inside blocks included."""
        for statement in self.body:
            if isinstance(statement, Assign):
                yield statement
            else:
                yield from statement.body

    def counts(self) -> dict[str, int]:
        """Return how often each operation stands in the program (once for a block's sweep), sorted."""
        total: dict[str, int] = {}
        for assign in self.assigns():
            total[assign.operation.name] = total.get(assign.operation.name, 0) + 1
        return dict(sorted(total.items()))

    def text(self) -> str:
        """Spell the program, one statement a line."""
        lines = [f"{self.name}({', '.join(f'{v.name}: {v.kind}' for v in self.inputs)})"]
        lines += [f"  for h = ({step.fraction.text()}) h:" for step in self.substeps]
        lines += ["  with Adt(q, mu) for mu:"] if self.frame == BODY else []
        for statement in self.body:
            if isinstance(statement, Assign):
                lines.append("  " + statement.text())
                continue
            pairs = zip(statement.unknowns, statement.starts, strict=True)
            lines.append(
                f"  solve {statement.label}: " + ", ".join(f"{u.name} from {s.name}" for u, s in pairs)
            )
            lines += ["    " + assign.text() for assign in statement.body]
            equations = zip(statement.unknowns, statement.images, strict=True)
            lines.append("    until " + ", ".join(f"{u.name} = {v.name}" for u, v in equations))
        lines += [f"  {name}' = {var.name}" for name, var in self.outputs]
        return "\n".join(lines) + "\n"


@dataclass
class Builder:
    """Appends assignments with fresh names; used by lowerings and by passes that insert operations."""

    taken: set[str] = field(default_factory=set)
    body: list[Assign] = field(default_factory=list)

    def fresh(self, name: str, kind: Kind) -> Var:
        """Return a variable called name, or name with a number where that is taken."""
        candidate, n = name, 1
        while candidate in self.taken:
            n += 1
            candidate = f"{name}_{n}"
        self.taken.add(candidate)
        return Var(candidate, kind)

    def do(self, name: str, target: str, *args: Var, order: int | None = None) -> Var:
        """Append target = name(args) for an operation with one result."""
        (kind,) = SIGNATURES[name][1]
        var = self.fresh(target, kind)
        self.body.append(Assign((var,), Operation(name, order=order), args))
        return var

    def lin(self, target: str, kind: Kind, terms: list[tuple[Coefficient, Var]]) -> Var:
        """Append target = sum of coefficient * variable; an empty sum is ``zero``."""
        var = self.fresh(target, kind)
        terms = [(c, v) for c, v in terms if not c.is_zero]
        operation = Operation("lin", tuple(c for c, _ in terms)) if terms else Operation("zero")
        self.body.append(Assign((var,), operation, tuple(v for _, v in terms)))
        return var

    def advance(self, target: str, t: Var, coefficient: Coefficient) -> Var:
        """Append target = t + coefficient."""
        var = self.fresh(target, Kind.REAL)
        self.body.append(Assign((var,), Operation("advance", (coefficient,)), (t,)))
        return var

    def hamilton(self, xi: str, n: str, *args: Var) -> tuple[Var, Var]:
        """Append (xi, n) = hamilton(q, mu[, t])."""
        targets = (self.fresh(xi, Kind.ALG), self.fresh(n, Kind.DUAL))
        name = "hamilton" if len(args) == 2 else "hamiltont"
        self.body.append(Assign(targets, Operation(name), args))
        return targets

    def flow(self, part: str, q: Var, mu: Var, duration: Coefficient, *time: Var) -> tuple[Var, Var]:
        """Append (q, mu) = the exact flow of a part for a time ``duration``."""
        number = 1 + len(self.body)
        targets = (self.fresh(f"q{number}", Kind.GROUP), self.fresh(f"mu{number}", Kind.DUAL))
        operation = Operation("flowt" if time else "flow", (duration,), part=part)
        self.body.append(Assign(targets, operation, (q, mu, *time)))
        return targets

    def take(self) -> tuple[Assign, ...]:
        """Return the assignments appended so far and start anew, names staying taken."""
        body = tuple(self.body)
        self.body.clear()
        return body
