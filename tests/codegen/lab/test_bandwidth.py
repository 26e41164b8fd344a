"""The measured memory bandwidth of steps on lattices."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest
from click.testing import CliRunner

from codegen.emitter import compile_method, emit_compiled
from codegen.ir.domain import FloatDomain
from codegen.ir.precision import DOUBLE
from codegen.lab.bandwidth import Bandwidth, Unmeasured, cache_bytes, free_bytes, measure
from codegen.printers import target as known_target
from codegen.run.execute import Machine
from codegen.run.plan import Plan
from codegen.run.site_terms import padded
from codegen.run.unit import unit_of
from orderconds.cli import program
from tests.codegen.chains import chain, plane
from tests.codegen.test_implicit_lattice import springs_in_a_row as row

SMALL = 4 << 20


def measured(scene, method, precision="double", seconds=600.0):
    compiled = compile_method(scene, method)
    names = {"scene": "scene", "method": method}
    artifact = emit_compiled(compiled, "c", "", names, precision=precision)
    return measure(compiled, artifact, SMALL, seconds)


@pytest.mark.parametrize("precision", ["double", "single"])
def test_an_explicit_step_uses_a_fraction_of_the_bandwidth_of_the_triad(precision):
    found = measured(plane(), "cf:cf4", precision=precision)
    assert isinstance(found, Bandwidth)
    assert SMALL / 4 < found.array_bytes <= SMALL
    # The workspace of cf4 has 18 numbers, and the state 3; doubles have 8 bytes.
    width = {"double": 8, "single": 4}[precision]
    assert found.array_bytes == 21 * width * found.shape[0] * found.shape[1]
    assert found.moved == (33 + 21) * width
    assert 0 < found.fraction < 1.5
    assert found.rate == pytest.approx(found.moved / found.ns)
    assert f"{found.shape[0]} x {found.shape[1]} sites" in found.lines()[0]
    assert f"{found.fraction:.2f} of the bandwidth" in found.lines()[-1]


def test_the_sweeps_of_implicit_equations_are_counted():
    found = measured(chain(), "rkmk:gauss2")
    assert isinstance(found, Bandwidth)
    (sweeps,) = found.sweeps
    assert 2 < sweeps < 50
    step = compile_method(chain(), "rkmk:gauss2").kernel.sites
    assert found.moved == 8 * step.numbers_moved((sweeps,))
    assert step.numbers_moved((2.0,)) - step.numbers_moved((1.0,)) == 23 + 14
    assert 0 < found.fraction < 1.5


def test_a_compiler_that_fails_gives_the_reason(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("CC", "false")
    found = measured(chain(), "cf:cf4")
    assert found == Unmeasured("false rejected the source (status 1)")
    assert found.lines() == ["bandwidth not measured: false rejected the source (status 1)"]
    monkeypatch.setenv("CC", "no-such-compiler")
    assert "no-such-compiler does not exist" in measured(chain(), "cf:cf4").reason


def test_a_compiler_that_takes_too_long_is_stopped(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    found = measured(chain(), "cf:cf4", seconds=0.001)
    assert "did not compile the module within 0.001 seconds" in found.reason


def test_a_target_without_compiler_is_not_measured(monkeypatch):
    compiled = compile_method(chain(), "cf:cf4")
    artifact = emit_compiled(compiled, "c", "", {"scene": "chain", "method": "cf:cf4"})
    uncompiled = dataclasses.replace(known_target("c"), compiler="")
    monkeypatch.setattr("codegen.lab.bandwidth.known_target", lambda name: uncompiled)
    assert measure(compiled, artifact).reason == "modules in C are not compiled"


def test_sizes_of_memory_are_plausible():
    assert 1 << 16 <= cache_bytes() <= 1 << 34
    assert free_bytes() > 1 << 20


@pytest.mark.slow
def test_explain_prints_the_fraction(tmp_path):
    words = ["emit", "spin_lattice", "--method", "splitting:strang", "--explain"]
    shown = CliRunner().invoke(program, words).stdout
    assert "of the bandwidth of a triad loop" in shown.partition("# memory bandwidth\n")[2]
    record = json.loads(CliRunner().invoke(program, [*words, "--json"]).stdout)[0]
    assert 0 < record["bandwidth"]["fraction"] < 1.5


class _Tracked(list):
    """A list that records the indices that are read and written."""

    def __init__(self, values, name, log):
        super().__init__(values)
        self.name, self.log = name, log

    def __getitem__(self, k):
        self.log[-1][0].add((self.name, k))
        return super().__getitem__(k)

    def __setitem__(self, k, value):
        self.log[-1][1].add((self.name, k))
        super().__setitem__(k, value)


class _Recording(Machine):
    """An executor that records, for each call of a function, the entries of arrays that it reads and
    writes."""

    def call(self, name, *arguments):
        self.log.append((set(), set()))
        result = super().call(name, *arguments)
        self.calls.append((name, *self.log.pop()))
        return result


OPEN = {"boundary": "open", "outside": {(-1,): [0, 0], (1,): [0, 0]}}


@pytest.mark.parametrize(
    ("scene", "method", "solver"),
    [
        (chain(), "cf:cf4", "auto"),
        (chain(), "rkmk:gauss2", "auto"),
        pytest.param(row(), "rk:gauss1", "simplified-newton", marks=pytest.mark.slow),
        (row(**OPEN), "rk:gauss1", "simplified-newton"),
    ],
    ids=["explicit", "fixed point", "periodic Newton", "open Newton"],
)
def test_the_counted_traffic_is_that_of_the_executed_statements(scene, method, solver):
    kernel = compile_method(scene, method, solver=solver).kernel
    (few, sweeps), (many, again) = executed(kernel, 24), executed(kernel, 72)
    assert sweeps == again
    # The difference of two chains does not contain the entries that belong to the ends. With these numbers of
    # sites, the rows of the workspace have no entries besides those of the sites.
    assert (padded(24), padded(72)) == (24, 72)
    assert many - few == 48 * kernel.sites.numbers_moved(sweeps)


def executed(kernel, n):
    """Return the numbers that a step reads and writes on a chain of n sites, and the sweeps of each block."""
    step = kernel.sites
    machine = _Recording(unit_of(Plan(kernel, DOUBLE)), FloatDomain(0.0))
    machine.log, machine.calls = [(set(), set())], []
    period = np.random.default_rng(1).normal(size=(step.size, 12)) / 2
    state = _Tracked(np.tile(period, (1, n // 12)).ravel().tolist(), "state", machine.log)
    work = _Tracked([0.0] * (step.workspace * padded(n)), "work", machine.log)
    assert machine.call("advance", 0, [n], n, state, work, work, 0.1) == 0
    names = [name for name, _, _ in machine.calls]
    moved, read, written = 0, set(), set()
    for name, own_read, own_written in machine.calls:
        read, written = read | own_read, written | own_written
        # The calls for one or some sites are parts of a sweep, so their entries are counted with the sweep.
        if not name.startswith(("site_", "sweep_")):
            moved += len(read) + len(written)
            read, written = set(), set()
    # Both loops of a substitution read and write the right-hand side; above, each entry is counted once.
    size = max((b.newton.size for b in step.blocks if b.newton is not None), default=0)
    moved += 2 * size * n * sum(name.startswith("substitute") for name in names)
    # In a periodic chain, two loops of the correction read the solution.
    moved += size * n * sum(name.startswith("correct") for name in names) * step.periodic
    return moved, [float(names.count(f"pass_{block.first + 1}")) for block in step.blocks]
