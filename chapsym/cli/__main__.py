"""`python -m chapsym.cli`, as `python -m chapsym`."""

from . import main

if __name__ == "__main__":
    main()
