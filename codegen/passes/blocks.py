"""Split each block of implicit equations into the strongly connected components of its dependency graph.

The split does not change the solution of the equations. The nodes of the graph are the assignments of the
block. An edge leads from the assignment P to the assignment Q in two cases:

- Q reads a variable that P computes.
- Q reads an unknown u, and P computes the right-hand side of the fixed-point equation for u.

A component without a cycle is moved out of the block.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve, Statement
from codegen.ir.values import Var


def run(program: Program) -> Program:
    """Return the program with every block of equations split into smaller blocks."""
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
    """Return the statements that replace a block, in order of execution.

    For each unknown of the block, the function adds an entry to ``names``: the variable that later statements
    read in place of the unknown.
    """
    # The import of networkx takes time, and only programs with blocks need it.
    import networkx

    start = {u: names.get(s, s) for u, s in zip(block.unknowns, block.starts, strict=True)}
    image = _resolved(dict(zip(block.unknowns, block.images, strict=True)), start)
    # The nodes are the indices of the assignments. If the nodes were variables, the order of the nodes in a
    # set, and therefore the order of the statements, could differ from run to run.
    maker = {target: k for k, assign in enumerate(block.body) for target in assign.targets}
    graph = networkx.DiGraph()
    # All assignments become nodes here, because ``add_edge`` adds only assignments that have an edge.
    graph.add_nodes_from(range(len(block.body)))
    for k, assign in enumerate(block.body):
        for arg in assign.args:
            # If ``arg`` is an unknown u with the equation u = g(u), ``source`` is the index of the assignment
            # that computes g(u). Otherwise ``source`` is the index of the assignment that computes ``arg``.
            source = maker.get(image.get(arg, arg))
            if source is not None:
                graph.add_edge(source, k)
    condensed = networkx.condensation(graph)
    # Inside a component, the assignments have the same order as in the block.
    members = {c: sorted(condensed.nodes[c]["members"]) for c in condensed}
    # Ties in the topological order are decided by the position in the block.
    order = networkx.lexicographical_topological_sort(condensed, key=lambda c: members[c][0])
    result: list[Statement] = []
    for component in order:
        inside = set(members[component])
        assigns = [block.body[k] for k in members[component]]
        # ``own`` contains the unknowns of the new block.
        own = [
            u for u in block.unknowns if maker.get(image[u]) in inside and any(u in a.args for a in assigns)
        ]
        kept = set(own)
        renamed = [_rename(a, names, image, kept) for a in assigns]
        # If ``own`` is empty, the assignments in ``renamed`` need no iteration.
        if not own:
            result += renamed
            continue
        label = _label(own)
        images = tuple(image[u] for u in own)
        # The new block has no residuals. The later pass :mod:`codegen.passes.legendre` adds residuals.
        result.append(Solve(label, tuple(own), tuple(start[u] for u in own), tuple(renamed), images))
    # At the solution, each unknown equals the right-hand side of its equation.
    names.update(image)
    return result


def _resolved(image: dict[Var, Var], start: dict[Var, Var]) -> dict[Var, Var]:
    """Return ``image`` without chains: if ``image`` maps u to v and v to w, the result maps u to w."""
    result = {}
    for unknown in image:
        var, seen = image[unknown], [unknown]
        while var in image and var not in seen:
            seen.append(var)
            var = image[var]
        # Equations such as v = w and w = v have no unique solution. The unknown of such an equation is
        # replaced by its initial guess.
        result[unknown] = start[unknown] if var in seen else var
    return result


def _rename(assign: Assign, names: dict[Var, Var], image: dict[Var, Var], kept: set[Var]) -> Assign:
    def now(var: Var) -> Var:
        # ``kept`` contains the unknowns of the new block. Every other unknown is replaced by the right-hand
        # side of its equation.
        if var in kept:
            return var
        return image.get(var, names.get(var, var))

    return replace(assign, args=tuple(now(a) for a in assign.args))


def _label(unknowns: list[Var]) -> str:
    return "the equations of " + ", ".join(u.name for u in unknowns)
