"""Translates a step program to a kernel.

The program is executed symbolically: the value of each variable becomes a tuple of expressions. A block of
implicit equations becomes a loop (:mod:`codegen.kernel.equations`). Expressions become assignments
(:mod:`codegen.kernel.assignments`).
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
from codegen.ir.summation import ShortChains
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
"""Four ways to treat the critical path (the longest chain of dependent operations).

- AS_WRITTEN leaves the operations unchanged.
- COMBINED changes c1 (c2 x) into (c1 c2) x if c1 and c2 are constant in a run, and x is not constant.
- ORDERED sorts the assignments by the estimated time at which each value is available.
- SHORTENED does what COMBINED and ORDERED do, and rewrites the longest chains
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
    - If ``variations`` is given, the kernel computes the variation of the new state, and not the new state
      itself.
    - ``chains`` selects a treatment of the critical path: AS_WRITTEN (no change), COMBINED, ORDERED or
      SHORTENED. The docstring of these constants describes the treatments. If the program has implicit
      equations, ``chains`` must be AS_WRITTEN.
    - ``whole`` matters only if the step is computed in the body frame, and the caller of the emitted code
      uses the space frame. If ``whole`` is true, each step converts the momentum between the two frames. If
      ``whole`` is false, the momentum is converted once at the beginning and once at the end of a run
      (:mod:`codegen.kernel.carried_momentum`).
    - If ``outlining`` is true, repeated computations of a long step become functions
      (:mod:`codegen.kernel.outlining`).

    :class:`codegen.errors.SceneError` is raised if an operation of the group has no closed form.
    :class:`codegen.ir.differentiate.NotDifferentiable` is raised if a derivative in the matrix of Newton's
    method does not exist. For some programs, this matrix is expanded in powers of h. ZeroDivisionError is
    raised if the expansion contains 1/0 or a value such as log(0).
    """
    return _Translation(program, scene, solvers, variations, chains, whole, outlining).kernel()


class _StepDomain(SharedArguments, ShortChains):
    """The arithmetic of a step. The longest chain of dependent operations often determines the run time of a
    step, so sums are computed in an order that shortens the chains (:class:`ShortChains`). Loops over many
    sites use another domain, because a processor executes the chains of different sites at the same time.
    """


class _Translation:
    """The symbolic execution of a program.

    - ``env`` maps each variable of the program to expressions for its components.
    - ``hints`` maps the ids of expressions to preferred names in emitted code.
    - ``taken`` contains all names that are already in use in emitted code.
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
        # This domain stores equal expressions only once.
        self.domain = _StepDomain()
        self.env: dict[Var, Any] = {}
        self.hints: dict[int, str] = {}
        self.blocks: list[Block] = []
        # These names are in use, so the method ``self.name`` returns none of them.
        self.taken = {*scene.symbols, *scene.runtime, *scene.inputs, "h", TIME, LEAD, ELAPSED}
        # ``inside`` is true while the equations of a block are translated.
        self.outline, self.inside = Outline(program, scene, self.domain), False
        self.sums = SeriesSums(program, scene)
        self.frames = Frames(scene, program, whole or variations is not None)

    def name(self, base: str) -> str:
        """Return a new name, and add it to ``taken``. The name is ``base`` if possible."""
        candidate = base if base not in self.taken else base + "_"
        # Names such as ``xi_0`` denote components, so a number must not be appended.
        while candidate in self.taken:
            candidate += "_"
        self.taken.add(candidate)
        return candidate

    def remember(self, var: Var) -> None:
        """Add a name for each component of ``var`` to ``hints``, for example ``xi_0``."""
        for k, x in enumerate(flatten(var.kind, self.env[var])):
            # An expression that already has a name keeps this name.
            self.hints.setdefault(x.id, f"{var.name}_{k}" if var.kind is not Kind.REAL else var.name)

    def run(self, assign: Assign) -> None:
        """Execute an assignment symbolically, and record the assignment."""
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
                hint="write the closed forms in the class of the group; "
                "without closed forms no code can be emitted",
            ) from error
        if isinstance(assign.operation, BodyForce):
            # The constants in the results are combined, because this can save operations.
            known = [x for v in assign.args for x in flatten(v.kind, self.env[v])]
            results = tuple(gathered(x, known) for x in results)
        # An operation with a time argument may read run-time inputs, but an outlined function cannot read
        # them.
        reads = bool(scene.inputs) and any(v.kind is Kind.REAL for v in assign.args)
        # The current block is added to ``blocks`` later, so its index is the length of ``blocks``.
        place = len(self.blocks) if self.inside else -1
        self.outline.trees.note(assign, args, results, place, joined=nested is None and not reads)
        for target, value in zip(assign.targets, results, strict=True):
            self.env[target] = value
            self.remember(target)

    def begin(self) -> State:
        """Set the values of the program's inputs to symbols, and return the initial state."""
        space = self.domain.space
        # The momentum in ``start`` is in the frame that ``self.program`` uses: the space or the body frame.
        given = start = self.frames.begin(self.domain, tuple(map(space.sym, self.scene.symbols)))
        starts: dict[str, State] = {}
        for block in self.scene.state:
            # ``given`` starts with the coordinates of ``block``.
            starts[block.name], given = given[: len(block.symbols)], given[len(block.symbols) :]
        for var in self.program.inputs:
            self.env[var] = starts[var.name] if var.name in starts else space.sym(var.name)
        return start

    def solve(self, statement: Solve) -> None:
        """Add a block of implicit equations to ``blocks``."""
        # While ``inside`` is true, ``run`` records that an assignment belongs to the new block of equations.
        self.inside = True
        entered = self.enter(statement)
        self.inside = False
        solver = self.solvers.get(statement.label, FIXED_POINT)
        residuals = None
        # ``compared`` replaces the equations u = g(u) for the unknowns u by equations r(u) = 0. If the kernel
        # computes derivatives of the step (``self.variations``), g is needed, so u = g(u) is not replaced.
        if solver == NEWTON and self.variations is None:
            residuals = compared(statement, entered, self.env, self.name, self.program)
        # The block ``residuals`` already contains Newton's matrix.
        if residuals is not None:
            entered = residuals
        elif solver != FIXED_POINT:
            entered = with_matrix(entered, solver)
            # An iteration of Newton's method first computes g(u). The difference g(u) - u then gives a
            # correction d, and the new value of the unknown is u + d. In the last iteration, u + d is more
            # accurate than g(u). Therefore later statements read the unknown in place of g(u).
            solved = Solved(entered)
            for var in self.env:
                self.env[var] = solved.value(self.env[var])
                self.remember(var)
        # The call of ``self.enter`` uses the length of ``self.blocks`` as the index of the new block.
        # Therefore the new block is added after this call.
        self.blocks.append(entered)

    def enter(self, block: Solve) -> Block:
        """Execute the body of ``block``, and return the equations u = g(u) as expressions."""
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
        """Return the new states of the method and of the embedded method.

        Without an embedded method, the second state is (). All statements of the program must be executed
        before this call.
        """
        state = tuple(map(self.domain.space.sym, self.scene.symbols))
        ends = []
        # The new state and the embedded solution are converted to the frame of the emitted code. The method
        # ``kernel`` computes the error estimate as the difference of the two converted values.
        for embedded in (False, True):
            # If the program has no embedded solution, ``values`` is empty in the second pass of this loop.
            parts = (v for n, v in self.program.outputs if (n == EMBEDDED) is embedded)
            values = tuple(x for v in parts for x in flatten(v.kind, self.env[v]))
            ends.append(self.frames.end(self.domain, state, start, values))
        outputs, lower = ends
        # The critical path is shortened before expressions are split into assignments.
        if self.chains in (COMBINED, SHORTENED):
            # Factors that contain only the symbols in ``constant`` are multiplied first.
            constant = frozenset({"h", LEAD, ELAPSED, *self.scene.runtime})
            outputs = critical_path.run(outputs, constant, spread=self.chains == SHORTENED)
        return outputs, lower

    def varied(self, variations: Variations, outputs: State) -> State:
        """Return the variation of the new state.

        The equations for the variations of all unknowns are added to ``blocks``.
        """
        space, seeds = self.domain.space, variations.seeds(self.domain)
        # Each block is followed by the linear equations for the variations of its unknowns.
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
            # A kernel with variations has no error estimate.
            outputs, lower = self.varied(self.variations, outputs), ()
            fields = (*fields, Field(VARIATION, self.variations.names, self.variations.text()))
        # The error estimate is the difference between the new state and the embedded solution.
        errors = tuple(x - y for x, y in zip(outputs, lower, strict=True)) if lower else ()
        # ``ordered`` is called only once, so outputs and error estimates can share assignments.
        body, ends, outlined = self.ordered((*outputs, *errors))
        # LEAD is the duration of the last flow of a splitting step. If this flow and the first flow of the
        # next step are joined, LEAD is the sum of the two durations. ELAPSED is the duration of a run.
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
        """Return the body, the outputs and the outlined functions of a kernel for the expressions ``ends``.

        Computations are outlined only if outlining makes the kernel much shorter.
        """
        # ``before`` contains the names that are in use before ``schedule`` creates new names. The kernel
        # contains either the assignments of ``schedule`` or the outlined assignments, but never both.
        # Therefore variables of ``schedule`` and of outlined assignments may have the same names. Outlining
        # must only avoid the names in ``before``.
        before = frozenset(self.taken)
        schedule = Assignments(self.blocks, ends, self.hints, self.name, self.variations is None)
        body = schedule.run()
        outlined: tuple[Function, ...] = ()
        # The number of assignments is a measure of the code size.
        long = _count(body) > (LONG if self.blocks else LONG_EXPLICIT)
        # The modes COMBINED and SHORTENED rewrite the expressions in ``ends``. Outlining needs the original
        # expressions. Therefore outlining is possible only in the modes AS_WRITTEN and ORDERED.
        if long and self.outlining and self.variations is None and self.chains in (AS_WRITTEN, ORDERED):
            self.taken.clear()
            self.taken.update(before)
            shorter, functions = _outlined(self.outline, self.blocks, ends, self.hints, self.name)
            if shorter is not None and _count(shorter.body) + _count(functions) < WORTH * _count(body):
                schedule, body, outlined = shorter, tuple(shorter.body), functions
        # The assignments that outlining creates must be sorted, too.
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
        # ``newton.body`` contains the assignments that compute Newton's matrix.
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
    """Return the assignments that call outlined functions, and the outlined functions.

    If no computation is repeated, the result is (None, ()).
    """
    flat = list(roots)
    for block in blocks:
        flat += [*block.starts, *block.images, *(x for row in block.matrix for x in row)]
    # A value in ``kept`` is removed if no expression in ``flat`` reads the value.
    read = {n.payload for n in walk(flat) if n.op == "sym"}
    blocks = [replace(b, kept=tuple(pair for pair in b.kept if pair[0] in read)) for b in blocks]
    # All blocks are outlined together, because different blocks may repeat the same computation.
    flat += [x for block in blocks for _, x in block.kept]
    owners = {u: k for k, block in enumerate(blocks) for u in block.unknowns}
    shorter = outline.run(flat, owners)
    if shorter is None:
        return None, ()
    # ``shorter`` contains the rewritten expressions in the order of ``flat``.
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
    """Return the linearised equations of ``block``.

    The unknowns of these equations are the variations du of the unknowns u of ``block``. This function adds
    the symbols of the variations to ``seeds``.
    """
    # Differentiating u = g(u) gives a linear equation for the variation du.
    own = [name(f"d_{u}") for u in block.unknowns]
    seeds |= {u: space.sym(d) for u, d in zip(block.unknowns, own, strict=True)}
    # The equations are linear, so the convergence does not depend on the starting values.
    starts = (space.zero,) * len(own)
    return Block(f"{VARIED}{block.label}", tuple(own), starts, tangents(block.images, seeds))


def _sampled(kernel: Kernel, scene: Problem, domain: ExprDomain) -> Kernel:
    """Return a copy of the kernel in which the attributes ``inputs`` and ``samples`` are set.

    ``inputs`` are the names of the functions of time that the caller of the emitted code supplies. A sample
    consists of a time t and the symbols for the values of these functions at t.
    """
    # Earlier compiler passes may have removed all uses of a sample. Then the sample is omitted.
    read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"}
    samples = [
        Sample(t, tuple(symbols[name].payload for name in scene.inputs))
        for t, symbols in domain.samples.values()
    ]
    needed = tuple(sample for sample in samples if read.intersection(sample.symbols))
    return replace(kernel, inputs=scene.inputs if needed else (), samples=needed)
