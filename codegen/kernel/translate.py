"""Translates a step program to a kernel, which consists of scalar assignments and loops.

The program is executed symbolically, so every value becomes a tuple of expressions. Equal expressions share
one node. A block of implicit equations becomes a loop (:mod:`codegen.kernel.equations`). Expressions become
assignments (:mod:`codegen.kernel.assignments`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from codegen.errors import SceneError
from codegen.ir.collect_constants import gathered
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.interpret import flatten
from codegen.ir.kernel import (
    ELAPSED,
    FIXED_POINT,
    LEAD,
    NEWTON,
    VARIATION,
    VARIED,
    Estimate,
    Field,
    Function,
    Kernel,
    Let,
    Loop,
    Sample,
    Start,
)
from codegen.ir.program import EMBEDDED, Assign, Program, Solve
from codegen.ir.scene_operations import BodyForce
from codegen.ir.tangent import tangents
from codegen.ir.values import Kind, Var
from codegen.kernel import critical_path
from codegen.kernel.assignments import Assignments
from codegen.kernel.carried_momentum import Frames, State
from codegen.kernel.equations import Block, Solved, compared, with_matrix
from codegen.kernel.outlining import LONG, LONG_EXPLICIT, WORTH, Outline
from codegen.kernel.shared_angles import SharedArguments
from codegen.kernel.variations import Variations
from codegen.passes.series_sums import SeriesSums
from codegen.scene.problem import TIME, Problem

AS_WRITTEN, COMBINED, ORDERED, SHORTENED = range(4)
"""Four ways to treat the critical path, which is the longest chain of dependent operations.

- AS_WRITTEN leaves the operations unchanged.
- COMBINED groups the factors that are constant in a run, such as the step size.
- ORDERED sorts the assignments by the estimated time at which each value is available.
- SHORTENED includes COMBINED and ORDERED, and rewrites the longest chains
  (:mod:`codegen.kernel.critical_path`).
