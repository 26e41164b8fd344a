"""The calling convention survives the manifest, and has exactly the arguments that a kernel reads."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from codegen.emitter import compile_method
from codegen.printers.interface import Interface

NAMES = st.lists(st.text("abc", min_size=1, max_size=3), max_size=3, unique=True).map(tuple)


@given(NAMES, NAMES, NAMES, st.booleans(), st.integers(0, 12))
def test_an_interface_survives_json(
    parameters: tuple[str, ...], blocks: tuple[str, ...], inputs: tuple[str, ...], flag: bool, n: int
) -> None:
    interface = Interface("m_", 3, flag, parameters, blocks, inputs=inputs, adaptive=flag, variations=n)
    assert Interface.from_json(json.loads(json.dumps(interface.as_json()))) == interface


@pytest.mark.parametrize(("scene", "method"), [("free_rigid_body", "cf4"), ("dipole", "vcg:midpoint")])
def test_time_is_an_argument_only_if_the_kernel_reads_it(scene: str, method: str) -> None:
    kernel = compile_method(scene, method).kernel
    interface = Interface.of(kernel, "m_")
    assert not interface.time
    assert interface.size == sum(len(field.symbols) for field in kernel.state)
    assert len(interface.blocks) == len(interface.solvers) == len(kernel.loops)


def test_the_module_is_the_prefix_without_its_underscore() -> None:
    assert Interface("a_b_", 1, False, (), ()).module == "a_b"
