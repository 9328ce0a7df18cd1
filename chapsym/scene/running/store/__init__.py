"""A result in Zarr that is written unit by unit: created whole, resumable, never mixed with another run."""

from .identity import attributes, check_ours, check_same, difference, is_store
from .store import Store, write_region

__all__ = ["Store", "attributes", "check_ours", "check_same", "difference", "is_store", "write_region"]
