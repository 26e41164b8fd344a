"""``orderconds modified``: print the modified equation of a method."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from orderconds.commands import screen
from orderconds.commands.names import completing, tableau_names

if TYPE_CHECKING:
    from orderconds.backward_error import ModifiedEquation, Term


@click.command(name="modified")
@click.argument("tableau", metavar="FILE|NAME", shell_complete=completing(tableau_names, files=True))
@click.option(
    "--order",
    "-p",
    type=click.IntRange(1, 10),
    required=True,
    help="Print the terms of the modified equation up to h^(ORDER - 1).",
)
@click.option(
    "--family",
    help="Treat the tableau as a method of this family. Default: the first of the families rk and cf that "
    "accepts the tableau.",
)
@click.option(
    "--modifying",
    is_flag=True,
    help="Print the modifying field instead of the modified field. If the method is applied to "
    "the modifying field, one step is the exact flow of f.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
def command(tableau: str, order: int, family: str | None, modifying: bool, as_json: bool) -> int:
    """Print the modified equation of a tableau. The argument is a file or the name of a library tableau.

    \b
    A step of the method is the exact flow, over the time h, of the field
        f~ = sum h^(order - 1) * coefficient * field.
    Each printed line contains the order, the tree, the coefficient and the field of one term.
    Each field is an elementary differential of f or a commutator of such differentials.

    For the family rk, the tree is a rooted tree. For families of Lie group methods (cg, cf, "rkmk(1)"), the
    tree is replaced by a Lyndon word. The letters of this word are ordered trees. For these families, a field
    is a function with values in the Lie algebra, and f[y] is the derivative of f along the field y. To
    compute the second derivative f[x y] at a point p, replace x and y by the constant fields with the values
    x(p) and y(p). Then differentiate f along y, and differentiate the result along x (Munthe-Kaas and Wright,
    Found. Comput. Math. 8 (2008) 227). The commutator is [x, y] = x y - y x.

    For a symplectic method, the command also prints the modified Hamiltonian H~. The first term of H~ is the
    Hamiltonian H. Each other term is a multiple of a derivative of H, such as H''(f, f). The arguments of
    such a derivative are elementary differentials of the vector field f.

    \b
    Examples:
        orderconds modified midpoint --order 5
        orderconds modified cf4 --order 5
        orderconds modified rk4 --family "rkmk(1)" --order 5
        orderconds modified euler --order 4 --modifying
    """
    from orderconds.backward_error import modified_equation
    from orderconds.checking import read

    method = read(tableau)
    with screen.working(f"expanding {method.name} to order {order}"):
        equation = modified_equation(method, order, family, modifying=modifying)
    if as_json:
        screen.print_json({"tableau": method.name, "modifying": modifying, **equation.as_json()})
    else:
        _print_text(method.name, equation)
    return 0


def _print_text(name: str, equation: ModifiedEquation) -> None:
    click.echo(f"{name}, family {equation.family}: f~ up to h^{equation.order - 1}")
    _print_terms(equation, equation.terms, "field")
    if equation.hamiltonian is not None:
        click.echo(f"\nmodified Hamiltonian: H~ up to h^{equation.order - 1}")
        _print_terms(equation, equation.hamiltonian, "Hamiltonian")


def _print_terms(equation: ModifiedEquation, terms: tuple[Term, ...], kind: str) -> None:
    rows = [(str(t.order), t.tree, equation.ring.text(t.coefficient), t.name) for t in terms]
    screen.print_table(("order", "tree", "coefficient", kind), rows, indent=2)
