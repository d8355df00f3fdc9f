"""What studies draw on: matplotlib without a screen, or one line that says how to get it."""

from artgen.core.errors import UsageError

try:
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
except ImportError as error:
    raise UsageError(
        "studies draw plots with matplotlib, which is not installed: pip install 'artgen[study]'"
    ) from error

__all__ = ["Axes", "Figure", "FigureCanvasAgg"]