"""


def to_kernel(
    program: Program,
    scene: Problem,
    solvers: Mapping[str, str] = MappingProxyType({}),
    variations: Variations | None = None,
    chains: int = AS_WRITTEN,
    whole: bool = False,
    outlining: bool = True,
) -> Kernel:
    """Return the kernel of a program. ``scene`` is the problem of the program
    (:func:`codegen.lower.problem_for`).

    - ``solvers`` maps labels of blocks of implicit equations to :data:`codegen.ir.kernel.NEWTON` or
      SIMPLIFIED_NEWTON. All other blocks are solved by fixed-point iteration.
    - If ``variations`` is given, the kernel also propagates a variation of the state (``Kernel.vary``).
    - ``chains`` is the treatment of the critical path. Values other than :data:`AS_WRITTEN` require a program
      without implicit equations.
    - ``whole`` is used if only the program stores the momentum in the body frame. If ``whole`` is true, each
      step transforms the momentum. Otherwise a run transforms the momentum at the beginning and at the end
      (:mod:`codegen.kernel.carried_momentum`).
    - If ``outlining`` is true, repeated computations of a long step become functions
      (:mod:`codegen.kernel.outlining`).

    :class:`codegen.errors.SceneError` is raised if an operation of the group has no closed form.
    :class:`codegen.ir.differentiate.NotDifferentiable` is raised if a derivative in the matrix of Newton's
    method does not exist. ZeroDivisionError is raised if this matrix must be expanded in h, but the equations
    have no value at h = 0.
    """
    return _Translation(program, scene, solvers, variations, chains, whole, outlining).kernel()


class _Translation:
    """The symbolic execution of a program.

    - ``env`` maps each variable of the program to its value, which consists of expressions.
    - ``hints`` maps the ids of expressions to preferred names in emitted code.
    - ``taken`` contains all names that emitted code uses already.
    """

    def __init__(
        self,
        program: Program,
        scene: Problem,
        solvers: Mapping[str, str],
        variations: Variations | None,
        chains: int,
        whole: bool,
        outlining: bool,
    ) -> None:
        self.program, self.scene, self.solvers = program, scene, solvers
        self.variations, self.chains, self.outlining = variations, chains, outlining
        # The domain represents equal expressions by one node.
        self.domain = SharedArguments()
        self.env: dict[Var, Any] = {}
        self.hints: dict[int, str] = {}
        self.blocks: list[Block] = []
        # Generated names must differ from these names.
        self.taken = {*scene.symbols, *scene.runtime, *scene.inputs, "h", TIME, LEAD, ELAPSED}
        # ``inside`` is true during the execution of a block of equations.
        self.outline, self.inside = Outline(program, scene, self.domain), False
        self.sums = SeriesSums(program, scene)
        # With variations, the kernel computes the Jacobian in the coordinates of the emitted code. Therefore
        # each step must convert the momentum.
        self.frames = Frames(scene, program, whole or variations is not None)

    def name(self, base: str) -> str:
        """Return a new name, and add it to ``taken``. The name is ``base`` if possible."""
        candidate = base if base not in self.taken else base + "_"
        # An appended number would look like an index, because xi1_2 denotes component 2 of xi1.
        while candidate in self.taken:
            candidate += "_"
        self.taken.add(candidate)
        return candidate

    def remember(self, var: Var) -> None:
        """Name the expressions of a variable after the variable."""
        for k, x in enumerate(flatten(var.kind, self.env[var])):
            # An expression that already has a name keeps this name.
            self.hints.setdefault(x.id, f"{var.name}_{k}" if var.kind is not Kind.REAL else var.name)

    def run(self, assign: Assign) -> None:
        """Execute an assignment symbolically, and record the assignment for outlining."""
        scene, domain = self.scene, self.domain
        args = tuple(self.env[a] for a in assign.args)
        try:
            # ``nested`` is the value in nested form (:mod:`codegen.passes.series_sums`), or None if nesting
            # saves nothing.
            nested = self.sums.value(domain, assign, self.env)
            results = (nested,) if nested is not None else assign.operation.evaluate(scene, domain, args)
        except ArithmeticError as error:
            raise SceneError(
                f"{assign.operation.name} on {scene.group.name}: {error}",
                where=scene.name,
                expected="a group whose operations have closed forms",
                hint="write the closed forms in the class of the group; without them the group has exact "
                "power series, but no emitted code",
            ) from error
        if isinstance(assign.operation, BodyForce):
            # ``gathered`` combines the constants of the results. The arguments remain unchanged, so that
            # other expressions can share the arguments.
            known = [x for v in assign.args for x in flatten(v.kind, self.env[v])]
            results = tuple(gathered(x, known) for x in results)
        # The results of an operation with a time argument may depend on run-time inputs. Such an operation is
        # not outlined, because an outlined function reads only its arguments.
        reads = bool(scene.inputs) and any(v.kind is Kind.REAL for v in assign.args)
        # The current block is not in the list yet, so its index is the length of the list.
        place = len(self.blocks) if self.inside else -1
        self.outline.trees.note(assign, args, results, place, joined=nested is None and not reads)
        for target, value in zip(assign.targets, results, strict=True):
            self.env[target] = value
            self.remember(target)

    def begin(self) -> State:
        """Set the values of the program's inputs to symbols, and return the initial state."""
        space = self.domain.space
        # All following statements read the transformed momentum.
        given = start = self.frames.begin(self.domain, tuple(map(space.sym, self.scene.symbols)))
        starts: dict[str, State] = {}
        for block in self.scene.state:
            # ``given`` contains the coordinates of this block, and then the coordinates of the next blocks.
            starts[block.name], given = given[: len(block.symbols)], given[len(block.symbols) :]
        for var in self.program.inputs:
            self.env[var] = starts[var.name] if var.name in starts else space.sym(var.name)
        return start

    def solve(self, statement: Solve) -> None:
        """Execute the body of a block of equations, and add the block to ``blocks``."""
        # While ``inside`` is true, ``run`` records assignments as part of this block. Outlining never joins
        # them with assignments outside the block.
        self.inside = True
        entered = self.enter(statement)
        self.inside = False
        solver = self.solvers.get(statement.label, FIXED_POINT)
        residuals = None
        # With variations, :func:`_varied` needs the images g(u) of the equations u = g(u). Without
        # variations, Newton's method can use residuals in place of the images.
        if solver == NEWTON and self.variations is None:
            residuals = compared(statement, entered, self.env, self.name, self.program)
        # :func:`compared` has added Newton's matrix to a block with residuals.
        if residuals is not None:
            entered = residuals
        elif solver != FIXED_POINT:
            entered = with_matrix(entered, solver)
            # After Newton's method the unknowns are more accurate than the last images, so later statements
            # read the unknowns.
            solved = Solved(entered)
            for var in self.env:
                self.env[var] = solved.value(self.env[var])
                self.remember(var)
        # ``run`` requires that ``blocks`` does not yet contain the current block.
        self.blocks.append(entered)

    def enter(self, block: Solve) -> Block:
        """Set the unknowns to symbols, execute the body, and return the block."""
        names: list[str] = []
        starts: list[Expr] = []
        for unknown, start in zip(block.unknowns, block.starts, strict=True):
            width = len(flatten(start.kind, self.env[start]))
            # An unknown has as many components as its starting value.
            own = [self.name(f"{unknown.name}_{k}") for k in range(width)]
            symbols = tuple(self.domain.space.sym(s) for s in own)
            self.env[unknown] = symbols if unknown.kind is not Kind.REAL else symbols[0]
            names += own
            starts += flatten(start.kind, self.env[start])
        for assign in block.body:
            self.run(assign)
        images = [x for v in block.images for x in flatten(v.kind, self.env[v])]
        return Block(block.label, tuple(names), tuple(starts), tuple(images))

    def ended(self, start: State) -> tuple[State, State]:
        """Return the new state, and the new state of the embedded method.

        All statements of the program must be executed before this call. If the program computes no embedded
        solution, the second state is ().
        """
        state = tuple(map(self.domain.space.sym, self.scene.symbols))
        ends = []
        # The error estimate is the new state minus the embedded solution. Therefore both states must be in
        # the same frame.
        for embedded in (False, True):
            # Without an embedded solution, no output has the name EMBEDDED. Then ``values`` is empty.
            parts = (v for n, v in self.program.outputs if (n == EMBEDDED) is embedded)
            values = tuple(x for v in parts for x in flatten(v.kind, self.env[v]))
            ends.append(self.frames.end(self.domain, state, start, values))
        outputs, lower = ends
        # The critical path is shortened before expressions are split into assignments.
        if self.chains in (COMBINED, SHORTENED):
            # These symbols are constant in a run, so a compiler moves their products out of the loop over the
            # steps.
            constant = frozenset({"h", LEAD, ELAPSED, *self.scene.runtime})
            outputs = critical_path.run(outputs, constant, spread=self.chains == SHORTENED)
        return outputs, lower

    def varied(self, variations: Variations, outputs: State) -> State:
        """Return the variation of the new state.

        The equations for the variations of all unknowns are added to ``blocks``.
        """
        space, seeds = self.domain.space, variations.seeds(self.domain)
        # The equations for the variations contain the solution of the block. Therefore the block comes first.
        both = (b for block in self.blocks for b in (block, _varied(block, seeds, space, self.name)))
        self.blocks = list(both)
        return variations.ends(self.domain, outputs, tangents(outputs, seeds))

    def kernel(self) -> Kernel:
        """Execute all statements of the program, and return its kernel."""
        start = self.begin()
        for statement in self.program.body:
            if isinstance(statement, Assign):
                self.run(statement)
            else:
                self.solve(statement)
        outputs, lower = self.ended(start)
        fields = self.frames.fields()
        if self.variations is not None:
            # The kernel for a Jacobian contains no error estimate.
            outputs, lower = self.varied(self.variations, outputs), ()
            fields = (*fields, Field(VARIATION, self.variations.names, self.variations.text()))
        # The error estimate is the new state minus the new state of the embedded method.
        errors = tuple(x - y for x, y in zip(outputs, lower, strict=True)) if lower else ()
        # Outputs and error estimates are ordered together, so that they can share assignments.
        body, ends, outlined = self.ordered((*outputs, *errors))
        # LEAD is the duration of the last flow of a step. ELAPSED is the duration of a single step or of a
        # whole run.
        durations = [v.name for v in self.program.inputs if v.name in (LEAD, ELAPSED)]
        kernel = Kernel(
            *(self.program.name, fields, (TIME, "h", *self.scene.runtime, *durations)),
            *(body, ends[: len(outputs)]),
            substeps=self.program.substeps,
            outlined=outlined,
            carried=self.frames.carried(self.domain),
        )
        if errors:
            kernel = replace(kernel, estimate=Estimate(ends[len(outputs) :], 0))
        return _sampled(kernel, self.scene, self.domain)

    def ordered(self, ends: State) -> tuple[tuple[Let | Start | Loop, ...], State, tuple[Function, ...]]:
        """Return the body, the outputs and the outlined functions of the kernel.

        Repeated computations become functions if this makes the code much shorter.
        """
        # Outlining replaces ``schedule``. The names in ``schedule`` are then free, but the names in
        # ``before`` are not.
        before = frozenset(self.taken)
        schedule = Assignments(self.blocks, ends, self.hints, self.name, self.variations is None)
        body = schedule.run()
        outlined: tuple[Function, ...] = ()
        # The number of assignments is a measure of the code size. Only long code is outlined.
        long = _count(body) > (LONG if self.blocks else LONG_EXPLICIT)
        # Outlining searches the expressions for the results of operations. COMBINED and SHORTENED rewrite
        # these results, so outlining would find nothing.
        if long and self.outlining and self.variations is None and self.chains in (AS_WRITTEN, ORDERED):
            self.taken.clear()
            self.taken.update(before)
            shorter, functions = _outlined(self.outline, self.blocks, ends, self.hints, self.name)
            if shorter is not None and _count(shorter.body) + _count(functions) < WORTH * _count(body):
                schedule, body, outlined = shorter, tuple(shorter.body), functions
        # Outlining may change the assignments, so they are sorted after outlining.
        if self.chains in (ORDERED, SHORTENED):
            body = critical_path.ordered([let for let in body if isinstance(let, Let)])
        return body, schedule.outputs, outlined


