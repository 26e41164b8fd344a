"""The legend of printed conditions. The legend defines the symbols in the conditions."""

from __future__ import annotations

from collections.abc import Iterable

from orderconds import families
from orderconds.conditions import OrderCondition
from orderconds.formula import coefficients
from orderconds.formula.notation import LATEX


def legend(family: str, conditions: Iterable[OrderCondition]) -> str:
    r"""Return LaTeX text that defines the coefficients in the conditions and states the range of the sums.
    The text is empty if the conditions contain no coefficients.

    >>> from orderconds.derivation import derive
    >>> print(legend("rk", derive("rk", order=2)).replace("; ", ";\n"))
    Here $b_i$ are the weights and $c_i = \sum_j a_{ij}$ are the abscissae;
    $a_{ij}$ are the coefficients of the stages. Sums run over all stages.
    """
    formulas = [condition.formula for condition in conditions]
    symbols = [x for formula in formulas for x in coefficients(formula)]
    known = families.family_class(family.partition("(")[0]).symbols
    names = list(dict.fromkeys(x.name for x in symbols))
    # The legend also defines symbols that occur only inside the definitions of other symbols.
    used = [name for name in known if name in names]
    inner = [name for name in known if name not in used and any(_occurs(name, known[u]) for u in used)]
    defined = [known[name] for name in used]
    text = " and ".join([", ".join(defined[:-1]), defined[-1]]) if len(defined) > 1 else "".join(defined)
    text += "".join(f"; {known[name]}" for name in inner)
    indices = {index[0] for x in symbols for index in x.indices}
    return f"Here {text}.{_range(indices)}" if text else ""


def _range(indices: set[str]) -> str:
    """Return a sentence about the range of the sums, or an empty text if there are no sums.

    ``indices`` contains one character for each index in the conditions. The character is a lower-case letter
    if the index runs over stages, and an upper-case letter if the index runs over exponentials. For a
    constant index, the character is a digit.
    """
    if any(index.isupper() for index in indices):
        return " Lower-case indices run over all stages, upper-case indices over all exponentials."
    return " Sums run over all stages." if any(index.isalpha() for index in indices) else ""


def _occurs(name: str, definition: str) -> bool:
    """Return True if the coefficient ``name`` occurs in ``definition``, the definition of another
    coefficient."""
    return f"{LATEX.names.get(name, name)}_" in definition.replace(r"\bar", "")
