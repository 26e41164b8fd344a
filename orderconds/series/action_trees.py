"""The trees that index the action series of variational Lie group methods on T*G.

Here g is the Lie algebra of G, g* its dual, and H(q, mu) the Hamiltonian. A g-valued tree denotes an element
of g, and a g*-valued tree denotes an element of g*. A word is a sequence of g-valued trees, called letters.
The elements of a multiset are always g*-valued trees. Each element of g, and therefore each letter, defines a
right-invariant vector field on G. There are three kinds of trees:

- A :class:`Velocity` is a g-valued tree with a word w and a multiset M, written (w, M) or ``o(w | M)``. The
  tree denotes a mixed derivative of the vector dH/dmu. Let t_1, ..., t_k be the elements of g that the
  letters of w denote. For the derivatives in q, replace q by exp(e_k t_k) ... exp(e_1 t_1) q, and
  differentiate once with respect to each of the numbers e_1, ..., e_k at zero. For the derivatives in mu, the
  directions are the covectors that the trees in M denote.
- A :class:`Force` is a g*-valued tree with two words u and v and a multiset M, written ``H(u * v | M)`` or
  ``f(u * v | M)``. The tree denotes a covector. The value of the covector at an element x of g is a mixed
  derivative of H. The derivatives in q and in mu are defined as for the :class:`Velocity`, but with a
  different list t_1, ..., t_k. The list consists of the elements of g that the letters of u denote, then x,
  and then the elements of g that the letters of v denote.
- A :class:`Transport` is a g*-valued tree with a word w, written ``L(w)``. The tree denotes the covector that
  maps an element x of g to ``<mu, ad t_1 ... ad t_k x>``. Here t_1, ..., t_k are the elements of g that the
  letters of w denote, and ``<mu, y>`` is the pairing of mu with y.

Each :class:`Velocity` also defines an elementary Hamiltonian (:func:`hamiltonian`). The elementary
Hamiltonians are the terms of the generating function of a step of a method. Equal trees are identical
objects.
"""

from __future__ import annotations

from functools import cache
from math import factorial, prod


class _Node:
    """The base class of the three kinds of trees.

    The cost of a tree measures how difficult the order condition of the tree is to read.
    """

    __slots__ = ("_key", "_text", "cost", "vertices")

    vertices: int
    cost: int
    _text: str | None
    _key: tuple[int, int, int, str] | None

    def _describe(self, vertices: int, cost: int) -> None:
        self.vertices, self.cost, self._text, self._key = vertices, cost, None, None

    @property
    def text(self) -> str:
        """The canonical text. Different trees have different texts."""
        if self._text is None:
            self._text = self._render()
        return self._text

    @property
    def key(self) -> tuple[int, int, int, str]:
        """The sort key: the attributes ``vertices`` and ``cost``, the length of ``text``, and ``text``."""
        if self._key is None:
            text = self.text
            self._key = (self.vertices, self.cost, len(text), text)
        return self._key

    def _render(self) -> str:
        raise TypeError("a subclass of _Node must define the method _render")

    def __str__(self) -> str:
        return self.text

    __repr__ = __str__


class Velocity(_Node):
    """The g-valued tree t = (w, M), where w is a word of g-valued trees, and M is a multiset of g*-valued
    trees. Use :func:`velocity` to create trees.

    >>> tree = velocity((velocity(),), (force(), force()))
    >>> tree, tree.vertices, tree.symmetry
    (o(o|f(*) f(*)), 4, 2)
    """

    __slots__ = ("momenta", "nesting", "word")

    nesting: int

    def __init__(self, word: Word, momenta: Momenta) -> None:
        self.word, self.momenta = word, momenta
        vertices, cost = 1, mixing(word)
        for letter in word:
            vertices += letter.vertices
            cost += letter.nesting
        for p in momenta:
            vertices += p.vertices
            cost += p.cost
        self._describe(vertices, cost)
        # The factor 2 gives deep trees a higher cost, because deep trees are harder to read than wide trees.
        self.nesting = 2 + 2 * cost if vertices > 1 else 0

    def _render(self) -> str:
        inner = _inside(" ".join([t.text for t in self.word]), self.momenta)
        return f"o({inner})" if inner else "o"

    @property
    def symmetry(self) -> int:
        """The order of the symmetry group of the tree."""
        return _symmetry(self.word, self.momenta)


class Force(_Node):
    """The g*-valued tree f(u * v | M). Here u and v are words of g-valued trees, the symbol * separates these
    words, and M is a multiset of g*-valued trees. The attribute ``before`` is u, the attribute ``after`` is
    v, and the attribute ``momenta`` is M. Use :func:`force` to create trees.

    >>> tree = force((), (velocity(),))
    >>> tree, tree.vertices
    (f(* o), 2)
    """

    __slots__ = ("after", "before", "momenta")

    def __init__(self, before: Word, after: Word, momenta: Momenta) -> None:
        self.before, self.after, self.momenta = before, after, momenta
        vertices = 1 + sum([child.vertices for child in (*before, *after, *momenta)])
        self._describe(vertices, force_cost(before, after) + sum([p.cost for p in momenta]))

    def _render(self) -> str:
        letters = " ".join([*[t.text for t in self.before], "*", *[t.text for t in self.after]])
        return f"f({_inside(letters, self.momenta)})"

    @property
    def symmetry(self) -> int:
        """The order of the symmetry group of the tree. The order is a product of factorials. Each distinct
        element of each multiset in the tree contributes one factor n!, where n is the multiplicity of the
        element in the multiset."""
        return _symmetry(self.before + self.after, self.momenta)


