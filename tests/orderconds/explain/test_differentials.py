"""Texts of elementary differentials and Hamiltonians."""

from __future__ import annotations

import pytest

from orderconds.explain import kinds

ORDERS = range(1, 6)


@pytest.mark.parametrize("name", sorted(set(kinds.KINDS) - {"free", "essential", "directed", "alternating"}))
def test_different_rooted_trees_name_different_functions(name: str) -> None:
    kind = kinds.get(name)
    for order in ORDERS:
        named = [kind.names(member) for member in kind.members(order)]
        assert len(set(named)) == len(named)


def test_names_known_from_books() -> None:
    named = {name: kinds.get(name) for name in kinds.KINDS}
    # HLW III.1, Table 1.1
    assert [*map(named["rooted"].names, named["rooted"].members(4))] == [
        "f'(f'(f'(f)))",
        "f'(f''(f, f))",
        "f''(f'(f), f)",
        "f'''(f, f, f)",
    ]
    # The terms of the modified Hamiltonian of symplectic Euler, HLW IX.3
    assert sorted(map(named["directed"].names, named["directed"].members(3))) == [
        "H_pp(H_q, H_q)",
        "H_q(H_qp(H_p))",
        "H_qq(H_p, H_p)",
    ]
