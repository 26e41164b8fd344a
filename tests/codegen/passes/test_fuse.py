from __future__ import annotations

import pytest

from codegen.ir.verify import verify
from codegen.passes import dead, fuse
from tests.strategies import butcher, field_scene, full, lowered, same


@pytest.mark.parametrize("place", ["R^3", "S^2", "SO(3)", "GL(2)", "Heisenberg"])
@pytest.mark.parametrize("tableau", ["kutta3", full(2)])
def test_an_exponential_used_once_is_never_formed(place, tableau):
    scene, program = lowered("cg", tableau, field_scene(place))
    new = verify(dead.run(fuse.run(program)))
    assert "exp" not in new.counts()
    assert "act" not in new.counts()
    assert new.counts()["actexp"] == program.counts()["act"]
    assert same(scene, program, new)


def test_an_exponential_used_twice_is_kept():
    from codegen.passes import sharing

    tableau = butcher("shared", [[0, 0], ["1/2", 0]], ["1/2", "1/2"])
    _, program = lowered("rkmk", tableau, field_scene("S^2"), 0)
    shared = sharing.run(program)
    assert fuse.run(shared).counts()["actexp"] >= 1

    twice = butcher("twice", [[0, 0, 0], ["1/2", 0, 0], [0, "1/2", 0]], ["1/2", 0, "1/2"])
    scene, program = lowered("cg", twice, field_scene("S^2"))
    new = verify(dead.run(fuse.run(sharing.run(program))))
    assert same(scene, program, new)
