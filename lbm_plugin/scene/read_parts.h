// SPDX-License-Identifier: MPL-2.0
// The parts of a scene file, each read by its own function; shared helpers.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "toml_reader.h"

namespace npfem::flow {

/// The box; its openings are read next, and then, with all that known, the walls in it.
Domain read_domain(const text::Table& table);
/// Axis of the flow and openings of the box.
void read_openings(const text::Table& root, Domain& domain);
/// The wall of a vessel and further solids; `folder` is the scene's.
void read_walls(const text::Table& table, Domain& domain, const std::filesystem::path& folder);
/// One [[domain.solids]] table.
Solid read_solid(const text::Table& table, const Domain& domain, const std::filesystem::path& folder);
/// A wall from an STL file.
SurfaceSolid read_surface(const text::Table& table, const Domain& domain, const std::filesystem::path& folder,
                          bool fluid_inside);
/// Settings of Palabos-npFEM.
/// Options of the cell solver.
std::vector<std::pair<std::string, double>> read_lineage(const text::Table& table);
/// The factor in time; needs the kind of driving.
Signal read_waveform(const text::Table& table);
/// Density, viscosity and time step; needs the domain.
void read_fluid(const text::Table& table, Setup& setup);
/// What drives the fluid, and how; needs domain and fluid.
void read_flow(const text::Table& root, Scene& scene);
/// The cells file; `folder` is the scene's.
void read_placement(const text::Table& table, Scene& scene, const std::filesystem::path& folder);
/// Seed and gap; needs the cells.
void read_random_placement(const text::Table& table, Scene& scene);
/// One [[cells]] table, of which `scene` has those that stand before it; needs the placement.
CellsRequest read_cells(const text::Table& table, const Scene& scene, const std::filesystem::path& folder);
/// The cells of the cells file, where there is one, to the types that the scene lists.
void match_stored_cells(const text::Table& placement, Scene& scene);

/// What acts between surfaces that touch; needs domain and cells.
void read_contact(const text::Table& table, Scene& scene);

/// A path of a scene file, as seen from the working directory.
std::string path_from(const std::string& path, const std::filesystem::path& folder);

/// The one key of `keys` that is given; nullptr where none is. Two are an error.
const text::Key* one_of(const text::Table& table, std::initializer_list<const text::Key*> keys);
const text::Key& exactly_one_of(const text::Table& table, std::initializer_list<const text::Key*> keys);
/// Fails with `reason` at the first of `keys` that is given.
void refuse(const text::Table& table, std::initializer_list<const text::Key*> keys, const std::string& reason);
/// An integer from least to largest.
int within(const text::Table& table, const text::Key& key, int least, int largest);

/// To three significant digits, for messages.
double rounded(double value);

}  // namespace npfem::flow
