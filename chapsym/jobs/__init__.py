"""Long work in units that can be gone on with: sweeps of scenes and studies, on all cores or on a Dask cluster."""

from .chains import Call, Chain, Crew, Lost, run
from .cluster import workers
from .crews import processes, threads
from .lock import claim, held

__all__ = ["Call", "Chain", "Crew", "Lost", "claim", "held", "processes", "run", "threads", "workers"]
