// SPDX-License-Identifier: MPL-2.0
#include "scene/scene_keys.h"

namespace npfem::flow {
std::vector<SceneSection> scene_sections() {
  using namespace keys;  // the names below are the keys of the file
  return {
      {"", "Top level", "", {schema_version, title, quality}},
      {"domain",
       "[domain]",
       "The space the blood flows in: a box of lattice nodes, and the walls in it.",
       {kind, size, diameter, length, dx, surface, surface_unit, surface_shift, periodic}},
      {"domain.solids",
       "[[domain.solids]]",
       "One table per further wall: obstacles and narrow places. The nearest wall counts.",
       {shape, solid_centre, solid_size, solid_diameter, at, solid_length, width, depth, surface, surface_unit,
        surface_shift}},
      {"openings",
       "[[openings]]",
       "One table per face of the box that blood flows in or out through, in place of a force that drives it. A "
       "direction with an opening is not periodic. Where there is an opening of given velocity, one of given pressure "
       "is needed too.",
       {face, opening_kind, velocity, profile, pressure}},
      {"fluid",
       "[fluid]",
       "",
       {density, kinematic_viscosity, dynamic_viscosity, time_step, tau, collision, magic_parameter, fluid_precision}},
      {"flow",
       "[flow]",
       "What drives it. A shear box needs `shear_rate`; tube and plates take one of the others, a vessel "
       "`pressure_gradient`, or none and stay at rest, or flow by openings.",
       {shear_rate, mean_velocity, centre_velocity, pressure_gradient, axis, start}},
      {"flow.waveform",
       "[flow.waveform]",
       "A factor that makes the driving pulsate: the body force, the speed of plates, the velocity at openings, or, "
       "where none is given, their pressure.",
       {period, mean, amplitude, phase, times, factors}},
      {"cells",
       "[[cells]]",
       "One table per type of cell. How many there are: exactly one of `haematocrit`, `count`, `ratio` with "
       "`ratio_to`, or a list of positions.",
       {name, material, level, mesh, body_folder, body_density, volume_weight, interior_viscosity_ratio, pull,
        pull_contact, haematocrit, count, ratio, ratio_to}},
      {"cells.positions",
       "[[cells.positions]]",
       "One table per cell, in place of a number of cells.",
       {centre, rotate}},
      {"placement", "[placement]", "Of cells that have no list of positions.", {seed, gap, file}},
      {"coupling", "[coupling]", "Between fluid and cells.", {scheme, kernel, inset, cell_every, forcing_iterations}},
      {"lineage",
       "[lineage]",
       "With the scheme `lineage` only: the cells are solved as Palabos-npFEM does, with its settings.",
       {lineage::alpha, lineage::beta, lineage::history, lineage::max_iterations, lineage::max_line_search,
        lineage::attempts, lineage::window, lineage::tolerance, lineage::armijo, lineage::curvature}},
      {"contact",
       "[contact]",
       "Keeps surfaces apart where they come nearer than the lattice resolves.",
       {range, strength, wall_range, wall_strength, attraction, attraction_width}},
      {"contact.pairs",
       "[[contact.pairs]]",
       "One table per pair of types, or type and wall, for which `[contact]` does not hold.",
       {first, second, pair_range, pair_strength, pair_attraction, pair_attraction_width}},
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
