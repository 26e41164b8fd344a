"""Compositions of Strang's second-order step: one step consists of Strang steps of different lengths.

Strang's step is a symmetric product of the flows of the parts of the Hamiltonian.
"""

from __future__ import annotations

from codegen.ir.number import Number
from codegen.lower.flow_words import FlowLowering, Parts, Word, adjoint_word, pairs, unread
from codegen.method import Method
from orderconds.tableau import AdjointComposition, Composition

HALF = Number.rational(1, 2)


class CompositionLowering(FlowLowering):
    """Symmetric compositions of Strang's step.

    The family also contains compositions of a first-order step Phi and its adjoint Phi*.
    """

    family = "composition"

    def word(self, parts: Parts, method: Method) -> tuple[Word, str]:
        """Return the flows with their durations, and the label of the family whose order conditions apply."""
        tableau = method.tableau.method
        if isinstance(tableau, AdjointComposition):
            return adjoint_word(parts, method, tableau)
        # Besides AdjointComposition (handled above), the family accepts only the class Composition.
        if not isinstance(tableau, Composition):
            raise unread(parts, method)
        # Phi applies the flows of all summands one after the other, and Phi* applies these flows in the
        # opposite order. A Strang step of length gamma h applies first Phi* and then Phi, each with the
        # duration gamma h/2.
        halves = [method.number(x) * HALF for x in tableau.gamma]
        return pairs(parts.arranged, [(x, x) for x in halves]), self.family
