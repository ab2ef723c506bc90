// SPDX-License-Identifier: MPL-2.0
#include "output/departure_table.h"

#include <string>

#include "quantity.h"

namespace npfem::flow {

DepartureTable::DepartureTable(Communicator& communicator, std::filesystem::path path)
    : file_(communicator, std::move(path),
            "step,time_us,cell_id,type,opening,centre_x_um,centre_y_um,centre_z_um,volume_um3\n", {}) {}

void DepartureTable::append(const Simulation& simulation) {
  const std::vector<Departure>& all = simulation.departures();
  if (written_ == all.size()) return;
  const Setup& setup = simulation.setup();
  std::string lines;
  for (; written_ < all.size(); ++written_) {
    const Departure& d = all[written_];
    lines += std::to_string(d.step) + ',' + text::format_number(static_cast<double>(d.step) * setup.time_step) + ',' +
             std::to_string(d.id) + ',' + setup.types[static_cast<std::size_t>(d.type)].name + ',' + name_of(d.face);
    for (const double x : d.centre) lines += ',' + text::format_number(x);
    lines += ',' + text::format_number(d.volume) + '\n';
  }
  file_.append(lines);
}

}  // namespace npfem::flow
