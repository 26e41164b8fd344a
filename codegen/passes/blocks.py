"""Blocks: the strongly connected components of the stage graph, each solved alone and in order.

Exact. An edge leads from each assignment to those that read its values; an unknown is represented by its
image. A component without a cycle becomes plain assignments, one with a cycle a block of its own unknowns. So
explicit methods lose their solver, and a composition tableau is solved stage by stage.
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
    """Return the statements of one block in order; ``names`` maps unknowns to their images from now on."""
    # Imported late: only programs with blocks need it.
    import networkx

    # Outside a block its unknowns are replaced by their images, also in the starts of later blocks.
    start = {u: names.get(s, s) for u, s in zip(block.unknowns, block.starts, strict=True)}
    image = _resolved(dict(zip(block.unknowns, block.images, strict=True)), start)
    # Positions in the body serve as graph nodes: integers sort, so the result does not depend on hashes.
    maker = {target: k for k, assign in enumerate(block.body) for target in assign.targets}
    graph = networkx.DiGraph()
    # Assignments that neither read nor feed another one of the block are components, too.
    graph.add_nodes_from(range(len(block.body)))
    for k, assign in enumerate(block.body):
        for arg in assign.args:
            # A reader of an unknown waits for its image. Values from before the block order nothing.
            source = maker.get(image.get(arg, arg))
            if source is not None:
                graph.add_edge(source, k)
    # Two assignments depend on each other exactly if they are in one strongly connected component.
    condensed = networkx.condensation(graph)
    # The old order is valid inside a component: only reads of unknowns point backwards in it.
    members = {c: sorted(condensed.nodes[c]["members"]) for c in condensed}
    # Among orders that are possible take that of the program, so that emitted text is stable.
    order = networkx.lexicographical_topological_sort(condensed, key=lambda c: members[c][0])
    result: list[Statement] = []
    for component in order:
        inside = set(members[component])
        assigns = [block.body[k] for k in members[component]]
        # An unknown belongs to the component that computes its image, if the component reads it.
        own = [
            u for u in block.unknowns if maker.get(image[u]) in inside and any(u in a.args for a in assigns)
        ]
        kept = set(own)
        renamed = [_rename(a, names, image, kept) for a in assigns]
        # Without an unknown that it reads the component has no cycle: it is explicit.
        if not own:
            result += renamed
            continue
        label = _label(own)
        images = tuple(image[u] for u in own)
        # No residuals to keep: :mod:`codegen.passes.legendre` adds them after the last split.
        result.append(Solve(label, tuple(own), tuple(start[u] for u in own), tuple(renamed), images))
    # At the solution an unknown equals its image, and the image may now be computed without a block.
    names.update(image)
    return result


def _resolved(image: dict[Var, Var], start: dict[Var, Var]) -> dict[Var, Var]:
    """Follow images that are themselves unknowns; one that must only equal itself stays at its start."""
    result = {}
    for unknown in image:
        var, seen = image[unknown], [unknown]
        while var in image and var not in seen:
            seen.append(var)
            var = image[var]
        # A closed chain v = w, w = v holds for any common value; the start is one that is known.
        result[unknown] = start[unknown] if var in seen else var
    return result


def _rename(assign: Assign, names: dict[Var, Var], image: dict[Var, Var], kept: set[Var]) -> Assign:
    def now(var: Var) -> Var:
        # Unknowns of the component itself stay: replacing them by their images would close a cycle.
        if var in kept:
            return var
        return image.get(var, names.get(var, var))

    return replace(assign, args=tuple(now(a) for a in assign.args))


def _label(unknowns: list[Var]) -> str:
    return "the equations of " + ", ".join(u.name for u in unknowns)
