"""matplotlib's figure, which a notebook shows as it is: as SVG, without pyplot."""

import io

from matplotlib.figure import Figure


class Picture(Figure):
    """A `matplotlib.figure.Figure` with a display of its own."""

    def svg(self) -> str:
        """The figure as an SVG element, for a page of HTML: as wide as there is room for."""
        from .style import write

        stream = io.BytesIO()
        write(self, stream, "svg")
        text = stream.getvalue().decode()
        return text[text.index("<svg") :].replace("<svg ", '<svg style="max-width: 100%; height: auto" ', 1)

    def _repr_svg_(self) -> str:
        return self.svg()
