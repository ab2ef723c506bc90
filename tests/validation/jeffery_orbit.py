# SPDX-License-Identifier: MPL-2.0
"""How spheroids turn in shear: Jeffery's orbit, in the plane of the flow.

A stiff spheroid (it strains by about 1e-3) turns slowly while it lies along the flow and fast across it. The angle phi
of its long axis from the velocity gradient follows tan phi = r tan(rate t/(r + 1/r)), r the ratio of the axes in that plane, and a
turn takes 2 pi (r + 1/r)/rate. Prolate and oblate of ratio 2, and the platelet's 3.6 to 1.1, at Re = rate a^2/nu = 0.1 for the long
semi-axis a, in boxes of six long semi-axes along flow and gradient. The law is fitted to half a turn, once the start has
died out.

Peers are 2 to 5 % off; 5 % is allowed where the short axis, the whole of it, has at least 4 nodes. The kernel smears the surface: every
axis is longer by the excess of I2 (0.48 nodes with 4 points), so that the body is rounder than meant and turns faster. The period
of that rounder body is given beside ours: it says how much of an error is left to anything else. Known weakness: orbits out of the plane
are not looked at; walls and images at three semi-axes.
"""
import math
import os

import numpy

from npfem.validation import Case, read_csv, run_scene
from npfem.validation.stiff_bodies import scene_in_shear, write_spheroid

CASE = Case(id="I4", title="Spheroids turn in shear", tier="nightly", cost_s=200,
            source="Jeffery, Proc. R. Soc. A 102 (1922) 161")

REYNOLDS = 0.1
EXCESS = {4: 0.485, 2: 0.277}  # dx, of the radius of a sphere, measured in I2
ROUNDER = ("the kernel smears the surface, axes grow by %.2g dx: the period of that rounder body is %.1f %% short; "
           "the error goes with dx over the short axis")

# name, semi-axes along flow, gradient, vorticity (dx), nodes, kernel
BODIES = (("prolate 2 : 1, short axis 8 dx", (8, 4, 4), (48, 48, 32), 4),
          ("oblate 2 : 1, short axis 8 dx", (8, 4, 8), (48, 48, 48), 4),
          ("platelet 3.6 : 1.1, short axis 4 dx", (6.545, 2, 6.545), (40, 40, 40), 4),
          ("platelet 3.6 : 1.1, short axis 6 dx", (9.818, 3, 9.818), (60, 60, 60), 4),
          ("platelet 3.6 : 1.1, short axis 4 dx, 2-point kernel", (6.545, 2, 6.545), (40, 40, 40), 2))


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


def run(report):
    """All bodies, and the angle of the first platelet."""
    for name, axes, box, kernel in BODIES:
        ratio, rate = axes[0] / axes[1], REYNOLDS / max(axes) ** 2
        start = 0.3  # until then, over the shear rate, the fluid gets used to the body
        write_spheroid(report.folder, axes, rate)
        folder = run_scene(report, "".join(c if c.isalnum() else "_" for c in name),
                           scene_in_shear(box, rate, 0.5 * turn(ratio) + start, kernel, lines=300))
        table = read_csv(os.path.join(folder, "cells.csv"))
        time = rate * numpy.array(table["time_us"])
        phi = numpy.unwrap(math.pi / 2 - numpy.radians(table["inclination_deg"]), period=math.pi)
        settled = time >= start
        fitted_ratio, speed = fit_law(time[settled], phi[settled])
        ours = 2 * math.pi / speed
        excess = EXCESS[kernel]
        rounder = turn((axes[0] + excess) / (axes[1] + excess))
        expected = 100 * (1 - rounder / turn(ratio))
        report.compare("turn times shear rate, " + name, ours, turn(ratio), relative=0.05,
                       known_failure=ROUNDER % (excess, expected) if expected > 5 else "")
        report.compare("turn times shear rate against that of axes longer by the excess, " + name, ours, rounder,
                       relative=0.05)
        report.measured("ratio of axes in the law of the angle, %s; with the excess %.3f" % (
            name, (axes[0] + excess) / (axes[1] + excess)), fitted_ratio)
        report.measured("largest change of the long axis, %s" % name,
                        100 * (numpy.ptp(table["long_semi_axis_um"]) / axes[0]), unit="%")
        plot = report.plot("Angle of the " + name, "time times shear rate", "angle from the velocity gradient (deg)")
        report.curve(plot, "ours", time, numpy.degrees(phi))
        shift = math.atan2(math.sin(phi[settled][0]), ratio * math.cos(phi[settled][0]))
        psi = shift + (time[settled] - time[settled][0]) * 2 * math.pi / turn(ratio)
        jeffery = numpy.unwrap(numpy.arctan2(ratio * numpy.sin(psi), numpy.cos(psi)))
        report.curve(plot, "Jeffery, through our first settled point", time[settled], numpy.degrees(jeffery))
