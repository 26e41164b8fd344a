"""Identifiers in a target language: legal and unique names for the symbols of a kernel.

A kernel is the arithmetic of a step. The code around a kernel uses only names that are legal in every target
language. Each name in a kernel is replaced by a legal identifier that differs from all other names in the
emitted function.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from codegen.run.language import Array, Function, Unit, direct, statements, terms
from codegen.run.names import Names
from codegen.run.terms import Term, names


@dataclass(frozen=True)
class Identifiers:
    """The identifiers of variables in one emitted function.

    ``by_name`` is a dictionary from the name of a variable in the kernel to the identifier of this variable
    in the emitted function, for example from ``f.0`` to ``f[0]``. An identifier is a name or ``array[k]``.
    """

    by_name: Mapping[str, str]

    def of(self, name: Term) -> str:
        """Return the identifier of ``name``. A name that is not from the kernel is returned unchanged."""
        # If a kernel name has no identifier, a KeyError is raised.
        return self.by_name[name.text] if name.own else name.text

    def variable(self, name: Term) -> str:
        """Return the identifier of ``name``. If the identifier is ``array[k]``, return only ``array``."""
        return self.of(name).partition("[")[0]


def plain_names(function: Function) -> frozenset[str]:
    """Return the names in a function that do not come from the kernel."""
    used = (*function.parameters, *terms(function.body))
    return frozenset(t.text for t in used if t.op == "name" and not t.own)


def identify(unit: Unit, reserved: Collection[str]) -> dict[str, Identifiers]:
    """Return a dictionary from the name of each function in the unit to its identifiers.

    No identifier is a ``reserved`` word.
    """
    # Functions and tables are global, so a local variable must not have the name of a function or table.
    outside = frozenset(reserved) | {f.name for f in unit.functions} | {t.name.text for t in unit.tables}
    return {
        f.name: Identifiers(_identified(f, unit.scalars, outside | plain_names(f))) for f in unit.functions
    }


def _identified(function: Function, scalars: Iterable[str], taken: Collection[str]) -> dict[str, str]:
    own = Names(taken)
    # The identifiers of the scalar arguments are chosen first, so no other name of the kernel takes
    # them.
    own.add_all(scalars)
    entries: dict[str, str] = {}
    # The identifiers are chosen in the order of the statements.
    for statement in statements(function.body):
        if isinstance(statement, Array) and statement.name.own:
            name = statement.name.text
            own.add_all([name])
            # The array ``name`` receives the results of an outlined function. In the kernel, result k has the
            # name ``name.k``.
            entries |= {
                f"{name}.{k}": f"{own.identifiers[name]}[{k}]" for k in range(statement.name.shape[0])
            }
        for text in (t.text for t in names(direct(statement)) if t.own):
            if text not in entries and text not in own.identifiers:
                # In an outlined function, the name of an input begins with the name of the function and a
                # dot.
                own.identifiers[text] = own.fresh(text.removeprefix(f"{function.name}."))
    return own.identifiers | entries
