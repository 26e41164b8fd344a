"""Terms: the symbolic expressions in the statements of the run representation (:mod:`codegen.run.language`).

A term is an expression with reals, counts, flags, status codes or arrays. Python operators build terms and
compute nothing:

>>> change, scale = real("change"), real("scale")
>>> (change <= 0.5 * scale).op
'<='
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import lru_cache, reduce

from codegen.ir.expr import Expr

OK, NOT_CONVERGED, NOT_FINITE, BAD_STEP, LIMIT = "OK", "NOT_CONVERGED", "NOT_FINITE", "BAD_STEP", "LIMIT"
TOO_FAR, SINGULAR, TOO_SHORT = "TOO_FAR", "SINGULAR", "TOO_SHORT"
EVENT, BAD_TIMES, LEAST_STEP, BAD_EVENT = "EVENT", "BAD_TIMES", "LEAST_STEP", "BAD_EVENT"
BAD_SHAPE = "BAD_SHAPE"
BAD_OPERATOR = "BAD_OPERATOR"
# New codes must be added at the end. Otherwise the numbers of the old codes would change.
STATUSES = (
    *(OK, NOT_CONVERGED, NOT_FINITE, BAD_STEP, LIMIT, TOO_FAR, SINGULAR, TOO_SHORT),
    *(EVENT, BAD_TIMES, LEAST_STEP, BAD_EVENT, BAD_SHAPE, BAD_OPERATOR),
)
"""The status codes. The number of a code is its index in this tuple."""


class Kind(Enum):
    """The kind of a term.

    A REAL has the precision of the emitted code. A WIDE is a double, even if the emitted code uses single
    precision.
    """

    REAL = "real"
    WIDE = "wide"
    COUNT = "count"
    # Flags differ from counts, because array languages distinguish booleans from integers.
    FLAG = "flag"
    STATUS = "status"
    RECORD = "record"
    SIGNAL = "signal"
    EVENTS = "events"


@dataclass(frozen=True, eq=False)
class Term:
    """A symbolic expression: an operation on terms, a name, or a constant.

    - ``text`` is the name of a variable, function or field.
    - ``own`` is True if ``text`` comes from a kernel (:class:`codegen.ir.kernel.Kernel`), otherwise False.
    - ``shape`` is the shape of an array, and () for a single value. A size of 0 means that the size is known
      only at run time.
    - ``optional`` is True for an argument that the caller may omit.
    - ``cell`` is True for a parameter that is a pointer to one number in C.
    """

    op: str
    args: tuple[Term, ...] = ()
    kind: Kind = Kind.REAL
    text: str = ""
    number: float = 0.0
    value: Expr | None = None
    shape: tuple[int, ...] = ()
    own: bool = False
    optional: bool = False
    cell: bool = False
    record: str = field(default="")

    def __add__(self, other: Operand) -> Term:
        return _arithmetic("+", self, other)

    # Python calls the reversed methods if the left operand is a number.
    def __radd__(self, other: Operand) -> Term:
        return _arithmetic("+", _term(other, self), self)

    def __sub__(self, other: Operand) -> Term:
        return _arithmetic("-", self, other)

    def __rsub__(self, other: Operand) -> Term:
        return _arithmetic("-", _term(other, self), self)

    def __mul__(self, other: Operand) -> Term:
        return _arithmetic("*", self, other)

    def __rmul__(self, other: Operand) -> Term:
        return _arithmetic("*", _term(other, self), self)

    def __truediv__(self, other: Operand) -> Term:
        return _arithmetic("/", self, other)

    def __rtruediv__(self, other: Operand) -> Term:
        return _arithmetic("/", _term(other, self), self)

    # Counts are never negative, so C and Python compute the same quotients and remainders.
    def __floordiv__(self, other: Operand) -> Term:
        return _arithmetic("//", self, other)

    def __mod__(self, other: Operand) -> Term:
        return _arithmetic("%", self, other)

    def __neg__(self) -> Term:
        return Term("neg", (self,), self.kind)

    # The operator ``==`` compares the identity of two objects, and builds no term. The method ``equals``
    # builds the comparison of two terms.
    def __lt__(self, other: Operand) -> Term:
        return _comparison("<", self, other)

    def __le__(self, other: Operand) -> Term:
        return _comparison("<=", self, other)

    def __gt__(self, other: Operand) -> Term:
        return _comparison(">", self, other)

    def __ge__(self, other: Operand) -> Term:
        return _comparison(">=", self, other)

    def equals(self, other: Operand) -> Term:
        """Return the comparison ``self == other`` of counts or status codes."""
        return _comparison("==", self, other)

    def differs(self, other: Operand) -> Term:
        """Return the comparison ``self != other``. Both operands are counts or status codes."""
        return _comparison("!=", self, other)

    def __getitem__(self, index: Operand) -> Term:
        """Return an entry of an array, or a row of a two-dimensional array."""
        place = _term(index, _COUNT)
        # Indexing removes the first dimension. An entry of an array of records is a record of the same type.
        return Term("item", (self, place), self.kind, shape=self.shape[1:], record=self.record)

    def __iter__(self) -> Iterator[Term]:
        """Raise TypeError, because an array is not a Python sequence."""
        # Without this method, Python would iterate by calling ``__getitem__`` with 0, 1, 2, ... The iteration
        # would never end, because ``__getitem__`` accepts every index.
        raise TypeError("a Term is symbolic and cannot be iterated; read its entries by index, such as x[0]")

    def part(self, start: int, size: int) -> Term:
        """Return a part of this array: ``size`` entries that begin at index ``start``."""
        # If the part is the whole array, the array itself is returned. The emitted code then contains no
        # offset in C and no slice in Python.
        if start == 0 and self.shape == (size,):
            return self
        return Term("part", (self,), self.kind, number=start, shape=(size,))

    def field(self, name: str, kind: Kind = Kind.REAL, shape: tuple[int, ...] = ()) -> Term:
        """Return the field ``name`` of a record."""
        return Term("field", (self,), kind, name, shape=shape)


Operand = Term | float | int

# In ``x[2]``, the index 2 must become a term of the kind COUNT and not of the kind REAL.
_COUNT = Term("name", kind=Kind.COUNT)


def _term(x: Operand, like: Term) -> Term:
    if isinstance(x, Term):
        return x
    # If the other operand ``like`` is a count or a flag, the Python number becomes a count.
    counted = like.kind in (Kind.COUNT, Kind.FLAG)
    return Term("number", kind=Kind.COUNT if counted else Kind.REAL, number=x)


def _arithmetic(op: str, x: Term, y: Operand) -> Term:
    # If at least one operand is wide (a double), the result is wide, as in C.
    right = _term(y, x)
    return Term(op, (x, right), Kind.WIDE if Kind.WIDE in (x.kind, right.kind) else x.kind)


def _comparison(op: str, x: Term, y: Operand) -> Term:
    # A Python number ``y`` becomes a count if ``x`` is a count or a flag, and a real otherwise.
    return Term(op, (x, _term(y, x)), Kind.FLAG)


def real(name: str, *shape: int, optional: bool = False, cell: bool = False) -> Term:
    """Return a real variable called ``name``, or an array of reals with the given shape."""
    return Term("name", (), Kind.REAL, name, shape=shape, optional=optional, cell=cell)


def count(name: str, *shape: int, optional: bool = False, cell: bool = False) -> Term:
    """Return a variable for a count (an integer that is never negative), or an array of counts."""
    return Term("name", (), Kind.COUNT, name, shape=shape, optional=optional, cell=cell)


def flag(name: str) -> Term:
    """Return a flag: a variable that is true or false."""
    return Term("name", (), Kind.FLAG, name)


def own(name: str, *shape: int) -> Term:
    """Return a variable of the kind REAL with a name from the kernel. With a shape, it is an array."""
    return Term("name", (), Kind.REAL, name, shape=shape, own=True)


def record(name: str, of: str, *shape: int, optional: bool = False) -> Term:
    """Return a record of the type ``of``, or an array of such records."""
    return Term("name", (), Kind.RECORD, name, shape=shape, optional=optional, record=of)


def signal(name: str) -> Term:
    """Return the function ``name`` as a term. The function maps a time to an array with the values of all
    run-time inputs at this time.
    """
    return Term("name", (), Kind.SIGNAL, name)


EVENT_FUNCTIONS = Term("name", (), Kind.EVENTS, "event")
"""The function of time and state that returns the values of all event functions."""


STATUS = Term("name", (), Kind.STATUS, "status")
"""The variable that contains the status in every emitted function."""


def code(name: str) -> Term:
    """Return the constant for the status code ``name``, one of :data:`STATUSES`."""
    return Term("status", (), Kind.STATUS, name)


def number(x: float) -> Term:
    """Return ``x`` as a constant term of the kind REAL."""
    return Term("number", (), Kind.REAL, number=x)


def whole(n: int) -> Term:
    """Return ``n`` as a constant term of the kind COUNT."""
    return Term("number", (), Kind.COUNT, number=n)


def truth(x: bool) -> Term:
    """Return ``x`` as a constant term of the kind FLAG."""
    return Term("number", (), Kind.FLAG, number=int(x))


def value(x: Expr) -> Term:
    """Return the expression ``x`` as a term. A symbol becomes the variable with the name of the symbol."""
    # A single symbol gets the ``op`` "name", because passes and printers recognise variables by this ``op``.
    if x.op == "sym":
        return own(x.payload)
    return Term("value", value=x)


# Infinity is a separate operation, because C and Python have no common constant for infinity.
INFINITY = Term("infinity")


def both(*tests: Term) -> Term:
    """Return the conjunction of tests. C and Python evaluate no test after the first false one."""
    # The tests are nested as ``(a and b) and c``, because this needs no parentheses in C and Python.
    return reduce(lambda a, b: Term("and", (a, b), Kind.FLAG), tests)


def either(*tests: Term) -> Term:
    """Return the disjunction of tests. C and Python evaluate no test after the first true one."""
    return reduce(lambda a, b: Term("or", (a, b), Kind.FLAG), tests)


def negated(test: Term) -> Term:
    """Return the negation of a test."""
    return Term("not", (test,), Kind.FLAG)


def select(test: Term, yes: Operand, no: Operand) -> Term:
    """Return the term that has the value ``yes`` if the test is true, and the value ``no`` otherwise.

    An array language computes both values and selects one (:mod:`codegen.run.language`).
    """
    # If only one of ``yes`` and ``no`` is a Python number, the other value determines whether the number
    # becomes an integer or a real. Two Python numbers become reals.
    like = yes if isinstance(yes, Term) else no if isinstance(no, Term) else number(0.0)
    first, second = _term(yes, like), _term(no, like)
    return Term("select", (test, first, second), first.kind)


def call(function: str, *args: Term) -> Term:
    """Return a call of a mathematical function, such as ``sqrt`` or ``copysign``."""
    return Term("call", args, Kind.REAL, function)


def size(x: Term) -> Term:
    """Return the absolute value of a real."""
    return call("abs", x)


def greatest(terms: Iterable[Term]) -> Term:
    """Return the maximum of one or more reals."""
    listed = tuple(terms)
    # A single term needs no call. In Python, the call ``max(x)`` would be an error if ``x`` is a number.
    return listed[0] if len(listed) == 1 else call("greatest", *listed)


def largest(array: Term) -> Term:
    """Return the largest absolute value in an array."""
    return call("largest", array)


def is_finite(x: Term) -> Term:
    """Return the term that tests whether a real is finite."""
    return Term("call", (x,), Kind.FLAG, "isfinite")


def all_finite(*terms: Term) -> Term:
    """Return the term that tests whether all ``terms`` are finite. For an array, all entries are tested."""
    return Term("finite", terms, Kind.FLAG)


def total(terms: Iterable[Term]) -> Term:
    """Return the sum of terms, added from left to right."""
    # The order of the additions is fixed. Therefore C and Python have the same rounding errors.
    return reduce(lambda a, b: a + b, terms)


def paired(terms: Iterable[Term]) -> Term:
    """Return the sum of terms, for example ((a + b) + (c + d)) + (e + f).

    Neighbouring terms are added in pairs. The sums of the pairs are added from left to right.
    """
    listed = list(terms)
    if len(listed) < 3:
        return total(listed)
    # A processor can compute the sums a + b and c + d at the same time.
    # Compilers are not allowed to regroup a sum, so the grouping is chosen here.
    return total(total(listed[k : k + 2]) for k in range(0, len(listed), 2))


def given(argument: Term) -> Term:
    """Return the term that tests whether the caller has passed an optional argument."""
    return Term("given", (argument,), Kind.FLAG)


def absent(parameter: Term) -> Term:
    """Return the argument that a call passes in place of an omitted optional argument.

    The argument is printed as NULL in C and as None in Python. ``parameter`` is the parameter of the called
    function.
    """
    # The printers read the kind and the shape of the argument. ``replace`` keeps the kind and the shape of
    # ``parameter``.
    return replace(parameter, op="none", args=())


def holding(inputs: Term) -> Term:
    """Return a constant signal: a function of time that has the value ``inputs`` at all times."""
    return Term("holding", (inputs,), Kind.SIGNAL)


def fresh(of: Term) -> Term:
    """Return a record of the same type as ``of``, with all fields equal to zero."""
    return Term("fresh", (), Kind.RECORD, record=of.record)


def wide(x: Term) -> Term:
    """Return the term that converts ``x`` to double precision."""
    return Term("wide", (x,), Kind.WIDE)


def narrow(x: Term) -> Term:
    """Return the term that rounds a double to the precision of the emitted code."""
    return Term("narrow", (x,))


def names(terms: Iterable[Term]) -> Iterator[Term]:
    """Yield the variables in ``terms``.

    If a term contains an expression (:attr:`Term.value`), the symbols of the expression are names of
    variables. These variables are yielded, too.
    """
    # ``pop`` takes the last term of the list, so the terms are listed in reverse order.
    waiting = list(terms)[::-1]
    while waiting:
        term = waiting.pop()
        if term.op == "name":
            yield term
        elif term.value is not None:
            yield from map(_read, symbols(term.value))
        waiting += term.args[::-1]


@lru_cache(maxsize=4096)
def _read(name: str) -> Term:
    """Return the variable for the symbol ``name``."""
    return own(name)


def symbols(root: Expr) -> Iterator[str]:
    """Yield the symbols of an expression in the order in which they first occur."""
    # Without the set ``seen``, a shared subexpression would be visited many times, and the walk could take
    # exponential time.
    seen: set[int] = set()
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if node.id in seen:
            continue
        seen.add(node.id)
        if node.op == "sym":
            yield node.payload
        waiting += node.args[::-1]
