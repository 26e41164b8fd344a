"""The commands of ``orderconds``. Each module defines one click command with the name ``command``. This
command returns an exit status.
"""
