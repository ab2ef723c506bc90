# SPDX-License-Identifier: MPL-2.0
"""Batches: cells of one model on one back end; the state that moves. um, us, fg, pN."""
import ctypes

from ._arrays import Output, read_in
from ._handle import Parameterised
from ._library import call, call_for_text

# How the last step of a cell ended, as in npfem.h: from NOT_FINITE on the cell has failed and kept the state it had.
CONVERGED, ITERATION_CAP, NOT_FINITE, NO_DESCENT, NOT_CONVERGED = range(5)
STATUS_NAMES = ("converged", "iteration cap", "not finite", "no descent", "not converged")

# Fields per vertex: components.
FIELDS = {
    "position": 3,
    "velocity": 3,
    "external_force": 3,
    "contact_stiffness": 1,
    "ambient_velocity": 3,
    "ambient_mass": 1,
    "held_force": 3,
    "lag_velocity": 3,
    "lag_acceleration": 3,
    "elastic_force": 3,
}


def _field(name, doc):
    return property(lambda batch: batch.get(name), lambda batch, values: batch.set(name, values),
                    doc=doc + " A copy: assign it back to change it.")


class Batch(Parameterised):
    """Cells of one model: Batch(model, cells=1, backend="cpu").

    Options by key, as for a material: `batch["time_step"] = 0.5`. Fields as attributes, of shape (cells, vertices, 3)
    or (cells, vertices); get() and set() take a range of cells. Per-cell results (`status`, measure()) have one entry
    per cell. A cell that fails is data: step() and relax() return how many did, `status` says which.
    """

    position = _field("position", "Vertex positions, um.")
    velocity = _field("velocity", "Vertex velocities, um/us; assigning them sets the lag fields to zero.")
    external_force = _field("external_force", "Loads on the vertices, pN; kept until set again.")
    contact_stiffness = _field("contact_stiffness", "Stiffness of the contacts of each vertex, pN/um.")
    ambient_velocity = _field("ambient_velocity", "Velocity of the surrounding fluid at each vertex, um/us.")
    ambient_mass = _field("ambient_mass", "Mass of fluid that moves with each vertex, fg; 0 without a fluid.")
    held_force = _field("held_force", "Force that each vertex exerts on the fluid, pN.")
    lag_velocity = _field("lag_velocity", "Of BDF2 (option integrator = 1): (x_n - x_{n-1})/time_step - v_n, um/us.")
    lag_acceleration = _field("lag_acceleration", "Of BDF2: (v_n - v_{n-1})/time_step, um/us2.")
    elastic_force = property(lambda batch: batch.get("elastic_force"),
                             doc="-dE/dx at the positions of the last evaluate(), pN.")

    def __init__(self, model, cells=1, backend="cpu"):
        super().__init__(call("npfem_batch_create", model.handle, backend.encode(), cells))
        self.vertex_count = model.vertex_count
        self.triangles = model.triangles
        self.energies = model.energies

    @property
    def cell_count(self):
        return call("npfem_batch_cell_count", self.handle)

    def add(self, cells=1):
        """Appends cells in the initial shape; returns the index of the first new one."""
        return call("npfem_batch_add", self.handle, cells)

    def remove(self, cell):
        """Removes one cell; the cells after it move down by one."""
        call("npfem_batch_remove", self.handle, cell)

    def _count(self, first, count):
        return self.cell_count - first if count is None else count

    def get(self, field, first=0, count=None, single=False):
        """A field of `count` cells from `first` (all by default); in single precision where `single`."""
        count = self._count(first, count)
        components = FIELDS.get(field, 1)
        shape = (count, self.vertex_count) + ((components,) if components > 1 else ())
        out = Output("f" if single else "d", *shape)
        call("npfem_batch_get_f32" if single else "npfem_batch_get", self.handle, field.encode(), first, count,
             out.pointer, out.length)
        return out.values

    def set(self, field, values, first=0, count=None):
        """Writes a field of `count` cells from `first` (all by default); `values` nested or flat, all of them."""
        pointer, length = read_in(values, "d")
        call("npfem_batch_set", self.handle, field.encode(), first, self._count(first, count), pointer, length)

    def step(self, steps=1):
        """Advances every cell by time steps of the option "time_step"; returns the number of failed cells."""
        return call("npfem_batch_step", self.handle, steps)

    def step_for_ms(self, milliseconds):
        """Steps until about that much wall time has passed, at least once; returns the steps done."""
        done = ctypes.c_int32()
        call("npfem_batch_step_for_ms", self.handle, milliseconds, ctypes.byref(done))
        return done.value

    def relax(self):
        """Static equilibrium under the external forces; velocities become 0. Returns the number of failed cells."""
        return call("npfem_batch_relax", self.handle)

    def evaluate(self):
        """Energies and elastic forces at the present positions, no step."""
        call("npfem_batch_evaluate", self.handle)

    def add_patch(self, vertices, stiffness_pN_per_um):
        """Ties vertices into one translating body, in every cell, as a bead adhered to a membrane does."""
        pointer, length = read_in(vertices, "i")
        return call("npfem_batch_add_patch", self.handle, pointer, length, stiffness_pN_per_um)

    def clear_patches(self):
        """Removes all patches."""
        call("npfem_batch_clear_patches", self.handle)

    def _per_cell(self, function, code, *key):
        out = Output(code, self.cell_count)
        call(function, self.handle, *(key + (0, self.cell_count, out.pointer, out.length)))
        return out.values

    @property
    def status(self):
        """How the last step of each cell ended: CONVERGED, ITERATION_CAP, or, failed, NOT_FINITE, NO_DESCENT,
        NOT_CONVERGED."""
        return self._per_cell("npfem_batch_get_status", "i")

    @property
    def iterations(self):
        """Iterations used by each cell in the last step."""
        return self._per_cell("npfem_batch_get_iterations", "i")

    @property
    def residual_pN(self):
        """Largest residual force of each cell after the last step, pN."""
        return self._per_cell("npfem_batch_get_residual", "d")

    def status_text(self, cell):
        """How the last step of one cell ended, in words."""
        return call_for_text("npfem_batch_status_text", self.handle, cell)

    def measure(self, key):
        """One number per cell: "volume" um3, "area" um2, "extent_x" "extent_y" "extent_z" um, "centre_x" "centre_y"
        "centre_z" um, "energy" pN um, "energy:<name>" pN um for one of `energies`; of the last step
        "evaluations", "hessian_iterations" and "flops"."""
        return self._per_cell("npfem_batch_measure", "d", key.encode())

    @property
    def state_hash(self):
        """64-bit hash of each cell's state; equal bits, equal hash."""
        return self._per_cell("npfem_batch_state_hash", "q")

    def pack(self, cell):
        """One cell's whole state as numbers, bit for bit."""
        out = Output("d", call("npfem_batch_pack_length", self.handle))
        call("npfem_batch_pack", self.handle, cell, out.pointer, out.length)
        return out.values

    def unpack(self, cell, state):
        """Overwrites one cell's state with a packed one."""
        pointer, length = read_in(state, "d")
        call("npfem_batch_unpack", self.handle, cell, pointer, length)

    def request_stop(self):
        """Makes a running step(), step_for_ms() or relax() return soon; may be called from another thread."""
        call("npfem_request_stop", self.handle)
