"""The run representation describes the code around a kernel as a small imperative program.

The code around a kernel contains, for example, stopping rules and step control. The following rules allow a
translation to array languages. Array languages express a loop by ``while_loop`` and a branch by ``select``.

- A loop ends only at its test. There is no ``break`` statement.
- A :class:`Return` is the last statement of a function or the only statement of an :class:`If`. An If with a
  Return is not inside a loop or another If.
- A function returns its status as a value. There are no pointers, but a function may overwrite entries of the
  arrays in its arguments.
- Scalars are declared by their first assignment. On every path, each scalar is assigned before it is read.
- Where C computes an infinity or a NaN, Python may raise an exception. Then ``Function.guard`` determines the
  result of the Python function, or ``While.guard`` ends the loop.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from codegen.run.terms import Kind, Term, names


@dataclass(frozen=True)
class Assign:
    """An assignment: target = value. If the target is an array or record, all its entries are assigned."""

    target: Term
    value: Term


@dataclass(frozen=True)
class Array:
    """The declaration of an array or record.

    The initial entries are ``values``. Without ``values``, all entries are 0 if ``zero`` is True, and
    undefined otherwise.
    """

    name: Term
    values: tuple[Term, ...] = ()
    zero: bool = False


@dataclass(frozen=True)
class For:
    """A loop: the body is executed for index = 0, ..., count - 1.

    - ``reverse`` is True if the index runs from count - 1 down to 0.
    - ``independent`` is True if several iterations may be executed at once by vector instructions.
    - ``parallel`` is True if the iterations may be executed in any order and on several processors. Scalar
      variables from outside the loop must be constant in the loop, apart from those in ``reductions``.
    - ``reductions`` contains pairs of an operation (``+`` or ``max``) and the variable for the sum or
      maximum.
    - ``when`` is a test or None. If the test fails, the loop is executed on one processor.
    """

    index: Term
    count: Term
    body: tuple[Statement, ...]
    reverse: bool = False
    # An independent loop calls only functions without branches. Branches prevent vector instructions.
    independent: bool = False
    parallel: bool = False
    reductions: tuple[tuple[str, Term], ...] = ()
    # If the test ``when`` is false, one processor executes the whole loop. For a short loop, one processor is
    # faster than several processors.
    when: Term | None = None


@dataclass(frozen=True)
class While:
    """A loop: the body is executed as long as the test holds.

    If ``at_least_once`` is True, the test is evaluated after the body, so the body is executed at least once.
    If ``guard`` is a variable for a status, an arithmetic error in Python ends the loop, and the variable
    becomes NOT_FINITE. Assignments before the error remain. A loop with a guard must not call functions that
    the user supplies (:data:`LANGUAGE`), because errors in these functions would not be reported.
    """

    test: Term
    body: tuple[Statement, ...]
    # If ``at_least_once`` is True, ``test`` may read variables that are assigned only in the body.
    at_least_once: bool = False
    guard: Term | None = None


@dataclass(frozen=True)
class If:
    """A branch. If the test holds, the body is executed, otherwise ``orelse`` is executed."""

    test: Term
    body: tuple[Statement, ...]
    orelse: tuple[Statement, ...] = ()


@dataclass(frozen=True)
class Call:
    """A call: results = function(arguments).

    ``function`` is the name of a function in the unit, a function of the mathematical library, or a function
    that the caller of the emitted code supplies (:data:`LANGUAGE`).
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
"""The names of the functions that the caller of the emitted code supplies.

``sample`` computes the run-time inputs, and ``measure`` computes the values of the event functions."""

Statement = Assign | Array | For | While | If | Call | Return | Note
Body = tuple[Statement, ...]

# After a division by zero, Python raises an exception, but C continues with an infinity or a NaN.
RAISES_STATUS, RAISES_NAN = "status", "nan"
"""The values of ``Function.guard``.

After an arithmetic error, a function with RAISES_STATUS returns the status NOT_FINITE. With RAISES_NAN, the
return value is NaN, and the arrays that the function changes are filled with NaNs.
"""


