"""Time commutator-free methods on ensembles to one error, with and without two registers.

    python benchmarks/low_storage.py [--systems N] [--turns N] [--error E]

Every explicit commutator-free tableau of the library is emitted as a batch. It makes the smallest number of
equal steps that reaches the error, on a ladder of ratio 1.1. The error is the largest deviation of a
coordinate at the end of the run, over all systems, from heyoka at its smallest tolerance. The methods run in
turns, and the least CPU time of each method is printed. A method with two registers (2N) stores the state and
one element of the Lie algebra.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass

import heyoka
import numpy as np
from batches import Emitted, Floats, Peer, seconds

from codegen import scenes
from codegen.ir.domain import FloatDomain
from orderconds import Tableau
from orderconds.ring import Ring
from orderconds.tableau import CommutatorFree, available, find
from orderconds.tableau.two_registers import two_registers

FAMILY = "cf"


@dataclass(frozen=True)
class Ensemble:
    """Systems of one scene that differ in their initial states, and the length of their runs."""

    scene: str
    end: float

    def states(self, systems: int) -> Floats:
        """Return initial states, of shape (size, systems)."""
        start = np.array([float(x) for x in scenes.load(self.scene).initial(FloatDomain(0.0))])
        return np.ascontiguousarray((start * (1 + 1e-3 * np.arange(systems) / systems)[:, None]).T)


ENSEMBLES = (Ensemble("driven_spin", 20.0), Ensemble("free_rigid_body", 20.0))

MOST = 20_000
"""The largest number of steps that is tried."""


def _explicit(method: CommutatorFree, ring: Ring) -> bool:
    paths = ((i, row) for i, stage in enumerate(method.stages) for row in method.from_start(stage))
    return all(ring.is_zero(x) for i, row in paths for x in row[i:])


def tableaux() -> dict[str, tuple[int, str]]:
    """Return the number of stages and the storage of each explicit commutator-free tableau, by name."""
    found = {}
    for name in available():
        tableau = Tableau.load(find(name))
        if isinstance(tableau.method, CommutatorFree) and _explicit(tableau.method, tableau.ring):
            stored = "2N" if two_registers(tableau.method, tableau.ring).holds is not False else "all stages"
            found[name] = len(tableau.method.stages), stored
    return found


def rows(ensemble: Ensemble, systems: int, turns: int, error: float) -> list[str]:
    """Return one row of the table for each method, the fastest first."""
    lanes = heyoka.recommended_simd_size()
    states = ensemble.states(systems + -systems % lanes)
    reference = Peer(ensemble.scene, 1e-18, lanes).run(states, ensemble.end)
    known, reached = tableaux(), {}
    for name in known:
        candidate = Emitted(ensemble.scene, f"{FAMILY}:{name}", states, ensemble.end)
        if (deviation := candidate.reach(reference, error, MOST)) is not None:
            reached[name] = candidate, deviation
    times = {name: float("inf") for name in reached}
    for _ in range(turns):
        for name, (candidate, _) in reached.items():
            times[name] = min(times[name], seconds(candidate.run))
    found = []
    for name in sorted(times, key=times.__getitem__):
        (candidate, deviation), (stages, stored) = reached[name], known[name]
        found.append(
            f"| {ensemble.scene} | {name} | {stored} | {candidate.steps} | {candidate.steps * stages} "
            f"| {deviation:.1e} | {1e6 * times[name] / states.shape[1]:.2f} |"
        )
    lost = [
        f"| {ensemble.scene} | {n} | {known[n][1]} | not reached | | | |" for n in known if n not in reached
    ]
    return found + lost


def main() -> None:
    """Print a table with a row for each scene and method."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--systems", type=int, default=1000, help="systems of an ensemble")
    parser.add_argument("--turns", type=int, default=7, help="measurements of each method")
    parser.add_argument("--error", type=float, default=1e-9, help="the error that all methods reach")
    options = parser.parse_args()
    print("| scene | tableau | storage | steps | evaluations | error | us per system |")
    print("|---|---|---|---:|---:|---:|---:|")
    for ensemble in ENSEMBLES:
        print("\n".join(rows(ensemble, options.systems, options.turns, options.error)), flush=True)


if __name__ == "__main__":
    main()
