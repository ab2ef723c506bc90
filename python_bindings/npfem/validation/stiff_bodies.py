# SPDX-License-Identifier: MPL-2.0
"""Bodies as good as rigid, for cases that know how a rigid one moves: a stiff shell around fluid, in a shear box."""
import os

import npfem

# One node spacing is 1 um, the fluid has 1000 kg/m3 and 1 mm2/s: a time step of (tau - 1/2)/3 us.
TAU = 4
TIME_STEP_US = (TAU - 0.5) / 3

_MATERIAL = """schema_version = 1
name = "stiff"
[mesh]
[parameters]
membrane_law = "skalak"
shear_modulus = "%.9g uN/m"
skalak_C = 1
bending_law = "dihedral"
bending_modulus = "%.9g pN um"
[sources]
"""

_SCENE = """schema_version = 1
[domain]
kind = "shear_box"
size = ["%d um", "%d um", "%d um"]
dx = "1 um"
[fluid]
density = "1000 kg/m3"
kinematic_viscosity = "1 mm2/s"
tau = %g
[flow]
shear_rate = "%.17g 1/us"
start = "developed"
[[cells]]
name = "body"
material = "body.toml"
mesh = "body.off"
positions = [ { centre = ["%.6f um", "%.6f um", "%.6f um"] } ]
[coupling]
kernel = %d
%s
[solver]
tolerance = "%.3g pN"
newton_iterations = 0
[output]
table_every = "%.17g us"
fluid = false
[run]
time = "%.17g us"
"""


def write_spheroid(folder, semi_axes, shear_rate, capillary=1e-3):
    """`body.off`, the stretched icosphere of 642 vertices, and `body.toml`, a shell that strains by about `capillary`.

    `semi_axes`: um; `shear_rate`: 1/us, of the flow that it is to bear.
    """
    sphere = npfem.Mesh.generate("icosphere", 3, 2.0)
    points = [[x * a for x, a in zip(point, semi_axes)] for point in sphere.positions]
    npfem.Mesh(points, sphere.triangles).save(os.path.join(folder, "body.off"))
    modulus = 1000 * shear_rate * max(semi_axes) / capillary
    with open(os.path.join(folder, "body.toml"), "w", encoding="utf-8") as stream:
        stream.write(_MATERIAL % (modulus, 0.01 * modulus * min(semi_axes) ** 2))


def scene_in_shear(box, shear_rate, duration, kernel=4, lines=100, inset=0):
    """The body in the middle of a shear box of so many nodes, a little off any place of symmetry among them.

    `duration` in units of 1/shear rate; `lines`: of the tables; `inset`: of the markers, None for the kernel's own.
    """
    centre = [0.5 * n + 0.21 for n in box]
    tolerance = 0.1 * shear_rate  # 1e-4 of the force that the flow exerts on 1 um2
    markers = "" if inset is None else "inset = %g" % inset
    return _SCENE % (*box, TAU, shear_rate, *centre, kernel, markers, tolerance, duration / shear_rate / lines,
                     duration / shear_rate)
