"""A bench as one call: methods and other integrators on a scene, measured and ranked."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.lab.efficiency import bench as benches
from codegen.lab.efficiency.bench import Result
from codegen.lab.efficiency.work_precision import BUDGET
from codegen.lab.progress import Progress
from codegen.method import Method
from codegen.printers import DEFAULT
from codegen.scene.problem import Problem
from orderconds.tableau import Tableau


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
    """Measure error against CPU time of methods, and of the integrators in ``against``, on a scene.

    The arguments are those of ``orderconds bench``. A notebook shows the result as a diagram. Errors:
    InputError for wrong arguments; a method that cannot be emitted has a row with the reason.
    """
    prepared = benches.bench(scene, methods, targets, against, budget, output, progress, adaptive, forms)
    return prepared.run(lambda row: progress(f"{row.method} ({row.target})"))
