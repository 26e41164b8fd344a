"""Private functions with many scalar parameters receive them in one array; results keep their bits."""

from __future__ import annotations

import re

import pytest

from codegen.build import build
from codegen.emitter import emit_compiled
from codegen.loader import load
from codegen.printers.c import packing
from codegen.printers.c.module import FLAGS
from tests.compilations import compiled

SCENE = "dipole"
METHODS = ("cg:cg5", "vcg:gauss4", "ambient:dop853")
"""Methods whose steps are outlined. The solver of vcg:gauss4 calls its functions in a loop."""


def emitted(method, wide, monkeypatch):
    monkeypatch.setattr(packing, "WIDE", wide)
    return emit_compiled(compiled(SCENE, method), "c")


def source(module):
    """Return the C code after the comment at its head."""
    text = next(text for name, text in module.files.items() if name.endswith(".c"))
    return text[text.index("*/") :]


@pytest.mark.parametrize(
    "method",
    [pytest.param(m, marks=pytest.mark.slow if m in ("cg:cg5", "vcg:gauss4") else ()) for m in METHODS],
)
def test_arrays_of_arguments_change_no_bit(method, monkeypatch):
    apart, together = (emitted(method, wide, monkeypatch) for wide in (10**9, 2))
    assert packing.PACKED not in source(apart)
    assert f"const double {packing.PACKED}[static " in source(together)
    assert f"const double {packing.PACKED}[] =" in source(together)
    start = apart.manifest["initial"]
    assert load(together).run(start, 0.01, 5) == load(apart).run(start, 0.01, 5)


@pytest.mark.parametrize("method", METHODS)
def test_every_compiler_accepts_the_arrays(method, monkeypatch, compiler):
    module = emitted(method, 2, monkeypatch)
    assert build(module.files, FLAGS, compiler).exists()


def test_short_lists_of_arguments_stay_as_they_are(monkeypatch):
    module = emit_compiled(compiled(SCENE, "cg:cg5"), "c")
    assert re.search(r"_piece_1\(double ", source(module))
    assert packing.PACKED not in source(module)


def test_an_array_with_exactly_these_values_is_passed_without_a_copy():
    values = [f"v[{k}]" for k in range(70)]
    assert packing.whole(values, ["result"]) == "v"
    assert packing.whole(values, ["v"]) == ""
    assert packing.whole([*values[:-1], "v[68]"], ["result"]) == ""
    assert packing.whole(["x", "y"], ["result"]) == ""
