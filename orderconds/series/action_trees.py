"""The trees of the action series on T*G: what a variational Lie group method composes out of one Hamiltonian.

Every vertex is a copy of H, except that a :class:`Transport` costs nothing. Two mutually recursive kinds:

- g-valued ``t = (word w of t's, multiset M of p's)``, a :class:`Velocity`: ``D_mu H`` differentiated along
  the word of right-invariant fields w (the first letter acts first) and along the covectors of M;
- g*-valued ``p``: a :class:`Force` ``H(u * v | M)``, which is ``D_q H`` with its own direction standing in
  the word between u and v, or a :class:`Transport` ``L(t_1 ... t_k)``, the covector ``x -> <mu, ad t_1 ...
  ad t_k x>``.

A velocity names at the same time the elementary Hamiltonian that has its root vertex without the outgoing
leg: ``o(w | M)`` is the coefficient of ``H_{q..mu..}[w; M]`` in the generating function. Nodes are
interned, so that identity is equality, and every list has one canonical order: simplest to read first.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from math import factorial, prod


class _Node:
    """What the three kinds share: number of copies of H, a reading cost, symmetry, canonical text."""

    __slots__ = ("cost", "key", "text", "vertices")

    vertices: int
    cost: int
    text: str
    key: tuple[int, int, int, str]

    def _describe(self, vertices: int, cost: int, text: str) -> None:
        self.vertices, self.cost, self.text = vertices, cost, text
        self.key = (vertices, cost, len(text), text)

    def __str__(self) -> str:
        return self.text

    __repr__ = __str__


class Velocity(_Node):
    """The g-valued tree t = (w, M); made by :func:`velocity`.

    >>> tree = velocity((velocity(),), (force(), force()))
    >>> tree, tree.vertices, tree.symmetry
    (o(o|f(*) f(*)), 4, 2)
    """

    __slots__ = ("momenta", "word")

    def __init__(self, word: Word, momenta: Momenta) -> None:
        self.word, self.momenta = word, momenta
        children: list[_Node] = [*word, *momenta]
        inner = _inside(" ".join(t.text for t in word), momenta)
        self._describe(
            1 + sum(c.vertices for c in children),
            _nesting(word) + sum(p.cost for p in momenta) + _mixing(word),
            f"o({inner})" if inner else "o",
        )

    @property
    def symmetry(self) -> int:
        """The order of the group of symmetries, which permute momenta."""
        return _symmetry(self.word, self.momenta)


class Force(_Node):
    """The g*-valued tree H(u * v | M); made by :func:`force`.

    >>> tree = force((), (velocity(),))
    >>> tree, tree.vertices
    (f(* o), 2)
    """

    __slots__ = ("after", "before", "momenta")

    def __init__(self, before: Word, after: Word, momenta: Momenta) -> None:
        self.before, self.after, self.momenta = before, after, momenta
        children: list[_Node] = [*before, *after, *momenta]
        letters = " ".join([*(t.text for t in before), "*", *(t.text for t in after)])
        self._describe(
            1 + sum(c.vertices for c in children),
            3 + _nesting(before + after) + sum(p.cost for p in momenta) + 6 * (len(before) + len(after)),
            f"f({_inside(letters, momenta)})",
        )

    @property
    def symmetry(self) -> int:
        """The order of the group of symmetries, which permute momenta."""
        return _symmetry(self.before + self.after, self.momenta)


class Transport(_Node):
    """The g*-valued tree L(w), w not empty; made by :func:`transport`.

    >>> tree = transport((velocity(), velocity()))
    >>> tree, tree.vertices
    (L(o o), 2)
    """

    __slots__ = ("word",)

    def __init__(self, word: Word) -> None:
        self.word = word
        self._describe(
            sum(t.vertices for t in word),
            4 + _nesting(word) + 6 * (len(word) - 1),
            f"L({' '.join(t.text for t in word)})",
        )

    @property
    def symmetry(self) -> int:
        """The order of the group of symmetries."""
        return _symmetry(self.word, ())


Momentum = Force | Transport
Word = tuple[Velocity, ...]
Momenta = tuple[Momentum, ...]


def _inside(letters: str, momenta: Momenta) -> str:
    return letters + ("|" + " ".join(p.text for p in momenta) if momenta else "")


def _nesting(word: Word) -> int:
    """A bushy tree reads better than a tall one: what stands inside letters counts double."""
    return sum(2 + 2 * t.cost for t in word if t.vertices > 1)


def _mixing(word: Word) -> int:
    """Words of one repeated letter are powers of a sum; any other needs sums over ordered indices."""
    return 0 if len(set(word)) <= 1 else 5 * (len(word) - 1)


def _symmetry(word: Word, momenta: Momenta) -> int:
    repeats = prod(factorial(momenta.count(p)) for p in dict.fromkeys(momenta))
    return repeats * prod(t.symmetry for t in word) * prod(p.symmetry for p in momenta)


@cache
def _velocity(word: Word, momenta: Momenta) -> Velocity:
    return Velocity(word, momenta)


@cache
def _force(before: Word, after: Word, momenta: Momenta) -> Force:
    return Force(before, after, momenta)


@cache
def transport(word: Word) -> Transport:
    """Return L(w): ``x -> <mu, ad t_1 ... ad t_k x>`` at the end of the step.

    >>> transport((velocity(),))
    L(o)
    """
    if not word:
        raise ValueError("L needs a letter: the empty word is mu itself")
    return Transport(word)


def multiset(momenta: Momenta) -> Momenta:
    """Return the canonical order of a multiset of g*-valued trees.

    >>> multiset((transport((velocity(),)), force()))
    (f(*), L(o))
    """
    return tuple(sorted(momenta, key=lambda p: p.key))


def velocity(word: Word = (), momenta: Momenta = ()) -> Velocity:
    """Return the g-valued tree (w, M); the order inside M does not matter, that inside w does.

    >>> velocity((velocity(),), (force(), transport((velocity(),))))
    o(o|f(*) L(o))
    """
    return _velocity(word, multiset(momenta))


def force(before: Word = (), after: Word = (), momenta: Momenta = ()) -> Force:
    """Return the g*-valued tree H(u * v | M).

    >>> force((velocity(),), (), (force(),))
    f(o *|f(*))
    """
    return _force(before, after, multiset(momenta))


@cache
def velocities(vertices: int) -> tuple[Velocity, ...]:
    """Return every g-valued tree with that many copies of H, simplest first.

    >>> [len(velocities(n)) for n in range(1, 5)]
    [1, 3, 17, 111]
    >>> velocities(2)
    (o(o), o(|f(*)), o(|L(o)))
    """
    found = [
        _velocity(word, momenta)  # a multiset is made in canonical order
        for k in range(vertices)
        for word in words(k)
        for momenta in multisets(vertices - 1 - k)
    ]
    return tuple(sorted(found, key=lambda t: t.key))


@cache
def words(vertices: int) -> tuple[Word, ...]:
    """Return every word of g-valued trees with that many copies of H in all.

    >>> words(2)
    ((o, o), (o(o),), (o(|f(*)),), (o(|L(o)),))
    """
    if vertices == 0:
        return ((),)
    return tuple(
        (*start, last)
        for k in range(1, vertices + 1)
        for start in words(vertices - k)
        for last in velocities(k)
    )


@cache
def momenta(vertices: int) -> Momenta:
    """Return every g*-valued tree with that many copies of H, simplest first.

    >>> [len(momenta(n)) for n in range(1, 5)]
    [2, 8, 48, 328]
    """
    found: list[Momentum] = [
        _force(before, after, others)
        for j in range(vertices)
        for before in words(j)
        for k in range(vertices - j)
        for after in words(k)
        for others in multisets(vertices - 1 - j - k)
    ]
    found += [transport(word) for word in words(vertices) if word]
    return tuple(sorted(found, key=lambda p: p.key))


@cache
def multisets(vertices: int) -> tuple[Momenta, ...]:
    """Return every multiset of g*-valued trees with that many copies of H, ordered as :func:`multiset` does.

    >>> multisets(1)
    ((f(*),), (L(o),))
    """
    return tuple(_multisets(vertices, vertices, None))


def _multisets(vertices: int, largest: int, bound: int | None) -> Iterator[Momenta]:
    """Yield multisets in decreasing order of (vertices, place in the list); bound is the last place used."""
    if vertices == 0:
        yield ()
        return
    for size in range(1, min(vertices, largest) + 1):
        places = momenta(size)
        stop = len(places) if bound is None or size < largest else bound + 1
        for place in range(stop):
            for rest in _multisets(vertices - size, size, place):
                yield (*rest, places[place])


def hamiltonian(tree: Velocity) -> str:
    """Return the elementary Hamiltonian that a tree names; ``m`` stands for mu, ``ad(x) y = [x, y]``.

    Arguments before the semicolon are right-invariant derivatives in q, the first one acting first.

    >>> hamiltonian(velocity((velocity(), velocity())))
    'H_qq(H_m, H_m)'
    >>> hamiltonian(velocity((), (force(), transport((velocity(),)))))
    'H_mm(; H_q(.), <m, ad(H_m) .>)'
    """
    return _derivative(tree.word, None, (), tree.momenta, "")


def _derivative(before: Word, slot: str | None, after: Word, momenta: Momenta, output: str) -> str:
    letters = [*map(_vector, before), *([slot] if slot else []), *map(_vector, after)]
    index = "q" * len(letters) + "m" * len(momenta) + output
    inner = ", ".join(letters) + ("; " + ", ".join(map(_covector, momenta)) if momenta else "")
    return ("H_" + index if index else "H") + (f"({inner})" if inner else "")


def _vector(tree: Velocity) -> str:
    return _derivative(tree.word, None, (), tree.momenta, "m")


def _covector(tree: Momentum) -> str:
    if isinstance(tree, Force):
        return _derivative(tree.before, ".", tree.after, tree.momenta, "")
    return "<m, " + " ".join(f"ad({_vector(t)})" for t in tree.word) + " .>"
