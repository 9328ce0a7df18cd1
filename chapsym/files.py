"""Files that are read whole, up to a limit, and written whole: into a temporary file, which is then renamed."""

import os
import shlex
import stat
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

#: An object of JSON: a part of a file or of a result.
Data = dict[str, Any]
#: Limits of a text that is read whole, and of its first line: an hour of a motion, a thousand frames each second.
MOST_BYTES, MOST_LINE = 2**30, 2**24
#: The letters of a file's name in the name of its temporary file.
SHORT = 40


class CannotRead(Exception):
    """A file cannot be read; the message has the reason."""


class CannotWrite(Exception):
    """A file cannot be written; the message has the reason."""


def check_destination(path: Path) -> None:
    """Raises CannotWrite, before anything is computed, if `path` cannot be a file in a writable folder."""
    folder = path.parent
    try:
        if not folder.is_dir():
            raise CannotWrite(f"{path}: the folder {folder} does not exist")
        if path.is_dir() or not os.access(folder, os.W_OK):
            raise CannotWrite(f"{path} cannot be written: choose a file in a folder that is writable")
        if path.exists() and not path.is_file():  # a rename would replace a device or a pipe by a file
            raise CannotWrite(f"{path} cannot be written: it is a device or a pipe, not a file")
    except OSError as error:
        raise CannotWrite(f"{path} cannot be written: {error.strerror or error}") from None
    except ValueError as error:  # a null byte in the name
        raise CannotWrite(f"{str(path)!r} cannot be written: {error}") from None


def check_folder(folder: Path) -> None:
    """Raises CannotWrite, before anything is computed, if `folder` is not, and cannot become, one that takes files."""
    there = next(place for place in (folder, *folder.parents) if os.path.exists(place))  # the last is . or /
    if not there.is_dir():
        clause = "it is a file" if there == folder else f"{there} is a file"
        raise CannotWrite(f"{folder} cannot be a folder of results: {clause}")
    if not os.access(there, os.W_OK):
        raise CannotWrite(f"{folder} cannot be written: choose a folder that is writable")


def made(folder: Path) -> Path:
    """A folder for results, made if it is not there; raises CannotWrite, before anything is computed, if it cannot."""
    check_folder(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CannotWrite(f"{folder} cannot be a folder of results: {error.strerror or error}") from None
    return folder


def check_source(path: Path) -> None:
    """Raises CannotRead for a pipe, which would be waited for, and for a device, which may have no end.

    What a shell makes of `<(...)` has no name, and is read.
    """
    try:
        named = Path(os.path.realpath(path))
        if named.exists() and not (named.is_file() or named.is_dir()):
            raise CannotRead(f"{path} is a {'pipe' if named.is_fifo() else 'device'}, not a file")
    except OSError as error:
        raise CannotRead(f"{path} cannot be read: {error.strerror or error}") from None
    except ValueError as error:  # a null byte in the name
        raise CannotRead(f"{str(path)!r} cannot be read: {error}") from None


def content_of(path: Path, most: int) -> bytes:
    """The bytes of a file; raises CannotRead if it cannot be read, and if it has more than `most` bytes."""
    check_source(path)
    try:
        with path.open("rb") as stream:
            content = stream.read(most + 1)
    except OSError as error:
        raise CannotRead(f"{path} cannot be read: {error.strerror or error}") from None
    if len(content) > most:
        raise CannotRead(f"{path} has more than {most} bytes")
    return content


def text_of(path: Path, most: int = MOST_BYTES) -> str:
    """A text in UTF-8, as `content_of`."""
    try:
        return content_of(path, most).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise CannotRead(f"{path} is not UTF-8 text") from None


def write_whole(path: Path, write: Callable[[IO[bytes]], object]) -> None:
    """Replaces the file by what `write` puts into a stream; raises CannotWrite if the disk refuses."""
    check_destination(path)
    path = Path(os.path.realpath(path))  # a link stays a link; its file is replaced
    temporary = None
    try:
        prefix = f".{path.name[:SHORT]}."  # a name with this and more must not be too long where the file's is not
        with tempfile.NamedTemporaryFile("wb", dir=path.parent, prefix=prefix, delete=False) as stream:
            temporary = Path(stream.name)
            write(stream)
            stream.flush()
            os.fsync(stream.fileno())  # else a power cut may leave the new name with an empty file
        os.umask(mask := os.umask(0))
        os.chmod(temporary, stat.S_IMODE(path.stat().st_mode) if path.exists() else 0o666 & ~mask)
        os.replace(temporary, path)
    except OSError as error:
        raise CannotWrite(f"{path} cannot be written: {error.strerror or error}") from None
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Waits for other processes that are in this `with` for a folder, where the disk has locks."""
    stream = None
    try:
        with suppress(OSError):
            stream = os.open(folder, os.O_RDONLY)
            if fcntl is not None:
                fcntl.flock(stream, fcntl.LOCK_EX)
        yield
    finally:
        if stream is not None:
            os.close(stream)


def write_text(path: Path, text: str) -> None:
    """Replaces the file by a text in UTF-8, as `write_whole` does."""
    write_whole(path, lambda stream: stream.write(encoded(text)))


def visible(text: str) -> str:
    """Replaces what a terminal would obey, in names of others, by escapes: control signs, line ends, directions."""
    return "".join(x if x.isprintable() else repr(x)[1:-1] for x in text)


def pasted(word: str | Path) -> str:
    """A word of a command that a sentence suggests, as a shell takes it; a file is never an option."""
    text = f"./{word}" if isinstance(word, Path) and str(word).startswith("-") else str(word)
    quoted = visible(text.replace("\\", r"\\").replace("'", r"\'"))
    return shlex.quote(text) if text.isprintable() else f"$'{quoted}'"


def encoded(text: str) -> bytes:
    """A text in UTF-8, with half a letter, which has no code there, as the escape that JSON has for it."""
    return text.encode("utf-8", "backslashreplace")
