"""Tableaux in which each stage i has three equal abscissae: c_i = chat_i = m_i.

Stage i of a variational method on a Lie group has three abscissae: c_i for the position q, chat_i for the
forces on the momentum, and m_i for the transport of the momentum by Ad* (the coadjoint action). Let beta_J^i
be the coefficient of stage i in the J-th exponential of the update. Let
b_i = sum_J beta_J^i and y_J = sum_i beta_J^i. The numbers b_i are the weights. The abscissa m_i is defined by

    1 - m_i = (1/b_i) sum_J beta_J^i (y_J/2 + sum_{K > J} y_K).

For Crouch-Grossman methods, m_i = b_1 + ... + b_{i-1} + b_i/2.

A method of order three satisfies sum_i b_i x_i z_i = 1/3, where each of x and z is one of c, chat and m.
Hence the sum of b_i (c_i - m_i)^2 over i is 1/3 - 2/3 + 1/3 = 0. The sum of b_i (chat_i - m_i)^2 is
zero, too. If the weights are positive, the three abscissae are equal.

Let a_ij be the coefficient with which stage j enters stage i, and let A be the matrix of these coefficients.
Then c_i = sum_j a_ij and 1 - chat_j = (1/b_j) sum_i b_i a_ij. If the three abscissae are equal, A therefore
satisfies the equations of a transportation problem: sum_j a_ij = m_i for each row i, and
sum_i b_i a_ij = b_j (1 - m_j) for each column j.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from orderconds.errors import InputError
from orderconds.solve.linear import divisor

WHERE = "structure abscissae"


def crouch_grossman_times(b: Sequence[str]) -> dict[str, str]:
    """Return formulas for the abscissae m_i = b_1 + ... + b_{i-1} + b_i/2 of a Crouch-Grossman method. ``b``
    contains the names of the weights.

    >>> crouch_grossman_times(["b1", "b2"])
    {'m1': '1/2*b1', 'm2': 'b1 + 1/2*b2'}
    """
    return {f"m{i + 1}": " + ".join([*b[:i], f"1/2*{b[i]}"]) for i in range(len(b))}


def commutator_free_times(update: Sequence[Sequence[str]], b: Sequence[str]) -> dict[str, str]:
    """Return formulas for the weights b_i, the sums y_J of the rows of ``update``, and the abscissae m_i
    (module docstring).

    Row J of ``update`` contains the coefficients of the J-th exponential of the update. ``b`` contains the
    names of the weights.

    >>> commutator_free_times([["x"], ["y"]], ["b1"])
    {'b1': 'x + y', 'y1': 'x', 'y2': 'y', 'm1': '1 - (x*(1/2*y1 + y2) + y*(1/2*y2))/b1'}
    """
    times = {b[i]: _sum(column) for i, column in enumerate(zip(*update, strict=True))}
    totals = [f"y{J + 1}" for J in range(len(update))]
    times |= {y: _sum(row) for y, row in zip(totals, update, strict=True)}
    for i, weight in enumerate(b):
        later = [
            f"{row[i]}*({' + '.join([f'1/2*{totals[J]}', *totals[J + 1 :]])})"
            for J, row in enumerate(update)
            if row[i] != "0"
        ]
        times[f"m{i + 1}"] = f"1 - ({' + '.join(later)})/{divisor(weight)}"
    return times


def _sum(row: Sequence[str]) -> str:
    return " + ".join(x for x in row if x != "0") or "0"


def transport(A: Sequence[Sequence[str]], b: Sequence[str], fixed: Mapping[str, str]) -> dict[str, str]:
    """Return formulas for 2 s - 1 entries of A, where s is the number of stages.

    With these formulas, sum_j a_ij = m_i for each row i, and sum_i b_i a_ij = b_j (1 - m_j) for each column
    j. Here m_i are the abscissae and b_i are the weights.

    ``b`` contains the texts of the weights. ``fixed`` maps the names of known entries to their values. A
    graph determines which entries get a formula. The nodes of this graph are the rows and columns of A, and
    each unknown entry a_ij is an edge between row i and column j. The edges of a spanning tree get formulas.
    Raises :class:`~orderconds.errors.InputError` if the graph is not connected.

    >>> transport([["a11", "a12"], ["a21", "a22"]], ["b1", "b2"], {})
    {'a12': 'm1 - a11', 'a21': '(b1*(1 - m1) - b1*a11)/b2', 'a22': 'm2 - a21'}
    """
    s = len(b)
    entries = [(i, j) for i in range(s) for j in range(s)]
    texts = {(i, j): fixed.get(A[i][j], A[i][j]) for i, j in entries}
    unknown = set(_spanning_tree([e for e in entries if A[e[0]][e[1]] not in fixed], s))
    cells = {}
    while unknown:
        i, j, by_row = _leaf(unknown)
        unknown.remove((i, j))
        if by_row:
            others = [texts[i, k] for k in range(s) if k != j and texts[i, k] != "0"]
            cells[A[i][j]] = " - ".join([f"m{i + 1}", *others]).replace("- -", "+ ")
        else:
            others = [f"{b[k]}*{texts[k, j]}" for k in range(s) if k != i and texts[k, j] != "0"]
            total = " - ".join([f"{b[j]}*(1 - m{j + 1})", *others])
            cells[A[i][j]] = f"({total})/{divisor(b[i])}"
    return cells


def _spanning_tree(edges: Sequence[tuple[int, int]], s: int) -> list[tuple[int, int]]:
    """Return a spanning tree of the graph whose edges (i, j) join row i and column j of an s x s matrix.
    Raises InputError if the graph is not connected."""
    component = list(range(2 * s))
    kept = []
    for i, j in sorted(edges, key=lambda e: (e[0] != s - 1 and e[1] != s - 1, -e[0], -e[1])):
        row, column = component[i], component[s + j]
        if row != column:
            kept.append((i, j))
            component = [row if x == column else x for x in component]
    if len(kept) != 2 * s - 1:
        raise InputError(
            "the free entries of A do not connect all rows and columns",
            where=WHERE,
            expected="more free entries: the rows and columns must form a connected graph, in which each "
            "free entry a_ij is an edge between row i and column j",
        )
    return kept


def _leaf(unknown: set[tuple[int, int]]) -> tuple[int, int, bool]:
    """Return a triple (row, column, by_row) for an entry that is the only unknown in its row or column. If
    the entry is the only unknown in its row, ``by_row`` is True."""
    for alone, by_row in ((0, True), (1, False)):
        for entry in sorted(unknown):
            if sum(other[alone] == entry[alone] for other in unknown) == 1:
                return (*entry, by_row)
    raise InputError(
        "no row and no column of A contains exactly one unknown entry",
        where=WHERE,
        expected="a row or column with exactly one unknown entry",
    )


def symmetric_transport(
    own: Sequence[Sequence[str]], leave: Sequence[int], update: Sequence[Sequence[str]], middle: Sequence[str]
) -> dict[str, str]:
    """Return formulas for coefficients of a symmetric method with s stages and the abscissae m_i.

    Let k_j be the vector field at stage j. Row J of ``update`` contains the coefficients of k_1, ..., k_s in
    the J-th exponential of the update. Let r be s/2, rounded down. If i <= r, stage i begins with the first
    ``leave[i - 1]`` exponentials of the update. If s is odd, the middle stage i = r + 1 begins with the first
    half of the update. The later exponentials of a stage are called own. For stage i, let a_ij be
    the sum of all coefficients of k_j, and x_ij the sum of the coefficients of k_j in the own exponentials.

    - ``own`` contains the row (x_i1, ..., x_is) for i = 1, ..., r.
    - ``middle`` contains the row (x_i1, ..., x_is) for i = r + 1. If s is even, ``middle`` is empty.

    With the formulas, sum_j a_ij = m_i for each i, and sum_i b_i a_ij = b_j (1 - m_j) for each j, where b_i
    are the weights. The formulas determine the last column of ``own``, the first r entries of the last row of
    ``own``, and auxiliary numbers C1, ..., Cr. The other entries of ``own`` remain free. The formulas contain
    the numbers m_i, b_i and y_J, where y_J is the sum of all entries in row J of ``update``.

    >>> last = symmetric_transport([["x11", "x12"]], [1], [["p", "q"], ["q", "p"]], [])
    >>> last["x12"], last["x11"]
    ('1/2*(m1 - (y1) - (C1/b1))', 'x12 + C1/b1')
    """
    s, half = len(update[0]), len(own)
    totals = [f"y{J + 1}" for J in range(len(update))]
    cells = {}
    for j in range(half):
        share = [f"b{j + 1}*(1 - m{j + 1})"]
        for i, k in enumerate(leave):
            for J, line in enumerate(update):
                times = (k > J) + (len(update) - k > J)
                if times and line[j] != "0":
                    share.append(f"{'2*' if times == 2 else ''}b{i + 1}*{line[j]}")
        if middle:
            number = half + 1
            for line in update[: len(update) // 2]:
                share.append(f"b{number}*{line[j]}")
            if len(update) % 2:
                share.append(f"1/2*b{number}*{update[len(update) // 2][j]}")
            if middle[j] != "0":
                share.append(f"b{number}*{middle[j]}")
        cells[f"C{j + 1}"] = " - ".join(share)
    rest = [f"m{i + 1} - ({' + '.join(totals[:k]) or '0'})" for i, k in enumerate(leave)]
    for i, line in enumerate(own[:-1]):
        cells[line[-1]] = " - ".join([rest[i], *line[:-1]])
    last, weight = own[-1], f"b{half}"
    differences = []
    for j in range(half):
        others = [f"b{i + 1}*({line[j]} - {line[s - 1 - j]})" for i, line in enumerate(own[:-1])]
        total = " - ".join([f"C{j + 1}", *others])
        differences.append(f"({total})/{weight}" if others else f"{total}/{weight}")
    for j in range(1, half):
        cells[last[j]] = f"{last[s - 1 - j]} + {differences[j]}"
    known = [f"({x})" for x in differences]
    known += [f"2*{last[s - 1 - j]}" for j in range(1, half)]
    if s % 2:
        known.append(last[half])
    cells[last[s - 1]] = f"1/2*({' - '.join([rest[-1], *known])})"
    cells[last[0]] = f"{last[s - 1]} + {differences[0]}"
    return cells
