"""The commands of the compiler, with one module for each command.

``orderconds`` finds the commands through the entry points of the installed package.
"""
