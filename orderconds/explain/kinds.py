"""Kinds of trees: rooted trees, free trees and others. A kind enumerates, counts, draws and describes its
trees."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from orderconds import families
from orderconds.argument import text
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError, UnknownName
from orderconds.explain.diagram import Diagram
from orderconds.explain.lines import Style, draw
from orderconds.families import Family

Member = Any
"""A tree, forest or word. The encoding depends on the kind."""


MAX_TREES = 7_000
"""If an order has more trees than this number, the conditions of this order are not derived."""


@dataclass(frozen=True)
class Kind:
    """One kind of trees, words or forests. Each tree, word or forest of the kind is called a member.

    Five attributes are functions:

    - ``members`` enumerates the members of an order.
    - ``count`` computes the number of members of an order without enumeration.
    - ``text`` returns the text of a member.
    - ``diagram`` returns the drawing of a member.
    - ``names`` returns the text of the elementary differential or of the elementary Hamiltonian of a member.

    The method :meth:`family` returns a family of numerical methods. Members index the order conditions of
    this family. If ``independent`` is true, these order conditions are independent of each other.

    >>> kind = get("rooted")
    >>> [(kind.text(tree), kind.names(tree)) for tree in kind.members(3)]
    [('[[.]]', "f'(f'(f))"), ('[..]', "f''(f, f)")]
    """

    members: Callable[[int], Iterable[Member]]
    count: Callable[[int], int]
    text: Callable[[Member], str]
    diagram: Callable[[Member], Diagram]
    names: Callable[[Member], str]
    name: str
    independent: bool = False

    def family(self) -> Family:
        """Return the family of methods whose order conditions ``orderconds trees --explain`` shows.

        The command shows each tree with its order condition.
        """
        for name in families.names():
            family = families.family_class(name)
            if self.name in family.illustrates:
                return family()
        raise UnknownName(
            f"no family has conditions for trees of the kind {self.name!r}", expected="a registered family"
        )

    def conditions(self, order: int) -> dict[Member, OrderCondition]:
        """Return the order conditions of the given order in the family that :meth:`family` returns.

        The keys of the result are trees, forests or words.
        """
        family = self.family()
        conditions = family.conditions(order) if self.independent else family.all_conditions(order)
        return {condition.key: condition for condition in conditions}

    def entry(self, member: Member, condition: OrderCondition | None, style: Style | None) -> list[str]:
        r"""Return the lines that explain a member: its text, drawing, elementary differential and condition.

        If no style is given, the drawing is omitted.

        >>> from orderconds.explain.lines import ASCII
        >>> kind = get("rooted")
        >>> tree = b"\0\1\1"
        >>> for line in kind.entry(tree, kind.conditions(3)[tree], ASCII):
        ...     print(line)
        [..]
            o
            +-o
            +-o
            names      f''(f, f)
            condition  sum_i b_i c_i^2 = 1/3
        """
        lines = [] if style is None else draw(self.diagram(member), style)
        lines.append(f"names      {self.names(member)}")
        if condition is not None:
            lines.append(f"condition  {condition}")
            if condition.relation is not None:
                lines.append(f"equals     {condition.relation}")
        return [self.text(member), *(f"    {line}" for line in lines)]


def get(name: str) -> Kind:
    """Return the kind with the given name. Raises :class:`~orderconds.errors.UnknownName` if there is no such
    kind.

    >>> get("ordered").count(8)
    429
    """
    if text(name, "kind", f"one of {', '.join(KINDS)}") not in KINDS:
        close = difflib.get_close_matches(name, KINDS, n=1)
        raise UnknownName(
            f"no kind of trees has the name {name!r}",
            expected=f"one of {', '.join(KINDS)}",
            hint=f"for example, run: orderconds trees {close[0] if close else 'rooted'} --order 4",
        )
    return KINDS[name]()


def of_family(label: str) -> Kind | None:
    r"""Return the kind of the trees, forests or words that index the conditions of a family.

    Return None if there is no such kind, for example for the family ``rkn``.

    >>> of_family("rkmk(1)").text(b"\0\1\0")
    '[.] .'
    """
    name = families.get(label).trees
    return None if name is None else get(name)


def refuse_too_many_trees(family: Family, order: int) -> None:
    """Raise an InputError if ``family`` has more than :data:`MAX_TREES` trees of one of the orders 1, ..., n.

    Here n is ``order``, or ``family.order_bound`` if this bound is smaller.

    >>> refuse_too_many_trees(families.get("rk"), 12)
    """
    if family.trees is None:
        return
    kind = get(family.trees)
    for n in range(1, min(order, family.order_bound or order) + 1):
        trees = kind.count(n)
        if trees > MAX_TREES:
            raise InputError(
                f"there are {trees} trees of order {n}",
                where=family.label(),
                expected=f"at most {MAX_TREES}",
                hint=f"lower the order to {n - 1}",
            )


def named_by(condition: OrderCondition) -> str:
    """Return the elementary differential or the elementary Hamiltonian that belongs to a condition.

    Return ``condition.tree`` if :func:`of_family` returns None for the family of the condition.

    >>> from orderconds.derivation import derive
    >>> print(*map(named_by, derive("vcg", order=2).conditions))
    H H_q(H_m)
    """
    kind = of_family(condition.family)
    return condition.tree if kind is None else kind.names(condition.key)


def _rooted() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import counts, levels, rooted

    return Kind(
        rooted.rooted_trees,
        counts.rooted_tree_count,
        levels.text,
        diagram.plain,
        differentials.differential,
        "rooted",
    )


def _ordered() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import counts, levels, ordered

    return Kind(
        ordered.ordered_trees,
        counts.ordered_tree_count,
        levels.text,
        diagram.plain,
        differentials.frozen_differential,
        "ordered",
    )


def _forests() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import counts, levels, ordered

    return Kind(
        ordered.ordered_forests,
        counts.ordered_forest_count,
        levels.text,
        diagram.plain,
        differentials.frozen_differential,
        "forests",
    )


def _lyndon() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import counts, levels, ordered
    from orderconds.words.lyndon import lyndon_words

    def words(order: int) -> Iterator[bytes]:
        letters = [tree for n in range(order, 0, -1) for tree in ordered.ordered_trees(n)]
        return map(b"".join, lyndon_words(letters, order, weigh=len))

    def count(order: int) -> int:
        return counts.lyndon_word_count(order, counts.ordered_tree_count)

    return Kind(
        words,
        count,
        levels.text,
        diagram.plain,
        differentials.frozen_differential,
        "lyndon",
        independent=True,
    )


def _bicoloured() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import bicoloured, counts

    return Kind(
        bicoloured.bicoloured_rooted_trees,
        lambda order: 2 * counts.rooted_tree_count(order, kinds=2),
        bicoloured.text,
        diagram.coloured,
        differentials.partitioned_differential,
        "bicoloured",
    )


def _free() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import counts, free, levels

    return Kind(
        free.free_trees,
        counts.free_tree_count,
        levels.text,
        diagram.plain,
        differentials.hamiltonian,
        "free",
    )


def _essential() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import counts, free, levels

    return Kind(
        free.essential_free_trees,
        counts.essential_free_tree_count,
        levels.text,
        diagram.plain,
        differentials.hamiltonian,
        "essential",
        independent=True,
    )


def _directed() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import counts, directed

    return Kind(
        directed.directed_free_trees,
        counts.directed_free_tree_count,
        directed.text,
        diagram.with_directions,
        differentials.directed_hamiltonian,
        "directed",
    )


def _directed_rooted() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import bicoloured, counts, directed

    return Kind(
        directed.directed_rooted_trees,
        lambda order: counts.rooted_tree_count(order, kinds=2),
        directed.text,
        diagram.with_directions,
        lambda tree: differentials.partitioned_differential(bicoloured.coloured(0, tree)),
        "directed-rooted",
    )


def _alternating() -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees import bicoloured, counts

    return Kind(
        bicoloured.alternating_free_trees,
        counts.alternating_free_tree_count,
        bicoloured.text,
        diagram.coloured,
        differentials.separable_hamiltonian,
        "alternating",
    )


def _action() -> Kind:
    from orderconds.explain import diagram
    from orderconds.series import action_counts, action_enumeration, action_trees

    return Kind(
        action_enumeration.velocities,
        action_counts.velocity_count,
        str,
        diagram.action,
        action_trees.hamiltonian,
        "action",
    )


def _graded() -> Kind:
    return _lyndon_words("graded", lambda weight: weight, lambda order: range(1, order + 1), str, " ")


def _letters() -> Kind:
    return _lyndon_words(
        "letters", lambda letter: 1, lambda order: range(2), "ABCDEFGHIJKLMNOPQRSTUVWXYZ".__getitem__, ""
    )


def _lyndon_words(
    name: str,
    weigh: Callable[[int], int],
    letters: Callable[[int], Iterable[int]],
    letter: Callable[[int], str],
    between: str,
) -> Kind:
    from orderconds.explain import diagram, differentials
    from orderconds.trees.counts import lyndon_word_count
    from orderconds.words.lyndon import lyndon_words

    return Kind(
        lambda order: lyndon_words(list(letters(order)), order, weigh),
        lambda order: lyndon_word_count(order, lambda k: sum(weigh(x) == k for x in letters(order))),
        lambda word: between.join(map(letter, word)),
        lambda word: diagram.word(word, letter),
        lambda word: differentials.bracket(word, letter),
        name,
        independent=True,
    )


KINDS: dict[str, Callable[[], Kind]] = {
    "rooted": _rooted,
    "ordered": _ordered,
    "forests": _forests,
    "lyndon": _lyndon,
    "bicoloured": _bicoloured,
    "free": _free,
    "essential": _essential,
    "directed": _directed,
    "directed-rooted": _directed_rooted,
    "alternating": _alternating,
    "action": _action,
    "graded": _graded,
    "letters": _letters,
}
"""A map from the name of each kind to a function that returns the kind."""
