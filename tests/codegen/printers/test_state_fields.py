"""The header lists every number of a state once, in order."""

from __future__ import annotations

from codegen.ir.expr import Space
from codegen.ir.kernel import Field, Kernel, Sample
from codegen.printers.state_fields import layout, times

S = Space()


def kernel(*fields: Field, **more: object) -> Kernel:
    return Kernel(name="k", scalars=(), state=fields, body=(), outputs=(), **more)  # type: ignore[arg-type]


def test_fields_follow_one_another_without_gaps() -> None:
    fields = (
        Field("q", ("a", "b"), "position"),
        Field("p", ("c",), "momentum"),
        Field("r", ("d", "e"), "rest"),
    )
    assert layout(kernel(*fields)) == ("[0..1] q: position", "[2] p: momentum", "[3..4] r: rest")


def test_inputs_are_listed_with_their_times() -> None:
    t, h = S.sym("t"), S.sym("h")
    samples = (Sample(t, ("u0",)), Sample(S.add(t, h), ("u1",)))
    assert times(kernel(inputs=("u",), samples=samples)) == (
        "u, as functions of time, evaluated at t, t + h",
    )


def test_without_inputs_there_is_no_line() -> None:
    assert times(kernel()) == ()
