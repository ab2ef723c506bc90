# SPDX-License-Identifier: MPL-2.0
"""npfem: deformable blood cells by the nodal projective finite element method.

    import npfem

    with npfem.Material.preset("rbc") as material, material.mesh(level=3) as mesh, \\
            npfem.Model(mesh, material) as model, npfem.Batch(model, cells=2) as batch:
        batch.relax()
        print(batch.measure("volume"))

    for row in npfem.stretch("rbc", forces_pN=[0, 50, 100]):
        print(row["force_pN"], row["axial_um"], row["transverse_um"])

Units everywhere: um, us, fg; hence force pN, energy pN um = 1e-18 J, stress Pa, surface modulus uN/m. Pure ctypes over
the C interface of npfem.h; numpy is used where it is present and not needed.
"""
from ._handle import Parameter
from ._library import Error, build_info, library_path, version
from .batch import CONVERGED, ITERATION_CAP, NO_DESCENT, NOT_CONVERGED, NOT_FINITE, Batch
from .material import Material
from .mesh import Mesh
from .meshio_glue import from_meshio, to_meshio
from .model import Model
from .tweezers import stretch

__all__ = [
    "Batch", "Error", "Material", "Mesh", "Model", "Parameter",
    "CONVERGED", "ITERATION_CAP", "NOT_FINITE", "NO_DESCENT", "NOT_CONVERGED",
    "build_info", "from_meshio", "library_path", "stretch", "to_meshio", "version",
]
