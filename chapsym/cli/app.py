"""The typer application, and the entry point."""

import _thread
import codecs
import errno
import io
import logging
import os
import re
import signal
import sys
import threading
import unicodedata
from typing import Annotated, Any, NoReturn

import typer
from typer.exceptions import TyperException

import chapsym
from chapsym.extras import MissingExtra
from chapsym.rationals import NotANumber

from .output import fail, note, quiet

app = typer.Typer(
    pretty_exceptions_enable=False, rich_markup_mode=None, context_settings={"help_option_names": ["-h", "--help"]}
)
INTERRUPTED = 130
#: Of errors that name no file, and are not of the output: where a process begins, or its folder is asked for.
CROWDED = "the system refuses more files, threads or processes: end others, or raise its limits (ulimit -n, -u, -v)"
NOT_OF_OUTPUT = dict.fromkeys((errno.EAGAIN, errno.EMFILE, errno.ENFILE), CROWDED) | {
    errno.ENOENT: "the folder in which this runs was deleted: change to another"
}
NO_MEMORY = "there is not enough memory for this"
#: Signs of mathematics in ASCII.
SIGNS = str.maketrans(
    {"⟨": "<", "⟩": ">", "⁻": "-", "−": "-", "–": "-", "±": "+/-", "×": "x", "·": "*", "⁄": "/", "→": "->", "≤": "<="}
    | {"≥": ">=", "≠": "!=", "∫": "integral of ", "√": "sqrt ", "∈": "in", "∞": "infinity", "…": "..."}
)


def in_ascii(error: UnicodeError) -> tuple[str, int]:
    """Greek letters by their names, m² as m2, 𝒦 as K, for an output that has no such letters; others as escapes."""
    assert isinstance(error, UnicodeEncodeError)
    return "".join(map(_in_ascii, error.object[error.start : error.end])), error.end


def _in_ascii(letter: str) -> str:
    plain = letter.translate(SIGNS)
    if unicodedata.decomposition(letter).startswith("<"):  # raised, lowered, script; not é, which a file may be called
        plain = unicodedata.normalize("NFKD", letter).translate(SIGNS)
    if not plain.isascii() and (name := unicodedata.name(plain[0], "")).startswith(("GREEK SMALL", "GREEK CAPITAL")):
        name = name.split()[3].replace("LAMDA", "LAMBDA")
        plain = name.lower() if letter.islower() else name.capitalize()
    return plain.encode("ascii", "backslashreplace").decode()


codecs.register_error("chapsym", in_ascii)


class _Notes(logging.Handler):
    def emit(self, record: logging.LogRecord) -> None:
        note(record.getMessage())


