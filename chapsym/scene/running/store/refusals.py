"""What the disk refuses, in one sentence."""

import errno
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from chapsym.files import CannotWrite

from ...read.errors import SceneError


@contextmanager
def refusals(path: Path, names: Iterable[str] = (), creating: bool = False) -> Iterator[None]:
    """Turns the errors of the disk inside into a SceneError.

    names: of the arrays that are being written: where the store was deleted meanwhile, Zarr makes their folders anew,
    and they are removed again.  creating: it is not expected to be there yet.
    """
    try:
        yield
    except (OSError, CannotWrite) as error:
        if not creating and not (path / "zarr.json").exists():
            _remove(path, names)
            told = f"{path} was deleted or moved while it was written; the same command begins anew"
        elif _full(error):
            told = (
                f"{path}: {_reason(error)}; what was written stays: make room, and the same command goes on from there"
            )
        else:
            told = f"{path} cannot be written: {_reason(error)}; what was written stays"
        raise SceneError(told) from None


def _full(error: BaseException) -> bool:
    """Whether there is no room; of a CannotWrite the error inside tells."""
    causes = (error, error.__cause__, error.__context__)
    return any(isinstance(e, OSError) and e.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG) for e in causes)


def _reason(error: BaseException) -> str:
    return (error.strerror if isinstance(error, OSError) else None) or str(error)


def _remove(path: Path, names: Iterable[str]) -> None:
    for name in names:
        shutil.rmtree(path / name, ignore_errors=True)
    with suppress(OSError):  # not empty, or not there: not ours
        path.rmdir()
