# SPDX-License-Identifier: MPL-2.0
"""A stiff spheroid that turns in shear, in the plane of the flow, beside Jeffery's law. Needs numpy."""
import math
import os

import numpy

from .programs import run_scene
from .stiff_bodies import scene_in_shear, write_spheroid
from .tables import read_csv

REYNOLDS = 0.1  # by the long semi-axis
_START = 0.3  # until then, over the shear rate, the fluid gets used to the body


def turn(ratio):
    """Duration of a turn times the shear rate."""
    return 2 * math.pi * (ratio + 1 / ratio)


def fit_law(time, phi):
    """Ratio r and rate of change of the angle psi, tan phi = r tan psi, by least squares over r."""
    def misfit(ratio):
        psi = numpy.unwrap(numpy.arctan2(numpy.sin(phi), ratio * numpy.cos(phi)))
        line = numpy.polyfit(time, psi, 1)
        return float(numpy.sum((psi - numpy.polyval(line, time)) ** 2)), line[0]

    low, high = 1.01, 8.0
    for _ in range(60):
        third = (high - low) / 3
        if misfit(low + third)[0] < misfit(high - third)[0]:
            high -= third
        else:
            low += third
    return low, misfit(low)[1]


class Orbit:
    """Half a turn of a spheroid.

    `time` (times the shear rate), `phi` (radians, of the long axis from the velocity gradient) and `settled` by line of
    the table; `turn`: duration of a turn times the shear rate, of the law fitted to what is settled; `fitted_ratio`: of
    the axes in that law; `bending`: largest change of the long axis over its length.
    """

    def __init__(self, report, name, axes, box, kernel, inset=None):
        """`axes`: semi-axes along flow, gradient and vorticity, `box`: nodes; `inset`: None for the kernel's own."""
        self.axes, rate = axes, REYNOLDS / max(axes) ** 2
        write_spheroid(report.folder, axes, rate)
        scene = scene_in_shear(box, rate, 0.5 * turn(axes[0] / axes[1]) + _START, kernel, lines=300, inset=inset)
        folder = run_scene(report, "".join(c if c.isalnum() else "_" for c in name), scene)
        table = read_csv(os.path.join(folder, "cells.csv"))
        self.time = rate * numpy.array(table["time_us"])
        self.phi = numpy.unwrap(math.pi / 2 - numpy.radians(table["inclination_deg"]), period=math.pi)
        self.settled = self.time >= _START
        self.fitted_ratio, speed = fit_law(self.time[self.settled], self.phi[self.settled])
        self.turn = 2 * math.pi / speed
        self.bending = numpy.ptp(table["long_semi_axis_um"]) / axes[0]

    def tell(self, report, name, known_failure=""):
        """Judges the turn against Jeffery's, and draws the angle."""
        ratio = self.axes[0] / self.axes[1]
        report.compare("turn times shear rate, " + name, self.turn, turn(ratio), relative=0.05,
                       known_failure=known_failure)
        report.measured("ratio of axes in the law of the angle, " + name, self.fitted_ratio)
        report.measured("largest change of the long axis, %s" % name, 100 * self.bending, unit="%")
        plot = report.plot("Angle of the " + name, "time times shear rate", "angle from the velocity gradient (deg)")
        report.curve(plot, "ours", self.time, numpy.degrees(self.phi))
        time, start = self.time[self.settled], self.phi[self.settled][0]
        psi = math.atan2(math.sin(start), ratio * math.cos(start)) + (time - time[0]) * 2 * math.pi / turn(ratio)
        jeffery = numpy.unwrap(numpy.arctan2(ratio * numpy.sin(psi), numpy.cos(psi)))
        report.curve(plot, "Jeffery, through our first settled point", time, numpy.degrees(jeffery))
