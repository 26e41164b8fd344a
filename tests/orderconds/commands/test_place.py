"""An empty name of a place to write to is bad usage, in every command that writes."""

from __future__ import annotations

import pytest
from click.testing import CliRunner

from orderconds.cli import program


@pytest.mark.parametrize(
    "arguments",
    [["convert", "rk4"], ["construct", "gauss", "--stages", "2"], ["refine", "cg4a"]],
    ids=lambda x: x[0],
)
@pytest.mark.parametrize("place", ["", "  "])
def test_an_empty_place_is_bad_usage(arguments: list[str], place: str) -> None:
    result = CliRunner().invoke(program, [*arguments, "-o", place])
    assert result.exit_code == 2
    assert "names no file" in result.output
