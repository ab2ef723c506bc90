// SPDX-License-Identifier: MPL-2.0
#include "scene/scene_keys.h"

namespace npfem::flow {
std::vector<SceneSection> scene_sections() {
  using namespace keys;  // the names below are the keys of the file
  return {
      {"", "Top level", "", {schema_version, title}},
      {"domain", "[domain]", "The space the blood flows in.", {kind, size, diameter, length, dx}},
      {"fluid", "[fluid]", "", {density, kinematic_viscosity, dynamic_viscosity, time_step, tau, magic_parameter}},
      {"flow",
       "[flow]",
       "What drives it. A shear box needs `shear_rate`; tube and plates take one of the others, or none and stay at "
       "rest.",
       {shear_rate, mean_velocity, centre_velocity, pressure_gradient, start}},
      {"cells",
       "[[cells]]",
       "One table per type of cell. How many there are: exactly one of `haematocrit`, `count`, `ratio` with "
       "`ratio_to`, or a list of positions.",
       {name, material, level, mesh, haematocrit, count, ratio, ratio_to}},
      {"cells.positions",
       "[[cells.positions]]",
       "One table per cell, in place of a number of cells.",
       {centre, rotate}},
      {"placement", "[placement]", "Of cells that have no list of positions.", {seed, gap}},
      {"coupling", "[coupling]", "Between fluid and cells.", {scheme, kernel, cell_every}},
      {"repulsion",
       "[repulsion]",
       "Keeps surfaces apart where the flow presses them together.",
       {range, strength, wall_range, wall_strength}},
      {"solver",
       "[solver]",
       "Of the cells.",
       {tolerance, residual_bound, max_iterations, newton_iterations, precision}},
      {"run", "[run]", "", {steps, time}},
      {"output",
       "[output]",
       "",
       {cells, cells_every, fluid, fluid_every, table_every, into_box, format, checkpoint_every, checkpoint_keep}},
  };
}

std::string scene_reference() {
  std::string page =
      "# Scene files\n\nA scene is a TOML file. Quantities carry their unit (`\"0.5 um\"`, `\"100 1/s\"`, "
      "`\"1.2 mPa s\"`); a bare number stands only where there is no dimension. An unknown key is an error. Any value "
      "can be set from the command line: `--set run.steps=100`, `--set cells[0].count=5`.\n\nThis page is printed by "
      "`npfem keys` from the table that the reader itself uses.\n";
  for (const SceneSection& section : scene_sections()) {
    page += "\n## " + std::string(section.title) + "\n\n";
    if (*section.about) page += std::string(section.about) + "\n\n";
    page += text::markdown_table(section.keys);
  }
  return page;
}

}  // namespace npfem::flow
