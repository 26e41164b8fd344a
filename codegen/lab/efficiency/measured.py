"""The Python function :func:`bench` measures and ranks methods on a scene. The function can also measure
integrators of other libraries, such as SciPy.
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.lab.efficiency import bench as benches
from codegen.lab.efficiency.bench import Result
from codegen.lab.efficiency.work_precision import BUDGET
from codegen.lab.progress import Progress
from codegen.method import Method
from codegen.printers import DEFAULT
from codegen.scene.problem import Problem
from codegen.scenes import problem_of
from orderconds.argument import described, real, text, texts
from orderconds.errors import InputError
from orderconds.tableau import Tableau

MOST_SECONDS = 1e5
"""The largest allowed ``budget`` of :func:`bench` and of ``recommend``, in seconds."""


def bench(
    scene: Problem | str,
    *methods: Method | Tableau | str,
    adaptive: Sequence[Method | Tableau | str] = (),
    targets: Sequence[str] = (DEFAULT,),
    against: Sequence[str] = (),
    forms: Sequence[str] = (),
    budget: float = BUDGET,
    output: str | None = None,
    progress: Progress = str,
) -> Result:
    """Measure the error and the CPU time of methods and of other integrators on a scene.

    ``methods`` contains the methods with equal steps. ``adaptive`` contains the methods with step-size
    control. ``against`` contains the names of the other integrators. If a method cannot be emitted for the
    scene, the result contains the reason. Raises InputError for invalid arguments.
    """
    if not isinstance(adaptive, Sequence) or isinstance(adaptive, str):
        raise InputError(described(adaptive), where="adaptive", expected="a list of methods")
    prepared = benches.bench(
        problem_of(scene),
        methods,
        texts(targets, "targets", DEFAULT),
        texts(against, "against", "scipy"),
        real(budget, "budget", (0, MOST_SECONDS)),
        None if output is None else text(output, "output", "the path of a folder as a str"),
        progress,
        adaptive,
        texts(forms, "forms", "printed"),
    )
    return prepared.run(lambda row: progress(f"{row.method} ({row.target})"))
