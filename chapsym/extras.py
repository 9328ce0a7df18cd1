"""The extras: packages that parts of chapsym need besides its core, and the sentence where one is absent."""

from importlib.util import find_spec

#: extra: what needs it, and the packages that it is made of; a test compares them with the project's metadata.
EXTRAS = {
    "scenes": (
        "labelled results, and files other than .csv and .npz, need",
        ("xarray", "zarr", "google_crc32c", "h5netcdf", "h5py", "pyarrow", "pandas"),
    ),
    "figures": ("figures and rolling pages need", ("matplotlib", "jinja2")),
    "cluster": ("a Dask cluster needs", ("distributed",)),
    "report": ("the pages of a report need", ("jinja2", "math_core")),
    "test": ("chapsym.testing needs", ("hypothesis",)),
}


class MissingExtra(ImportError):
    """An extra is not installed: what needs it, the packages that are absent, and the command that installs them."""


def need(extra: str, *only: str) -> None:
    """Raises MissingExtra unless all packages of an extra, or `only` these of it, are there; none is imported."""
    what, packages = EXTRAS[extra]
    absent = [package for package in only or packages if find_spec(package) is None]
    if absent:
        *some, last = absent
        listed, are = (f"{', '.join(some)} and {last}", "are") if some else (last, "is")
        raise MissingExtra(f"{what} {listed}, which {are} not installed: pip install 'chapsym[{extra}]'")
