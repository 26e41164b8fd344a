"""Substitution: a vector field g replaces the vector field f in the series of a step. The field g is given as
a series in f.

For B-series, the coefficient of a tree is a sum over all partitions of the tree into connected components.
Each partition has a quotient tree, in which each component becomes one vertex. Let a(t) be the coefficient of
a tree t in the series of the step, and let b(t) be the coefficient of t in the series of g. The summand is
a(q) b(t_1) ... b(t_k) for the quotient tree q and the components t_1, ..., t_k (Chartier, Hairer and Vilmart,
Found. Comput. Math. 10 (2010) 407, Theorem 3.2).

For Lie-Butcher series, each forest becomes a linear combination of forests (Lundervold and Munthe-Kaas,
Contemp. Math. 539 (2011) 295, Section 4.3).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from itertools import product

from orderconds.errors import InputError
from orderconds.ring.protocol import Element
from orderconds.series.characters import ROOTED, Character, exact_flow
from orderconds.series.modified_equations import VectorField
from orderconds.trees.grafting import left_graft
from orderconds.trees.levels import Forest, Tree, branches, children, rooted_at_new_vertex, trees_of
from orderconds.trees.ordered import ordered_forests

Combination = dict[Forest, Element]


def substituted(field: VectorField, step: Character) -> Character:
    """Return the series that results from ``step`` if ``field`` replaces the vector field f. The coefficients
    of ``step`` and ``field`` must be elements of one ring.

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.characters import exact_flow
    >>> from orderconds.series.modified_equations import modified_field
    >>> euler = Character(QQ, ROOTED, lambda tree: QQ.rational(len(tree) == 1))
    >>> again = substituted(modified_field(euler), exact_flow(QQ, ROOTED))
    >>> [str(again(tree)) for tree in (b"\\0", b"\\0\\1", b"\\0\\1\\1", b"\\0\\1\\2")]
    ['1', '0', '0', '0']
    """
    if field.algebra is ROOTED:
        return Character(step.ring, ROOTED, lambda tree: _by_partitions(field, step, tree))
    images = _Images(field)

    def value(forest: Forest) -> Element:
        result = step.ring.zero
        for size in range(1, len(forest) + 1):
            for word in ordered_forests(size):
                share = images(word, len(forest)).get(forest)
                if share is not None:
                    result = result + step(word) * share
        return result

    return Character(step.ring, step.algebra, value)


def modifying_field(step: Character) -> VectorField:
    """Return the modifying field of the method ``step`` for the equation y' = f(y). The method, applied to
    the modifying field, gives the exact flow of f.

    For every p, the field truncated after the power h^(p-1) gives a method of order at least p (Chartier,
    Hairer and Vilmart, Math. Comp. 76 (2007) 1941). Raises :class:`~orderconds.errors.InputError` if ``step``
    is a Lie-Butcher series, or if the sum of the weights of the method is proved to differ from 1.

    >>> from orderconds.ring import QQ
    >>> euler = Character(QQ, ROOTED, lambda tree: QQ.rational(len(tree) == 1))
    >>> field = modifying_field(euler)
    >>> [str(field(tree)) for tree in (b"\\0", b"\\0\\1", b"\\0\\1\\1", b"\\0\\1\\2")]
    ['1', '1/2', '1/3', '1/6']
    """
    if step.algebra is not ROOTED:
        raise InputError("a Lie-Butcher series", where="modifying field", expected="a B-series")
    if step.ring.is_zero(step(b"\0") - step.ring.one) is False:
        raise InputError(
            f"the weights sum to {step.ring.text(step(bytes(1)))}",
            where="modifying field",
            expected="a consistent method, whose weights sum to 1",
        )
    flow = exact_flow(step.ring, ROOTED)
    field = VectorField(step.ring, ROOTED, lambda tree: step.ring.zero)

    def value(tree: Tree) -> Element:
        # The sum over all partitions is ``flow(tree)``. In one of the partitions, the only component is
        # ``tree`` itself, and the quotient tree is a single vertex. The summand of this partition is
        # step(vertex) multiplied by field(tree). The factor step(vertex) is 1, because the method is
        # consistent. Hence field(tree) is ``flow(tree)`` minus the summands of all other partitions.
        return flow(tree) - _by_partitions(field, step, tree, whole=False)

    field.define(value)
    return field


def _by_partitions(field: VectorField, step: Character, tree: Tree, *, whole: bool = True) -> Element:
    """Return the coefficient of a tree in the series ``substituted(field, step)``, as a sum over partitions
    of the tree. If ``whole`` is false, the sum omits the partition into one component."""
    result = field.ring.zero
    for components, skeleton in partitions(tree):
        if len(components) == 1 and not whole:
            continue
        term = step(skeleton)
        for component in components:
            term = term * field(component)
        result = result + term
    return result


@lru_cache(maxsize=1 << 12)
def partitions(tree: Tree) -> tuple[tuple[tuple[Tree, ...], Tree], ...]:
    r"""Return all partitions of a canonical tree, as pairs (components, skeleton). The skeleton is the
    quotient tree, in which each component becomes one vertex.

    >>> partitions(b"\0\1")
    (((b'\x00\x01',), b'\x00'), ((b'\x00', b'\x00'), b'\x00\x01'))
    """
    parts = []
    for choice in product((False, True), repeat=len(tree) - 1):
        root, components, skeleton, _ = _parted(tree, choice)
        parts.append(((root, *components), skeleton))
    return tuple(parts)


def _parted(tree: Tree, cut: tuple[bool, ...]) -> tuple[Tree, list[Tree], Tree, tuple[bool, ...]]:
    """Remove edge k of a tree if ``cut[k]`` is true. The edges are numbered in preorder. ``cut`` may contain
    more flags than the tree has edges. Return the component of the root, the other components, the quotient
    tree, and the unused flags. In the quotient tree, each component becomes one vertex."""
    attached: list[Tree] = []
    components: list[Tree] = []
    skeletons: list[Tree] = []
    for child in children(tree):
        taken, cut = cut[0], cut[1:]
        root, others, skeleton, cut = _parted(child, cut)
        components += others
        if taken:
            components.append(root)
            skeletons.append(skeleton)
        else:
            attached.append(root)
            skeletons += children(skeleton)
    return _tree(attached), components, _tree(skeletons), cut


def _tree(below: list[Tree]) -> Tree:
    return rooted_at_new_vertex(b"".join(sorted(below, reverse=True)))


class _Images:
    """The images of ordered forests under the substitution that replaces the vector field f by ``field``.
    Forests with more than a given number of vertices are omitted."""

    def __init__(self, field: VectorField) -> None:
        self._field = field
        self._known: dict[tuple[Forest, int], Combination] = {}

    def __call__(self, word: Forest, most: int) -> Combination:
        if (word, most) not in self._known:
            self._known[word, most] = self._image(word, most)
        return self._known[word, most]

    def _image(self, word: Forest, most: int) -> Combination:
        letters = trees_of(word)
        if not letters:
            return {b"": self._field.ring.one}
        if len(letters) > 1:
            front = b"".join(letters[:-1])
            left, right = self(front, most - len(letters[-1])), self(letters[-1], most - len(front))
            return self._product(left, right, most, lambda u, v: (u + v,))
        return self._product(self(branches(word), most - 1), self._of_vertex(most), most, left_graft)

    def _of_vertex(self, most: int) -> Combination:
        values = {forest: self._field(forest) for n in range(1, most + 1) for forest in ordered_forests(n)}
        return {forest: x for forest, x in values.items() if self._field.ring.is_zero(x) is not True}

    def _product(
        self,
        x: Combination,
        y: Combination,
        most: int,
        multiply: Callable[[Forest, Forest], tuple[Forest, ...]],
    ) -> Combination:
        result: Combination = {}
        for u, a in x.items():
            for v, b in y.items():
                if len(u) + len(v) <= most:
                    for forest in multiply(u, v):
                        result[forest] = result.get(forest, self._field.ring.zero) + a * b
        return result
