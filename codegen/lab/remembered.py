"""References kept between runs, beside the compiled modules: a minute's computation is done once.

The file's name is a digest of everything that the reference depends on: the ambient field with its
constants, the initial state, the span, and the settings of the integrator. A file that cannot be read is as
good as none.
"""

from __future__ import annotations

import hashlib
import json

from codegen.artifact import write_text
from codegen.cache_entry import cache_directory
from codegen.ir.domain import PreciseDomain
from codegen.lab.reference import AGREEMENT, BITS, DIGITS, RUNS, Reference, reference
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem


def remembered(scene: Problem) -> Reference:
    """Return the reference of a scene, from the cache where it is there; errors as :func:`reference`."""
    path = cache_directory() / "references" / f"{_digest(scene)}.json"
    context = PreciseDomain(0, DIGITS).context
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
        state = tuple(context.mpf(x) for x in kept["state"])
        if len(state) == len(scene.symbols):
            return Reference(scene.name, state, float(kept["uncertainty"]))
    except (OSError, ValueError, KeyError, TypeError):
        pass
    found = reference(scene)
    kept = {"state": list(found.digits(DIGITS)), "uncertainty": found.uncertainty}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_text(path, json.dumps(kept) + "\n")
    except OSError:
        pass  # a cache that cannot be written costs time, nothing else
    state = tuple(context.mpf(x) for x in kept["state"])
    return Reference(scene.name, state, found.uncertainty)


def _digest(scene: Problem) -> str:
    field = velocity(scene)
    start = scene.initial(PreciseDomain(0, DIGITS))
    parts = (
        field.lines,
        field.results,
        [x.text() for x in field.constants],
        [str(x) for x in start],
        [str(x) for x in scene.span],
        (AGREEMENT, BITS, DIGITS, RUNS),
    )
    return hashlib.sha256(repr(parts).encode()).hexdigest()[:32]
