"""The command: thin, a module for a subcommand or several of one kind, each package imported when it is asked for.

Exit status: 0 done and proved; 1 a verdict or a check is not what it should be; 2 the input has no answer,
or the command line is wrong; 130 interrupted, by TERM and HUP, too; 141 nobody reads the output.
"""

import sys

try:
    # The order of the imports is that of the subcommands in --help.
    from . import (  # noqa: F401, I001
        prove, report, codegen, step, scene, run, show, check, certify, judge, trade, bench, lab,
    )  # fmt: skip
    from .app import main
except KeyboardInterrupt:  # while the command starts
    print("chapsym: interrupted", file=sys.stderr)
    sys.exit(130)

__all__ = ["main"]
