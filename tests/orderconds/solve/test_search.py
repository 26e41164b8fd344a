"""A search is decided by its seed: not by processes, interruptions, or what was searched before."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from orderconds.errors import InputError
from orderconds.solve.least_squares import least_squares
from orderconds.solve.minimise import minimise
from orderconds.solve.problem import find_problem
from orderconds.solve.search import Batch, Checkpoint, Search, batches, run_batch, write_whole
from orderconds.solve.solver import Order, solve
from orderconds.solve.spec import Spec

SEARCH = Search("vcg", 3, Spec(3), "abscissae", seed=3, minimised=True)
ORDER = Order("vcg", 3, Spec(3), seed=3, minimised=True, starts=256)


def test_batches_survive_being_written() -> None:
    batch = run_batch(SEARCH, 1)
    assert Batch.read(json.loads(json.dumps(batch.as_json()))) == batch


def test_a_killed_search_resumed_gives_the_same_file(tmp_path: Path) -> None:
    whole = solve(ORDER).solution
    assert whole is not None
    path = tmp_path / "checkpoint"
    stopped = batches(SEARCH, 4, Checkpoint(path, SEARCH))
    next(stopped), next(stopped)
    record = json.loads(path.read_text())
    assert len(record["batches"]) == 2
    resumed = solve(
        Order(ORDER.family, 3, ORDER.spec, seed=3, minimised=True, starts=256, checkpoint=path)
    ).solution
    assert resumed is not None
    assert resumed.text == whole.text
    assert not path.exists()


def test_the_checkpoint_is_used_and_not_computed_again(tmp_path: Path) -> None:
    path = tmp_path / "checkpoint"
    checkpoint = Checkpoint(path, SEARCH)
    made_up = Batch(0, 0.125, ((7.0, (1.0, 2.0)),))
    checkpoint.add(made_up)
    again = Checkpoint(path, SEARCH)
    again.load()
    assert next(batches(SEARCH, 1, again)) == made_up


def test_two_processes_give_the_same_file_as_one() -> None:
    alone = solve(ORDER).solution
    together = solve(Order("vcg", 3, Spec(3), seed=3, minimised=True, starts=256, processes=2)).solution
    assert alone is not None
    assert together is not None
    assert together.text == alone.text


def test_a_dask_cluster_gives_the_same_batches() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None
    ) as cluster:
        address = cluster.scheduler_address
        there = list(batches(SEARCH, 2, Checkpoint(None, SEARCH), cluster=address))
    assert there == list(batches(SEARCH, 2, Checkpoint(None, SEARCH)))


def test_a_cluster_that_does_not_answer_is_named() -> None:
    with pytest.raises(InputError, match=r"no scheduler answers|not installed"):
        list(batches(SEARCH, 2, Checkpoint(None, SEARCH), cluster="tcp://127.0.0.1:1"))


def test_an_address_that_needs_certificates_is_bad_input() -> None:
    pytest.importorskip("distributed")
    with pytest.raises(InputError, match=r"--dask tls://127.0.0.1:1: no scheduler answers.*tcp://host:port"):
        list(batches(SEARCH, 2, Checkpoint(None, SEARCH), cluster="tls://127.0.0.1:1"))


SCHEDULER = """
import asyncio
from distributed import Scheduler, Worker
async def main():
    async with Scheduler(host="127.0.0.1", port=0, dashboard=False) as scheduler:
        async with Worker(scheduler.address, nthreads=1):
            print(scheduler.address, flush=True)
            await asyncio.sleep(600)
