"""The commands of ``orderconds``. Each module has a click ``command``, which returns its exit status."""
