// SPDX-License-Identifier: MPL-2.0
#include "output/collection.h"

#include "file.h"
#include "quantity.h"

namespace npfem::flow {

void Collection::add(double time_us, const std::string& file) {
  entries_.push_back({time_us, file});
  std::string xml =
      "<?xml version=\"1.0\"?>\n<!-- timestep: us -->\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const Entry& entry : entries_) {
    xml +=
        "<DataSet timestep=\"" + text::format_number(entry.time_us) + "\" part=\"0\" file=\"" + entry.file + "\"/>\n";
  }
  text::write_file(path_.string(), xml + "</Collection>\n</VTKFile>\n");
}

}  // namespace npfem::flow
