"""A user's script is checked by mypy --strict against the annotations of both packages."""

from __future__ import annotations

from pathlib import Path

import pytest

api = pytest.importorskip("mypy.api")

ROOT = Path(__file__).parents[2]
SCRIPT = Path(__file__).with_name("typing_script.py")


def mypy(script: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.setenv("MYPYPATH", str(ROOT))
    monkeypatch.chdir(ROOT)
    settings = ["--config-file", "pyproject.toml", "--follow-imports=silent", "--explicit-package-bases"]
    out, _, _ = api.run([*settings, "--strict", str(script)])
    return str(out)


@pytest.mark.parametrize("package", ["orderconds", "codegen"])
def test_both_packages_say_that_they_are_typed(package: str) -> None:
    assert (ROOT / package / "py.typed").is_file()


@pytest.mark.slow
def test_a_script_of_a_user_has_types(monkeypatch: pytest.MonkeyPatch) -> None:
    assert mypy(SCRIPT, monkeypatch).startswith("Success")


@pytest.mark.slow
def test_a_wrong_type_in_a_script_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    script = tmp_path / "wrong.py"
    script.write_text("import orderconds\n\norderconds.trees(4, order='rooted')\n", encoding="utf-8")
    assert mypy(script, monkeypatch).count("arg-type") == 2
