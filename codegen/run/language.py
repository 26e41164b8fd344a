"""The run representation: the code around a kernel as a small imperative program.

Stopping rules, warm starts, continuation, runs and step control are written once in this representation.
Printers translate it to a target, and :mod:`codegen.run.execute` executes it over any scalars.

The rules of the representation also suit array languages, where a loop is a ``while_loop`` and a branch is a
``select``:

- A loop is never left from its middle. A status or flag in its test ends the loop.
- A :class:`Return` is at the end of a function, or alone in an :class:`If` of the outermost block. A target
  may compute the statements after such an If and then discard their results.
- A function returns its status as a value. There are no pointers, but a function may change the arrays that
  it receives in place.
- Scalars are declared by their first assignment. On every path, each scalar is assigned before it is read.
- Some targets raise an exception where C computes an infinity or a NaN. ``Function.guard`` determines the
  result of a function after such an exception.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from codegen.run.terms import Kind, Term, names


@dataclass(frozen=True)
class Assign:
    """An assignment: target = value. For an array or a record, all entries or fields are assigned."""

    target: Term
    value: Term


@dataclass(frozen=True)
class Array:
    """The declaration of an array or record. The entries are ``values``, or zeros if ``zero`` is True."""

    name: Term
    values: tuple[Term, ...] = ()
    # Without values and without ``zero``, the entries have no values until they are assigned.
    zero: bool = False


@dataclass(frozen=True)
class For:
    """A loop: the body is executed for index = 0, ..., count - 1, or in ``reverse`` order.

    - ``independent``: the iterations may be executed in any order, with vector instructions.
    - ``parallel``: the iterations may be executed in any order, on several processors. They change no
      variable from outside the loop, except the ``reductions``.
    - ``reductions``: pairs of an operation (``+`` or ``max``) and a variable. Each iteration applies the
      operation to the variable.
    - ``when``: the loop is parallel only if this test holds.
    """

    index: Term
    count: Term
    body: tuple[Statement, ...]
    reverse: bool = False
    # Vector instructions and threads are separate properties: a loop that calls functions can be parallel,
    # but compilers cannot vectorise it.
    independent: bool = False
    parallel: bool = False
    reductions: tuple[tuple[str, Term], ...] = ()
    # A short loop is faster without threads.
    when: Term | None = None


@dataclass(frozen=True)
class While:
    """A loop: the body is executed as long as the test holds.

    With ``at_least_once`` the test comes after the body.
    """

    test: Term
    body: tuple[Statement, ...]
    # If the body comes first, the test may read variables that only the body assigns.
    at_least_once: bool = False


@dataclass(frozen=True)
class If:
    """A branch. If the test holds, the body is executed, otherwise ``orelse`` is executed."""

    test: Term
    body: tuple[Statement, ...]
    orelse: tuple[Statement, ...] = ()


@dataclass(frozen=True)
class Call:
    """A call: results = function(arguments).

    ``function`` is the name of a function of the unit, of the target's library, or of the caller of the unit
    (:data:`LANGUAGE`).
    """

    function: str
    arguments: tuple[Term, ...]
    results: tuple[Term, ...] = ()


@dataclass(frozen=True)
class Return:
    """The statement that ends a function and returns its result."""

    value: Term


@dataclass(frozen=True)
class Note:
    """A comment in the emitted code."""

    text: str


LANGUAGE = frozenset({"sample", "measure"})
"""The functions that the caller of the unit supplies, by their names in a :class:`Call`.

``sample`` computes the run-time inputs, and ``measure`` computes the values of the event functions."""

Statement = Assign | Array | For | While | If | Call | Return | Note
Body = tuple[Statement, ...]

# After a division by zero, Python raises an exception, but C continues with an infinity or a NaN. A function
# with a guard returns the same result in both targets.
RAISES_STATUS, RAISES_NAN = "status", "nan"
"""The values of ``Function.guard``.

