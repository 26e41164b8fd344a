"""The names of arguments and arrays in the functions of a lattice."""

from __future__ import annotations

from codegen.ir.site_step import RESULT, STATE, WORK, SiteStep
from codegen.run.terms import Term, count, flag, real

SITES, COLUMNS, COLUMN, ROW = count("sites"), count("columns"), count("column"), count("row")
"""The number of all sites, the number of sites in one row of the lattice, the index of a site in its row, and
the index of the first site of this row among all sites."""

SITE, NUMBER, PLACE, INDEX = count("site"), count("number"), count("place"), count("i")
BAD, WHOLE = count("bad"), flag("whole")
"""The number of sites whose new state is not finite, and the flag for computing each site alone."""

_STATE, _WORK, _RESULT = real(STATE, 0), real(WORK, 0), real(RESULT, 0)
ARRAYS = {STATE: _STATE, WORK: _WORK, RESULT: _RESULT}


def shape_of(step: SiteStep) -> Term:
    """Return the argument for the numbers of sites in all dimensions."""
    return count("shape", step.dimension)
