"""Random emissions called with extreme arguments: statuses under the sanitizers, no traps and no warnings."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from codegen.build import Compiler, compile_files
from tests.dialects import DIALECTS, objections, standard
from tests.emissions import Options, drawn, emitted
from tests.extremes import program
from tests.promises import sanitizes

SANITIZE = ("-g", "-O0", "-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all")

SEEDS = (1, 2, 3, 4, 5, 6, 7, 8)
"""Seeds of the draws; each gives five emissions."""


def check(
    emission: tuple[str, str, Options], compiler: Compiler, dialect: str, folder: Path, draws: int
) -> None:
    """Compile an emission with sanitizers and run it with extreme arguments."""
    artifact = emitted(*emission)
    files = {**artifact.files, "main.c": program(artifact, draws)}
    compile_files(files, folder, folder / "main", (*standard(dialect), *SANITIZE), compiler)
    answer = subprocess.run([folder / "main"], capture_output=True, text=True, check=False, timeout=600)
    assert (answer.returncode, answer.stderr) == (0, ""), emission
    ordinary = int(answer.stdout.split()[2])
    assert ordinary >= 3, (emission, answer.stdout)


@pytest.mark.parametrize(
    ("emission", "dialect"),
    [
        (("actuated_rigid_body", "rkmk:gauss2", (("precision", "single"), ("inputs", ("u0",)))), "gnu17"),
        (("free_rigid_body", "ambient:radau2a3", (("adaptive", True), ("jacobian", True))), "c11"),
    ],
)
def test_extreme_arguments_end_in_a_status(
    compiler: Compiler, emission: tuple[str, str, Options], dialect: str, tmp_path: Path
) -> None:
    if not sanitizes(compiler):
        pytest.skip(f"{compiler.command[0]} has no library for its sanitizers")
    check(emission, compiler, dialect, tmp_path, 50)


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_random_emissions_are_clean_in_every_dialect(compiler: Compiler, seed: int, tmp_path: Path) -> None:
    if not sanitizes(compiler):
        pytest.skip(f"{compiler.command[0]} has no library for its sanitizers")
    for number, emission in enumerate(drawn(seed, 5)):
        for dialect in DIALECTS:
            folder = tmp_path / f"{number}{dialect}"
            folder.mkdir()
            check(emission, compiler, dialect, folder, 50)
            source = next(path for path in folder.glob("*.c") if path.name != "main.c")
            assert objections(compiler.command[0], dialect, [source]) == "", emission