def main() -> NoReturn:
    """The entry point: turns every foreseen error into one sentence and an exit status."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by the caller
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115
    sys.unraisablehook = _unraisable
    os.environ["MPLBACKEND"] = "agg"  # no window is opened, and one that this Python has not would be refused
    for stream in (sys.stdout, sys.stderr):  # for a terminal, or a pipe, without Greek
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="chapsym")
    logging.basicConfig(handlers=[_Notes()])
    logging.getLogger("chapsym").setLevel(logging.INFO)
    logging.getLogger("asyncio").setLevel(logging.CRITICAL)  # the first error of Zarr has a sentence of its own
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # of a home that cannot be written it says four lines
    if len(sys.argv) == 1:
        sys.argv.append("--help")
    try:
        _hear()
        date = os.environ.get("SOURCE_DATE_EPOCH", "0")  # for figures: matplotlib and SymPy have errors of theirs
        if not re.fullmatch(r"\d{1,11}", date, re.ASCII):
            fail(f"SOURCE_DATE_EPOCH must be a number of seconds, such as 1700000000, not {date[:40]!r}", 2)
        status = plain(typer.main.get_command(app)).main(prog_name="chapsym", standalone_mode=False)
        sys.stdout.flush()
        if status == INTERRUPTED:
            fail("interrupted", INTERRUPTED)
        sys.exit(status if isinstance(status, int) else 0)
    except SystemExit as stop:
        if isinstance(stop.__context__, BrokenPipeError):  # typer turns it into exit 1, which means something else
            _abandon_output()
        raise
    except TyperException as error:
        fail(f"{error.format_message()} (see chapsym{_called(typer.main.get_command(app), sys.argv[1:])} --help)", 2)
    except (KeyboardInterrupt, typer.Abort) as stop:
        if isinstance(stop.__cause__, EOFError):  # typer takes one for the end of an answer, and we ask nothing
            raise stop.__cause__ from None
        fail("interrupted", INTERRUPTED)
    except BrokenPipeError:
        _abandon_output()
    except MemoryError:
        quiet()
        fail(NO_MEMORY, 2)
    except OSError as error:
        if error.filename is not None:
            quiet()
            fail(f"{error.filename}: {error.strerror}", 2)
        if error.errno in NOT_OF_OUTPUT and error.strerror == os.strerror(error.errno):  # that of a pipe is another
            fail(NOT_OF_OUTPUT[error.errno], 2)
        _silence_output()
        fail(f"standard output cannot be written: {error.strerror or error}", 2)
    except RuntimeError as error:
        if "can't start new thread" not in str(error):
            raise
        sys.unraisablehook = lambda what: None  # Zarr would wait in the end for a thread that it has not started
        fail(CROWDED, 2)
    except ImportError as error:
        no_room = "failed to map segment" in str(error)  # for a library
        if not no_room and not isinstance(error, MissingExtra):
            raise
        quiet()
        fail(NO_MEMORY if no_room else str(error), 2)
    except _foreseen() as error:
        from chapsym.dynamics.errors import LimitReached

        quiet()
        fail(str(error), 1 if isinstance(error, LimitReached) else 2)


def _hear() -> None:
    """Takes the signals that end a command, as a scheduler and a terminal that goes send them, for an interrupt."""
    if threading.current_thread() is threading.main_thread():
        for name in ("SIGTERM", "SIGHUP"):
            which = getattr(signal, name, None)
            if which and signal.getsignal(which) == signal.SIG_DFL:  # nohup ignores the latter
                signal.signal(which, signal.default_int_handler)


def _unraisable(what: "sys.UnraisableHookArgs") -> None:
    """Raises an interrupt anew that came where Python only writes an exception down, as at the end of an import."""
    if what.exc_type is KeyboardInterrupt:
        threading.Timer(0.01, _thread.interrupt_main).start()  # when this has ended
    elif what.exc_type is not BrokenPipeError:  # of a message to a process that has ended
        sys.__unraisablehook__(what)


def _foreseen() -> tuple[type[Exception], ...]:
    """The errors whose sentence is for the user; imported only where there is an error, so that --help is fast."""
    from chapsym.dynamics import BadInput, StepNotTaken
    from chapsym.files import CannotWrite

    return NotANumber, BadInput, StepNotTaken, CannotWrite


def plain(command: Any) -> Any:
    """The same command, whose help shows an argument as it is called, without Python's name for its type."""
    for argument in command.params:
        if argument.param_type_name == "argument":
            argument.display_type_rich = lambda ctx: None
    for one in getattr(command, "commands", {}).values():
        plain(one)
    return command


def _called(command: Any, words: list[str]) -> str:
    """The subcommands that were called; of an option without its value typer does not say which it is of."""
    inner = getattr(command, "commands", {}).get(words[0]) if words else None
    return "" if inner is None else f" {words[0]}{_called(inner, words[1:])}"


def _abandon_output() -> NoReturn:
    _silence_output()
    sys.exit(141)


def _silence_output() -> None:
    """Lets nothing more be flushed to an output that refuses it."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _version(wanted: bool) -> None:
    if wanted:
        print(f"chapsym {chapsym.__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Machine-checked review of Fedorov's discrete Chaplygin ball, and a simulator of it."""
