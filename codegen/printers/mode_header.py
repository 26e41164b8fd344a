"""The header comment of a module for a step on Fourier modes."""

from __future__ import annotations

from codegen.ir.kernel import Kernel
from codegen.printers.recipe import Recipe, header


def mode_header(kernel: Kernel, recipe: Recipe, width: int) -> list[str]:
    """Return the lines of the header comment, without the usage example."""
    step = kernel.modes
    assert step is not None
    # The length n of the state is known only at run time.
    (state,) = kernel.state
    layout = [f"n {state.meaning}; n is even"]
    return header(recipe, layout, step.explanation(), width)
