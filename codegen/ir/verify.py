"""The verifier of step programs (:mod:`codegen.ir.program`). After every compiler pass it checks that

- the arguments and results of each operation have the right kinds (spaces such as the algebra or the group),
- each variable is assigned only once, and
- each variable is assigned before it is used.
"""

from __future__ import annotations

from codegen.ir.program import EMBEDDED, POWERS, Assign, Program, Solve
from codegen.ir.values import Kind, Var


class IllFormed(AssertionError):
    """Raised for a step program that breaks a rule of :mod:`codegen.ir.program`. Such a program is always the
    result of an error in the compiler.
    """


def verify(program: Program) -> Program:
    """Return the program unchanged. If a statement is wrong, :class:`IllFormed` is raised, and its message
    names the first wrong statement.
    """
    _Verifier(program).run()
    return program


class _Verifier:
    """Checks one program, statement by statement in the order of execution."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.defined: set[Var] = set()
        self.names: set[str] = set()

    def run(self) -> None:
        """Check the whole program. :class:`IllFormed` is raised for the first broken rule."""
        # Before each statement, ``self.defined`` contains exactly the variables that already have values.
        for var in self.program.inputs:
            self.define(var, "the inputs")
        for statement in self.program.body:
            if isinstance(statement, Assign):
                self.assign(statement)
            else:
                self.block(statement)
        inputs = {v.name: v.kind for v in self.program.inputs}
        for name, var in self.program.outputs:
            self.use(var, f"output {name}")
            # The coefficients of a continuous extension (dense output) are outputs without a corresponding
            # input.
            if name.startswith(POWERS) and var.kind is Kind.ALG:
                continue
            # The embedded solution must have the same kind as the input ``y``.
            if inputs.get("y" if name == EMBEDDED else name) != var.kind:
                raise IllFormed(
                    f"{self.program.name}: the output {name} requires an input of kind {var.kind}; "
                    "this input must have the name of the output, or the name y if the output is the "
                    "embedded solution"
                )

    def define(self, var: Var, at: str | Assign) -> None:
        """Record that the statement ``at`` assigns ``var``. Raise :class:`IllFormed` if an earlier variable
        has the same name.
        """
        # Two variables with the same name would have the same identifier in emitted code.
        if var.name in self.names:
            raise IllFormed(f"{self.program.name}: {var.name} is assigned twice, at {_place(at)}")
        self.names.add(var.name)
        self.defined.add(var)

    def use(self, var: Var, at: str | Assign) -> None:
        """Raise :class:`IllFormed` if ``var`` has no value yet. ``at`` is the statement that reads it."""
        if var not in self.defined:
            what = f"the variable {var.name} of kind {var.kind} is used before it is defined"
            raise IllFormed(f"{self.program.name}: {what}, at {_place(at)}")

    def assign(self, assign: Assign) -> None:
        """Check one assignment: the arguments must have values, the operation must accept the kinds, and the
        targets must not have values yet.
        """
        for arg in assign.args:
            self.use(arg, assign)
        # An assignment must not read its own target.
        _types(self.program.name, assign)
        for target in assign.targets:
            self.define(target, assign)

    def block(self, block: Solve) -> None:
        """Check the block u = g(u). The statements that compute g(u) may read the unknowns u."""
        # Each unknown needs an initial value and a new value of the same kind.
        _shape(self.program.name, block)
        for start in block.starts:
            self.use(start, f"the starts of {block.label}")
        # The initial values are tested first, because they must not depend on the unknowns.
        for unknown in block.unknowns:
            self.define(unknown, block.label)
        for assign in block.body:
            self.assign(assign)
        # The statements in ``block.body`` assign the images g(u) and the residuals.
        for image in block.images:
            self.use(image, f"the images of {block.label}")
        for residual in block.residuals:
            self.use(residual, f"the residuals of {block.label}")


def _place(at: str | Assign) -> str:
    """Return the text that describes ``at`` in a message."""
    return at.text() if isinstance(at, Assign) else at


def _shape(name: str, block: Solve) -> None:
    kinds = [tuple(v.kind for v in vs) for vs in (block.unknowns, block.starts, block.images)]
    if not block.unknowns or kinds[0] != kinds[1] or kinds[0] != kinds[2]:
        raise IllFormed(
            f"{name}: {block.label} needs unknowns. Each unknown needs an initial value (start) and a new "
            "value (image) of the same kind"
        )
    if block.residuals and len(block.residuals) != len(block.unknowns):
        raise IllFormed(f"{name}: {block.label} needs one residual for each unknown, or no residuals")


def _types(name: str, assign: Assign) -> None:
    arguments, results = tuple(a.kind for a in assign.args), tuple(t.kind for t in assign.targets)
    if not assign.operation.accepts(arguments, results):
        raise IllFormed(f"{name}: wrong kinds of arguments or results in {assign.text()}")