class Transport(_Node):
    """A g*-valued tree, written L(w). Here w is a non-empty word of g-valued trees. Use :func:`transport` to
    create trees.

    >>> tree = transport((velocity(), velocity()))
    >>> tree, tree.vertices
    (L(o o), 2)
    """

    __slots__ = ("word",)

    def __init__(self, word: Word) -> None:
        self.word = word
        self._describe(sum([letter.vertices for letter in word]), transport_cost(word))

    def _render(self) -> str:
        return f"L({' '.join([t.text for t in self.word])})"

    @property
    def symmetry(self) -> int:
        """The order of the symmetry group of the tree. It is the product of ``letter.symmetry`` over all
        letters of ``word``."""
        return _symmetry(self.word, ())


Momentum = Force | Transport
Word = tuple[Velocity, ...]
Momenta = tuple[Momentum, ...]


def _inside(letters: str, momenta: Momenta) -> str:
    return letters + ("|" + " ".join(p.text for p in momenta) if momenta else "")


def mixing(word: Word) -> int:
    """Return one summand of the cost of a :class:`Velocity` with the word ``word``. The cost of a tree
    measures how difficult the order condition of the tree is to read.

    If all letters of the word are equal, the summand is zero. Otherwise, the summand is 5 (k - 1), where k is
    the number of letters.

    >>> mixing((velocity(), velocity())), mixing((velocity(), velocity((velocity(),))))
    (0, 5)
    """
    return 0 if len(word) < 2 or len(set(word)) == 1 else 5 * (len(word) - 1)


def force_cost(before: Word, after: Word) -> int:
    """Return the cost of the tree f(u * v) with the words u = ``before`` and v = ``after``
    (:class:`Force`). The cost measures how difficult an order condition with this tree is to read.

    >>> force_cost((), ()), force_cost((velocity(),), ())
    (3, 9)
    """
    letters = before + after
    return 3 + sum([letter.nesting for letter in letters]) + 6 * len(letters)


def transport_cost(word: Word) -> int:
    """Return the cost of the :class:`Transport` with the word ``word``. If the cost is low, an order
    condition with this ``Transport`` is easy to read.

    >>> transport_cost((velocity(), velocity()))
    10
    """
    return 4 + sum([letter.nesting for letter in word]) + 6 * (len(word) - 1)


def _symmetry(word: Word, momenta: Momenta) -> int:
    repeats = prod(factorial(momenta.count(p)) for p in dict.fromkeys(momenta))
    return repeats * prod(t.symmetry for t in word) * prod(p.symmetry for p in momenta)


@cache
def canonical_velocity(word: Word, momenta: Momenta) -> Velocity:
    """Return the :class:`Velocity` with the word ``word`` and the multiset ``momenta``. The trees in
    ``momenta`` must be in canonical order.

    >>> canonical_velocity((), (force(), transport((velocity(),))))
    o(|f(*) L(o))
    """
    return Velocity(word, momenta)


@cache
def canonical_force(before: Word, after: Word, momenta: Momenta) -> Force:
    """Return the :class:`Force` with the words ``before`` and ``after`` and the multiset ``momenta``. The
    trees in ``momenta`` must be in canonical order.

    >>> canonical_force((velocity(),), (), ())
    f(o *)
    """
    return Force(before, after, momenta)


@cache
def transport(word: Word) -> Transport:
    """Return the tree L(w), where w is the word with the letters t_1, ..., t_k. The tree denotes the covector
    that maps x to the number ``<mu, ad t_1 ... ad t_k x>``. Here mu is the momentum at the end of the step.

    >>> transport((velocity(),))
    L(o)
    """
    if not word:
        raise ValueError("the word w of a tree L(w) must have at least one letter")
    return Transport(word)


def multiset(momenta: Momenta) -> Momenta:
    """Sort the trees of a multiset into canonical order, by their sort keys.

    >>> multiset((transport((velocity(),)), force()))
    (f(*), L(o))
    """
    return momenta if len(momenta) < 2 else tuple(sorted(momenta, key=lambda p: p.key))


def velocity(word: Word = (), momenta: Momenta = ()) -> Velocity:
    """Return the :class:`Velocity` with the word ``word`` and the multiset ``momenta``. The trees in
    ``momenta`` need not be sorted.

    >>> velocity((velocity(),), (force(), transport((velocity(),))))
    o(o|f(*) L(o))
    """
    return canonical_velocity(word, multiset(momenta))


def force(before: Word = (), after: Word = (), momenta: Momenta = ()) -> Force:
    """Return the :class:`Force` with the words ``before`` and ``after`` and the multiset ``momenta``. The
    trees in ``momenta`` need not be sorted.

    >>> force((velocity(),), (), (force(),))
    f(o *|f(*))
    """
    return canonical_force(before, after, multiset(momenta))


def hamiltonian(tree: Velocity) -> str:
    """Return the elementary Hamiltonian of a tree as text. In the text, ``m`` denotes mu, and ``ad(x) y`` is
    [x, y].

    The letters after ``H_`` are the variables in which H is differentiated. The parentheses contain the
    directions of differentiation. A semicolon separates the directions in q from the directions in mu. A
    direction in mu is a linear function on the Lie algebra. A dot denotes the argument of this function.

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
