"""Rewrite a program with a rule. The rule keeps, replaces or removes each assignment of the program."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace

from codegen.ir.program import Assign, Builder, Program, Solve, Statement
from codegen.ir.values import Var


@dataclass
class Rewriter:
    """Applies a rule to every assignment of a program.

    ``rule(rewriter, assign)`` returns one variable for each target of the assignment. Later statements read
    these variables instead of the targets. To keep the assignment, a rule returns ``rewriter.emit(assign)``.
    """

    rule: Callable[[Rewriter, Assign], tuple[Var, ...]]
    program: Program
    names: dict[Var, Var] = field(default_factory=dict)
    definitions: dict[Var, Assign] = field(default_factory=dict)
    uses: dict[Var, int] = field(default_factory=dict)
    builder: Builder = field(default_factory=Builder)
    _out: list[Assign] = field(default_factory=list)

    def run(self) -> Program:
        """Return the rewritten program."""
        # ``uses`` maps each variable to the number of times that the old program reads the variable.
        self.uses = uses(self.program)
        # The name of a new variable must differ from all names in the program.
        self.builder.taken = {v.name for v in defined(self.program)}
        body = tuple(s for statement in self.program.body for s in self._statement(statement))
        outputs = tuple((name, self.now(var)) for name, var in self.program.outputs)
        return replace(self.program, body=body, outputs=outputs)

    def now(self, var: Var) -> Var:
        """Return the variable that replaces ``var``. If no variable replaces ``var``, return ``var``."""
        return self.names.get(var, var)

    def emit(self, assign: Assign) -> tuple[Var, ...]:
        """Append an assignment and return its targets."""
        self._out.append(assign)
        for target in assign.targets:
            self.definitions[target] = assign
        return assign.targets

    def _visit(self, assign: Assign) -> None:
        # A rule receives the assignment with the arguments already replaced.
        current = replace(assign, args=tuple(self.now(a) for a in assign.args))
        for old, new in zip(assign.targets, self.rule(self, current), strict=True):
            self.names[old] = new

    def _statement(self, statement: Statement) -> Iterable[Statement]:
        self._out = []
        if isinstance(statement, Assign):
            self._visit(statement)
            return self._out
        # Start values come from earlier statements, so they are renamed before the body is rewritten.
        starts = tuple(self.now(v) for v in statement.starts)
        for assign in statement.body:
            self._visit(assign)
        # The body computes the images and the residuals. Therefore the new names of images and residuals are
        # known only after the body is rewritten.
        images = tuple(self.now(v) for v in statement.images)
        residuals = tuple(self.now(v) for v in statement.residuals)
        body = tuple(self._out)
        return [replace(statement, starts=starts, body=body, images=images, residuals=residuals)]


def rewrite(program: Program, rule: Callable[[Rewriter, Assign], tuple[Var, ...]]) -> Program:
    """Return the program with a rule applied to every assignment in order."""
    return Rewriter(rule, program).run()


def defined(program: Program) -> Iterable[Var]:
    """Yield the inputs of a program, the unknowns of its blocks, and the targets of its assignments."""
    yield from program.inputs
    for statement in program.body:
        if isinstance(statement, Solve):
            yield from statement.unknowns
    for assign in program.assigns():
        yield from assign.targets


def uses(program: Program) -> dict[Var, int]:
    """Return how often each variable is read by assignments, blocks and outputs."""
    count: dict[Var, int] = {}

    def add(variables: Iterable[Var]) -> None:
        for v in variables:
            count[v] = count.get(v, 0) + 1

    for assign in program.assigns():
        add(assign.args)
    for statement in program.body:
        if isinstance(statement, Solve):
            add(statement.starts)
            add(statement.images)
            add(statement.residuals)
    add(var for _, var in program.outputs)
    return count
