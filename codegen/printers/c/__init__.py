"""Printers for C11. Emitted modules allocate no memory, have no global variables and cause no warnings. All
external names of a module start with the prefix of the module."""
