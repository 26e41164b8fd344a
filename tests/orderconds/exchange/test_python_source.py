"""Python modules: arrays are read from the syntax tree. A module is executed only on request, and a module
that may change its arrays is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from orderconds import Tableau
from orderconds.checking import check, read
from orderconds.errors import TableauError
from orderconds.exchange.python_source import read as parsed
from orderconds.exchange.python_source import reason_to_skip

HEUN = {"A": [["0", "0"], ["1", "0"]], "b": ["1/2", "1/2"], "family": "rk"}


@pytest.mark.parametrize(
    "source",
    [
        "A = [[0, 0], [1, 0]]\nb = [1/2, 1/2]",
        "A, b = [[0, 0], [1, 0]], (1/2, 1/2)",
        "import numpy as np\nA = np.zeros((2, 2))\nA[1, 0] = 1\n"
        "b = np.array([1.5, 1])\nb[0] = 1/2\nb[1] = 1/2",
        "import numpy as np\nA = np.zeros((2, 2))\nA[1][0] = 1\nh = 1/2\nb = np.asarray([h, h])",
        "from fractions import Fraction as F\nfrom fractions import Fraction\n"
        "A: list = [[0, 0], [1, 0]]\nb = [Fraction(1, 2), Fraction('1/2')]",
        "from sympy import *\nA = Matrix([[0, 0], [1, 0]])\nb = Matrix([[Rational(1, 2)], [S(1)/2]])",
        "A = [[0, 0], [1, 0]]\nb = [1/2, 1/2]\nc = A.sum(axis=1)\n"
        "print(A)\n\ndef step(y):\n    return A, y\n",
        "A = [[0, 0], [1, 0]]\nb = [1/2, 1/2]\nif __name__ == '__main__':\n    A[1][0] = 7\n",
        '"""A docstring."""\nA = [[0, 0], [1, 0]]\nb = ["1/2", "1/2"]',
        "A = [[9]]\nA = [[0, 0], [1, 0]]\nb = [1/2, 1/2]",
    ],
)
def test_arrays_are_read_from_literals_names_and_constructors(source: str) -> None:
    data = parsed(source.encode(), "m.py")
    assert {key: data[key] for key in HEUN} == HEUN


@pytest.mark.parametrize(
    "source",
    [
        "A = make()\nb = [1]",
        "A = [[0]]\nb = [1]\nfor i in range(1):\n    A[i][i] = 1",
        "A = [[0]]\nb = [1]\nA[0][0] += 1",
        "A = [[0]]\nb = [1]\nB = A\nB[0][k] = 1",
        "A = [[0]]\nb = [1]\nfill(A)",
        "A = [[0]]\nb = [1]\nA.append([1])",
        "A = [[0]]\nb = [1]\nfrom other import *",
        "A = [[0]]\nb = [1]\nif x:\n    b = [2]",
        "A = [[0]]\nb = [1]\ndef change():\n    global A\n    A = [[1]]\nchange()",
        "A = [[0]]\nb = [1]\ntry:\n    b[0] = 2\nfinally:\n    pass",
        "A = [[0]]\nb = [1]\nwith f() as b:\n    pass",
        "A = [[0]]\nb = [x for x in [1]]",
        "A = [[0]]\nb = [1j]",
        "A = [[0]]\nb = [True]",
        "A = [[0]]\nb = [2**x]",
        "A = [[0]]\nb = [1 // 2]",
        "import numpy as np\nA = [[0]]\nb = np.array([1/3], dtype=np.float32)",
        "A = [[0]]\nb = np.linspace(0, 1, 1)",
        "A = [[0]] * 2\nb = [1, 0]",
        "A = [[0]]\nb = [1]\ndel b",
        "def sqrt(x):\n    return 1\nA = [[0]]\nb = [sqrt(2)]",
        "import numpy as np\nA = np.array([[0, 0], [1, 0]])\nb = [0, 1]\nA[1, 0] = 1/2",
        "A = [[0]]\n[b] = [[1]]\nb = f(b)",
    ],
)
def test_a_module_whose_arrays_only_execution_yields_is_refused(source: str) -> None:
    with pytest.raises(TableauError, match=r"not known without executing the file: .*--execute"):
        parsed(source.encode(), "m.py")


def test_nothing_is_executed_without_the_flag(tmp_path: Path) -> None:
    path = tmp_path / "m.py"
    path.write_text(
        f"open({str(tmp_path / 'ran')!r}, 'w').close()\n"
        "A = [[0, 0], [1.0, 0]]\nb = [1/3 + 1/6, 0.5]\norder = 2\n"
        "print('text')\n"
    )
    assert check(path).verdict == "holds"
    assert not (tmp_path / "ran").exists()
    assert check(read(path, execute=True)).verdict == "holds"
    assert (tmp_path / "ran").exists()


def test_an_executed_module_may_compute_its_arrays(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "gauss.py"
    path.write_text(
        "import numpy as np\nfrom fractions import Fraction\nr = np.sqrt(3) / 6\nprint('text')\n"
        "A = 0.25 * np.ones((2, 2)) + r * np.array([[0, -1], [1, 0]])\n"
        "b = [Fraction(1, 2)] * 2\nclaims = {'rk': 4}\n"
    )
    report = check(read(path, execute=True))
    assert (report.verdict, report.orders[0].certificate) == ("holds", "double")
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("raise ValueError('x')", "ValueError: x"),
        ("raise SystemExit(3)", "SystemExit: 3"),
        ("A = [[0]]\nb = [1j]", "expected a real number"),
        ("A = [[0]]\nb = [object()]", "an object of type object"),
        ("A = [[0]]\nb = [float('nan')]", "expected a finite number"),
        ("x = 1", "no array of coefficients"),
    ],
)
def test_an_executed_module_that_fails_gives_one_message(tmp_path: Path, source: str, message: str) -> None:
    path = tmp_path / "m.py"
    path.write_text(source)
    with pytest.raises(TableauError, match=message):
        read(path, execute=True)


@pytest.mark.parametrize(
    ("source", "skipped"),
    [
        ("A = [[0]]\nb = [1]", False),
        ("A = make()\nb = make()", False),
        ("gamma = [1]", False),
        ("alpha, beta = 0.1, 0.2", True),
        ("A = 1\nb = 2", True),
        ("b = [1]", True),
        ("def (", True),
        ("", True),
    ],
)
def test_a_module_without_the_arrays_of_a_tableau_is_skipped(source: str, skipped: bool) -> None:
    assert bool(reason_to_skip(source.encode())) is skipped


@pytest.mark.parametrize(
    "source",
    [
        "from fractions import Fraction as F\nA = [[0, 0], [F(1), 0]]\nb = [F(1, 2), F('1/2')]",
        "from sympy import Rational as R, Matrix as M\nA = M([[0, 0], [1, 0]])\nb = [R(1, 2), R(1, 2)]",
        "from numpy import array as arr\nA = arr([[0, 0], [1, 0]])\nb = arr([1/2, 1/2])",
    ],
)
def test_imported_functions_may_have_other_names(source: str) -> None:
    assert parsed(source.encode(), "m.py")["A"] == HEUN["A"]
    assert check(Tableau.rk(HEUN["A"], parsed(source.encode(), "m.py")["b"])).orders[0].order == 2


def test_functions_of_other_modules_are_refused() -> None:
    source = b"from mine import Fraction\nA = [[0, 0], [1, 0]]\nb = [Fraction(1, 2), Fraction(1, 2)]\n"
    with pytest.raises(TableauError, match="a call of Fraction is not evaluated, because Fraction is"):
        parsed(source, "m.py")
