// SPDX-License-Identifier: MPL-2.0
#include "output/write_cells.h"

namespace npfem::flow {

void write_cells(Communicator& communicator, const std::filesystem::path& path, double time_us, const CellArrays& a) {
  const VtkFile& file = a.file;
  const std::string body =
      "<UnstructuredGrid>\n" + time_element(time_us) + "<Piece NumberOfPoints=\"" + std::to_string(a.vertices) +
      "\" NumberOfCells=\"" + std::to_string(a.triangles) + "\">\n<Points>\n" + file.element(a.points) +
      "</Points>\n<Cells>\n" + file.element(a.connectivity) + file.element(a.offsets) + file.element(a.types) +
      "</Cells>\n<PointData>\n" + file.element(a.velocity) + file.element(a.force) + "</PointData>\n<CellData>\n" +
      file.element(a.cell_id) + file.element(a.cell_type) + file.element(a.larger) + file.element(a.smaller) +
      "</CellData>\n</Piece>\n</UnstructuredGrid>\n";
  file.write(communicator, path, "UnstructuredGrid", body);
}

}  // namespace npfem::flow
