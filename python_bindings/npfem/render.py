# SPDX-License-Identifier: MPL-2.0
"""A picture of a run: the cells in their vessel, and below it a cut along the flow. Needs numpy and matplotlib.

Our own z-buffer, so that a picture needs neither a display nor a graphics library.
"""
import numpy

from .rasteriser import Camera
from .run_output import UP_AXIS, read_run
from .section_plot import draw_section
from .shading import averaged, glass_tube, laid_over, shade
from .surfaces import refine

_DPI = 150
_TITLE_HEIGHT = 100
_SUPERSAMPLING = 2
# A vessel longer than this, in its heights, has its section below the view, a shorter one beside it.
_LONG_VESSEL = 2.2
_TRIANGLE_BUDGET = 350000
_PLATELET = (0.95, 0.70, 0.20)
_RED_CELL = (0.64, 0.05, 0.06)
_GLASS = (0.40, 0.52, 0.60)
_INK = "#33414d"
_FLOW = "#2c6e9b"


def _type_name(snapshot, cell_type):
    """In words that a person reads; "cell" where the run does not name its types."""
    name = snapshot.type_names[cell_type] if cell_type < len(snapshot.type_names) else "cell"
    return "red cell" if "rbc" in name else name


def cell_colours(snapshot, labels):
    """(m, 3): one colour per cell, red or, for platelets, yellow; each cell a shade of its own."""
    ids, types = snapshot.cell_id[labels], snapshot.cell_type[labels]
    base = numpy.empty((len(labels), 3))
    for cell_type in numpy.unique(types):
        base[types == cell_type] = _PLATELET if "platelet" in _type_name(snapshot, cell_type) else _RED_CELL
    shade_of_cell = 0.86 + 0.28 * numpy.modf(ids * 0.6180339887)[0]
    return numpy.clip(base * shade_of_cell[:, None], 0, 1)


def _unit_axis(axis):
    return numpy.eye(3)[axis]


def _frame(snapshot):
    """(right, up, toward): along the flow, up, and toward the viewer, right-handed."""
    right, up = _unit_axis(snapshot.flow_axis), _unit_axis(UP_AXIS)
    return right, up, numpy.cross(right, up)


def _flow_profile(snapshot):
    """(heights um, velocity um/us) along the vertical through the axis, averaged along the flow."""
    along = snapshot.velocity[..., snapshot.flow_axis]
    middle = along.shape[snapshot.depth_axis] // 2
    order = [snapshot.depth_axis, snapshot.flow_axis, UP_AXIS]
    profile = along.transpose(order)[middle].mean(axis=0)
    fluid = ~snapshot.solid.transpose(order)[middle].all(axis=0)
    heights = (numpy.arange(len(profile)) + 0.5) * snapshot.spacing[UP_AXIS]
    return heights[fluid], profile[fluid]


def _flow_arrows(snapshot):
    """(feet, tips), each (n, 3) um: the velocity profile, standing free before the vessel's inlet."""
    heights, profile = _flow_profile(snapshot)
    fastest = numpy.abs(profile).max() if len(profile) else 0.0
    if fastest <= 0:
        return numpy.empty((0, 3)), numpy.empty((0, 3))
    right, up, toward = _frame(snapshot)
    lengths = 0.17 * (snapshot.size @ right) * profile / fastest
    first_cell = (snapshot.points @ right).min() if len(snapshot.points) else 0.0
    start = min(-0.05 * (snapshot.size @ right), first_cell - 0.4) - max(lengths.max(), 0)
    feet = 0.5 * snapshot.size * numpy.abs(toward) + heights[:, None] * up + start * right
    return feet, feet + lengths[:, None] * right


def _camera(snapshot, width, height):
    """Looks at the vessel from the side, a little from above and from upstream; everything fits the view."""
    right, up, toward = _frame(snapshot)
    middle = 0.5 * snapshot.size
    direction = toward - 0.42 * right + 0.30 * up
    reach = float(numpy.linalg.norm(snapshot.size))
    eye = middle + 3.2 * reach * direction / numpy.linalg.norm(direction)
    corners = numpy.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * snapshot.size
    corners = numpy.concatenate([corners, snapshot.points, *_flow_arrows(snapshot)])
    trial = Camera(eye, middle, up, 1.0, 0, 0).project(corners)[:, :2]
    low, high = trial.min(axis=0), trial.max(axis=0)
    scale = min(0.94 * width / (high[0] - low[0]), 0.84 * (height - _TITLE_HEIGHT) / (high[1] - low[1]))
    shift = 0.5 * (low + high) - [0, 0.4 * _TITLE_HEIGHT / scale]
    plain = Camera(eye, middle, up, 1.0, 0, 0)
    move = shift[0] * plain.right - shift[1] * plain.up
    return Camera(eye + move, middle + move, up, scale, width, height)


