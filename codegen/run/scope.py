"""Choose where a target language such as C declares each scalar variable.

A variable is declared in the innermost block that contains all its uses, as late as possible. There is one
exception. Suppose that the variable is used only inside several separate inner blocks, and that each of these
inner blocks assigns the variable before reading it. Then each of these inner blocks declares the variable.

In the declaring block, let S be the first statement that mentions the variable. If S assigns only this
variable and does not read it, S also declares it, as in ``double x = 1.0;``. If moreover no other statement
of the block assigns the variable, S declares a constant, as in ``const double x = 1.0;``.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from codegen.run.identifiers import Identifiers
from codegen.run.language import (
    Array,
    Assign,
    Body,
    Call,
    For,
    Function,
    Statement,
    While,
    assigned,
    blocks,
    direct,
    reads,
)
from codegen.run.terms import Term, names


@dataclass
class Declarations:
    """The declarations of a function, in two dictionaries with the keys ``id(statement)``.

    - ``before[id(statement)]`` is a list of the variables that are declared before the statement. Each
      variable is a pair (identifier, term).
    - ``by[id(statement)]`` is a dictionary of the variables that the statement itself declares. Each key of
      ``by[id(statement)]`` is the identifier of a variable. The value is True if this variable is constant,
      and False if this variable is assigned more than once.
    """

    before: dict[int, list[tuple[str, Term]]] = field(default_factory=dict)
    by: dict[int, dict[str, bool]] = field(default_factory=dict)


def declarations(function: Function, identifiers: Identifiers) -> Declarations:
    """Return the declarations of all scalars in a function, except parameters and loop indices."""
    result = Declarations()
    _Scopes(identifiers, result).place(function.body, _variables(function, identifiers))
    return result


def _variables(function: Function, identifiers: Identifiers) -> dict[str, Term]:
    """Return the scalars that a function assigns, in the order of first assignment.

    Parameters are omitted.
    """
    result: dict[str, Term] = {}

    def collect(body: Body) -> None:
        for statement in body:
            if isinstance(statement, Assign | Call):
                for target in assigned(statement):
                    # Arrays and records are omitted. The body already contains their declarations.
                    if target.op == "name" and not target.shape and not target.record:
                        result.setdefault(identifiers.variable(target), target)
            # Some variables are assigned only in inner blocks, so inner blocks are visited too.
            for inner in blocks(statement):
                collect(inner)

    collect(function.body)
    for parameter in function.parameters:
        # The head of the function declares the parameters, so they need no declaration in the body.
        result.pop(identifiers.of(parameter), None)
    return result


class _Scopes:
    """Chooses the blocks that declare the variables of one function."""

    def __init__(self, identifiers: Identifiers, result: Declarations) -> None:
        self.identifiers, self.result = identifiers, result
        # These dictionaries cache the results of ``mentioned``, ``own`` and ``assignments``, in this order.
        # The keys are ``id(statement)``.
        self.known: dict[int, frozenset[str]] = {}
        self.known_own: dict[int, frozenset[str]] = {}
        self.counts: dict[int, Counter[str]] = {}

    def place(self, body: Body, variables: dict[str, Term]) -> None:
        """Declare variables in the block ``body`` or in its inner blocks.

        The variables must not occur outside ``body``.
        """
        inside: dict[int, dict[str, Term]] = {}
        # A loop for each variable would take quadratic time.
        holders: dict[str, list[int]] = {name: [] for name in variables}
        for k, statement in enumerate(body):
            for name in self.mentioned(statement):
                if name in holders:
                    holders[name].append(k)
        for name, variable in variables.items():
            places = holders[name]
            if not places:
                continue
            # A small scope makes the emitted code easier to read, so inner blocks are preferred.
            deeper = self.deeper(body, places, name)
            if not deeper:
                self.declare(body, places, name, variable)
            for block in deeper:
                inside.setdefault(id(block), {})[name] = variable
        # The recursive call of ``place`` handles the variables of an inner block.
        for statement in body:
            for block in blocks(statement):
                if id(block) in inside:
                    self.place(block, inside[id(block)])

    def deeper(self, body: Body, places: list[int], name: str) -> list[Body]:
        """Return the inner blocks in which a variable can be declared.

        The list is empty if the variable must be declared in ``body`` itself.
        """
        result: list[Body] = []
        # ``places`` contains the indices of all statements in ``body`` that mention the variable.
        for k in places:
            statement = body[k]
            if name in self.own(statement):  # the variable occurs outside the inner blocks
                return []
            result += [block for block in blocks(statement) if self.within(block, name)]
        # If an inner block reads a value from another inner block, the variable must be declared outside
        # both.
        if len(result) > 1 and not all(self.begins(block, name) for block in result):
            return []
        return result

    def begins(self, body: Body, name: str) -> bool:
        """Return True if ``body`` always assigns the variable ``name`` before it reads the variable."""
        looped = False
        for statement in body:
            if name not in self.mentioned(statement):
                continue
            if name in {self.identifiers.variable(x) for x in reads(statement)}:
                return False
            if isinstance(statement, Assign | Call):
                # A call with several results assigns several variables.
                return any(
                    t.op == "name" and self.identifiers.variable(t) == name for t in assigned(statement)
                )
            if isinstance(statement, While) and statement.at_least_once:
                return self.begins(statement.body, name)
            if not isinstance(statement, For) or not self.begins(statement.body, name):
                return False
            # The loop may have no iterations. Then a later statement may read ``name`` before an assignment.
            looped = True
        return looped

    def declare(self, body: Body, places: list[int], name: str, variable: Term) -> None:
        """Declare a variable in the block ``body``.

        ``places`` contains the indices of the statements that mention the variable.
        """
        first = body[places[0]]
        # A variable with two assignments is not constant, even if one assignment is in an inner block.
        times = sum(self.assignments(body[k])[name] for k in places)
        # A statement such as ``x = x + 1`` cannot declare ``x``, because it also reads ``x``.
        direct_first = isinstance(first, Assign) and self.assignments(first)[name] > 0
        called = isinstance(first, Call) and len(first.results) == 1 and self.assignments(first)[name] > 0
        if (direct_first or called) and name not in {self.identifiers.variable(x) for x in reads(first)}:
            self.result.by.setdefault(id(first), {})[name] = times == 1
        else:
            self.result.before.setdefault(id(first), []).append((name, variable))

    def assignments(self, statement: Statement) -> Counter[str]:
        """Return the number of assignments to each variable in a statement and its inner blocks."""
        if id(statement) not in self.counts:
            # Only assignments to scalars are counted, so the declaration of an array is left out.
            targets = () if isinstance(statement, Array) else assigned(statement)
            count = Counter(self.identifiers.variable(t) for t in targets if t.op == "name")
            for block in blocks(statement):
                for inner in block:
                    count.update(self.assignments(inner))
            self.counts[id(statement)] = count
        return self.counts[id(statement)]

    def own(self, statement: Statement) -> frozenset[str]:
        """Return the variables that a statement mentions outside its inner blocks."""
        if id(statement) not in self.known_own:
            read = frozenset(self.identifiers.variable(x) for x in names(direct(statement)))
            self.known_own[id(statement)] = read
        return self.known_own[id(statement)]

    def within(self, body: Body, name: str) -> bool:
        """Return True if ``body`` mentions the variable ``name``."""
        return any(name in self.mentioned(statement) for statement in body)

    def mentioned(self, statement: Statement) -> frozenset[str]:
        """Return the variables that a statement and its inner blocks mention."""
        if id(statement) not in self.known:
            result = set(self.own(statement))
            for block in blocks(statement):
                for inner in block:
                    result |= self.mentioned(inner)
            self.known[id(statement)] = frozenset(result)
        return self.known[id(statement)]