def _count(body: Iterable[Let | Start | Loop | Function]) -> int:
    """Return the number of assignments, including the assignments in loops and in functions."""
    total = 0
    for statement in body:
        if isinstance(statement, Let):
            total += 1
            continue
        total += len(statement.body)
        # A loop of Newton's method also computes Newton's matrix.
        if isinstance(statement, Loop) and statement.newton is not None:
            total += len(statement.newton.body)
    return total


def _outlined(
    outline: Outline,
    blocks: Sequence[Block],
    roots: Sequence[Expr],
    hints: dict[int, str],
    name: Callable[[str], str],
) -> tuple[Assignments | None, tuple[Function, ...]]:
    """Return a schedule that calls outlined functions, and the list of these functions.

    The schedule is None if no computation is repeated.
    """
    flat = list(roots)
    for block in blocks:
        flat += [*block.starts, *block.images, *(x for row in block.matrix for x in row)]
    # Outlining must not create functions for unused values. Therefore a value in ``kept`` is removed if no
    # expression in ``flat`` reads the value.
    read = {n.payload for n in walk(flat) if n.op == "sym"}
    blocks = [replace(b, kept=tuple(pair for pair in b.kept if pair[0] in read)) for b in blocks]
    # The expressions of all blocks are in one list. Therefore outlining also finds computations that are
    # repeated in different blocks.
    flat += [x for block in blocks for _, x in block.kept]
    owners = {u: k for k, block in enumerate(blocks) for u in block.unknowns}
    shorter = outline.run(flat, owners)
    if shorter is None:
        return None, ()
    # ``shorter`` contains the rewritten expressions in the order of ``flat``. ``take(n)`` returns the next n.
    new = iter(shorter)

    def take(n: int) -> tuple[Expr, ...]:
        return tuple(next(new) for _ in range(n))

    ends = take(len(roots))
    changed = []
    for block in blocks:
        starts, images = take(len(block.starts)), take(len(block.images))
        matrix = tuple(take(len(row)) for row in block.matrix)
        changed.append(replace(block, starts=starts, images=images, matrix=matrix))
    changed = [replace(b, kept=tuple((key, next(new)) for key, _ in b.kept)) for b in changed]
    for old, rewritten in zip(flat, shorter, strict=True):
        if old.id in hints:
            # Rewritten expressions keep the names of the old expressions.
            hints.setdefault(rewritten.id, hints[old.id])
    schedule = Assignments(changed, ends, hints, name)
    schedule.run()
    functions = []
    for function in outline.outlined:
        # An outlined function contains no implicit equations, so its schedule has no blocks.
        own = Assignments((), function.outputs, {}, name)
        lets = own.run()
        functions.append(
            replace(function, body=tuple(x for x in lets if isinstance(x, Let)), outputs=own.outputs)
        )
    return schedule, tuple(functions)


