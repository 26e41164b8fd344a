"""The program's own commands, one module each; each module's ``command`` is a click command returning its status."""
