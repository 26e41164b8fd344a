r"""Formulas with sums over indices. Order conditions are printed in this form.

A formula is built from coefficients (``b_i``, ``a_ij``, ``c_i``, ``ahat_ij``, ``beta_Jj`` ...) by products,
powers, linear combinations and sums over indices. A relation such as i < j can restrict a sum.

>>> b, a, c = coefficient("b", "i"), coefficient("a", "i", "j"), coefficient("c", "j")
>>> formula = index_sum(("i",), (), product(b, index_sum(("j",), (), product(a, c))))
>>> formula.text()
'sum_{i,j} b_i a_ij c_j'
>>> print(formula.latex())
\sum_{i,j} b_{i} a_{ij} c_{j}
"""

from orderconds.formula.nodes import (
    Coefficient,
    Formula,
    IndexSum,
    Power,
    Product,
    Total,
    coefficient,
    coefficients,
    free_indices,
    fresh,
    index_sum,
    named,
    one,
    product,
    refreshed,
    total,
    zero,
)
from orderconds.formula.notation import Relation

__all__ = [
    "Coefficient",
    "Formula",
    "IndexSum",
    "Power",
    "Product",
    "Relation",
    "Total",
    "coefficient",
    "coefficients",
    "free_indices",
    "fresh",
    "index_sum",
    "named",
    "one",
    "product",
    "refreshed",
    "total",
    "zero",
]