asyncio.run(main())
"""


def test_a_scheduler_that_dies_is_one_error_and_the_checkpoint_stays(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    words = ["vcg", "--stages", "3", "--order", "3", "--minimise", "error", "--starts", "1000000"]
    checkpoint = tmp_path / "found.toml.search"
    with subprocess.Popen(
        [sys.executable, "-c", SCHEDULER], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as scheduler:
        assert scheduler.stdout is not None
        address = scheduler.stdout.readline().strip()
        command = [sys.executable, "-m", "orderconds", "solve", *words, "--dask", address]
        with subprocess.Popen(
            [*command, "-o", str(tmp_path / "found.toml")], stderr=subprocess.PIPE, text=True
        ) as search:
            while search.poll() is None and not checkpoint.exists():
                time.sleep(0.01)
            scheduler.kill()
            _, err = search.communicate(timeout=60)
    assert search.returncode == 2
    assert err.startswith(f"orderconds: --dask {address}: the scheduler no longer answers; ")
    assert err.count("\n") == 1
    assert checkpoint.exists()


@pytest.mark.slow
def test_the_death_of_a_worker_changes_nothing() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        found = batches(SEARCH, 40, Checkpoint(None, SEARCH), cluster=cluster.scheduler_address)
        first = next(found)
        os.kill(cluster.workers[0].pid, signal.SIGKILL)
        there = [first, *found]
    assert there == list(batches(SEARCH, 40, Checkpoint(None, SEARCH)))


def test_a_checkpoint_is_not_written_through_a_link_that_foresees_its_name(tmp_path: Path) -> None:
    victim = tmp_path / "victim"
    victim.write_text("mine")
    (tmp_path / ".checkpoint.partial").symlink_to(victim)
    checkpoint = Checkpoint(tmp_path / "checkpoint", SEARCH)
    checkpoint.add(Batch(0, 1.0))
    assert victim.read_text() == "mine"
    checkpoint.remove()
    (tmp_path / "checkpoint").symlink_to(victim)
    with pytest.raises(InputError, match="not a regular file"):
        checkpoint.add(Batch(1, 1.0))
    with pytest.raises(InputError, match="a checkpoint that cannot be used: not a regular file"):
        checkpoint.load()
    assert victim.read_text() == "mine"


def test_another_search_does_not_take_over_a_checkpoint(tmp_path: Path) -> None:
    path = tmp_path / "checkpoint"
    Checkpoint(path, SEARCH).add(Batch(0, 1.0))
    other = Checkpoint(path, Search("vcg", 3, Spec(3), "abscissae", seed=4))
    with pytest.raises(InputError, match="another search"):
        other.load()
    path.write_text("{")
    with pytest.raises(InputError, match="not a checkpoint"):
        other.load()


def test_a_file_is_written_whole_or_not_at_all(tmp_path: Path) -> None:
    folder = tmp_path / "is_a_folder"
    folder.mkdir()
    (folder / "kept").touch()
    with pytest.raises(InputError):
        write_whole(folder, "text")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["is_a_folder"]


def test_minimising_stays_on_the_family_and_goes_down() -> None:
    problem = find_problem("vcf", 4, Spec(2), "abscissae")
    start = np.array(run_batch(Search("vcf", 4, Spec(2), "abscissae"), 0).solutions[-1][1])
    before = float(np.linalg.norm(problem.error.values(start[None])[0]))
    point, size = minimise(problem, start)
    assert np.abs(problem.tape.values(point[None])).max() < 1e-12
    assert size < before
    assert size == pytest.approx(0.06785359536389, rel=1e-9)
    values, slopes = problem.error.jacobians(point[None])
    _, conditions = problem.tape.jacobians(point[None])
    gradient = slopes[0].T @ values[0]
    tangent = np.linalg.svd(conditions[0])[2][problem.tape.size :]
    assert np.abs(tangent @ gradient).max() < 1e-6


def test_least_squares_says_when_there_is_no_solution() -> None:
    def never(x):
        return x * x + 1, 2 * x[:, :, None]

    _, norms = least_squares(never, np.array([[3.0], [np.inf]]))
    assert norms[0] == pytest.approx(1.0)
    assert norms[1] == np.inf


def test_bounds_hold() -> None:
    spec = Spec(4, explicit=True, positive=("b", "a32"), size=None)
    for score, point in run_batch(Search("rk", 4, spec, "full"), 0).solutions:
        problem = find_problem("rk", 4, spec, "full")
        values = problem.coefficients.values(np.array([point]))[0]
        named = dict(zip(problem.ansatz.cells, values, strict=False))
        assert min(named[f"b{i}"] for i in range(1, 5)) > 0.009
        assert named["a32"] > 0.009
        assert score > 0
