// SPDX-License-Identifier: MPL-2.0
#include "output/write_fluid.h"

#include "quantity.h"

namespace npfem::flow {
namespace {

std::string three(double value) {
  const std::string number = text::format_number(value);
  return number + ' ' + number + ' ' + number;
}

}  // namespace

void write_fluid(Communicator& communicator, const std::filesystem::path& path, double time_us, const FluidArrays& a) {
  const VtkFile& file = a.file;
  std::string extent;
  for (const int n : a.nodes) extent += (extent.empty() ? "0 " : " 0 ") + std::to_string(n - 1);
  const std::string body = "<ImageData WholeExtent=\"" + extent + "\" Origin=\"" + three(0.5 * a.dx) + "\" Spacing=\"" +
                           three(a.dx) + "\">\n" + time_element(time_us) + "<Piece Extent=\"" + extent +
                           "\">\n<PointData>\n" + file.element(a.velocity) + file.element(a.pressure) +
                           file.element(a.flags) + "</PointData>\n</Piece>\n</ImageData>\n";
  file.write(communicator, path, "ImageData", body);
}

}  // namespace npfem::flow
