"""``orderconds solve``: what it finds passes ``check``; what it cannot do it says in one message."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from orderconds.checking import check
from orderconds.cli import program


def run(*args: str) -> Result:
    return CliRunner().invoke(program, ["solve", *args, "--processes", "1"])


def record(*args: str, status: int = 0) -> Any:
    result = run(*args, "--json")
    assert result.exit_code == status, result.stderr
    return json.loads(result.stdout)


@pytest.mark.parametrize(
    ("args", "family", "certificate"),
    [
        ("vcg --stages 3 --order 3", "vcg", "exact"),
        ("vcf --stages 2 --order 4", "vcf", "exact"),
        ("vcf --stages 2 --order 4 --symmetric", "vcf", "exact"),
        pytest.param(
            "vcf --stages 3 --order 6 --symmetric --exponentials 4 --inner 3",
            "vcf",
            "exact",
            marks=pytest.mark.slow,
        ),
        ("cg --stages 3 --order 3 --explicit", "cg", "exact"),
        ("rk --stages 4 --order 4 --explicit", "rk", "exact"),
        ("rk --stages 6 --order 5 --explicit", "rk", "ball"),
        ("vcg --stages 4 --order 4", "vcg", "ball"),
        ("vcg --stages 2 --order 2 --positive b --size 1", "vcg", "exact"),
        ("vcf --stages 1 --order 2", "vcf", "exact"),
        ("sprk --stages 2 --order 4", "sprk", "exact"),
        ("vrkmk(2) --stages 2 --order 4", "vrkmk(2)", "exact"),
        ("composition --stages 5 --order 4", "composition", "exact"),
        ("splitting --stages 6 --order 4 --symmetric", "splitting", "exact"),
        ("splitting --stages 3 --order 4 --symmetric --rkn", "rkn", "exact"),
        ("cf --stages 3 --order 3 --explicit", "cf", ""),
        ("rkmk(1) --stages 3 --order 3 --explicit", "rkmk(1)", "exact"),
        ("symplectic_rk --stages 3 --order 6", "rk", "exact"),
        ("symplectic_rk --stages 3 --order 4 --symmetric", "rk", "exact"),
        ("symplectic_rk --stages 3 --order 4 --dirk --symmetric", "rk", "exact"),
        ("symplectic_rk --stages 3 --order 4 --fix a12=0", "rk", "exact"),
    ],
)
def test_what_is_found_passes_check(args: str, family: str, certificate: str, tmp_path: Path) -> None:
    path = tmp_path / "found.toml"
    found = record(*args.split(), "-o", str(path))
    assert found["verdict"] == "found"
    assert found["certificate"] in ("exact", "ball")
    assert certificate in ("", found["certificate"])
    report = check(path, complete=True, certified=True)
    assert report.verdict == "holds"
    (order,) = check(path, family).orders
    assert order.order >= found["order"]
    assert order.certificate == found["certificate"]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["found.toml"]


def test_the_command_in_the_source_finds_the_same_file() -> None:
    found = record("rk", "--stages", "4", "--order", "4", "--explicit", "--fix", "a21=1/2", "--seed", "7")
    command = found["command"].split()
    assert command[:2] == ["orderconds", "solve"]
    assert record(*command[2:])["tableau"] == found["tableau"]
    assert (
        'source = "orderconds solve rk --stages 4 --order 4 --explicit --fix a21=1/2 --seed 7"'
        in (found["tableau"])
    )


def test_fixed_entries_are_in_the_file() -> None:
    found = record("rk", "--stages", "3", "--order", "3", "--explicit", "--fix", "a21=2/5", "--fix", "a31=0")
    assert 'A = [[], ["2/5"], ["0", ' in found["tableau"]


@pytest.mark.parametrize(
    "args",
    [
        "rk --stages 2 --order 2 --explicit --positive b --fix b1=1/200",
        "rk --stages 2 --order 2 --explicit --positive b --fix c2=100",
    ],
)
def test_every_positive_weight_is_accepted(args: str) -> None:
    """In the second case, the weight b_2 = 1/200 is computed by the search."""
    assert '"1/200"' in record(*args.split(), "--starts", "64")["tableau"]


def test_the_bound_of_size_does_not_apply_to_sums_of_coefficients() -> None:
    args = "cf --stages 1 --order 2 --exponentials 2 --inner 1 --size 1/2 --starts 64"
    found = record(*args.split())
    assert 'exp = [["1/2"], ["1/2"]]' in found["tableau"]


def test_two_stages_of_order_three_are_refuted() -> None:
    proof = record("vcg", "--stages", "2", "--order", "3", status=1)["proof"]
    assert proof["reason"] == "3*b2^2 - 3*b2 + 1 = 0 has no real root (Sturm)"
    result = run("vcg", "--stages", "2", "--order", "3")
    assert result.exit_code == 1
    assert "no vcg method with 2 stages has order 3" in result.stdout


def test_a_refutation_names_the_options_and_the_assumptions() -> None:
    result = run("symplectic_rk", "--stages", "2", "--order", "3", "--dirk")
    assert result.exit_code == 1
    assert result.stdout.splitlines()[:3] == [
        "no symplectic_rk method with 2 stages and the options --dirk and the following properties "
        "has order 3:",
        "  - all weights b_i are nonzero",
        "proof:",
    ]


def test_found_symplectic_tableaux_are_symplectic(tmp_path: Path) -> None:
    for options in ("--stages 2", "--stages 3 --symmetric", "--stages 4 --dirk --size 1"):
        found = record("symplectic_rk", "--order", "2", *options.split(), "-o", str(tmp_path / "found.toml"))
        assert "symplectic = true" in found["tableau"]


def test_nothing_found_says_what_was_tried() -> None:
    result = run("cg", "--stages", "4", "--order", "4", "--explicit", "--starts", "64")
    assert result.exit_code == 1
    assert "the least residual norm is" in result.stderr
    assert "structure full" in result.stderr
    assert result.stdout == ""


@pytest.mark.parametrize(
    ("args", "said"),
    [
        ("rk --stages 0 --order 2", "--stages"),
        ("magnus --stages 2 --order 2", "methods of family 'magnus' cannot be searched"),
        ("nosuch --stages 2 --order 2", "unknown family"),
        ("rk --stages 2 --order 2 --fix a21=1 --fix a21=2", "contradicts"),
        ("rk --stages 2 --order 2 --explicit --fix a11=1", "contradicts"),
        ("rk --stages 2 --order 2 --fix a99=1", "unknown coefficient"),
        ("rk --stages 2 --order 2 --positive q", "--positive"),
        ("rk --stages 2 --order 2 --positive b --fix b1=0", "the constraints imply b1 = 0"),
        ("rk --stages 2 --order 2 --size -1", "--size"),
        ("rk --stages 2 --order 2 --size 1e999999999", "--size"),
        ("rk --stages 2 --order 2 --size 1/0", "--size"),
        ("rk --stages 2 --order 2 --exponentials 3", "--exponentials is not available for family rk"),
        ("composition --stages 3 --order 2 --inner 1", "--inner is not available for family composition"),
        ("composition --stages 3 --order 4 --explicit", "--explicit"),
        ("vcf --stages 2 --order 4 --explicit --symmetric", "--explicit with --symmetric"),
        ("rk --stages 2 --order 2 -o nowhere/found.toml", "no such folder"),
        ("rk --stages 2 --order 2 --fix a21=sqrt(2)", "not linear"),
        (
            "rk --stages 2 --order 2 -o found.toml --checkpoint ./found.toml",
            "--checkpoint and --output name the same file",
        ),
        (
            "symplectic_rk --stages 2 --order 2 --explicit",
            "--explicit is not available for family symplectic_rk",
        ),
        ("symplectic_rk --stages 2 --order 2 --fix a12=0 --fix a21=1", "both a12 and a21"),
        ("vcg --stages 4 --order 12", "vcg: there are 51677 trees of order 7;"),
    ],
)
def test_bad_input_is_one_message(args: str, said: str) -> None:
    result = run(*args.split())
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.stderr
    assert result.stdout == ""


def test_a_division_by_zero_at_the_solution_is_the_reason_for_no_proof() -> None:
    # The condition b1 + b2 = 1 implies b1 = 0, and the formulas of the family divide by b1.
    result = run("vrkmk", "--stages", "2", "--order", "2", "--fix", "b1=b2-1", "--starts", "64")
    assert result.exit_code == 1
    said = "the formulas of the family divide by a weight or another number that is zero at the solution"
    assert f"solutions not proved: {said}" in result.stdout + result.stderr


@pytest.mark.skipif(os.name != "posix", reason="links")
@pytest.mark.parametrize("option", ["-o", "--checkpoint"])
def test_a_link_to_itself_is_one_message(option: str, tmp_path: Path) -> None:
    loop, other = tmp_path / "loop.toml", "-o" if option == "--checkpoint" else "--checkpoint"
    loop.symlink_to(loop)
    words = ["rk", "--stages", "2", "--order", "2", option, str(loop), other, str(tmp_path / "other.toml")]
    result = run(*words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert str(loop) in result.stderr
    assert loop.is_symlink()


def test_a_killed_process_resumes_to_the_same_bytes(tmp_path: Path) -> None:
    args = ["vcg", "--stages", "3", "--order", "3", "--minimise", "error", "--starts", "192"]
    whole = tmp_path / "whole.toml"
    start = [sys.executable, "-m", "orderconds", "solve", *args, "--processes", "1"]
    subprocess.run([*start, "-o", str(whole)], check=True, capture_output=True)
    killed = tmp_path / "killed.toml"
    process = subprocess.Popen([*start, "-o", str(killed)], stdout=subprocess.DEVNULL)
    checkpoint = tmp_path / "killed.toml.search"
    while process.poll() is None and not checkpoint.exists():
        os.sched_yield()
    process.kill()
    process.wait()
    subprocess.run([*start, "-o", str(killed)], check=True, capture_output=True)
    assert killed.read_bytes() == whole.read_bytes()


def test_two_processes_that_resume_one_search_give_the_file_of_one(tmp_path: Path) -> None:
    words = [
        "vcg",
        "--stages",
        "3",
        "--order",
        "3",
        "--minimise",
        "error",
        "--starts",
        "192",
        "--processes",
        "1",
    ]
    start = [sys.executable, "-m", "orderconds", "solve", *words, "-o"]
    both = [subprocess.Popen([*start, str(tmp_path / "both.toml")], stdout=subprocess.DEVNULL) for _ in "ab"]
    assert [process.wait() for process in both] == [0, 0]
    subprocess.run([*start, str(tmp_path / "one.toml")], check=True, capture_output=True)
    assert (tmp_path / "both.toml").read_bytes() == (tmp_path / "one.toml").read_bytes()
    assert sorted(os.listdir(tmp_path)) == ["both.toml", "one.toml"]


def test_candidates_that_the_family_cannot_read_do_not_end_the_search() -> None:
    """Some solutions that this search meets have a zero weight, by which the family divides."""
    result = run("vrkmk_pade", "--stages", "3", "--order", "3", "--starts", "256", "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["tried"][0].startswith("structure full: 12 free coefficients")


def test_a_start_at_which_a_formula_divides_by_zero_does_not_end_the_search() -> None:
    found = record("vrkmk", "--stages", "3", "--order", "1", "--seed", "1")
    assert found["verdict"] == "found"
