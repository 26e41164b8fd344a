"""The orders that the sources state, beside those that the files claim and ``check`` computes."""

from __future__ import annotations

import pytest

from orderconds.tableau import Tableau, available, find

# name: the order that its source states, and the family it states it in.
PUBLISHED = {
    "rk": {
        1: "euler radau2a1",
        2: "heun explicit_midpoint ralston2 ssp32 heun_euler fehlberg2 alexander2 tr_bdf2 qin_zhang2 kahan "
        "lobatto3a2 lobatto3b2 lobatto3c2 lobatto3d2 gauss1",
        3: "kutta3 heun3 runge3 ralston3 ssp33 ssp43 van_der_houwen3 bogacki_shampine3 alexander3 crouzeix3 "
        "kvaerno3 hammer_hollingsworth3 radau1a2 radau2a2",
        4: "rk4 three_eighths gill4 ralston4 ssp104 merson4 zonneveld4 crouzeix4 hairer_wanner4 ssp54 gauss2 "
        "lobatto3a3 lobatto3b3 lobatto3c3 lobatto3d3 kahan_triple_jump",
        5: "nystrom5 butcher5 lawson5 fehlberg5 england5 cash_karp5 dormand_prince5 bogacki_shampine5 "
        "radau1a3 radau2a3",
        6: "butcher6 luther6 verner6 verner6_efficient gauss3 lobatto3a4 lobatto3b4 lobatto3c4 lobatto3d4",
        7: "verner7_efficient radau1a4 radau2a4",
        8: "cooper_verner8 fehlberg8 dop853 verner8_efficient gauss4 lobatto3a5 lobatto3b5 "
        "lobatto3c5 lobatto3d5",
        9: "verner9_efficient radau1a5 radau2a5",
        10: "gauss5",
    },
    "cg": {3: "cg3 cg3b", 4: "cg4 cg4a"},
    "cf": {3: "cf3 luescher3 williamson3", 4: "cf4 carpenter_kennedy4 berland4", 5: "yan5"},
    "composition": {
        2: "midpoint",
        4: "triple_jump suzuki4 mclachlan4",
        6: "yoshida6 yoshida6b yoshida6c kahan_li6 triple_jump6",
        8: "yoshida8a yoshida8d suzuki_umeno8 kahan_li8",
    },
    "splitting": {
        1: "lie_trotter",
        2: "strang position_verlet omelyan2 mclachlan_atela2",
        3: "ruth3",
        4: "forest_ruth4 blanes_moan4 pefrl4",
        6: "blanes_moan6",
    },
    "rkn": {4: "mclachlan_atela4 blanes_moan_rkn4", 6: "blanes_moan_rkn6 blanes_moan_rkn6a"},
    "magnus": {
        1: "lie_euler",
        2: "magnus2",
        4: "magnus4 fer4 cf_magnus4 lie_midpoint_triple_jump",
        6: "magnus6 fer6 cf_magnus6",
        8: "magnus8 cf_magnus8 cf_magnus8_11",
    },
    "cayley": {2: "cayley2", 4: "cayley4", 6: "cayley6"},
    "sprk_separable": {
        1: "symplectic_euler",
        2: "stormer_verlet",
        3: "ruth3_pair",
        4: "lobatto3ab3",
        6: "lobatto3ab4",
        8: "lobatto3ab5",
    },
}
STATED = [
    (name, family, order)
    for family, orders in PUBLISHED.items()
    for order, names in orders.items()
    for name in names.split()
]


@pytest.mark.parametrize(("name", "family", "order"), STATED)
def test_a_file_claims_the_order_that_its_source_states(name: str, family: str, order: int) -> None:
    assert Tableau.load(find(name)).claims.order(family) == order


def test_the_library_has_at_least_a_hundred_tableaux() -> None:
    assert len(available()) >= 100


# The lower order of a pair as its source states it.
PAIRS = {
    "heun_euler": 1,
    "fehlberg2": 1,
    "ssp43": 2,
    "bogacki_shampine3": 2,
    "tr_bdf2": 3,
    "merson4": 3,
    "zonneveld4": 3,
    "fehlberg5": 4,
    "england5": 4,
    "cash_karp5": 4,
    "dormand_prince5": 4,
    "bogacki_shampine5": 4,
    "verner6": 5,
    "verner6_efficient": 5,
    "verner7_efficient": 6,
    "verner8_efficient": 7,
    "verner9_efficient": 8,
    "fehlberg8": 7,
    "dop853": 5,
}


@pytest.mark.parametrize("name", PAIRS)
def test_the_second_row_of_a_pair_has_the_order_that_its_source_states(name: str) -> None:
    embedded = Tableau.load(find(name)).embedded
    assert embedded is not None
    assert embedded.order == PAIRS[name]