@dataclass(frozen=True)
class Function:
    """A function of the emitted code.

    - ``about`` is the comment above the function in the emitted code.
    - ``returns`` is the kind of the result, or None if the function returns nothing.
    - ``public`` is True if the function can be called from outside the unit.
    - ``often`` is True if the function is called in each step and should be inlined.
    - ``near`` is True if the function calls fast variants of the sine, the cosine and the Stumpff functions,
      which are valid only near zero (:mod:`codegen.run.batch`).
    """

    name: str
    about: str
    parameters: tuple[Term, ...]
    body: Body
    returns: Kind | None = None
    # If ``guard`` is empty, the Python function does not catch arithmetic errors.
    guard: str = ""
    # A function that is not public is not visible outside the unit, so compilers may inline it.
    public: bool = False
    often: bool = False
    near: bool = False


@dataclass(frozen=True)
class Record:
    """A record type, for values that the emitted functions keep from one call to the next.

    ``fields`` contains a pair for each value. The first entry is a term (name and type). The second entry is
    a comment for the emitted code. If ``public`` is True, the caller of the emitted code creates the records.
    """

    name: str
    about: str
    fields: tuple[tuple[Term, str], ...]
    public: bool = False


@dataclass(frozen=True)
class Table:
    """A constant array with one or two dimensions. A two-dimensional array is stored row by row."""

    name: Term
    # A one-dimensional array is stored as a single row.
    rows: tuple[tuple[float, ...], ...]
    about: str = ""


@dataclass(frozen=True)
class Unit:
    """All emitted code of one kernel: its records, tables and functions.

    Each function comes after the functions that it calls. ``scalars`` contains the names of t, h and the
    parameters of the kernel.
    """

    scalars: tuple[str, ...]
    records: tuple[Record, ...]
    tables: tuple[Table, ...]
    functions: tuple[Function, ...]
    # The functions by their names.
    parts: dict[str, Function] = field(default_factory=dict, compare=False)

    def __post_init__(self) -> None:
        self.parts.update({f.name: f for f in self.functions})

    def record(self, name: str) -> Record:
        """Return the record type called ``name``."""
        # A unit has only a few record types, so a search is fast enough.
        return next(r for r in self.records if r.name == name)


def blocks(statement: Statement) -> tuple[Body, ...]:
    """Return the bodies of a statement: one for a loop, two for a branch, and none for other statements."""
    match statement:
        case For(body=body) | While(body=body):
            return (body,)
        case If(body=body, orelse=orelse):
            return (body, orelse)
        case _:
            return ()


def direct(statement: Statement) -> tuple[Term, ...]:
    """Return the terms of a statement, without the terms in the bodies of a loop or branch.

    The terms that the statement assigns come before the terms that it only reads.
    """
    match statement:
        case Assign(target, term):
            return (target, term)
        case Array(name, values):
            return (name, *values)
        case For(index, count, when=when):
            # The test ``when`` is optional.
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
    # For a sum over many unknowns, a recursive function could exceed Python's recursion limit.
    waiting = [term for statement in statements(body) for term in direct(statement)]
    while waiting:
        # The last term of the list is taken, so the terms are not yielded in the order of the code.
        term = waiting.pop()
        yield term
        waiting += term.args


def root(target: Term) -> Term:
    """Return the variable that contains ``target``, for example ``memory`` for ``memory.values[3]``."""
    # The first argument of an array entry or record field is the array or the record.
    while target.args:
        target = target.args[0]
    return target


def assigned(statement: Statement) -> tuple[Term, ...]:
    """Return the terms that a statement assigns. Assignments in the bodies of a loop or branch are not
    included."""
    match statement:
        case Assign(target):
            return (target,)
        case Array(name):
            return (name,)
        # A For loop assigns its index.
        case For(index):
            return (index,)
        case Call(results=results):
            return results
        case _:
            return ()


def reads(statement: Statement) -> Iterator[Term]:
    """Yield the names that a statement reads. Names in the body of a loop or branch are omitted.

    An assignment to one entry of an array also counts as reading the array.
    """
    given = assigned(statement)
    # An assignment to a whole variable does not read the variable.
    whole = {id(t) for t in given if t.op == "name"}
    for term in direct(statement):
        if id(term) not in whole:
            yield from names([term])
