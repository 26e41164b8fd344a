"""Sequences of all trees of one kind and order. A notebook displays such a sequence as drawings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import overload

from orderconds.argument import TREE_ORDER, integer
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.explain import kinds, lines
from orderconds.explain.kinds import Kind, Member
from orderconds.explain.svg import sheet
from orderconds.explain.tikz import picture

MAX_TREES = 100_000
"""The largest number of trees, forests or words that are enumerated."""

DRAWN = 500
"""The largest number of trees that a notebook displays in one picture."""


@dataclass(frozen=True, repr=False)
class ShownTree:
    """A tree of the kind ``kind``, for example a rooted tree. The class prints and draws the tree.

    Some kinds consist of forests or words. For these kinds, "tree" means a forest or a word.

    >>> tree = trees("rooted", 3)[1]
    >>> tree.text, tree.differential, str(tree.condition)
    ('[..]', "f''(f, f)", 'sum_i b_i c_i^2 = 1/3')
    """

    kind: Kind
    member: Member
    order: int

    @property
    def text(self) -> str:
        """The tree as text, such as ``[..]``."""
        return self.kind.text(self.member)

    @property
    def differential(self) -> str:
        """The elementary differential or Hamiltonian of the tree."""
        return self.kind.names(self.member)

    @property
    def condition(self) -> OrderCondition | None:
        """The order condition of this tree for methods of the family ``kind.family()``. None if the tree has
        no condition in this family."""
        return self.kind.conditions(self.order).get(self.member)

    def drawing(self, *, ascii_only: bool = False) -> str:
        """Return a drawing as text, with the root in the first line."""
        style = lines.ASCII if ascii_only else lines.UNICODE
        return "\n".join(lines.draw(self.kind.diagram(self.member), style))

    def tikz(self) -> str:
        """Return a picture for LaTeX (package tikz, style :data:`orderconds.explain.tikz.STYLE`)."""
        return picture(self.kind.diagram(self.member))

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<{self.kind.name} {self.text}>"

    def _repr_svg_(self) -> str:
        return sheet([(self.kind.diagram(self.member), [self.text, self.differential])])


@dataclass(frozen=True, repr=False)
class ShownTrees:
    """All trees of one kind and one order. Every run of the program enumerates the trees in the same
    sequence."""

    kind: Kind
    order: int

    @cached_property
    def members(self) -> tuple[ShownTree, ...]:
        """The trees as a tuple."""
        return tuple(ShownTree(self.kind, member, self.order) for member in self.kind.members(self.order))

    @property
    def conditions(self) -> Mapping[Member, OrderCondition]:
        """A map from trees to their order conditions. The keys are encodings of the trees
        (:data:`~orderconds.explain.kinds.Member`)."""
        return self.kind.conditions(self.order)

    def __iter__(self) -> Iterator[ShownTree]:
        return iter(self.members)

    def __len__(self) -> int:
        return self.kind.count(self.order)

    @overload
    def __getitem__(self, index: int) -> ShownTree: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[ShownTree, ...]: ...

    def __getitem__(self, index: int | slice) -> ShownTree | tuple[ShownTree, ...]:
        return self.members[index]

    def __repr__(self) -> str:
        return f"<{len(self)} {self.kind.name} of order {self.order}>"

    def svg(self, *, explain: bool = False) -> str:
        """Return one SVG document with all drawings.

        If ``explain`` is true, the captions contain the elementary differentials.
        """
        entries = (
            (self.kind.diagram(tree.member), [tree.text, *([tree.differential] if explain else [])])
            for tree in self
        )
        return sheet(entries)

    def _repr_svg_(self) -> str:
        entries = [(self.kind.diagram(t.member), [t.text, t.differential]) for t in self.members[:DRAWN]]
        return sheet(entries)


def trees(kind: str, order: int) -> ShownTrees:
    """Return all trees, forests or words of ``kind`` and ``order``.

    Raises :class:`~orderconds.errors.UnknownName` for an unknown kind. Raises
    :class:`~orderconds.errors.InputError` if the order is not an integer from 1 to 40, or if there are more
    than :data:`MAX_TREES` trees.

    >>> trees("rooted", 4)
    <4 rooted of order 4>
    >>> [tree.text for tree in trees("rooted", 3)]
    ['[[.]]', '[..]']
    """
    chosen = kinds.get(kind)
    order = integer(order, "order", TREE_ORDER)
    members = chosen.count(order)
    if members > MAX_TREES:
        raise InputError(
            f"there are {members} trees or words of order {order}",
            where=f"trees {kind}",
            expected=f"at most {MAX_TREES}",
            hint="lower the order, or print only the number of trees: orderconds trees --count",
        )
    return ShownTrees(chosen, order)
