# SPDX-License-Identifier: MPL-2.0
"""The stretching curve drawn over the measured points. Needs matplotlib."""
from .tweezers_data import MILLS_2004, rms_errors

_AXIAL_COLOUR = "#b3202c"
_TRANSVERSE_COLOUR = "#1f5f8b"


def plot_stretch(rows, path, title, measured=True):
    """Draws the rows of `stretch()` and, if `measured`, the points of Mills et al. 2004 into a PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 4.8), dpi=160)
    FigureCanvasAgg(figure)
    axes = figure.add_axes([0.09, 0.12, 0.88, 0.78])
    usable = [row for row in rows if row["usable"]]
    forces = [row["force_pN"] for row in usable]
    points = MILLS_2004 if measured else ()
    measured_forces = [point[0] for point in points]
    curves = (("axial", "axial_um", 1, _AXIAL_COLOUR, "o"), ("transverse", "transverse_um", 2, _TRANSVERSE_COLOUR, "s"))
    errors = rms_errors(rows) if measured else None
    for index, (name, key, column, colour, marker) in enumerate(curves):
        label = name if errors is None else "%s, rms error %.1f %%" % (name, 100 * errors[index])
        axes.plot(forces, [row[key] for row in usable], color=colour, linewidth=2, label=label)
        if measured:
            axes.plot(measured_forces, [point[column] for point in points], marker, color=colour, markersize=6,
                      markerfacecolor="white", markeredgewidth=1.4, label=name + ", Mills et al. 2004")
    axes.set_xlabel("force on each side (pN)")
    axes.set_ylabel("diameter (µm)")
    axes.set_ylim(0, None)
    axes.set_xlim(0, 1.03 * max(forces + measured_forces + [1.0]))
    axes.grid(True, color="#e6e6e6", linewidth=0.8)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.legend(frameon=False, loc="center right")
    axes.set_title(title, loc="left", fontsize=11)
    figure.savefig(path, metadata={"Software": None})
