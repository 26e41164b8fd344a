"""The continuous extension of a method on a scene: its kernels and its order."""

from __future__ import annotations

from codegen.certify import certified_order
from codegen.errors import MethodError
from codegen.ir.kernel import Continuous
from codegen.kernel.dense_output import continuous
from codegen.lower import lowering, problem_for
from codegen.method import Method
from codegen.scene.problem import Problem


def extension_of(method: Method, scene: Problem) -> Continuous:
    """Return the kernels of the continuous extension of a method.

    The order is the computed order of the extension in the family ``rk``, and at most the order of the
    method: the coordinates of the solution satisfy a differential equation in the Lie algebra, which is a
    vector space. :class:`MethodError` is raised for a method without an extension.
    """
    from orderconds.checking.continuous import extension_order

    problem = problem_for(scene, method)
    program = None if method.coefficients is None else lowering(method.family).extension(problem, method)
    computed = None if program is None else extension_order(method.tableau)
    if program is None or computed is None or not computed.order or computed.continuous is not True:
        raise MethodError(
            f"no continuous extension for {method.label}",
            where=scene.name,
            expected="rk or rkmk(r) with an explicit tableau that has the key dense",
            hint="orderconds extend TABLEAU finds one; or use --integrate, which makes shorter steps instead",
        )
    order = min(computed.order, certified_order(method, scene).order)
    return continuous(program, problem, order)
