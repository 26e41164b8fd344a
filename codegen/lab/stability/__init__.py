"""Stability tests of methods on scenes.

There are five kinds of tests:

- single steps with extreme input, for example a very large step size (:mod:`.extreme_steps`),
- the largest step size that gives a usable result (:mod:`.largest_step`),
- the order on stiff variants of the scene (:mod:`.order_reduction`),
- runs of many steps (:mod:`.endurance`),
- the region of linear stability of the tableau (:mod:`.linear_stability`).
"""
