# SPDX-License-Identifier: MPL-2.0
"""Computed curves drawn over the measured points. Needs matplotlib."""
from .recovery import HOCHMUTH_1979
from .tweezers_data import MILLS_2004, rms_errors

_AXIAL_COLOUR = "#b3202c"
_TRANSVERSE_COLOUR = "#1f5f8b"


def _frame(title):
    """(figure, axes) of a plot of ours."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 4.8), dpi=160)
    FigureCanvasAgg(figure)
    axes = figure.add_axes([0.09, 0.12, 0.88, 0.78])
    axes.grid(True, color="#e6e6e6", linewidth=0.8)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.set_title(title, loc="left", fontsize=11)
    return figure, axes


def _points(axes, x, y, marker, colour, label):
    axes.plot(x, y, marker, color=colour, markersize=6, markerfacecolor="white", markeredgewidth=1.4, label=label)


def plot_stretch(rows, path, title, points=MILLS_2004, source="Mills et al. 2004"):
    """Draws the rows of `stretch()` and measured points (force_pN, axial_um, transverse_um), if any, into a PNG."""
    figure, axes = _frame(title)
    usable = [row for row in rows if row["usable"]]
    forces = [row["force_pN"] for row in usable]
    measured_forces = [point[0] for point in points]
    curves = (("axial", "axial_um", 1, _AXIAL_COLOUR, "o"), ("transverse", "transverse_um", 2, _TRANSVERSE_COLOUR, "s"))
    errors = rms_errors(rows, points) if points else None
    for index, (name, key, column, colour, marker) in enumerate(curves):
        label = name if errors is None else "%s, rms error %.1f %%" % (name, 100 * errors[index])
        axes.plot(forces, [row[key] for row in usable], color=colour, linewidth=2, label=label)
        if points:
            _points(axes, measured_forces, [point[column] for point in points], marker, colour,
                    "%s, %s" % (name, source))
    axes.set_xlabel("force on each side (pN)")
    axes.set_ylabel("diameter (µm)")
    axes.set_ylim(0, None)
    axes.set_xlim(0, 1.03 * max(forces + measured_forces + [1.0]))
    axes.legend(frameon=False, loc="center right")
    figure.savefig(path, metadata={"Software": None})


def plot_recovery(times, ratios, path, title):
    """Draws a curve of `recovery.recover()` over cells 1 and 2 of Hochmuth et al. 1979 into a PNG."""
    figure, axes = _frame(title)
    axes.plot(times, ratios, color=_AXIAL_COLOUR, linewidth=2, label="computed")
    for number, (cell, marker) in enumerate(zip(HOCHMUTH_1979, "os"), 1):
        _points(axes, *zip(*cell), marker, _TRANSVERSE_COLOUR, "cell %d, Hochmuth et al. 1979" % number)
    axes.set_xlabel("time after the release (s)")
    axes.set_ylabel("length / width")
    axes.set_xlim(0, None)
    axes.legend(frameon=False, loc="upper right")
    figure.savefig(path, metadata={"Software": None})