After an arithmetic error, a function with RAISES_STATUS returns the status NOT_FINITE. With RAISES_NAN, its
result and the arrays that it changes are filled with NaNs.
"""


@dataclass(frozen=True)
class Function:
    """A function of the unit.

    - ``about`` is the comment of the function.
    - ``returns`` is the kind of its result; None if it returns nothing.
    - ``public`` functions can be called from outside the unit.
    - ``often`` marks functions that should be inlined.
    - ``near`` marks functions in which sines, cosines and Stumpff functions have no branches, and return NaN
      for arguments that are not near zero (:mod:`codegen.run.batch`).
    """

    name: str
    about: str
    parameters: tuple[Term, ...]
    body: Body
    returns: Kind | None = None
    # Without a guard, the exception of an arithmetic error reaches the caller of the function.
    guard: str = ""
    # Only public functions belong to the interface of the unit, so compilers may inline all others.
    public: bool = False
    often: bool = False
    near: bool = False


@dataclass(frozen=True)
class Record:
    """A record type: values that functions store from one call to the next.

    ``fields`` contains each value with a comment. Records of a public type belong to the caller of the unit.
    """

    name: str
    about: str
    fields: tuple[tuple[Term, str], ...]
    public: bool = False


@dataclass(frozen=True)
class Table:
    """A constant array. An array of two dimensions is stored by rows."""

    name: Term
    # An array of one dimension has a single row.
    rows: tuple[tuple[float, ...], ...]
    about: str = ""


@dataclass(frozen=True)
class Unit:
    """All code around one kernel: records, tables, and functions, callees first.

    ``scalars`` are the names of t, h and the parameters of the kernel, which have the same identifiers in all
    functions.
    """

    scalars: tuple[str, ...]
    records: tuple[Record, ...]
    tables: tuple[Table, ...]
    functions: tuple[Function, ...]
    # The functions by name, because printers look up the callee at each call.
    parts: dict[str, Function] = field(default_factory=dict, compare=False)

    def __post_init__(self) -> None:
        self.parts.update({f.name: f for f in self.functions})

    def record(self, name: str) -> Record:
        """Return a record by its name."""
        # A unit has only a few record types, so a search is fast enough.
        return next(r for r in self.records if r.name == name)


def blocks(statement: Statement) -> tuple[Body, ...]:
    """Return the bodies inside a statement. A loop has one body, and a branch has two."""
    match statement:
        case For(body=body) | While(body=body):
            return (body,)
        case If(body=body, orelse=orelse):
            return (body, orelse)
        case _:
            return ()


def direct(statement: Statement) -> tuple[Term, ...]:
    """Return the terms of a statement, without the terms in the bodies of a loop or branch.

    Terms that the statement assigns come first.
    """
    match statement:
        case Assign(target, term):
            return (target, term)
        case Array(name, values):
            return (name, *values)
        case For(index, count, when=when):
            # A loop that is always parallel, or never, has no test ``when``.
            return (index, count) if when is None else (index, count, when)
        case While(test) | If(test):
            return (test,)
        case Call(arguments=arguments, results=results):
            return (*results, *arguments)
        case Return(term):
            return (term,)
        case Note():
            return ()


def statements(body: Iterable[Statement]) -> Iterator[Statement]:
    """Yield every statement, including the statements of inner bodies."""
    for statement in body:
        yield statement
        # Blocks are nested only a few levels deep, so this recursion stays far below the recursion limit.
        for inner in blocks(statement):
            yield from statements(inner)


def terms(body: Iterable[Statement]) -> Iterator[Term]:
    """Yield every term of a body, and all its subterms."""
    # Sums over many unknowns are deeper than Python's recursion limit, so the stack is explicit.
    waiting = [term for statement in statements(body) for term in direct(statement)]
    while waiting:
        # The terms are taken from the end of the list, so their order differs from the order of the text.
        term = waiting.pop()
        yield term
        waiting += term.args


def root(target: Term) -> Term:
    """Return the name that an assignment changes, for example ``memory`` for ``memory.values[3]``."""
    # The first argument of an entry, part or field is its array or record.
    while target.args:
        target = target.args[0]
    return target


def assigned(statement: Statement) -> tuple[Term, ...]:
    """Return the terms that a statement assigns, without assignments in the bodies of a loop or branch."""
    match statement:
        case Assign(target):
            return (target,)
        case Array(name):
            return (name,)
        # Printers declare the index in the head of the loop, so a loop assigns its index.
        case For(index):
            return (index,)
        case Call(results=results):
            return results
        case _:
            return ()


def reads(statement: Statement) -> Iterator[Term]:
    """Yield the names that a statement reads outside the bodies of a loop or branch.

    A change of an entry counts as reading the array.
    """
    given = assigned(statement)
    # Assigning one entry keeps all other entries, so the new array depends on the old array.
    whole = {id(t) for t in given if t.op == "name"}
    for term in direct(statement):
        if id(term) not in whole:
            yield from names([term])