def _background(width, height):
    """A soft grey, lighter in the middle."""
    y, x = numpy.mgrid[0:height, 0:width]
    away = numpy.hypot(x / width - 0.5, 0.8 * (y / height - 0.45))
    return (1.0 - 0.10 * numpy.clip(away / 0.7, 0, 1) ** 2)[..., None] * numpy.array([0.985, 0.99, 1.0])


def _detailed(snapshot):
    """Points, triangles and the original triangle of each, refined until they look smooth."""
    points, triangles, labels = snapshot.points, snapshot.triangles, numpy.arange(len(snapshot.triangles))
    while 0 < 4 * len(triangles) <= _TRIANGLE_BUDGET:
        points, triangles, labels = refine(points, triangles, labels)
    return points, triangles, labels


def draw_view(snapshot, camera, image):
    """(image, depth): the cells in their vessel over `image` (height, width, 3); how far away what is seen stands."""
    depth = numpy.full(image.shape[:2], numpy.inf)
    walls = []
    if snapshot.kind == "tube":
        right = _frame(snapshot)[0]
        start = 0.5 * snapshot.size * (1 - right)
        walls = glass_tube(camera, start, start + snapshot.size * right, snapshot.tube_radius)
        image = laid_over(image, _GLASS, walls[0][1])
    if len(snapshot.triangles):
        points, triangles, labels = _detailed(snapshot)
        rgba, fine_depth = shade(points, triangles, cell_colours(snapshot, labels), camera.enlarged(_SUPERSAMPLING))
        small = averaged(rgba, _SUPERSAMPLING)
        # Distance fades the colours a little into the background.
        fine = averaged(numpy.where(numpy.isfinite(fine_depth), fine_depth, camera.distance), _SUPERSAMPLING)
        extent = 0.5 * float(numpy.linalg.norm(snapshot.size))
        haze = 0.16 * numpy.clip((fine - camera.distance + extent) / (2 * extent), 0, 1) * small[..., 3]
        image = image * (1 - small[..., 3:]) + laid_over(small[..., :3], numpy.array([0.93, 0.95, 0.97]), haze)
        depth = fine_depth[::_SUPERSAMPLING, ::_SUPERSAMPLING]
    if walls:
        image = laid_over(image, _GLASS, 0.7 * walls[1][1])
        image = laid_over(image, (1, 1, 1), 0.42 * walls[1][2])
    return numpy.clip(image, 0, 1), depth


def _outlines(snapshot):
    """Lines (n, 3) that show the vessel: rings of a tube, edges of a box."""
    right, _, _ = _frame(snapshot)
    if snapshot.kind == "tube":
        angle = numpy.linspace(0, 2 * numpy.pi, 241)
        ring = (snapshot.tube_radius * (numpy.cos(angle)[:, None] * _unit_axis(UP_AXIS)
                                        + numpy.sin(angle)[:, None] * _unit_axis(snapshot.depth_axis))
                + 0.5 * snapshot.size * (1 - right))
        return [ring, ring + snapshot.size * right]
    lines = []
    for axis in range(3):
        for a in (0, 1):
            for b in (0, 1):
                start = numpy.zeros(3)
                start[(axis + 1) % 3], start[(axis + 2) % 3] = a, b
                steps = numpy.linspace(0, 1, 121)[:, None]
                lines.append((start + steps * _unit_axis(axis)) * snapshot.size)
    return lines


def _draw_outlines(axes, snapshot, camera, depth):
    """The vessel's outlines, faint where a cell stands before them."""
    for line in _outlines(snapshot):
        screen = camera.project(line)
        column = numpy.clip(screen[:, 0].astype(int), 0, camera.width - 1)
        row = numpy.clip(screen[:, 1].astype(int), 0, camera.height - 1)
        hidden = screen[:, 2] > depth[row, column]
        axes.plot(numpy.where(hidden, numpy.nan, screen[:, 0]), screen[:, 1], color=_INK, alpha=0.6, linewidth=1.2,
                  solid_capstyle="round")


def _draw_flow(axes, snapshot, camera):
    """The velocity profile as arrows before the inlet."""
    feet, tips = (camera.project(points) for points in _flow_arrows(snapshot))
    for line in (feet, tips):
        axes.plot(line[:, 0], line[:, 1], color=_FLOW, linewidth=1.2, alpha=0.8)
    for index in numpy.unique(numpy.linspace(0, len(feet) - 1, 11).astype(int)[1:-1]) if len(feet) else ():
        axes.annotate("", xy=tips[index, :2], xytext=feet[index, :2], annotation_clip=False,
                      arrowprops={"arrowstyle": "-|>,head_width=0.22,head_length=0.45", "color": _FLOW,
                                  "linewidth": 1.5, "shrinkA": 0, "shrinkB": 0})


