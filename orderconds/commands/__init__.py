"""The commands of ``orderconds``. The module of a command defines a click command named ``command``,
which returns the exit status.
"""
