"""What is emitted is what is certified: coefficients come from the proved enclosure, not from the file."""

from __future__ import annotations

from pathlib import Path

import pytest

import codegen
from codegen.certify import certified_order
from codegen.method import parse
from orderconds.checking import check

TRIPLE_JUMP = """name = "jump"
family = "rk"
A = [["b1/2"], ["b1", "b2/2"], ["b1", "b2", "b1/2"]]
b = ["b1", "b2", "b1"]
numbers = {{ b1 = "{digits}~", b2 = "1 - 2*b1" }}
{proof}[claims]
rk = 4
cg = 4
"""
PROOF = '[proof]\nconditions = "vcg"\norder = 4\nreduction = "spelling"\n'
EXACT = "1.3512071919596576340476878089714608269219993"


def written(folder: Path, digits: str, proof: str = PROOF) -> str:
    path = folder / "jump.toml"
    path.write_text(TRIPLE_JUMP.format(digits=digits, proof=proof), encoding="utf-8")
    return f"cg:{path}"


@pytest.mark.parametrize("digits", ["1.3512", "1.35120719", EXACT])
def test_coefficients_are_the_solution_and_not_the_digits(tmp_path: Path, digits: str) -> None:
    method = parse(written(tmp_path, digits), ("cg",))
    assert [float(str(method.ring.nearest_float(x))) for x in method.runge_kutta().b] == [  # type: ignore[attr-defined]
        float(EXACT),
        float("-1.7024143839193152680953756179429216538439986"),
        float(EXACT),
    ]
    order = certified_order(method)
    assert (order.order, order.certificate, order.radius) == (4, "ball", "")


def test_emitted_code_has_the_solution(tmp_path: Path) -> None:
    (text,) = codegen.emit("free_rigid_body", written(tmp_path, "1.3512"), target="python").files.values()
    assert "certificate: ball" in text
    assert "1.3512071919596577" in text or "0.6756035959798288" in text
    assert "1.3512 " not in text


def test_coefficients_known_to_less_than_a_double_have_the_certificate_of_check_and_their_uncertainty(
    tmp_path: Path,
) -> None:
    method = parse(written(tmp_path, "1.351207191959", proof=""), ("cg",))
    order = certified_order(method)
    known = next(f for f in check(method.tableau).orders if f.family == "cg")
    assert (order.order, order.certificate) == (known.order, known.certificate) == (4, "decimal")
    assert any(f"the coefficients is {r}" in order.text() for r in ("1.0e-12", "2.0e-12"))


def test_decimals_as_precise_as_a_double_are_decimals(tmp_path: Path) -> None:
    order = certified_order(parse(written(tmp_path, EXACT, proof=""), ("cg",)))
    assert (order.order, order.certificate) == (4, "decimal")
