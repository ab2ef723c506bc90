// SPDX-License-Identifier: MPL-2.0
// Keys of a scene file: the space the blood flows in, its walls and openings.
#pragma once

#include "key.h"

namespace npfem::flow::keys {

using text::Dimension;
using text::Key;
using text::Kind;
using text::optional;
using text::Range;

// [domain]
inline constexpr Key kind{
    .name = "kind",
    .kind = Kind::choice,
    .choices = "tube shear_box plates periodic_box vessel",
    .doc =
        "`tube`: round, along z, periodic in z. `shear_box`: plates at y = 0 and y = size that slide past each "
        "other, periodic in x and z. `plates`: the same at rest. `periodic_box`: no walls. `vessel`: the inside of "
        "the STL surface `surface`."};
inline constexpr Key size{.name = "size",
                          .kind = Kind::vector3,
                          .dimension = Dimension::length(),
                          .range = Range::positive,
                          .fallback = optional,
                          .doc = "Lengths along x, y, z; all kinds but the tube. Whole multiples of `dx`."};
inline constexpr Key diameter{.name = "diameter",
                              .dimension = Dimension::length(),
                              .range = Range::positive,
                              .fallback = optional,
                              .doc = "Of the tube. A whole multiple of `dx`."};
inline constexpr Key length{.name = "length",
                            .dimension = Dimension::length(),
                            .range = Range::positive,
                            .fallback = optional,
                            .doc = "Of the tube. A whole multiple of `dx`."};
inline constexpr Key dx{
    .name = "dx", .dimension = Dimension::length(), .range = Range::positive, .doc = "Distance of the lattice nodes."};

inline constexpr Key surface{
    .name = "surface",
    .kind = Kind::text,
    .fallback = optional,
    .doc =
        "Path of an STL file, from the scene. Of a vessel: its wall, inside the box from (0, 0, 0) to `size`, closed, "
        "or ending on faces of the box that are periodic or openings. Of a solid: its closed surface."};
inline constexpr Key surface_unit{.name = "surface_unit",
                                  .dimension = Dimension::length(),
                                  .range = Range::positive,
                                  .fallback = "1 um",
                                  .doc = "Length that 1 in the STL file stands for."};
inline constexpr Key surface_shift{.name = "surface_shift",
                                   .kind = Kind::vector3,
                                   .dimension = Dimension::length(),
                                   .fallback = "[\"0 um\", \"0 um\", \"0 um\"]",
                                   .doc = "Added to the positions of the STL file."};
inline constexpr Key periodic{.name = "periodic",
                              .kind = Kind::choice,
                              .choices = "none x y z xy xz yz xyz",
                              .fallback = optional,
                              .doc = "Periodic directions of a vessel. Default: `none`."};

// [[domain.solids]]
inline constexpr Key shape{
    .name = "shape",
    .kind = Kind::choice,
    .choices = "box sphere slit constriction surface",
    .doc =
        "`box` (`centre`, `size`), `sphere` (`centre`, `diameter`), `surface` (an STL body): obstacles. `slit`: a "
        "wall across the flow with a rectangular opening in its middle. `constriction`: a tube or plates that narrow "
        "smoothly, by a whole wave of a cosine."};
inline constexpr Key solid_centre{.name = "centre",
                                  .kind = Kind::vector3,
                                  .dimension = Dimension::length(),
                                  .fallback = optional,
                                  .doc = "Of a box or sphere."};
inline constexpr Key solid_size{.name = "size",
                                .kind = Kind::vector3,
                                .dimension = Dimension::length(),
                                .range = Range::positive,
                                .fallback = optional,
                                .doc = "Of a box."};
inline constexpr Key solid_diameter{.name = "diameter",
                                    .dimension = Dimension::length(),
                                    .range = Range::positive,
                                    .fallback = optional,
                                    .doc = "Of a sphere."};
inline constexpr Key at{.name = "at",
                        .dimension = Dimension::length(),
                        .fallback = optional,
                        .doc = "Where along the flow a slit or constriction has its middle. Default: half-way."};
inline constexpr Key solid_length{.name = "length",
                                  .dimension = Dimension::length(),
                                  .range = Range::positive,
                                  .fallback = optional,
                                  .doc = "Of the passage of a slit, or of the whole constriction, along the flow."};
inline constexpr Key width{.name = "width",
                           .dimension = Dimension::length(),
                           .range = Range::positive,
                           .fallback = optional,
                           .doc =
                               "Of a slit, along y; of the throat of a constriction: its diameter in a tube, else the "
                               "distance of the walls."};
inline constexpr Key depth{.name = "depth",
                           .dimension = Dimension::length(),
                           .range = Range::positive,
                           .fallback = optional,
                           .doc = "Of a slit, across flow and width. Default: through the whole box."};

// [[openings]]
inline constexpr Key face{.name = "face",
                          .kind = Kind::choice,
                          .choices = "x- x+ y- y+ z- z+",
                          .doc = "Of the box: at its low (-) or high (+) end."};
inline constexpr Key opening_kind{
    .name = "kind", .kind = Kind::choice, .choices = "velocity pressure", .doc = "What is given there."};
inline constexpr Key velocity{.name = "velocity",
                              .dimension = Dimension::velocity(),
                              .fallback = optional,
                              .doc = "Mean over the fluid nodes of the face, into the box; negative: out of it."};
inline constexpr Key profile{
    .name = "profile",
    .kind = Kind::choice,
    .choices = "developed plug",
    .fallback = optional,
    .doc =
        "Of the velocity. `developed` (default): of the steady flow along a channel of the section's shape, parabolic "
        "in a tube and between plates. `plug`: the same everywhere."};
inline constexpr Key pressure{.name = "pressure",
                              .dimension = Dimension::stress(),
                              .fallback = optional,
                              .doc = "Above that of the fluid at rest. Default: 0 Pa."};

}  // namespace npfem::flow::keys
