"""Stability tests of methods on scenes.

There are five kinds of tests:

- single steps on extreme input (:mod:`.extreme_steps`),
- the largest usable step (:mod:`.largest_step`),
- the order on stiff variants of the scene (:mod:`.order_reduction`),
- long runs (:mod:`.endurance`),
- the linear stability region of the tableau (:mod:`.linear_stability`).
"""
