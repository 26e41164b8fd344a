"""The program verifier: types, single assignment, definition before use; run after every pass."""

from __future__ import annotations

from codegen.ir.program import EMBEDDED, Assign, Program, Solve
from codegen.ir.values import Var


class IllFormed(AssertionError):
    """A program that breaks a rule of :mod:`codegen.ir.program`: the compiler's fault, not the user's."""


def verify(program: Program) -> Program:
    """Return the program unchanged, or raise :class:`IllFormed` naming the first statement that is wrong."""
    defined: set[Var] = set()
    names: set[str] = set()

    def define(var: Var, at: str | Assign) -> None:
        if var.name in names:
            raise IllFormed(f"{program.name}: {var.name} is assigned twice, at {_place(at)}")
        names.add(var.name)
        defined.add(var)

    def use(var: Var, at: str | Assign) -> None:
        if var not in defined:
            what = f"{var.name}: {var.kind} is used before it is defined"
            raise IllFormed(f"{program.name}: {what}, at {_place(at)}")

    def check(assign: Assign) -> None:
        for arg in assign.args:
            use(arg, assign)
        _types(program.name, assign)
        for target in assign.targets:
            define(target, assign)

    for var in program.inputs:
        define(var, "the inputs")
    for statement in program.body:
        if isinstance(statement, Assign):
            check(statement)
        else:
            _shape(program.name, statement)
            for start in statement.starts:
                use(start, f"the starts of {statement.label}")
            for unknown in statement.unknowns:
                define(unknown, statement.label)
            for assign in statement.body:
                check(assign)
            for image in statement.images:
                use(image, f"the images of {statement.label}")
            for residual in statement.residuals:
                use(residual, f"the residuals of {statement.label}")
    inputs = {v.name: v.kind for v in program.inputs}
    for name, var in program.outputs:
        use(var, f"output {name}")
        if inputs.get("y" if name == EMBEDDED else name) != var.kind:
            raise IllFormed(f"{program.name}: output {name} replaces no input of kind {var.kind}")
    return program


def _place(at: str | Assign) -> str:
    """Spell where something is wrong; long numbers make that slow, so it is done for what is wrong alone."""
    return at.text() if isinstance(at, Assign) else at


def _shape(name: str, block: Solve) -> None:
    kinds = [tuple(v.kind for v in vs) for vs in (block.unknowns, block.starts, block.images)]
    if not block.unknowns or kinds[0] != kinds[1] or kinds[0] != kinds[2]:
        raise IllFormed(f"{name}: unknowns, starts and images of {block.label} differ in kind")
    if block.residuals and len(block.residuals) != len(block.unknowns):
        raise IllFormed(f"{name}: {block.label} has not a residual for each unknown")


def _types(name: str, assign: Assign) -> None:
    arguments, results = tuple(a.kind for a in assign.args), tuple(t.kind for t in assign.targets)
    if not assign.operation.accepts(arguments, results):
        raise IllFormed(f"{name}: wrong types in {assign.text()}")
