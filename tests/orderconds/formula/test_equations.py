"""LaTeX of conditions: it is what a TeX engine accepts, and breaking lines loses nothing."""

from __future__ import annotations

import re

import pytest

from orderconds import families
from orderconds.derivation import derive
from orderconds.formula.equations import LINE, Equation, broken, numbered
from orderconds.stage_expansion import expand_stages


def formulas(family: str) -> list[str]:
    order = families.get(family).order_bound or 3
    found = [condition.latex_equation for condition in derive(family, order).conditions]
    if families.get(family).formats[0] == "rk":
        written = expand_stages(derive(family, order), 3)
        found += [condition.latex_equation for condition in written.conditions]
    return found


@pytest.mark.parametrize("family", families.with_conditions())
def test_conditions_are_mathematics_that_a_tex_engine_reads(family: str) -> None:
    mathtext = pytest.importorskip("matplotlib.mathtext")
    parser = mathtext.MathTextParser("path")
    for latex in formulas(family):
        # Matplotlib knows neither \tfrac nor \Bigl, which differ from \frac and \left in size alone.
        known = latex.replace("tfrac", "frac").replace("Bigl", "left").replace("Bigr", "right")
        parser.parse(f"${known}$")


def test_a_wrong_formula_is_refused() -> None:
    mathtext = pytest.importorskip("matplotlib.mathtext")
    with pytest.raises(ValueError, match="sumx"):
        mathtext.MathTextParser("path").parse(r"$\sumx b_{i}$")


@pytest.mark.parametrize("family", families.with_conditions())
@pytest.mark.parametrize("line", [20, LINE])
def test_broken_lines_are_the_formula(family: str, line: int) -> None:
    for latex in formulas(family):
        lines = broken(latex, line)
        assert " ".join(lines).replace(" ", "") == latex.replace(" ", "")
        # Braces never stand open at the end of a line; sized brackets may.
        assert all(part.count("{") == part.count("}") for part in lines)
        assert all(re.match(r"[+-] ", part) for part in lines[1:])


def test_a_line_is_broken_outside_brackets_where_that_will_do() -> None:
    latex = r"\sum_{i} \Bigl(b_{i} + c_{i}\Bigr) + \sum_{i} b_{i}"
    assert broken(latex, 12) == [r"\sum_{i} \Bigl(b_{i} + c_{i}\Bigr)", r"+ \sum_{i} b_{i}"]


def test_rows_are_parted_by_two_backslashes() -> None:
    rows = [Equation("x", "1", label="one"), Equation(" + ".join(["a_{1} b_{2}"] * 40), "1/2", label="two")]
    first, *lines, last = (line.strip() for line in numbered(rows).splitlines())
    assert (first, last) == (r"\begin{align}", r"\end{align}")
    assert lines[0] == r"& x = 1 \label{one} \\"
    assert all(line.startswith("& ") for line in lines)
    assert all(line.endswith(r" \notag \\") for line in lines[1:-1])
    assert lines[-1].endswith(r"= 1/2 \label{two}")


def test_short_equations_have_three_columns_and_aligned_signs() -> None:
    rows = [Equation("x", "1", picture="P", label="one"), Equation("y z", "2", label="two")]
    assert numbered(rows).splitlines() == [
        r"\begin{alignat}{2}",
        r"  P &\quad& x &= 1 \label{one} \\",
        r"   &\quad& y z &= 2 \label{two}",
        r"\end{alignat}",
    ]


def test_nothing_is_broken_inside_braces() -> None:
    assert broken(r"x_{i + 1} + y", 1) == ["x_{i + 1}", "+ y"]
