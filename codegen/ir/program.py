"""Step programs: a step program describes one step of an integrator by a list of operations.

Each variable is assigned only once. Equations that depend on one another form a :class:`Solve` block
u = g(u). The statements of a program contain no branches.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from codegen.ir.number import Number
from codegen.ir.operations import (
    Act,
    Adjoint,
    Advance,
    Bracket,
    DualDexp,
    Exp,
    Identity,
    InverseDexp,
    Linear,
    Multiply,
    Operation,
    Zero,
)
from codegen.ir.scene_operations import Field, FlowOf, HamiltonianDerivatives
from codegen.ir.values import Coefficient, Kind, Var


@dataclass(frozen=True)
class Assign:
    """The statement ``targets = operation(args)``."""

    targets: tuple[Var, ...]
    operation: Operation
    args: tuple[Var, ...]

    @property
    def terms(self) -> tuple[tuple[Coefficient, Var], ...]:
        """The terms (coefficient, variable) of a linear combination, or () for any other operation."""
        if not isinstance(self.operation, Linear):
            return ()
        return tuple(zip(self.operation.coefficients, self.args, strict=True))

    # If ``is_multiple`` is true, compiler passes may replace L(c y) by c L(y) for a linear map L.
    @property
    def is_multiple(self) -> bool:
        """True if the operation is a linear combination with one term: a coefficient times a value."""
        return isinstance(self.operation, Linear) and len(self.args) == 1

    @classmethod
    def of_terms(cls, target: Var, terms: Iterable[tuple[Coefficient, Var]]) -> Assign:
        """Return the assignment target = sum of coefficient * variable over ``terms``."""
        pairs = tuple(terms)
        return cls((target,), Linear(tuple(c for c, _ in pairs)), tuple(v for _, v in pairs))

    def text(self) -> str:
        """Return the assignment as text, for example ``x = operation(a, b)``."""
        left = ", ".join(t.name for t in self.targets)
        return f"{left} = {self.operation.applied([a.name for a in self.args])}"


@dataclass(frozen=True)
class Solve:
    """A block: the system of equations u = g(u) for the unknowns u.

    - ``label`` is the name of the block in messages.
    - ``starts`` are the variables with the initial values of the unknowns.
    - ``body`` contains the statements that compute g(u).
    - ``images`` are the variables with the values g(u), one for each unknown.
    - ``residuals`` is empty, or contains one residual for each unknown. Each residual is an estimate of the
      error of its unknown.

    Statements after the block may use the variables that ``body`` assigns. The values of these variables are
    computed from the solution u.
    """

    label: str
    unknowns: tuple[Var, ...]
    starts: tuple[Var, ...]
    body: tuple[Assign, ...]
    images: tuple[Var, ...]
    # The stopping rule compares the size of each residual with the size of the corresponding unknown.
    residuals: tuple[Var, ...] = ()


Statement = Assign | Solve


EMBEDDED = "embedded"
"""The name of the output for the embedded solution.

The embedded solution is used only to estimate the error of the step.
"""


POWERS = "power"
"""The prefix of the output names ``power1``, ``power2``, ... of a continuous extension (dense output).

