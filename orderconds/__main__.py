"""``python -m orderconds`` is the command-line program."""

from orderconds.cli import main

if __name__ == "__main__":
    main()
