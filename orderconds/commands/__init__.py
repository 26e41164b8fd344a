"""The commands of ``orderconds``. The module of a command defines the click command under the name
``command``. It returns the exit status.
"""