These outputs are the coefficients of theta, theta^2, ... in a polynomial sigma(theta) with values in the Lie
algebra. For a step of size h from the state y at the time t, exp(sigma(theta)) y approximates the solution at
the time t + theta h.
"""


SPACE, BODY = "space", "body"
"""The possible values of :attr:`Program.frame`: the space frame and the body frame."""


@dataclass(frozen=True)
class Substep:
    """One substep of a composition method. A step leads from the time t to t + h. The length of the substep
    is ``fraction`` * h, and the substep begins at the time t + ``offset`` * h.
    """

    fraction: Number
    offset: Number


@dataclass(frozen=True)
class Program:
    """One step of an integrator: its inputs, its statements, and its outputs.

    An output with the name of an input is the new value of this input. If ``substeps`` is not empty, the
    statements are executed once for each substep.

    If ``frame`` is :data:`BODY`, the statements use the body momentum m = Ad*_q mu in place of mu. Let q' and
    m' be the new values of q and m. In exact arithmetic, mu = Ad*_{q^-1} m, and the new value of mu is
    mu' = Ad*_{q'^-1} m'. Therefore mu' is also mu + (Ad*_{q'^-1} m' - Ad*_{q^-1} m). The program computes
    this sum, because the rounding errors of the two terms in parentheses are nearly equal and nearly cancel.
    """

    name: str
    inputs: tuple[Var, ...]
    body: tuple[Statement, ...]
    outputs: tuple[tuple[str, Var], ...]
    substeps: tuple[Substep, ...] = ()
    frame: str = SPACE

    def assigns(self) -> Iterator[Assign]:
        """Yield all assignments in the order of the statements, including the assignments inside blocks."""
        for statement in self.body:
            if isinstance(statement, Assign):
                yield statement
            else:
                yield from statement.body

    def counts(self) -> dict[str, int]:
        """Count how often each operation occurs in the program.

        The keys of the result are the names of the operations, in alphabetical order.
        """
        total: dict[str, int] = {}
        for assign in self.assigns():
            # The number of iterations of a block is unknown, so each assignment in a block is counted once.
            total[assign.operation.name] = total.get(assign.operation.name, 0) + 1
        return dict(sorted(total.items()))

    def text(self) -> str:
        """Return the program as text, with one statement on each line."""
        lines = [f"{self.name}({', '.join(f'{v.name}: {v.kind}' for v in self.inputs)})"]
        lines += [f"  in a substep of length ({step.fraction.text()}) h:" for step in self.substeps]
        # If ``self.frame`` is BODY, the name ``mu`` denotes the body momentum in all following lines.
        lines += ["  mu is replaced by the body momentum Ad*(q, mu):"] if self.frame == BODY else []
        for statement in self.body:
            if isinstance(statement, Assign):
                lines.append("  " + statement.text())
                continue
            # The text of a block has three parts: initial values, assignments, and the equations u = g(u).
            pairs = zip(statement.unknowns, statement.starts, strict=True)
            lines.append(
                f"  solve {statement.label}: " + ", ".join(f"{u.name} from {s.name}" for u, s in pairs)
            )
            lines += ["    " + assign.text() for assign in statement.body]
            # The iteration ends when these equations are satisfied.
            equations = zip(statement.unknowns, statement.images, strict=True)
            lines.append("    until " + ", ".join(f"{u.name} = {v.name}" for u, v in equations))
        lines += [f"  {name}' = {var.name}" for name, var in self.outputs]
        return "\n".join(lines) + "\n"


@dataclass
class Builder:
    """Builds a list of assignments.

    Each method for an operation, for example :meth:`exp`, appends an assignment and returns its variable.
    """

    taken: set[str] = field(default_factory=set)
    """The variable names that are in use."""
    body: list[Assign] = field(default_factory=list)
    """The assignments appended so far."""

    def fresh(self, name: str, kind: Kind) -> Var:
        """Return a new variable called ``name``, or ``name_2``, ``name_3``, ... if this name is in use."""
        candidate, n = name, 1
        while candidate in self.taken:
            n += 1
            candidate = f"{name}_{n}"
        # Each variable of a program is assigned only once, so this name must not be used again.
        self.taken.add(candidate)
        return Var(candidate, kind)

    def add(self, operation: Operation, target: str, *args: Var) -> Var:
        """Append target = operation(args) for an operation with one result."""
        # The new variable has the kind of the result.
        (kind,) = operation.signature()[1]
        var = self.fresh(target, kind)
        self.body.append(Assign((var,), operation, args))
        return var

    def identity(self, target: str) -> Var:
        """Append target = e, where e is the neutral element of the group."""
        return self.add(Identity(), target)

    def exp(self, target: str, x: Var) -> Var:
        """Append target = exp(x)."""
        return self.add(Exp(), target, x)

    def mul(self, target: str, g: Var, k: Var) -> Var:
        """Append target = g k."""
        return self.add(Multiply(), target, g, k)

    def act(self, target: str, g: Var, y: Var) -> Var:
        """Append target = g.y."""
        return self.add(Act(), target, g, y)

    def adjoint(self, target: str, g: Var, v: Var, *, inverse: bool = False) -> Var:
        """Append target = Ad_g v, or Ad*_g v if v is a covector. If ``inverse`` is true, g^-1 replaces g."""
        return self.add(Adjoint(v.kind is Kind.DUAL, inverse), target, g, v)

    def bracket(self, target: str, x: Var, v: Var) -> Var:
        """Append target = [x, v], or ad*_x v if v is a covector."""
        return self.add(Bracket(v.kind is Kind.DUAL), target, x, v)

    def dexpinv(self, target: str, x: Var, v: Var, order: int) -> Var:
        """Append target = dexp^{-1}_x v. The series in powers of ad_x is truncated after the power ``order``.

        If v is a covector, ad*_x replaces ad_x.
        """
        return self.add(InverseDexp(order, v.kind is Kind.DUAL), target, x, v)

    def dual_dexp(self, target: str, x: Var, mu: Var) -> Var:
        """Append target = dexp*_x mu, where dexp*_x is the transpose of dexp_x."""
        return self.add(DualDexp(), target, x, mu)

    def field_at(self, target: str, y: Var, *time: Var) -> Var:
        """Append target = f(y) for the vector field f. If a variable t is given as ``time``, append
        target = f(y, t).
        """
        return self.add(Field(bool(time)), target, y, *time)

    def lin(self, target: str, kind: Kind, terms: list[tuple[Coefficient, Var]]) -> Var:
        """Append target = sum of coefficient * variable over ``terms``. An empty sum is the zero vector."""
        var = self.fresh(target, kind)
        # Terms with the coefficient zero are omitted, because compiler passes assume that a sum depends on
        # each of its variables.
        terms = [(c, v) for c, v in terms if not c.is_zero]
        operation = Linear(tuple(c for c, _ in terms)) if terms else Zero(kind)
        self.body.append(Assign((var,), operation, tuple(v for _, v in terms)))
        return var

    def advance(self, target: str, t: Var, coefficient: Coefficient) -> Var:
        """Append target = t + c h, the time of a stage with node c. The product c h is ``coefficient``."""
        return self.add(Advance(coefficient), target, t)

    def hamilton(self, xi: str, n: str, q: Var, mu: Var, *time: Var) -> tuple[Var, Var]:
        """Append the evaluation of the derivatives xi and n of H(q, mu), or of H(q, mu, t).

        See :class:`HamiltonianDerivatives`.
        """
        # :meth:`add` is not used here, because this operation has two results.
        targets = (self.fresh(xi, Kind.ALG), self.fresh(n, Kind.DUAL))
        self.body.append(Assign(targets, HamiltonianDerivatives(bool(time)), (q, mu, *time)))
        return targets

    def flow(self, part: str, q: Var, mu: Var, duration: Coefficient, *time: Var) -> tuple[Var, Var]:
        """Append the exact flow of a term of the Hamiltonian, and return q and mu after the flow.

        ``part`` is the name of the term. If the term depends on time, ``time`` is the time t at which the
        term is evaluated.
        """
        # The variable names contain the position of this assignment in ``body``, for example q3 and mu3.
        number = 1 + len(self.body)
        targets = (self.fresh(f"q{number}", Kind.GROUP), self.fresh(f"mu{number}", Kind.DUAL))
        self.body.append(Assign(targets, FlowOf(part, duration, bool(time)), (q, mu, *time)))
        return targets

    def take(self) -> tuple[Assign, ...]:
        """Return the assignments appended so far, and clear the list."""
        body = tuple(self.body)
        # ``taken`` is not cleared: the names in the returned assignments must not be used again.
        self.body.clear()
        return body
