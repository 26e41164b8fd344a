"""Find the parameters that an emitted function changes, directly or through calls."""

from __future__ import annotations

from codegen.run.language import Array, Assign, Call, Function, Unit, root, statements


def written(unit: Unit, function: Function) -> frozenset[str]:
    """Return the names of the array and record parameters that ``function`` changes."""
    # Scalars are passed by value, so an assignment to a scalar parameter does not change a variable of the
    # caller.
    own = {p.text for p in function.parameters if p.shape or p.record}
    changed_names: set[str] = set()
    for statement in statements(function.body):
        match statement:
            case Assign(target):
                changed_names.add(root(target).text)
            case Call(name, arguments, results):
                changed_names |= {root(r).text for r in results}
                callee = unit.parts.get(name)
                if callee is None:  # Of the library functions, only ``invert`` changes an argument.
                    changed_names |= {root(a).text for a in arguments if name == "invert"}
                    continue
                changed = written(unit, callee)
                # The recursion ends, because no emitted function calls itself, directly or through other
                # functions.
                pairs = zip(callee.parameters, arguments, strict=True)
                changed_names |= {root(a).text for p, a in pairs if p.text in changed and a.op != "none"}
            # This statement declares a local array and changes no parameter.
            case Array():
                pass
    return frozenset(changed_names & own)
