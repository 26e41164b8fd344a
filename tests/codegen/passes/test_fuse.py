from __future__ import annotations

import pytest

from codegen.ir.number import Number
from codegen.ir.program import Builder, Program
from codegen.ir.values import Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes import dead, fuse
from tests.strategies import field_scene, full, lowered, same


@pytest.mark.parametrize("place", ["R^3", "S^2", "SO(3)", "GL(2)", "Heisenberg"])
@pytest.mark.parametrize("tableau", ["kutta3", full(2)])
def test_an_exponential_used_once_is_never_formed(place, tableau):
    scene, program = lowered("cg", tableau, field_scene(place))
    new = verify(dead.run(fuse.run(program)))
    assert "exp" not in new.counts()
    assert "act" not in new.counts()
    assert new.counts()["actexp"] == program.counts()["act"]
    assert same(scene, program, new)


def test_an_exponential_used_twice_is_formed_once():
    """exp(x) moves y, and then what it moved."""
    builder, y = Builder({"y", "t", "h"}), Var("y", Kind.POINT)
    k = builder.field_at("k", y)
    x = builder.lin("x", Kind.ALG, [(Coefficient(Number.rational(1, 2), 1), k)])
    g = builder.exp("g", x)
    half = builder.act("y1", g, y)
    whole = builder.act("y2", g, half)
    program = verify(Program("p", (y,), builder.take(), (("y", whole),)))
    new = verify(dead.run(fuse.run(program)))
    assert new.counts() == {"act": 2, "exp": 1, "field": 1, "lin": 1}
    assert same(field_scene("S^2"), program, new)
