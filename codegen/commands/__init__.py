"""The commands that emit and test integrators. Each command has its own module.

``orderconds`` finds the commands through the entry points of the installed package.
"""
