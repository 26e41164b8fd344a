"""Each limit of .ci/structure.py is enforced: a tree that breaks it is caught, one that keeps it passes."""

from __future__ import annotations

import importlib.util
import json
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

SCRIPT = Path(__file__).parents[1] / ".ci/structure.py"


def load() -> ModuleType:
    spec = importlib.util.spec_from_file_location("structure", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["structure"] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


structure = load()


def tree(root: Path, **files: str) -> Path:
    """Write files named ``package__folder__module`` below ``root``; ``package`` is ``__init__``."""
    for name, text in files.items():
        path = root / (name.replace("__", "/").replace("/package", "/__init__") + ".py")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return root


def violations(root: Path, **limits: Any) -> list[str]:
    return [str(v) for v in structure.measure(root, structure.Limits(**limits)).violations]


def function(lines: int, indent: str = "") -> str:
    return f"{indent}def f():\n" + f"{indent}    x = 1\n" * (lines - 1)


def branches(number: int, comment: str = "") -> str:
    return f"def f(x):{comment}\n" + "    if x: pass\n" * (number - 1)


def test_a_function_of_sixty_lines_passes_and_of_sixty_one_fails(tmp_path: Path) -> None:
    assert violations(tree(tmp_path, codegen__a=function(60))) == []
    assert violations(tree(tmp_path, codegen__a="\n" + function(61))) == [
        "codegen/a.py:2: function f has 61 lines (allowed: 60)"
    ]


def test_methods_and_inner_functions_count_and_classes_do_not(tmp_path: Path) -> None:
    tree(tmp_path, orderconds__a="class A:\n" + function(61, "    "))
    assert violations(tmp_path) == ["orderconds/a.py:2: function A.f has 61 lines (allowed: 60)"]
    tree(tmp_path, orderconds__a="class A:\n" + "    x = 1\n" * 70)
    assert violations(tmp_path) == []


def test_a_complexity_of_sixteen_fails(tmp_path: Path) -> None:
    assert violations(tree(tmp_path, codegen__a=branches(15))) == []
    (found,) = violations(tree(tmp_path, codegen__a=branches(16)))
    assert found.startswith("codegen/a.py:1: function f has complexity 16 (allowed: 15")


def test_a_reason_at_the_signature_excuses_complexity_and_an_empty_one_does_not(tmp_path: Path) -> None:
    assert violations(tree(tmp_path, codegen__a=branches(16, "  # complexity: one case a node"))) == []
    assert len(violations(tree(tmp_path, codegen__a=branches(16, "  # complexity:")))) == 1
    assert len(violations(tree(tmp_path, codegen__a=branches(16) + "    # complexity: too late\n"))) == 1


@pytest.mark.parametrize(
    ("body", "number"),
    [
        ("pass", 1),
        ("if x: pass\n elif y: pass\n else: pass", 3),
        ("for _ in x: pass", 2),
        ("while x: pass\n else: pass", 3),
        ("try: pass\n except A: pass\n except B: pass\n else: pass", 4),
        ("match x:\n  case 1: pass\n  case 2: pass\n  case _: pass", 3),
        ("def g():\n  if x: pass", 3),
    ],
)
def test_complexity_is_mccabes_number(body: str, number: int) -> None:
    module = structure.ast.parse(f"def f(x):\n {body}\n")
    assert structure.complexity(module.body[0]) == number


def test_a_module_above_five_hundred_lines_fails(tmp_path: Path) -> None:
    assert violations(tree(tmp_path, codegen__a="x = 1\n" * 500)) == []
    assert violations(tree(tmp_path, codegen__a="x = 1\n" * 501)) == [
        "codegen/a.py:1: 501 lines (allowed: 500)"
    ]


def test_lines_with_any_are_counted_over_both_packages(tmp_path: Path) -> None:
    root = tree(tmp_path, codegen__a="x: Any\ny: Any | Any\n", orderconds__b="z: Any\nAnything = 1\n")
    assert violations(root, any_lines=3) == []
    (found,) = violations(root, any_lines=2)
    assert found.startswith("total: 3 lines with Any in 2 files")


def test_type_ignores_are_counted(tmp_path: Path) -> None:
    root = tree(tmp_path, codegen__a="x = 1  # type: ignore\ny = 2  # type: ignore[misc]\n")
    assert violations(root, type_ignores=2) == []
    (found,) = violations(root, type_ignores=1)
    assert found.startswith("total: 2 lines with type: ignore in 1 files")


@pytest.mark.parametrize(
    "back",
    [
        "import codegen.a\n",
        "from codegen import a\n",
        "from codegen.a import x\n",
        "from . import a\n",
        "from .a import x\n",
        "def f():\n    from codegen.a import x\n",
        "class A:\n    def f(self):\n        import codegen.a\n",
        "try:\n    import codegen.a\nexcept ImportError: pass\n",
    ],
)
def test_a_circle_of_imports_is_caught_at_any_level(tmp_path: Path, back: str) -> None:
    (found,) = violations(tree(tmp_path, codegen__a="from codegen.b import y\n", codegen__b=back))
    assert found.startswith("codegen/a.py:1: 2 modules import each other")
    assert "codegen/b.py:" in found


def test_a_relative_import_in_a_package_starts_at_the_package(tmp_path: Path) -> None:
    tree(tmp_path, codegen__r__package="from .a import x\nfrom . import a\n", codegen__a="import codegen.r\n")
    assert violations(tmp_path) == []
    (found,) = violations(tree(tmp_path, codegen__r__a="from . import y\n"))
    assert found.startswith("codegen/r/__init__.py:1: 2 modules import each other")


def test_circles_by_imports_inside_functions_are_figures_of_their_own(tmp_path: Path) -> None:
    tree(tmp_path, codegen__a="import codegen.b\n", codegen__b="def f():\n    import codegen.a\n")
    figures = structure.measure(tmp_path).figures
    assert figures["imports inside functions"] == 1
    assert figures["circles of imports"] == 1
    assert figures["  of these without imports inside functions"] == 0


def test_a_circle_through_three_files_and_a_package_is_printed(tmp_path: Path) -> None:
    tree(tmp_path, codegen__r__package="from codegen.a import x\n", codegen__a="import codegen.b\n")
    (found,) = violations(tree(tmp_path, codegen__b="from codegen.r import z\n"))
    for step in ("codegen/a.py:1 (module) -> codegen.b", "codegen/b.py:1 (module) -> codegen.r"):
        assert step in found


def test_an_import_for_types_closes_no_circle_and_is_counted(tmp_path: Path) -> None:
    typed = "if TYPE_CHECKING:\n    from codegen.a import x\n"
    tree(tmp_path, codegen__a="from codegen.b import y\n", codegen__b=typed)
    assert violations(tmp_path) == []
    assert structure.measure(tmp_path).figures["circles with TYPE_CHECKING imports added"] == 1


def test_imports_in_one_direction_are_no_circle(tmp_path: Path) -> None:
    tree(
        tmp_path, codegen__a="from codegen import b, c\n", codegen__b="from codegen import c\n", codegen__c=""
    )
    assert violations(tmp_path) == []


def test_the_comment_density_of_the_core_is_enforced(tmp_path: Path) -> None:
    text = '"""# no comment"""\n# why\nx = 1  # noqa: E741\ny = "# none"\n'
    root = tree(tmp_path, codegen__lower__a=text, codegen__lab__b="# elsewhere\n")
    assert structure.measure(root).figures["comments in the core (%)"] == 25
    assert violations(root) == ["total: 25.0 % comment lines in the core (allowed: 8 to 15 %)"]
    tree(tmp_path, codegen__lower__a=text + "z = 1\n" * 6)
    assert violations(root) == []
    tree(tmp_path, codegen__lower__a=text + "z = 1\n" * 9)
    assert violations(root) == ["total: 7.7 % comment lines in the core (allowed: 8 to 15 %)"]


def test_the_status_is_one_if_and_only_if_a_limit_is_broken(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tree(tmp_path, codegen__a="x: Any = 1\n")
    assert structure.main([str(tmp_path), "--files"]) == 0
    assert "lines with Any" in capsys.readouterr().out
    tree(tmp_path, codegen__a=function(61))
    assert structure.main([str(tmp_path)]) == 1
    assert "1 violations:\ncodegen/a.py:1: function f has 61 lines" in capsys.readouterr().out
    assert structure.main([str(tmp_path), "--json"]) == 1
    result = json.loads(capsys.readouterr().out)
    assert result["figures"]["longest function (lines)"] == 61
    assert result["violations"][0]["where"] == "codegen/a.py:1"


def test_a_folder_without_the_packages_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SystemExit) as refused:
        structure.main([str(tmp_path)])
    assert refused.value.code == 2
