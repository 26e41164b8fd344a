"""The program's own commands, a module each, whose ``command`` is a click command that returns its status."""
