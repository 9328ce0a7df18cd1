"""A result in Zarr that is written unit by unit: created whole, resumable, never mixed with another run."""

from .identity import check_same, difference
from .store import Store, write_region

__all__ = ["Store", "check_same", "difference", "write_region"]
