"""Pictures with matplotlib."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._shapes import Curve, Surface


def picture(shape: Curve | Surface, points: Any = None, path: str | None = None, most: int = 2000) -> Any:
    """Draws a shape, points and the lines to their feet, coloured by distance.

    points   shape (n, 3) or None; of more than `most` evenly chosen ones are drawn
    path     file to write, PNG, SVG or PDF; None: none
    returns  the matplotlib figure
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
        from mpl_toolkits.mplot3d.art3d import Line3DCollection
    except ImportError:
        raise ImportError("plot needs matplotlib: pip install matplotlib") from None
    figure = Figure(figsize=(8, 6.4), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(projection="3d")
    if isinstance(shape, Curve):
        drawn = shape.evaluate(np.linspace(*shape.domain, 600))
        axes.plot(*drawn.T, color="#30506b", linewidth=1.6)
    else:
        (u0, u1), (v0, v1) = shape.domain
        grid = np.stack(np.meshgrid(np.linspace(u0, u1, 61), np.linspace(v0, v1, 61), indexing="ij"), -1)
        drawn = shape.evaluate(grid)
        axes.plot_surface(*np.moveaxis(drawn, -1, 0), color="#9fb8cc", alpha=0.55, linewidth=0, rcount=60, ccount=60)
        axes.plot_wireframe(*np.moveaxis(drawn, -1, 0), color="#30506b", linewidth=0.4, rcount=12, ccount=12)
    everything = [drawn.reshape(-1, 3)]
    if points is not None and len(points):
        queries = np.asarray(points)[:: -(-len(points) // most)]
        feet = shape.closest(queries)
        good = np.isfinite(feet.distance)
        queries, feet = queries[good], feet[good]
        axes.add_collection3d(Line3DCollection(np.stack([queries, feet.point], 1), colors="#888888", linewidths=0.5))
        dots = axes.scatter(*queries.T, c=feet.distance, s=9, cmap="viridis", depthshade=False)
        axes.scatter(*feet.point.T, s=4, color="#c03028", depthshade=False)
        figure.colorbar(dots, ax=axes, shrink=0.7, label="distance")
        axes.set_title(f"{len(queries):,} of {len(points):,} points; {int(feet.proven.sum()):,} of these proven", fontsize=10)
        everything.append(queries)
    both = np.concatenate(everything)
    low, high = both.min(0), both.max(0)
    axes.set_box_aspect(np.maximum(high - low, 0.05 * (high - low).max()))
    axes.set(xlabel="x", ylabel="y", zlabel="z")
    if path is not None:
        figure.savefig(path, dpi=140)
    return figure
