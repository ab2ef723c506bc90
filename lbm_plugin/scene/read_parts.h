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

Domain read_domain(const text::Table& table);
/// Density, viscosity and time step; needs the domain.
void read_fluid(const text::Table& table, Setup& setup);
/// What drives the fluid; needs domain and fluid.
void read_flow(const text::Table& table, Scene& scene);
/// One [[cells]] table; `before` are those that stand before it, `folder` is the scene's.
CellsRequest read_cells(const text::Table& table, const std::vector<CellsRequest>& before,
                        const std::filesystem::path& folder);

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
