"""The target C: emitted C11 modules allocate no memory, have no global variables and cause no warnings. Every
external name of a module starts with the prefix of the module."""
