# SPDX-License-Identifier: MPL-2.0
"""A neo-Hookean capsule, a sphere at rest, in simple shear: deformation and inclination at three capillary numbers.

The core benchmark of the coupling. Radius 8 nodes, box 10 radii, Re = 0.1, 642 vertices, tau = 2, kernel of 2 points;
with 4 points where that matters most, at the smallest Ca. Held against two things: published curves, and a boundary
integral computed beside it (npfem.validation.boundary_integral), which shares neither fluid nor membrane code with the
coupled solver and has neither walls nor inertia nor a lattice.

The two yardsticks disagree: at Ca = 0.3 and 0.6 the boundary integral, which meets linear theory within 0.3 % and
changes by 0.6 % from 162 to 642 vertices, ends at D = 0.400 and 0.531, published curves at 0.381 to 0.392 and 0.495 to
0.500, though all of them agree within 1.5 % up to gdot t = 1. No kernel, mesh, box or time step moves the coupled
result there. With Ramanujan & Pozrikidis' thin-shell law instead of the neo-Hookean one the boundary integral gives
0.396 and 0.521.

D: (long - short)/(long + short) of the semi-axes of the ellipsoid with the same second moments; largest and smallest
distance of a vertex from the centre give 0.397 instead of 0.400 at Ca = 0.3. Ca = mu gdot a / G_s: papers that divide
by E_s = 3 G_s print a third of it.
"""
from npfem.validation import Case, boundary_integral
from npfem.validation.capsule_scene import shear_capsule

CASE = Case(id="C1", title="Neo-Hookean capsule in shear", tier="nightly", cost_s=600,
            source="Ramanujan & Pozrikidis, J. Fluid Mech. 361 (1998) 117; Doddi & Bagchi, Int. J. Multiphase Flow 34 "
                   "(2008) 966; Huet & Wachs, J. Comput. Phys. 492 (2023) 112424; own boundary integral")

# Ca: (end of the run, steps per strain of the boundary integral, D published, by whom, inclination of Huet & Wachs)
_POINTS = {
    0.075: (2.5, 250, 0.1524, "Huet & Wachs", 35.8),
    0.3: (4.0, 100, 0.3844, "Ramanujan & Pozrikidis", 24.9),
    0.6: (4.0, 100, 0.5002, "Ramanujan & Pozrikidis", 19.8),
}
# D at these gdot t. At Ca = 0.075 Ramanujan & Pozrikidis' curve ends at 1.4.
_TIMES = (0.5, 1.0, 1.5, 2.0, 3.0)
_TRANSIENT = {
    "Huet & Wachs": {0.3: (0.2045, 0.3123, 0.3585, 0.3752, 0.3812), 0.6: (0.2227, 0.3685, 0.4451, 0.4798, 0.4970)},
    "Ramanujan & Pozrikidis": {0.075: (0.119, 0.144), 0.3: (0.197, 0.306, 0.356, 0.377, 0.386),
                               0.6: (0.217, 0.361, 0.440, 0.480, 0.506)},
    "Doddi & Bagchi": {0.075: (0.130, 0.151, 0.157, 0.160, 0.161), 0.3: (0.207, 0.311, 0.357, 0.377, 0.389),
                       0.6: (0.221, 0.363, 0.439, 0.470, 0.496)},
}

_REFERENCE_LOW = "an independent boundary integral gives the D computed here, not the published one; cause not known"
_TIPS = "3.04 %: between both yardsticks; 2 points at the pointed tips, where 4 points at the vertices are 1.1 % low"
_LOW = (0.075, "Ramanujan & Pozrikidis")
_SCATTER = "published curves scatter: theirs lies 4.6 % below that of Doddi & Bagchi here, ours 1.6 % above"
_WIDE_KERNEL = "second order in the width of the kernel over the radius (C3)"


def run(report):
    """Three capillary numbers, coupled and by the boundary integral."""
    plot = report.plot("Neo-Hookean capsule in shear, lambda = 1", "gdot t", "Taylor's D")
    for capillary, (strain, steps, published, author, angle) in _POINTS.items():
        name = "Ca = %g" % capillary
        yardstick = list(boundary_integral.Capsule(capillary).shear(strain, 1 / steps))
        ours = shear_capsule(report, "ca%g" % capillary, capillary, strain, box=(10, 10, 10), kernel=2)
        steady = ours.mean(ours.deformation, 0.9 * strain)
        unbounded = yardstick[-1][1]
        report.compare("D, %s, against the boundary integral" % name, steady, unbounded, relative=0.03,
                       known_failure=_TIPS if capillary > 0.5 else "")
        report.compare("D, %s, against %s" % (name, author), steady, published, relative=0.03,
                       known_failure=_REFERENCE_LOW if capillary < 0.5 else "")
        report.compare("inclination, %s, against Huet & Wachs" % name, ours.mean(ours.inclination, 0.9 * strain), angle,
                       absolute=2, unit="deg")
        for who, curves in _TRANSIENT.items():
            if capillary in curves:
                shown = curves[capillary]
                report.compare("D at gdot t = 1, %s, against %s" % (name, who), ours.deformation[ours.at(1)], shown[1],
                               relative=0.05, known_failure=_SCATTER if (capillary, who) == _LOW else "")
        report.curve(plot, "%s, coupled" % name, ours.strain, ours.deformation)
        report.curve(plot, "%s, boundary integral" % name, [row[0] for row in yardstick], [row[1] for row in yardstick])
        report.measured("change of volume, %s" % name, 100 * (ours.volume[-1] - 1), unit="%")
        if capillary < 0.1:
            wide = shear_capsule(report, "four_points", capillary, strain, box=(10, 10, 10), kernel=4)
            report.compare("D, %s, 4 points, against the boundary integral" % name,
                           wide.mean(wide.deformation, 0.9 * strain), unbounded, relative=0.03,
                           known_failure=_WIDE_KERNEL)
    for who, curves in _TRANSIENT.items():
        report.curve(plot, who, [time for shown in curves.values() for time in _TIMES[:len(shown)]],
                     [value for shown in curves.values() for value in shown], points=True)
