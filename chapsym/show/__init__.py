"""The display of results: figures and the rolling ball."""

from chapsym import extras

extras.need("figures")  # which installs those of scenes, too
extras.need("scenes")
