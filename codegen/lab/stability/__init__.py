"""Stability: what held, what failed and how it was reported, for methods on scenes.

Three questions of each method: how it answers to extreme input in one step (:mod:`.extremes`), which is the
largest usable step and what limits it (:mod:`.limits`), what is left of its order on stiff variants of the
scene (:mod:`.stiff`); and of its tableau, the linear stability region (:mod:`.regions`).
"""