def _varied(block: Block, seeds: dict[str, Expr], space: Space, name: Callable[[str], str]) -> Block:
    """Return the linear equations for the variations of a block's unknowns.

    The symbols of these variations are added to ``seeds``.
    """
    # The derivative of u = g(u) is an equation for the variation du of u. The variations of the old state and
    # of the unknowns of earlier blocks are known when this equation is solved.
    own = [name(f"d_{u}") for u in block.unknowns]
    seeds |= {u: space.sym(d) for u, d in zip(block.unknowns, own, strict=True)}
    # The equations are linear, so the convergence does not depend on the starting values. The iteration
    # starts from zero.
    starts = (space.zero,) * len(own)
    return Block(f"{VARIED}{block.label}", tuple(own), starts, tangents(block.images, seeds))


def _sampled(kernel: Kernel, scene: Problem, domain: ExprDomain) -> Kernel:
    """Add samples of the run-time inputs to the kernel. A sample contains all run-time inputs at one time.

    Only samples that the kernel reads are added.
    """
    # The compiler passes may have removed all expressions that read a sample.
    read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"}
    samples = [
        Sample(t, tuple(symbols[name].payload for name in scene.inputs))
        for t, symbols in domain.samples.values()
    ]
    needed = tuple(sample for sample in samples if read.intersection(sample.symbols))
    return replace(kernel, inputs=scene.inputs if needed else (), samples=needed)
