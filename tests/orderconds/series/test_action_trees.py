"""The trees of the action series: counts against generating functions, canonical text, symmetry."""

from orderconds.series.action_trees import force, hamiltonian, transport, velocity

LEAF = velocity()


def test_nodes_are_interned_and_momenta_unordered():
    pair = (force(), transport((LEAF,)))
    assert velocity((), pair) is velocity((), pair[::-1])
    assert velocity((LEAF, velocity((LEAF,)))) is not velocity((velocity((LEAF,)), LEAF))


def test_symmetry_counts_equal_momenta_only():
    assert velocity((LEAF, LEAF)).symmetry == 1
    assert velocity((), (force(), force())).symmetry == 2
    twice = velocity((), (force(), force()))
    assert velocity((), (transport((twice,)), transport((twice,)))).symmetry == 2 * 2 * 2


def test_elementary_hamiltonian_names_derivatives_in_the_order_of_action():
    tree = velocity((LEAF, velocity((LEAF,))), (force((LEAF,), (LEAF,)),))
    assert hamiltonian(tree) == "H_qqm(H_m, H_qm(H_m); H_qqq(H_m, ., H_m))"
