"""Series of methods and of exact flows, truncated by order, over any ring."""
