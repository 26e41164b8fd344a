"""Compositions of an integer."""

from orderconds.words.compositions import compositions


def test_compositions_number_powers_of_two():
    for n in range(1, 8):
        found = list(compositions(n))
        assert len(set(found)) == len(found) == 2 ** (n - 1)
        assert all(sum(parts) == n for parts in found)


def test_compositions_with_few_parts_come_first():
    for n in range(1, 7):
        lengths = [len(parts) for parts in compositions(n)]
        assert lengths == sorted(lengths)
        assert all(min(parts) >= 1 for parts in compositions(n))
