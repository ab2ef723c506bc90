# SPDX-License-Identifier: MPL-2.0
"""The optical-tweezers experiment on one cell: two opposite forces along x, at rest under each force.

Two beads are stuck to the rim of the cell and pulled apart (Mills et al. 2004). The contact of each bead is a disc of
`contact_diameter_um`, seen along x, around the two ends of the cell: it decides the curve more than the membrane law
does, so a modulus means nothing without it. "rigid" ties the vertices of a disc to the bead, which moves as one
translating body; "shared" leaves them free and splits the force equally over them.
"""
import math

from .batch import NOT_FINITE, STATUS_NAMES, Batch
from .material import Material
from .model import Model

LOADS = ("rigid", "shared")
CONTACT_DIAMETER_UM = 2.0

# Forces are raised in steps no larger than this, each starting from the shape under the force before.
_LARGEST_FORCE_STEP_PN = 25.0
# Ties the vertices of a bead's contact together; 10 % more changes the diameters by less than 0.06 %.
_BEAD_STIFFNESS_PN_PER_UM = 1000.0


def flat_numbers(rows, kind=float):
    """The numbers of a flat or nested sequence, one after the other."""
    numbers = []
    for row in rows:
        if hasattr(row, "__iter__"):
            numbers += flat_numbers(row, kind)
        else:
            numbers.append(kind(row))
    return numbers


def contact_vertices(positions, contact_diameter_um=CONTACT_DIAMETER_UM):
    """(left, right): indices of the vertices under each bead.

    `positions`: (vertices, 3) or flat, um. A vertex lies under a bead where it stands at most half a contact diameter
    off the x axis through the cell's middle and more than half way out to that end: the hollows of a red cell come near
    the axis too, but no bead touches them.
    """
    flat = flat_numbers(positions)
    columns = [flat[axis::3] for axis in range(3)]
    middle = [0.5 * (min(column) + max(column)) for column in columns]
    half_way = 0.25 * (max(columns[0]) - min(columns[0]))
    left, right = [], []
    for vertex, point in enumerate(zip(*columns)):
        x, y, z = (point[axis] - middle[axis] for axis in range(3))
        # The tolerance keeps a vertex that stands on the edge of the disc, whatever the last bit of its position.
        if math.hypot(y, z) <= 0.5 * contact_diameter_um * (1 + 1e-9) and abs(x) > half_way:
            (right if x > 0 else left).append(vertex)
    if not left or not right:
        raise ValueError("no vertex lies under a contact %g um wide: use a finer mesh or a wider contact"
                         % contact_diameter_um)
    return left, right


def held_area(positions, triangles, vertices):
    """Area (um2) of the triangles whose three corners all belong to a contact: what a rigid bead keeps from straining.

    On meshes of different fineness a contact holds the same membrane where this area is the same, not where the disc
    is: the triangles cut by its edge can still strain.
    """
    flat, corners = flat_numbers(positions), flat_numbers(triangles, int)
    inside, area = set(vertices), 0.0
    for a, b, c in zip(corners[0::3], corners[1::3], corners[2::3]):
        if a in inside and b in inside and c in inside:
            p, q = ([flat[3 * end + axis] - flat[3 * a + axis] for axis in range(3)] for end in (b, c))
            area += 0.5 * math.hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
    return area


def force_path(forces_pN):
    """Rising forces from 0 through every force asked for, no step larger than 25 pN."""
    path = [0.0]
    for force in sorted(set(forces_pN) - {0.0}):
        start = path[-1]
        steps = math.ceil((force - start) / _LARGEST_FORCE_STEP_PN - 1e-9)
        path += [start + (force - start) * step / steps for step in range(1, steps)] + [force]
    return path


def _check(forces_pN, load, contact_diameter_um):
    if load not in LOADS:
        raise ValueError('load "%s" is not known; allowed: %s' % (load, ", ".join(LOADS)))
    if not (math.isfinite(contact_diameter_um) and contact_diameter_um > 0):
        raise ValueError("the contact diameter must be positive and finite, found %g um" % contact_diameter_um)
    if not forces_pN:
        raise ValueError("no force given")
    for force in forces_pN:
        if not (math.isfinite(force) and force >= 0):
            raise ValueError("forces must be finite and not negative, found %g pN" % force)


def add_beads(batch, sides):
    """Ties the vertices of each contact of contact_vertices() to a rigid bead."""
    for vertices in sides:
        if len(vertices) > 1:
            batch.add_patch(vertices, _BEAD_STIFFNESS_PN_PER_UM)


def pull_beads(batch, sides, force_pN):
    """Loads the cell with the force on each side, spread evenly over the vertices of the contact."""
    loads = [0.0] * (3 * batch.vertex_count)
    for vertices, sign in zip(sides, (-1.0, 1.0)):
        for vertex in vertices:
            loads[3 * vertex] = sign * force_pN / len(vertices)
    batch.external_force = loads


def _row(batch, model, force_pN):
    status = int(batch.status[0])
    usable = status < NOT_FINITE

    def measured(key):
        # A failed cell keeps the shape it had under the force before: that is no result of this one.
        return float(batch.measure(key)[0]) if usable else None

    volume, area = measured("volume"), measured("area")
    return {
        "force_pN": force_pN,
        "axial_um": measured("extent_x"),
        "transverse_um": measured("extent_y"),
        "volume_error": volume / model.measure("rest_volume") - 1.0 if usable else None,
        "area_error": area / model.measure("rest_area") - 1.0 if usable else None,
        "residual_pN": float(batch.residual_pN[0]),
        "iterations": int(batch.iterations[0]),
        "usable": usable,
        "status": STATUS_NAMES[status],
        "message": batch.status_text(0),
    }


def pull(material, forces_pN, level=-1, load="rigid", contact_diameter_um=CONTACT_DIAMETER_UM):
    """The rows of `stretch()`, each as soon as it is computed."""
    forces = sorted({float(force) for force in forces_pN})
    _check(forces, load, contact_diameter_um)
    chosen = material if isinstance(material, Material) else Material.named(material)
    with chosen.mesh(level) as mesh, Model(mesh, chosen) as model, Batch(model) as batch:
        sides = contact_vertices(mesh.positions, contact_diameter_um)
        batch.relax()
        if load == "rigid":
            add_beads(batch, sides)
        for force in force_path(forces):
            pull_beads(batch, sides, force)
            failed = batch.relax()
            if force in forces or failed:
                yield _row(batch, model, force)
            if failed:
                return


def stretch(material="rbc", forces_pN=(0.0, 25.0, 50.0, 100.0, 150.0, 193.0), level=-1, load="rigid",
            contact_diameter_um=CONTACT_DIAMETER_UM):
    """Pulls one cell and measures it, at rest under each force.

    `material`: a preset, a path of a TOML file, or a `Material`; the cell is its mesh at `level` (negative: the
    material's own). Returns one dict per force, rising: force_pN (on each side), axial_um (extent along the pull),
    transverse_um (extent across it, in the plane of the flat cell), volume_error and area_error (relative to the
    mesh), residual_pN, iterations, usable, status and message. The cell first relaxes without load and without beads.
    A force under which no equilibrium is found ends the experiment: its row, the last, has usable False and None for
    what would have been measured.
    """
    return list(pull(material, forces_pN, level, load, contact_diameter_um))
