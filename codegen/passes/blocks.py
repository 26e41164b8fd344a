"""Split each block into the strongly connected components of its dependency graph, which are solved in order.

The pass is exact. An edge of the graph leads from each assignment to every assignment that reads one of its
values. An unknown is represented by its image, the right-hand side of the unknown's fixed-point equation. A
component without a cycle becomes assignments outside blocks. A component with a cycle becomes a block with
its own unknowns. Explicit methods therefore need no solver, and a composition tableau is solved stage by
stage.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve, Statement
from codegen.ir.values import Var


def run(program: Program) -> Program:
    """Return the program with every block split into its strongly connected components."""
    body: list[Statement] = []
    names: dict[Var, Var] = {}
    for statement in program.body:
        if isinstance(statement, Solve):
            body += _split(statement, names)
        else:
            body.append(replace(statement, args=tuple(names.get(a, a) for a in statement.args)))
    outputs = tuple((name, names.get(var, var)) for name, var in program.outputs)
    return replace(program, body=tuple(body), outputs=outputs)


def _split(block: Solve, names: dict[Var, Var]) -> list[Statement]:
    """Return the statements that replace a block, in order.

    ``names`` receives, for each unknown of the block, the variable that replaces it in later statements.
    """
    # networkx is imported here and not at the top of the file, because only programs with blocks need it.
    import networkx

    # ``names`` contains the images of the unknowns of earlier blocks. Each start that is such an unknown is
    # replaced by its image.
    start = {u: names.get(s, s) for u, s in zip(block.unknowns, block.starts, strict=True)}
    image = _resolved(dict(zip(block.unknowns, block.images, strict=True)), start)
    # The nodes of the graph are positions in the body. The order of these integers is the same in every run,
    # unlike the order of a set of variables.
    maker = {target: k for k, assign in enumerate(block.body) for target in assign.targets}
    graph = networkx.DiGraph()
    # Assignments without an edge to other assignments of the block are components, too.
    graph.add_nodes_from(range(len(block.body)))
    for k, assign in enumerate(block.body):
        for arg in assign.args:
            # An assignment that reads an unknown depends on the image of the unknown. Values that are
            # computed before the block add no edges.
            source = maker.get(image.get(arg, arg))
            if source is not None:
                graph.add_edge(source, k)
    # Two assignments depend on each other exactly if they are in one strongly connected component.
    condensed = networkx.condensation(graph)
    # Inside a component the old order of assignments remains valid. An assignment depends on later
    # assignments only through unknowns, whose values are known from the previous sweep.
    members = {c: sorted(condensed.nodes[c]["members"]) for c in condensed}
    # Several orders of the components may be possible. The order closest to the old program is chosen, so
    # that a small change of a program causes a small change of emitted text.
    order = networkx.lexicographical_topological_sort(condensed, key=lambda c: members[c][0])
    result: list[Statement] = []
    for component in order:
        inside = set(members[component])
        assigns = [block.body[k] for k in members[component]]
        # An unknown belongs to the component that computes its image. The component must also read the
        # unknown.
        own = [
            u for u in block.unknowns if maker.get(image[u]) in inside and any(u in a.args for a in assigns)
        ]
        kept = set(own)
        renamed = [_rename(a, names, image, kept) for a in assigns]
        # If the component reads no unknown whose image it computes, it has no cycle. Its assignments are then
        # explicit and need no block.
        if not own:
            result += renamed
            continue
        label = _label(own)
        images = tuple(image[u] for u in own)
        # Residuals need not be copied to the new blocks, because the old block has none.
        # :mod:`codegen.passes.legendre` adds residuals after the last split.
        result.append(Solve(label, tuple(own), tuple(start[u] for u in own), tuple(renamed), images))
    # Later statements read the image in place of the unknown, because both are equal at the solution. An
    # unknown whose component has no cycle is in no block and has no value of its own.
    names.update(image)
    return result


def _resolved(image: dict[Var, Var], start: dict[Var, Var]) -> dict[Var, Var]:
    """Return a value for each unknown that is not itself an unknown of the block.

    The value is the image of the unknown. If the image is itself an unknown, the image of that unknown is
    used, and so on. If this chain of unknowns is closed, the value is the start value of the unknown.
    """
    result = {}
    for unknown in image:
        var, seen = image[unknown], [unknown]
        while var in image and var not in seen:
            seen.append(var)
            var = image[var]
        # If the chain is closed, as for the equations v = w and w = v, any common value is a solution. The
        # start value of the unknown is chosen.
        result[unknown] = start[unknown] if var in seen else var
    return result


def _rename(assign: Assign, names: dict[Var, Var], image: dict[Var, Var], kept: set[Var]) -> Assign:
    def now(var: Var) -> Var:
        # Unknowns of the component itself are not replaced by their images. Otherwise an assignment would
        # read a value that depends on its own result.
        if var in kept:
            return var
        return image.get(var, names.get(var, var))

    return replace(assign, args=tuple(now(a) for a in assign.args))


def _label(unknowns: list[Var]) -> str:
    return "the equations of " + ", ".join(u.name for u in unknowns)
