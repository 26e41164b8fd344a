"""Scopes for target languages with declarations: variables are declared in the innermost block, as late as
possible.

A variable belongs to the innermost block that contains all its uses. If several sibling blocks each assign
the variable before they read it, it belongs to each of these blocks.

In a block to which a variable belongs, the first statement that mentions the variable declares it, if this
statement assigns the variable and no other one. Otherwise a separate declaration precedes this statement. A
variable that is assigned once is constant.
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
    """The declarations of a function. The keys of both dictionaries are ``id(statement)``.

    - ``before``: the variables that are declared before the statement, each with its identifier.
    - ``by``: the identifiers that the statement itself declares. The value is True for a constant.
    """

    before: dict[int, list[tuple[str, Term]]] = field(default_factory=dict)
    by: dict[int, dict[str, bool]] = field(default_factory=dict)


def declarations(function: Function, identifiers: Identifiers) -> Declarations:
    """Return the declarations of the scalars that a function assigns, except parameters and loop indices."""
    result = Declarations()
    _Scopes(identifiers, result).place(function.body, _variables(function, identifiers))
    return result


def _variables(function: Function, identifiers: Identifiers) -> dict[str, Term]:
    """Return the scalars that a function assigns, in order, without parameters and arrays."""
    result: dict[str, Term] = {}

    def collect(body: Body) -> None:
        for statement in body:
            if isinstance(statement, Assign | Call):
                for target in assigned(statement):
                    # Statements of the type Array declare arrays and records, so only scalars are collected.
                    if target.op == "name" and not target.shape and not target.record:
                        result.setdefault(identifiers.variable(target), target)
            # Inner blocks are included, because a variable may be assigned only there.
            for inner in blocks(statement):
                collect(inner)

    collect(function.body)
    for parameter in function.parameters:
        # The head of the function declares the parameters, including parameters that the body assigns.
        result.pop(identifiers.of(parameter), None)
    return result


class _Scopes:
    """The analysis of one function."""

    def __init__(self, identifiers: Identifiers, result: Declarations) -> None:
        self.identifiers, self.result = identifiers, result
        # Results are stored for each statement, because they are needed for many variables. The keys are
        # ``id(statement)``, because equal statements at different places have separate scopes.
        self.known: dict[int, frozenset[str]] = {}
        self.known_own: dict[int, frozenset[str]] = {}
        self.counts: dict[int, Counter[str]] = {}

    def place(self, body: Body, variables: dict[str, Term]) -> None:
        """Declare the variables in the body or in its inner blocks. No statement outside the body mentions
        them.
        """
        inside: dict[int, dict[str, Term]] = {}
        # One pass over the body finds the uses of all variables. A pass for each variable would take
        # quadratic time.
        holders: dict[str, list[int]] = {name: [] for name in variables}
        for k, statement in enumerate(body):
            for name in self.mentioned(statement):
                if name in holders:
                    holders[name].append(k)
        for name, variable in variables.items():
            places = holders[name]
            if not places:
                continue
            # Variables are declared in the innermost block. A small scope shows readers and compilers how
            # long a value is needed.
            deeper = self.deeper(body, places, name)
            if not deeper:
                self.declare(body, places, name, variable)
            for block in deeper:
                inside.setdefault(id(block), {})[name] = variable
        # An inner block declares its variables itself, or passes them on to its own inner blocks.
        for statement in body:
            for block in blocks(statement):
                if id(block) in inside:
                    self.place(block, inside[id(block)])

    def deeper(self, body: Body, places: list[int], name: str) -> list[Body]:
        """Return the inner blocks to which a variable belongs; an empty list if it belongs to ``body``."""
        result: list[Body] = []
        # Only statements that mention the variable can contain a block to which the variable belongs.
        for k in places:
            statement = body[k]
            if name in self.own(statement):  # a statement of ``body`` itself mentions the variable
                return []
            result += [block for block in blocks(statement) if self.within(block, name)]
        # If a block reads the variable before assigning it, the value comes from an earlier block, so the
        # variable belongs to ``body``.
        if len(result) > 1 and not all(self.begins(block, name) for block in result):
            return []
        return result

    def begins(self, body: Body, name: str) -> bool:
        """Return True if a body assigns a variable before it reads it."""
        looped = False
        for statement in body:
            if name not in self.mentioned(statement):
                continue
            if name in {self.identifiers.variable(x) for x in reads(statement)}:
                return False
            if isinstance(statement, Assign | Call):
                # A call with several results writes them through pointers. This counts as an assignment to
                # each result.
                return any(
                    t.op == "name" and self.identifiers.variable(t) == name for t in assigned(statement)
                )
            # The body of a branch may be skipped. The body of a While whose test comes first may be skipped,
            # too.
            if isinstance(statement, While) and statement.at_least_once:
                return self.begins(statement.body, name)
            if not isinstance(statement, For) or not self.begins(statement.body, name):
                return False
            # A For loop may have no iterations, so the later statements are tested in the same way.
            looped = True
        return looped

    def declare(self, body: Body, places: list[int], name: str, variable: Term) -> None:
        """Declare a variable in the block ``body``.

        ``places`` contains the indices of the statements that mention the variable.
        """
        first = body[places[0]]
        # Assignments in inner blocks are also counted. A variable that an inner block assigns again is not
        # constant.
        times = sum(self.assignments(body[k])[name] for k in places)
        # `x = x + 1` cannot be a declaration, because it reads x.
        direct_first = isinstance(first, Assign) and self.assignments(first)[name] > 0
        called = isinstance(first, Call) and len(first.results) == 1 and self.assignments(first)[name] > 0
        if (direct_first or called) and name not in {self.identifiers.variable(x) for x in reads(first)}:
            self.result.by.setdefault(id(first), {})[name] = times == 1
        else:
            self.result.before.setdefault(id(first), []).append((name, variable))

    def assignments(self, statement: Statement) -> Counter[str]:
        """Return the number of assignments to each variable in a statement and its inner blocks."""
        if id(statement) not in self.counts:
            # The declaration of an array is no assignment to a scalar.
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
        """Return True if a body mentions a variable."""
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
