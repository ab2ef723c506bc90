# SPDX-License-Identifier: MPL-2.0
"""A cut through a run along the flow: velocity of the fluid in colours, and the cells that the plane meets."""
import numpy

from .run_output import UP_AXIS
from .surfaces import cut, refine

_INK = "#33414d"
_MM_PER_S = 1000.0  # of one um/us
_REFINEMENTS = 2
_BAR_ROOM = 100  # pixels, for the colour bar and its numbers
# Pale enough for the cells to stand out.
_ONE_WAY = ("#fbfdf6", "#d5ecdc", "#8fc9cf", "#4b97bd", "#2f6598")
_BOTH_WAYS = ("#b98a4a", "#e3cda4", "#fafaf7", "#a9d3cf", "#3d8f8c")


def velocity_in_section(snapshot):
    """(up, along): velocity along the flow (mm/s) in the middle plane; NaN in solids."""
    order = [snapshot.depth_axis, UP_AXIS, snapshot.flow_axis]
    along = _MM_PER_S * snapshot.velocity[..., snapshot.flow_axis].transpose(order)
    solid = snapshot.solid.transpose(order)
    count = along.shape[0]
    # The middle of an even number of nodes lies between two of them.
    pair = ((count - 1) // 2, count // 2)
    plane = 0.5 * (along[pair[0]] + along[pair[1]])
    return numpy.where(solid[pair[0]] & solid[pair[1]], numpy.nan, plane)


def cell_outlines(snapshot, cell):
    """Outlines (n, 2), along and up in um, of one cell's section, with its copies beyond the ends of the vessel."""
    own = snapshot.triangles[snapshot.cell_id == cell]
    vertices, local = numpy.unique(own, return_inverse=True)
    points, triangles = snapshot.points[vertices], local.reshape(-1, 3)
    for _ in range(_REFINEMENTS):
        points, triangles, _ = refine(points, triangles, numpy.zeros(len(triangles)))
    period = snapshot.size[snapshot.flow_axis]
    outlines = []
    for outline in cut(points, triangles, snapshot.depth_axis, 0.5 * snapshot.size[snapshot.depth_axis]):
        flat = outline[:, [snapshot.flow_axis, UP_AXIS]]
        for image in (-1, 0, 1):
            moved = flat + [image * period, 0.0]
            if moved[:, 0].max() > 0 and moved[:, 0].min() < period:
                outlines.append(moved)
    return outlines


def _colour_limits(plane):
    """(least, largest, colours): from 0 for a flow one way, symmetric for a flow both ways."""
    values = plane[numpy.isfinite(plane)]
    least, largest = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    if least < -0.2 * largest and largest > 0:
        bound = max(-least, largest)
        return -bound, bound, _BOTH_WAYS
    return min(least, 0.0), largest if largest > least else least + 1e-12, _ONE_WAY


def draw_section(figure, place, snapshot, cell_colours):
    """Draws the section into `place` (left, bottom, width, height of the figure), as wide as it fits."""
    from matplotlib.colors import LinearSegmentedColormap

    plane = velocity_in_section(snapshot)
    length, height = snapshot.size[snapshot.flow_axis], snapshot.size[UP_AXIS]
    pixels = figure.get_size_inches() * figure.dpi
    room = place[2] * pixels[0] - _BAR_ROOM, place[3] * pixels[1]
    scale = min(room[0] / length, room[1] / height)
    width, tall = scale * length / pixels[0], scale * height / pixels[1]
    left = place[0] + 0.5 * (room[0] / pixels[0] - width)
    axes = figure.add_axes([left, place[1] + 0.5 * (place[3] - tall), width, tall])
    least, largest, colours = _colour_limits(plane)
    colour_map = LinearSegmentedColormap.from_list("velocity", colours)
    picture = axes.imshow(plane, origin="lower", extent=(0, length, 0, height), vmin=least, vmax=largest,
                          cmap=colour_map, interpolation="bilinear")
    cells = cell_colours(snapshot, numpy.arange(len(snapshot.triangles)))
    for cell in numpy.unique(snapshot.cell_id):
        colour = cells[numpy.argmax(snapshot.cell_id == cell)]
        for outline in cell_outlines(snapshot, cell):
            axes.fill(outline[:, 0], outline[:, 1], facecolor=tuple(colour), edgecolor=tuple(0.55 * colour),
                      linewidth=0.9)
    axes.set_xlim(0, length)
    axes.set_ylim(0, height)
    names = "xyz"
    axes.set_xlabel("%s (µm)" % names[snapshot.flow_axis], color=_INK, fontsize=9)
    axes.set_ylabel("%s (µm)" % names[UP_AXIS], color=_INK, fontsize=9)
    axes.tick_params(colors=_INK, labelsize=8)
    for spine in axes.spines.values():
        spine.set_color("#9aa5ad")
    box = axes.get_position()
    bar = figure.colorbar(picture, cax=figure.add_axes([box.x1 + 14 / pixels[0], box.y0, 16 / pixels[0], box.height]))
    bar.set_label("velocity along %s (mm/s)" % names[snapshot.flow_axis], color=_INK, fontsize=9)
    bar.ax.tick_params(colors=_INK, labelsize=8)
    bar.outline.set_edgecolor("#9aa5ad")
