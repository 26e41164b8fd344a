"""The stack that headers state is enough for gcc and clang at every level of optimisation."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from codegen.artifact import Artifact
from codegen.build import Compiler
from tests.emissions import Options, drawn, emitted
from tests.painted_stack import painted

LIBRARY = 512
"""Bytes for functions of the mathematical library, which headers do not count."""

LEVELS = ("-O0", "-O1", "-O2", "-O3")

STIFF: tuple[tuple[str, str, Options], ...] = (
    ("dipole", "ambient:radau2a3", (("adaptive", True), ("solver", "newton"))),
    ("dipole", "cf:radau2a5", (("precision", "single"), ("solver", "newton"))),
    ("free_rigid_body_attitude", "ambient:radau2a3", (("adaptive", True), ("solver", "simplified-newton"))),
    (
        "actuated_rigid_body",
        "ambient:gauss3",
        (("solver", "newton"), ("jacobian", True), ("inputs", ("u0",))),
    ),
)
"""Methods with large matrices: they need the most stack beyond the names of a module."""

OTHERS: tuple[tuple[str, str, Options], ...] = (
    ("free_rigid_body", "cf4", ()),
    ("free_rigid_body", "cf43", (("adaptive", True), ("precision", "single"))),
    ("dipole", "ambient:dop853", (("adaptive", True),)),
    ("heavy_top", "slgi:midpoint", (("frame", "body"), ("jacobian", True))),
)


def stated(artifact: Artifact) -> int:
    """Return the bound of a header."""
    source = next(text for name, text in artifact.files.items() if name.endswith(".c"))
    return int(re.search(r"stack: +at most (\d+) bytes", source)[1])  # type: ignore[index]


def check(emission: tuple[str, str, Options], compiler: Compiler, level: str, folder: Path) -> None:
    """Compare the painted stack of an emission with its bound."""
    artifact = emitted(*emission)
    found = painted(artifact, compiler, level, folder)
    assert {"step", "run"} <= set(found)
    assert min(found.values()) > 0
    assert max(found.values()) <= stated(artifact) + LIBRARY, (emission, found)


def slow(emission: tuple[str, str, Options], level: str) -> bool:
    """Return whether only the slow run tries an emission at a level. Large matrices are slow to optimise."""
    return level in ("-O1", "-O3") or (level == "-O2" and emission in STIFF)


@pytest.mark.parametrize(
    ("emission", "level"),
    [
        pytest.param(e, x, id=f"{e[0]}-{e[1]}-{x}", marks=pytest.mark.slow if slow(e, x) else ())
        for x in LEVELS
        for e in (STIFF[0], OTHERS[1], OTHERS[2])
    ],
)
def test_calls_stay_within_the_stated_stack(
    compiler: Compiler, level: str, emission: tuple[str, str, Options], tmp_path: Path
) -> None:
    check(emission, compiler, level, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("level", LEVELS)
def test_all_calls_stay_within_the_stated_stack(compiler: Compiler, level: str, tmp_path: Path) -> None:
    """Large matrices, other options, and twenty random emissions of a fixed seed."""
    for number, emission in enumerate((*STIFF, *OTHERS, *drawn(11, 20))):
        folder = tmp_path / str(number)
        folder.mkdir()
        check(emission, compiler, level, folder)
