// SPDX-License-Identifier: MPL-2.0
#include "output/view_script.h"

namespace npfem::flow {

std::string view_script() {
  return R"(# SPDX-License-Identifier: MPL-2.0
"""Shows the run in this folder in ParaView: cells coloured by type, a slice of the fluid coloured by speed.

  in ParaView     Tools > Python Shell > Run Script, and this file
  pvpython view.py picture.png     a picture of the last instant, without a window
"""
import os
import sys

from paraview import simple

FOLDER = os.path.dirname(os.path.abspath(__file__))


def reader(name):
    """Of a collection, the newest state of which is shown; None where the run has not written it."""
    path = os.path.join(FOLDER, name)
    return simple.PVDReader(FileName=path) if os.path.exists(path) else None


def show_cells(view):
    cells = reader("cells.pvd")
    if cells is None:
        return
    smooth = simple.GenerateSurfaceNormals(Input=simple.ExtractSurface(Input=cells))
    shown = simple.Show(smooth, view)
    simple.ColorBy(shown, ("CELLS", "cell_type"))
    shown.RescaleTransferFunctionToDataRange(True, False)
    colours = simple.GetColorTransferFunction("cell_type")
    colours.RGBPoints = [0, 0.75, 0.1, 0.1, 1, 0.95, 0.8, 0.3, 2, 0.3, 0.5, 0.9]


def show_fluid(view):
    fluid = reader("fluid.pvd")
    if fluid is None:
        return
    inside = simple.Threshold(Input=fluid, Scalars=["POINTS", "flags"])
    inside.LowerThreshold, inside.UpperThreshold = 0, 0
    section = simple.Slice(Input=inside)
    section.SliceType.Normal = [0, 0, 1] if flows_along_x() else [1, 0, 0]
    shown = simple.Show(section, view)
    simple.ColorBy(shown, ("POINTS", "velocity_um_per_us", "Magnitude"))
    shown.RescaleTransferFunctionToDataRange(True, False)
    shown.Opacity = 0.6
    shown.SetScalarBarVisibility(view, True)


def flows_along_x():
    """All domains but the tube, which lies along z."""
    with open(os.path.join(FOLDER, "scene.toml"), encoding="utf-8") as scene:
        return '"tube"' not in scene.read()


def main():
    view = simple.GetActiveViewOrCreate("RenderView")
    show_cells(view)
    show_fluid(view)
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.GetAnimationScene().GoToLast()
    view.ViewSize = [1200, 900]
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    simple.ResetCamera(view)
    view.GetActiveCamera().Elevation(15)
    simple.Render(view)
    if len(sys.argv) > 1:
        simple.SaveScreenshot(sys.argv[1], view)


main()
)";
}

}  // namespace npfem::flow
