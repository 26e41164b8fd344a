"""The commands of ``orderconds``.

The module of a command defines a click command named ``command``. The click command returns the exit status.
"""
