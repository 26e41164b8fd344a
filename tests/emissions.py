"""Emissions for tests of emitted code: named ones, each emitted once a process, and random ones."""

from __future__ import annotations

import random
from collections.abc import Iterator
from functools import cache

from codegen import scenes
from codegen.artifact import Artifact
from codegen.emitter import emit
from codegen.lower import families_for
from orderconds.errors import InputError
from orderconds.families import family_class
from orderconds.tableau import available

PREFIX = "drawn_"

Options = tuple[tuple[str, object], ...]

LONG = frozenset({"kahan_li8", "suzuki_umeno8", "yoshida8a", "yoshida8d", "gauss5", "triple_jump6"})
"""Tableaux with so many stages that emission takes half a minute on some scenes."""


@cache
def emitted(scene: str, method: str, options: Options = (), target: str = "c") -> Artifact:
    """Return an emission with the prefix PREFIX."""
    return emit(scene, method, target, prefix=PREFIX, **dict(options))  # type: ignore[arg-type]


def drawn(seed: int, count: int) -> Iterator[tuple[str, str, Options]]:
    """Yield random triples of scene, method and options that can be emitted; the same for the same seed."""
    rng = random.Random(seed)
    tableaux = [name for name in available() if name not in LONG]
    while count:
        scene = rng.choice(scenes.names())
        problem = scenes.load(scene)
        family = rng.choice(families_for(problem))
        method = f"{family}:{rng.choice(tableaux)}"
        if family_class(family).takes_cutoff and rng.random() < 0.5:
            method = f"{family}({rng.randrange(5)}):{method.partition(':')[2]}"
        options = _options(rng, tuple(problem.parameters), tuple(problem.signals), problem.is_hamiltonian)
        for chosen in (options, tuple(x for x in options if x[0] != "adaptive")):
            try:
                emitted(scene, method, chosen)
            except InputError:
                continue  # not every tableau has the family's order or an embedded method
            yield scene, method, chosen
            count -= 1
            break


def _options(
    rng: random.Random, parameters: tuple[str, ...], signals: tuple[str, ...], momenta: bool
) -> Options:
    """Draw options of an emission."""
    options: dict[str, object] = {}
    if rng.random() < 0.5:
        options["adaptive"] = True
    if rng.random() < 0.3:
        options["precision"] = "single"
    if rng.random() < 0.3:
        options["jacobian"] = True
    if rng.random() < 0.5:
        options["solver"] = rng.choice(("newton", "simplified-newton", "fixed-point"))
    if rng.random() < 0.3 and momenta:
        options["frame"] = "body"
    if rng.random() < 0.3:
        options["parameters"] = tuple(name for name in parameters if rng.random() < 0.5)
    if rng.random() < 0.3:
        options["inputs"] = tuple(name for name in signals if rng.random() < 0.5)
    return tuple(options.items())
