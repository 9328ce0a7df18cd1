"""The command: thin, one module for each subcommand, every room imported only when it is asked for.

Exit status: 0 done and proved; 1 a verdict or a check is not what it should be; 2 the input has no answer,
or the command line is wrong; 130 interrupted; 141 nobody reads the output.
"""

# The order of the imports is that of the subcommands in --help.
<<<<<<< HEAD
from . import prove, report, codegen, step, branches, run, check, bench, trade  # noqa: F401, I001
=======
from . import prove, report, codegen, step, branches, run, check, extremes, bench  # noqa: F401, I001
>>>>>>> h-extremes
from .app import main

__all__ = ["main"]
