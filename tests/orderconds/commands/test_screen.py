"""What commands print goes through rich on a terminal only."""

from __future__ import annotations

import pytest

from orderconds.commands import screen


def test_a_pipe_gets_plain_columns(capsys: pytest.CaptureFixture[str]) -> None:
    screen.print_table(("a", "b"), [("long entry", "x")], indent=2)
    assert capsys.readouterr().out == "  a           b\n  long entry  x\n"


def test_a_terminal_gets_the_same_cells(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(screen, "is_terminal", lambda: True)
    screen.print_table(("a", "b"), [("[bold]", "x")])
    out = capsys.readouterr().out
    assert "[bold]" in out
    assert "x" in out


def test_progress_is_for_terminals_only(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with screen.working("counting"):
        pass
    assert capsys.readouterr() == ("", "")
    monkeypatch.setattr(screen, "is_terminal", lambda: True)
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    with screen.working("counting"):
        pass
    assert capsys.readouterr().out == ""


def test_json_keeps_the_order_of_keys(capsys: pytest.CaptureFixture[str]) -> None:
    screen.print_json({"z": 1, "a": "å"})
    assert capsys.readouterr().out == '{\n  "z": 1,\n  "a": "\\u00e5"\n}\n'
