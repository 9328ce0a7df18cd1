"""`python -m chapsym`."""

from chapsym.cli import main

if __name__ == "__main__":
    main()
