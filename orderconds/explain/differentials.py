"""Texts of the elementary differentials and Hamiltonians that belong to trees.

In the texts, ``f''(x, y)`` is the second derivative of f, applied to the vectors x and y. For a function
f(y, z), ``f_zy`` is the mixed second partial derivative. ``[A, B]`` is the commutator of A and B.

The abbreviation HLW denotes the book by Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from orderconds.trees import bicoloured, directed, levels
from orderconds.words.lie import Bracket, standard_bracketing
from orderconds.words.lyndon import is_lyndon
from orderconds.words.shuffle import Letter, Word


def differential(tree: levels.Tree) -> str:
    r"""Return the elementary differential of a rooted tree.

    Source: Hairer, Lubich and Wanner, *Geometric Numerical Integration*, III.1, Definition 1.2.

    >>> differential(b"\0\1\2\1")
    "f''(f'(f), f)"
    """
    return _derivative("f", list(map(differential, levels.children(tree))))


def hamiltonian(tree: levels.Tree) -> str:
    r"""Return the elementary Hamiltonian of a free tree (HLW IX.9.2).

    The choice of the root affects only the sign of the result. H is the Hamiltonian, and f is the Hamiltonian
    vector field.

    >>> hamiltonian(b"\0\1\1")
    "H''(f, f)"
    """
    return _derivative("H", list(map(differential, levels.children(tree))))


def frozen_differential(forest: levels.Forest) -> str:
    r"""Return the differential operator of an ordered forest, or the vector field of an ordered tree.

    ``f[x]`` is the derivative of the vector field f along the vector field x. To compute ``f[x y]``, write y
    as a linear combination of invariant vector fields. Then ``f[x y]`` is the derivative of ``f[y]`` along x,
    with the coefficients of y held constant.

    The operator of a forest is the product of the operators of its trees (Munthe-Kaas and Wright, Found.
    Comput. Math. 8 (2008) 227).

    >>> frozen_differential(b"\0\1\2\1"), frozen_differential(b"\0\1\0")
    ('f[f[f] f]', 'f[f] f')
    """
    factors = []
    for tree in levels.trees_of(forest):
        inside = frozen_differential(levels.branches(tree))
        factors.append(f"f[{inside}]" if inside else "f")
    return " ".join(factors)


def partitioned_differential(tree: bicoloured.BicolouredTree) -> str:
    r"""Return the elementary differential of a tree of two colours.

    The system is y' = f(y, z) and z' = g(y, z). A black vertex denotes f, and a white vertex denotes g.
    Source: Hairer, Lubich and Wanner, *Geometric Numerical Integration*, III.2.1.

    >>> partitioned_differential(b"\0\3\2")
    'f_zy(g, f)'
    """
    below = bicoloured.children(tree)
    letters = "".join("yz"[child[0]] for child in below)
    return _partial("fg"[tree[0]], letters, list(map(partitioned_differential, below)))


def directed_hamiltonian(tree: directed.DirectedTree) -> str:
    r"""Return the elementary Hamiltonian of a tree with directed edges, up to the sign.

    Each vertex denotes a partial derivative of H. Each edge that begins at the vertex adds the subscript q,
    and each edge that ends at the vertex adds the subscript p.

    >>> directed_hamiltonian(b"\0\3\2")
    'H_pq(H_q, H_p)'
    """
    return _directed(tree, "")


def separable_hamiltonian(tree: bicoloured.BicolouredTree) -> str:
    r"""Return the elementary Hamiltonian of a tree of two colours, up to the sign (HLW VI.7.2).
    Neighbouring vertices of the tree must have different colours.

    The Hamiltonian is H = T(p) + V(q). A black vertex denotes T, and a white vertex denotes V.

    >>> separable_hamiltonian(b"\0\3\3")
    'T_pp(V_q, V_q)'
    """
    return _separable(tree, "")


def bracket(word: Word, name: Callable[[Letter], str]) -> str:
    """Return the differential operator of a word as text. Each letter denotes a Lie derivative.

    A Lyndon word is written as a commutator, and any other word as a product. In a product, the leftmost
    letter acts first.

    >>> bracket((1, 1, 2), str), bracket((2, 1), str)
    ('[1, [1, 2]]', '2 1')
    """
    if not is_lyndon(word):
        return " ".join(map(name, word))
    return commutator(standard_bracketing(word), name)


def commutator(nested: Bracket, name: Callable[[Letter], str]) -> str:
    """Return a nested commutator as text. The function ``name`` converts a letter to text.

    >>> commutator(("A", ("A", "B")), str)
    '[A, [A, B]]'
    """
    if not isinstance(nested, tuple):
        return name(nested)
    return f"[{', '.join(commutator(part, name) for part in nested)}]"


def _derivative(name: str, inside: Sequence[str]) -> str:
    if not inside:
        return name
    primes = "'" * len(inside) if len(inside) <= 3 else f"^({len(inside)})"
    return f"{name}{primes}({', '.join(inside)})"


def _partial(name: str, letters: str, inside: Sequence[str]) -> str:
    return (f"{name}_{letters}" if letters else name) + (f"({', '.join(inside)})" if inside else "")


def _directed(tree: directed.DirectedTree, output: str) -> str:
    below = directed.branches(tree)
    letters = "".join("qp"[kind] for kind, _ in below)
    inside = [_directed(child, "pq"[kind]) for kind, child in below]
    return _partial("H", letters + output, inside)


def _separable(tree: bicoloured.BicolouredTree, output: str) -> str:
    below = bicoloured.children(tree)
    variable = "pq"[tree[0]]
    return _partial(
        "TV"[tree[0]], variable * len(below) + output, [_separable(child, "pq"[child[0]]) for child in below]
    )