def _draw_scale_bar(axes, snapshot, camera):
    """A bar along the vessel's lower edge, a round length that is at most a quarter of it."""
    right, up, toward = _frame(snapshot)
    length = snapshot.size @ right
    bar = max(value for value in (1, 2, 5, 10, 20, 50, 100, 200, 500) if value <= max(length / 4, 1))
    nearest = 0.5 * snapshot.size * numpy.abs(toward) - 0.06 * snapshot.size * up
    if snapshot.kind != "tube":
        nearest = nearest + 0.5 * (snapshot.size @ numpy.abs(toward)) * toward
    ends = camera.project([nearest + (length - bar) * right, nearest + length * right])
    axes.plot(ends[:, 0], ends[:, 1], color=_INK, linewidth=3, solid_capstyle="butt")
    axes.text(ends[:, 0].mean(), ends[:, 1].max() + 12, "%g µm" % bar, color=_INK, ha="center", va="top", fontsize=10)


def caption(snapshot):
    """What is seen: counts, haematocrit, size, time."""
    parts = []
    for cell_type in numpy.unique(snapshot.cell_type):
        name = _type_name(snapshot, cell_type)
        count = snapshot.cell_count(cell_type)
        parts.append("%d %s%s" % (count, name, "" if count == 1 else "s"))
    if snapshot.haematocrit is not None:
        parts.append("haematocrit %.1f %%" % (100 * snapshot.haematocrit))
    length = snapshot.size[snapshot.flow_axis]
    if snapshot.kind == "tube":
        parts.append("tube %.3g µm wide, %.3g µm long" % (2 * snapshot.tube_radius, length))
    else:
        parts.append("%.3g × %.3g × %.3g µm" % tuple(snapshot.size))
    parts.append("t = %.3g ms" % (1e-3 * snapshot.time_us))
    return "  ·  ".join(parts)


class Layout:
    """Pixels of the picture, of the view in its upper left corner, and the place (left, bottom, width, height as parts
    of the picture) of the section."""

    def __init__(self, snapshot):
        if snapshot.size[snapshot.flow_axis] > _LONG_VESSEL * snapshot.size[UP_AXIS]:
            self.picture, self.view = (1800, 1240), (1800, 820)
            self.section = (0.05, 0.075, 0.92, 0.26)
        else:
            self.picture, self.view = (1920, 920), (1250, 920)
            self.section = (0.69, 0.10, 0.295, 0.74)


def _draw_view_axes(figure, layout, snapshot):
    """The three-dimensional view, with its lines, arrows and scale bar."""
    camera = _camera(snapshot, *layout.view)
    width, height = layout.picture
    image, depth = draw_view(snapshot, camera, _background(width, height)[:camera.height, :camera.width])
    axes = figure.add_axes([0, 1 - camera.height / height, camera.width / width, camera.height / height])
    axes.imshow(image, extent=(0, camera.width, camera.height, 0), interpolation="nearest", aspect="auto")
    _draw_outlines(axes, snapshot, camera, depth)
    _draw_flow(axes, snapshot, camera)
    _draw_scale_bar(axes, snapshot, camera)
    axes.set_xlim(0, camera.width)
    axes.set_ylim(camera.height, 0)
    axes.axis("off")


def render(folder, path, index=-1):
    """Draws the instant `index` (-1: the last) of the run in `folder` into the PNG `path`."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    snapshot = read_run(folder, index)
    layout = Layout(snapshot)
    width, height = layout.picture
    figure = Figure(figsize=(width / _DPI, height / _DPI), dpi=_DPI)
    FigureCanvasAgg(figure)
    backdrop = figure.add_axes([0, 0, 1, 1])
    backdrop.imshow(_background(width, height), interpolation="nearest", aspect="auto")
    backdrop.axis("off")
    _draw_view_axes(figure, layout, snapshot)
    figure.text(32 / width, 1 - 30 / height, snapshot.title, color=_INK, fontsize=15, va="top", weight="bold")
    figure.text(32 / width, 1 - (74 if snapshot.title else 30) / height, caption(snapshot), color=_INK, fontsize=10,
                va="top")
    draw_section(figure, layout.section, snapshot, cell_colours)
    figure.savefig(path, metadata={"Software": None})
