"""Splittings of a vector field A + B + ... into its parts A, B, .... Each step is a product of flows of the
parts.

For two parts, one step of size h is ``... exp(b_2 h B) exp(a_2 h A) exp(b_1 h B) exp(a_1 h A)``. The
rightmost flow acts first.

There is one condition for each word over A, B, .... A word of n letters must have the coefficient 1/n! in the
series of the step (HLW III.5; McLachlan and Quispel, Acta Numerica 11 (2002) 341).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import accumulate, groupby, pairwise
from itertools import product as tuples
from math import factorial, prod
from typing import TYPE_CHECKING, ClassVar, Self

from orderconds.errors import InputError
from orderconds.families.base import Family, expect
from orderconds.families.registry import register
from orderconds.families.stage_form import StageForm, refuse_explicit
from orderconds.families.word_family import WordFamily
from orderconds.formula import Formula, coefficient, fresh, index_sum, product, total
from orderconds.ring.protocol import Element, Ring
from orderconds.series.exponentials import ProductOfExponentials
from orderconds.tableau.products import AdjointComposition, Method, Splitting
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work
from orderconds.words.compositions import compositions
from orderconds.words.shuffle import Word

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues

MAX_PARTS = 6


@register
class SplittingFamily(WordFamily):
    """Splittings of a vector field into a sum of vector fields, called parts. The number of parts is
    ``parts``. A word is a sequence of indices 0, 1, ... of parts, printed as letters A, B, ....

    >>> for condition in SplittingFamily().conditions(3):
    ...     print(condition.tree, condition)
    AAB sum_i c_i^2 b_i = 1/3
    ABB sum_i c_i b_i^2 + 2 sum_{i<j} c_i b_i b_j = 1/3
    """

    name = "splitting"
    description = (
        "Splittings of a vector field A + B + ...: products of the flows of A, B, ...; each condition "
        "corresponds to a word over A, B, ..."
    )
    formats = ("splitting",)
    symbols: ClassVar[Mapping[str, str]] = {
        "a": r"$a_i$ are the step sizes of the flows of the first part, as fractions of $h$",
        "b": r"$b_i$ are the step sizes of the flows of the second part, as fractions of $h$",
        "c": r"$c_i = a_1 + \dots + a_i$",
    }
    trees = "letters"
    illustrates = ("letters",)
    implies: ClassVar[Mapping[str, str]] = {"rkn": "a Runge-Kutta-Nystroem splitting is a splitting"}
    unknowns = "splitting"

    def __init__(self, parts: int = 2) -> None:
        if not 2 <= parts <= MAX_PARTS:
            raise InputError(f"{parts} parts", where="family splitting", expected=f"2 to {MAX_PARTS} parts")
        self.parts = parts

    def label(self) -> str:
        """Return the label of the family: ``splitting`` for two parts, and a label such as ``splitting(3)``
        for any other number of parts."""
        return self.name if self.parts == 2 else f"{self.name}({self.parts})"

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` if the number of parts of ``method`` is not
        ``self.parts``."""
        parts = expect(method, Splitting).parts
        if len(parts) != self.parts:
            right = SplittingFamily(len(parts)).label()
            raise InputError(
                f"a splitting into {len(parts)} parts: {', '.join(parts)}",
                where=f"family {self.label()}",
                expected=f"{self.parts} parts",
                hint=f"use the family {right!r}",
            )

    def weigh(self, letter: int) -> int:
        """Return 1, the weight of every letter."""
        return 1

    def words(self, order: int) -> tuple[Word, ...]:
        """Return all words of ``order`` letters."""
        return tuple(tuples(range(self.parts), repeat=order))

    def text(self, word: Word) -> str:
        """Return a word as text. The word (0, 0, 1) becomes ``AAB``."""
        return "".join(chr(ord("A") + letter) for letter in word)

    def exact(self, word: Word) -> Fraction:
        """Return 1/n!, the coefficient of a word of n letters in the exact flow."""
        return Fraction(1, factorial(len(word)))

    def scale(self, word: Word) -> int:
        """Return the product of the factorials of the run lengths of ``word``. A run is a maximal block of
        equal letters.

        Both sides of the order condition are multiplied by this product.
        """
        return prod(factorial(len(list(run))) for _, run in groupby(word))

    def formula(self, word: Word) -> Formula:
        """Return the left-hand side of the condition of a word as an index sum.

        The coefficients a_i, b_i, ... are the step sizes of the fields A, B, ... in stage i. For two fields,
        the formula also contains the sums c_i = a_1 + ... + a_i.
        """
        return two_part_formula(word) if self.parts == 2 else splitting_formula(word)

    def for_method(self, method: Method) -> Family:
        """Return the family of splittings into n fields, where n is the number of fields of ``method``."""
        return SplittingFamily(len(expect(method, Splitting).parts))

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family for splittings, and for compositions of a method with its adjoint. Otherwise
        return None."""
        method = tableau.method
        if isinstance(method, AdjointComposition):
            return cls()
        return cls(len(method.parts)) if isinstance(method, Splitting) else None

    def implied_order(self, orders: Mapping[str, int]) -> int:
        """Return the lower bound min(3, p) of the order, where p is the order in the family ``rkn``. Up to
        order 3, the families ``splitting`` and ``rkn`` have the same conditions."""
        return min(3, orders.get("rkn", 0))

    def work(self, tableau: Tableau) -> Work | None:
        """Return None for a splitting, because the cost of a flow depends on the problem."""
        return None if isinstance(tableau.method, Splitting) else super().work(tableau)

    def solved_as(self, nystroem: bool) -> str:
        """Return the label ``rkn`` if ``nystroem`` is true. Otherwise return the label of ``self``."""
        return "rkn" if nystroem else self.label()

    def series(self, method: Method, ring: Ring) -> ProductOfExponentials:
        """Return the series of one step, as a callable object that maps each word to its coefficient."""
        steps = expect(method, Splitting).steps
        return ProductOfExponentials(ring, len(steps), lambda J, k: steps[J][1] if steps[J][0] == k else None)

    def in_stages(self, stages: int, *, explicit: bool = False) -> StageForm:
        """Return the unknowns of a splitting with ``stages`` stages: one step size for each part in each
        stage."""
        refuse_explicit(self.label(), explicit)
        letters = "abcdef"[: self.parts]
        names = tuple((x, (str(i),)) for i in range(1, stages + 1) for x in letters)

        def method(values: Sequence[Element], ring: Ring) -> Splitting:
            steps = tuple((place % self.parts, x) for place, x in enumerate(values))
            return Splitting(tuple(map(self.text, self.words(1))), steps)

        return StageForm(names, method)

    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Splitting:
        """Return a splitting with random step sizes. The splitting has more step sizes than there are
        independent conditions up to ``order``."""
        stages = 1 + sum(len(self.independent(n)) for n in range(1, order + 1)) // self.parts
        steps = [(part, ring.random(generator)) for _ in range(stages) for part in range(self.parts)]
        return Splitting(tuple(map(self.text, self.words(1))), tuple(steps))


def splitting_formula(word: Word) -> Formula:
    """Return a sum over stage indices: the left-hand side of the condition of ``word``.

    The left-hand side is the coefficient of the word in the series of one step, times
    :meth:`SplittingFamily.scale`.

    >>> from orderconds.formula import named
    >>> named(splitting_formula((0, 1, 0))).text()
    'sum_{i<=j<k} a_i b_j a_k'
    """
    runs = [(letter, len(list(run))) for letter, run in groupby(word)]
    terms = []
    for weight, split in _splits([length for _, length in runs]):
        blocks = [(letter, n) for (letter, _), parts in zip(runs, split, strict=True) for n in parts]
        indices = [fresh() for _ in blocks]
        relations = []
        for (i, (one, _)), (j, (two, _)) in pairwise(zip(indices, blocks, strict=True)):
            # A block consists of equal letters that act in one stage. The first block has the letter ``one``
            # and acts in stage i. The second block has the letter ``two`` and acts in stage j. The case i = j
            # requires ``one`` < ``two``, because the letters of a stage act in alphabetical order.
            relations.append((i, "<=" if one < two else "<", j))
        factors = [
            coefficient("abcdef"[letter], i)
            for i, (letter, length) in zip(indices, blocks, strict=True)
            for _ in range(length)
        ]
        terms.append((weight, index_sum(indices, relations, product(*factors))))
    return total(*terms)


def two_part_formula(word: Word) -> Formula:
    """Return the left-hand side of the condition of a word over two letters A and B, as an index sum.

    Let c_i = a_1 + ... + a_i. A letter B in stage i gives the factor b_i. If the first letter B is in stage
    i, each letter A before this B gives the factor c_i. If two consecutive letters B are in the stages i
    and j, each letter A between them gives the factor c_j - c_i. If the last letter B is in stage i, each
    letter A after this B gives the factor c_s - c_i. Here s is the number of stages, and c_s is printed as
    sum_j a_j.

    >>> from orderconds.formula import named
    >>> named(two_part_formula((0, 0, 1, 0, 1))).text()
    'sum_{i<j} c_i^2 b_i (c_j - c_i) b_j'
    """
    if 1 not in word:
        i = fresh()
        return product(*[index_sum((i,), (), coefficient("a", i))] * len(word))
    *gaps, tail = "".join("AB"[letter] for letter in word).split("B")
    # A pair (m, n) represents m letters A, followed by n letters B.
    runs: list[tuple[int, int]] = []
    for gap in map(len, gaps):
        if gap or not runs:
            runs.append((gap, 1))
        else:
            runs[-1] = (runs[-1][0], runs[-1][1] + 1)
    terms = []
    for weight, split in _splits([length for _, length in runs]):
        factors, indices, before = [], [], None
        blocks = [
            (0 if k else gap, n)
            for (gap, _), parts in zip(runs, split, strict=True)
            for k, n in enumerate(parts)
        ]
        for gap, length in blocks:
            indices.append(fresh())
            here = coefficient("c", indices[-1])
            between = here if before is None else total((1, here), (-1, before))
            factors += [between] * gap + [coefficient("b", indices[-1])] * length
            before = here
        if tail and before is not None:
            i = fresh()
            after = total((1, index_sum((i,), (), coefficient("a", i))), (-1, before))
            factors += [after] * len(tail)
        relations = [(i, "<", j) for i, j in pairwise(indices)]
        terms.append((weight, index_sum(indices, relations, product(*factors))))
    return total(*terms)


def _splits(lengths: list[int]) -> Iterator[tuple[int, tuple[tuple[int, ...], ...]]]:
    """Yield all ways to divide runs of equal letters into blocks, as pairs (factor, blocks).

    ``lengths`` contains the lengths of the runs, and ``blocks`` contains the block lengths of each run. A run
    of length n that is divided into blocks of lengths n_1, n_2, ... contributes the factor n!/(n_1! n_2!
    ...), and ``factor`` is the product of these factors over all runs.
    """
    for split in tuples(*(tuple(compositions(length)) for length in lengths)):
        yield prod(factorial(sum(parts)) // prod(map(factorial, parts)) for parts in split), split


def stage_tables(method: Splitting, ring: Ring) -> dict[str, list[Element]]:
    """Return the step sizes of all parts in all stages, as a map from names to lists.

    The name ``a`` belongs to the first part, ``b`` to the second part, and so on. In a stage, each part acts
    at most once: first the first part, then the second part, and so on. If a part does not act in a stage,
    the step size of the part in the stage is zero. For two parts, the map also contains ``c``, the list of
    the sums c_i = a_1 + ... + a_i.

    >>> from orderconds.ring import QQ
    >>> strang = Splitting(("T", "V"), ((1, QQ.rational(1, 2)), (0, QQ.one), (1, QQ.rational(1, 2))))
    >>> stage_tables(strang, QQ)
    {'a': [0, 1], 'b': [1/2, 1/2], 'c': [0, 1]}
    """
    stages: list[list[Element]] = []
    last = len(method.parts)
    for part, step in method.steps:
        if part <= last:
            stages.append([ring.zero] * len(method.parts))
        stages[-1][part] = step
        last = part
    tables = {"abcdef"[part]: [stage[part] for stage in stages] for part in range(len(method.parts))}
    return tables if len(method.parts) > 2 else {**tables, "c": list(accumulate(tables["a"]))}
