"""The program verifier. After every pass it checks types, single assignment, and definition before use."""

from __future__ import annotations

from codegen.ir.program import EMBEDDED, POWERS, Assign, Program, Solve
from codegen.ir.values import Kind, Var


class IllFormed(AssertionError):
    """The error for a program that breaks a rule of :mod:`codegen.ir.program`. The compiler is at fault."""


def verify(program: Program) -> Program:
    """Return the program unchanged. :class:`IllFormed` is raised with the first wrong statement."""
    _Verifier(program).run()
    return program


class _Verifier:
    """The check of one program, statement by statement in the order of execution."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.defined: set[Var] = set()
        self.names: set[str] = set()

    def run(self) -> None:
        """Check the whole program. :class:`IllFormed` is raised for the first broken rule."""
        # Inputs, body and outputs are checked in the order of execution.
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
            # Coefficients of a continuous extension replace no input.
            if name.startswith(POWERS) and var.kind is Kind.ALG:
                continue
            # The embedded solution has another name than the input y, but the same kind.
            if inputs.get("y" if name == EMBEDDED else name) != var.kind:
                raise IllFormed(f"{self.program.name}: output {name} replaces no input of kind {var.kind}")

    def define(self, var: Var, at: str | Assign) -> None:
        """Record a definition. :class:`IllFormed` is raised if the name is already defined."""
        # Two variables with the same name would have the same identifier in emitted code.
        if var.name in self.names:
            raise IllFormed(f"{self.program.name}: {var.name} is assigned twice, at {_place(at)}")
        self.names.add(var.name)
        self.defined.add(var)

    def use(self, var: Var, at: str | Assign) -> None:
        """Raise :class:`IllFormed` if a value is not defined yet."""
        if var not in self.defined:
            what = f"{var.name}: {var.kind} is used before it is defined"
            raise IllFormed(f"{self.program.name}: {what}, at {_place(at)}")

    def assign(self, assign: Assign) -> None:
        """Check one assignment."""
        for arg in assign.args:
            self.use(arg, assign)
        # The targets are defined last, because an assignment cannot read its own result.
        _types(self.program.name, assign)
        for target in assign.targets:
            self.define(target, assign)

    def block(self, block: Solve) -> None:
        """Check one block of equations. Its body may read the unknowns of the block."""
        # Start k and image k belong to unknown k.
        _shape(self.program.name, block)
        for start in block.starts:
            self.use(start, f"the starts of {block.label}")
        # The unknowns are defined after the check of the starts, because a start must not be an unknown.
        for unknown in block.unknowns:
            self.define(unknown, block.label)
        for assign in block.body:
            self.assign(assign)
        # The body defines the images and the residuals.
        for image in block.images:
            self.use(image, f"the images of {block.label}")
        for residual in block.residuals:
            self.use(residual, f"the residuals of {block.label}")


def _place(at: str | Assign) -> str:
    """Return the text of the statement that breaks a rule."""
    return at.text() if isinstance(at, Assign) else at


def _shape(name: str, block: Solve) -> None:
    kinds = [tuple(v.kind for v in vs) for vs in (block.unknowns, block.starts, block.images)]
    if not block.unknowns or kinds[0] != kinds[1] or kinds[0] != kinds[2]:
        raise IllFormed(f"{name}: {block.label} has no unknowns, or its starts or images differ in kind")
    if block.residuals and len(block.residuals) != len(block.unknowns):
        raise IllFormed(f"{name}: {block.label} needs one residual for each unknown")


def _types(name: str, assign: Assign) -> None:
    arguments, results = tuple(a.kind for a in assign.args), tuple(t.kind for t in assign.targets)
    if not assign.operation.accepts(arguments, results):
        raise IllFormed(f"{name}: wrong types of arguments or results in {assign.text()}")
