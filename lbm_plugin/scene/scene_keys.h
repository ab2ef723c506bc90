// SPDX-License-Identifier: MPL-2.0
// Every key of a scene file, described once: the reader fetches values through these, and the reference page is printed
// from them.
#pragma once

#include <string>
#include <vector>

#include "key.h"
#include "scene/domain_keys.h"
#include "scene/lineage_keys.h"

namespace npfem::flow::keys {

using text::Dimension;
using text::Key;
using text::Kind;
using text::optional;
using text::Range;

// top level
inline constexpr Key schema_version{
    .name = "schema_version", .kind = Kind::integer, .range = Range::positive, .doc = "Version of this format: 1."};
inline constexpr Key title{.name = "title",
                           .kind = Kind::text,
                           .fallback = "untitled",
                           .doc = "One line about the scene, repeated in the summary."};
inline constexpr Key quality{
    .name = "quality",
    .kind = Kind::choice,
    .choices = "fast balanced accurate",
    .fallback = optional,
    .doc =
        "Values for `domain.dx`, `fluid.tau`, `fluid.precision`, `coupling.kernel` and `coupling.cell_every` where the "
        "scene leaves them out, for red cells of level 3, with `accurate` of level 4; their errors: "
        "docs/speed_and_error.md. Default: none, each key has its own."};

// [fluid]
inline constexpr Key density{.name = "density",
                             .dimension = Dimension::density(),
                             .range = Range::positive,
                             .fallback = "1025 kg/m3",
                             .doc = "Of the fluid, inside and outside of the cells."};
inline constexpr Key kinematic_viscosity{.name = "kinematic_viscosity",
                                         .dimension = Dimension::kinematic_viscosity(),
                                         .range = Range::positive,
                                         .fallback = optional,
                                         .doc = "Either this or `dynamic_viscosity`."};
inline constexpr Key dynamic_viscosity{.name = "dynamic_viscosity",
                                       .dimension = Dimension::dynamic_viscosity(),
                                       .range = Range::positive,
                                       .fallback = optional,
                                       .doc = "Either this or `kinematic_viscosity`."};
inline constexpr Key time_step{.name = "time_step",
                               .dimension = Dimension::time(),
                               .range = Range::positive,
                               .fallback = optional,
                               .doc = "Of the fluid. Either this or `tau`."};
inline constexpr Key tau{
    .name = "tau",
    .range = Range::positive,
    .fallback = optional,
    .doc = "Relaxation time in time steps, above 0.5; sets the time step. Either this or `time_step`."};
inline constexpr Key magic_parameter{.name = "magic_parameter",
                                     .range = Range::positive,
                                     .fallback = "0.1875",
                                     .doc = "Of the collision `trt` only; 3/16 puts flat walls exactly half-way."};

inline constexpr Key collision{
    .name = "collision",
    .kind = Kind::choice,
    .choices = "trt bgk regularised",
    .fallback = "trt",
    .doc =
        "`trt`: two relaxation times, walls in place at any relaxation time. `bgk`: one. `regularised`: one, of "
        "populations rebuilt from their moments."};
inline constexpr Key fluid_precision{.name = "precision",
                                     .kind = Kind::choice,
                                     .choices = "double float",
                                     .fallback = "double",
                                     .doc = "Numbers of the fluid."};

// [flow]
inline constexpr Key shear_rate{.name = "shear_rate",
                                .dimension = Dimension::rate(),
                                .range = Range::non_negative,
                                .fallback = optional,
                                .doc = "Of the shear box: relative speed of the plates over their distance."};
inline constexpr Key mean_velocity{.name = "mean_velocity",
                                   .dimension = Dimension::velocity(),
                                   .range = Range::non_negative,
                                   .fallback = optional,
                                   .doc =
                                       "Tube and plates: sets the body force that would drive the fluid without cells "
                                       "and without solids at this mean velocity, along z in a tube and along x "
                                       "between plates. With solids in the channel the flow is slower; the program "
                                       "then warns and estimates by how much."};
inline constexpr Key centre_velocity{
    .name = "centre_velocity",
    .dimension = Dimension::velocity(),
    .range = Range::non_negative,
    .fallback = optional,
    .doc = "The same, by the velocity in the middle; Palabos-npFEM does not count solids either."};
inline constexpr Key pressure_gradient{.name = "pressure_gradient",
                                       .dimension = Dimension::force_density(),
                                       .range = Range::non_negative,
                                       .fallback = optional,
                                       .doc = "Pressure drop per length: the body force itself, whatever the walls."};
inline constexpr Key axis{.name = "axis",
                          .kind = Kind::choice,
                          .choices = "x y z",
                          .fallback = optional,
                          .doc = "Direction of the flow. Default: x; in a tube always z."};
inline constexpr Key start{.name = "start",
                           .kind = Kind::choice,
                           .choices = "rest developed",
                           .fallback = "rest",
                           .doc = "The fluid starts at `rest`, or in the steady flow without cells (`developed`)."};

// [flow.waveform]
inline constexpr Key period{
    .name = "period",
    .dimension = Dimension::time(),
    .range = Range::positive,
    .doc =
        "Of the beat; at least 20 steps of the cells (`time_step` x `cell_every`), between which the driving holds."};
inline constexpr Key mean{.name = "mean", .fallback = optional, .doc = "Of the factor. Default: 1."};
inline constexpr Key amplitude{
    .name = "amplitude", .fallback = optional, .doc = "Of a factor mean + amplitude sin(2 pi t/period + phase)."};
inline constexpr Key phase{
    .name = "phase", .dimension = Dimension::angle(), .fallback = optional, .doc = "Default: 0 deg."};
inline constexpr Key times{.name = "times",
                           .kind = Kind::quantities,
                           .dimension = Dimension::time(),
                           .range = Range::non_negative,
                           .fallback = optional,
                           .doc = "Ascending, below `period`; instead of `amplitude`."};
inline constexpr Key factors{.name = "factors",
                             .kind = Kind::quantities,
                             .fallback = optional,
                             .doc = "At those times, joined by straight lines."};

// [[cells]]
inline constexpr Key name{.name = "name", .kind = Kind::text, .doc = "Of this type of cell."};
inline constexpr Key material{
    .name = "material",
    .kind = Kind::text,
    .fallback = optional,
    .doc = "A preset (`rbc`, `platelet`, ...) or the path of a material file, from the scene."};
inline constexpr Key level{
    .name = "level",
    .kind = Kind::integer,
    .range = Range::non_negative,
    .fallback = optional,
    .doc = "Refinement of the mesh, up to 5: 2, 3, 4 give 66, 258, 1026 vertices. Default: the material's."};
inline constexpr Key mesh{
    .name = "mesh",
    .kind = Kind::text,
    .fallback = optional,
    .doc = "Path of a mesh file (.off .obj .stl .ply, um), from the scene. Default: the material's shape."};
inline constexpr Key body_folder{
    .name = "body_folder",
    .kind = Kind::text,
    .fallback = optional,
    .doc =
        "Path of a body folder of Palabos-npFEM (points.csv, ...), from the scene: mesh and energies in one, instead "
        "of `material`."};
inline constexpr Key body_density{.name = "body_density",
                                  .dimension = Dimension::density(),
                                  .range = Range::non_negative,
                                  .fallback = optional,
                                  .doc = "With `body_folder`: of the body beyond the fluid it holds. Default: 0."};
inline constexpr Key volume_weight{.name = "volume_weight",
                                   .dimension = Dimension::surface_modulus(),
                                   .range = Range::non_negative,
                                   .fallback = optional,
                                   .doc = "With `body_folder`: of its term that keeps the volume. Default: 250 uN/m."};
inline constexpr Key interior_viscosity_ratio{
    .name = "interior_viscosity_ratio",
    .range = Range::positive,
    .fallback = "1",
    .doc = "Viscosity of the fluid inside over that outside. All types for which it is not 1 have the same."};
inline constexpr Key pull{.name = "pull",
                          .dimension = Dimension::force(),
                          .range = Range::non_negative,
                          .fallback = "0 pN",
                          .doc =
                              "Two opposite forces that pull each cell apart, as optical tweezers do, along the x "
                              "axis of the cell as it starts."};
inline constexpr Key pull_contact{.name = "pull_contact",
                                  .dimension = Dimension::length(),
                                  .range = Range::positive,
                                  .fallback = "2 um",
                                  .doc = "Width of the two discs whose vertices share that force."};
inline constexpr Key haematocrit{
    .name = "haematocrit",
    .range = Range::fraction,
    .fallback = optional,
    .doc = "Volume of these cells over the volume open to the fluid; met within half a cell."};
inline constexpr Key count{.name = "count",
                           .kind = Kind::integer,
                           .range = Range::non_negative,
                           .fallback = optional,
                           .doc = "Number of these cells, placed at random."};
inline constexpr Key ratio{.name = "ratio",
                           .range = Range::non_negative,
                           .fallback = optional,
                           .doc = "Number of these cells per cell of the type `ratio_to`, placed at random."};
inline constexpr Key ratio_to{
    .name = "ratio_to", .kind = Kind::text, .fallback = optional, .doc = "Name of a type listed before."};

// [[cells.positions]]
inline constexpr Key centre{.name = "centre",
                            .kind = Kind::vector3,
                            .dimension = Dimension::length(),
                            .doc = "Where the middle of the cell starts."};
inline constexpr Key rotate{
    .name = "rotate",
    .kind = Kind::vector3,
    .dimension = Dimension::angle(),
    .fallback = "[\"0 deg\", \"0 deg\", \"0 deg\"]",
    .doc = "Turns about the fixed axes x, then y, then z; a red cell or platelet has its axis along z before."};

// [placement]
inline constexpr Key seed{.name = "seed",
                          .kind = Kind::integer,
                          .range = Range::non_negative,
                          .fallback = "1",
                          .doc = "Of the random placement; refused where `positions` lists every cell."};
inline constexpr Key gap{.name = "gap",
                         .dimension = Dimension::length(),
                         .range = Range::non_negative,
                         .fallback = "0.3 um",
                         .doc = "Least distance between the surfaces of cells placed at random, and to the walls."};
inline constexpr Key file{.name = "file",
                          .kind = Kind::text,
                          .fallback = optional,
                          .doc =
                              "Path of a cells file, from the scene: every cell starts as it stands there, deformed. "
                              "The numbers of cells in `[[cells]]` are then not used and may be left out."};

// [coupling]
inline constexpr Key scheme{.name = "scheme",
                            .kind = Kind::choice,
                            .choices = "implicit peskin lineage",
                            .fallback = "implicit",
                            .doc =
                                "`implicit`: stable for any stiffness of the membrane. `peskin`: explicit, the "
                                "yardstick while it is stable; knows no viscosity of the membrane. "
                                "`lineage`: as in Palabos-npFEM, for comparison."};
inline constexpr Key kernel{.name = "kernel",
                            .kind = Kind::integer,
                            .range = Range::positive,
                            .fallback = "4",
                            .doc = "Width of the immersed-boundary kernel in nodes: 2, 3 or 4."};
inline constexpr Key inset{.name = "inset",
                           .range = Range::non_negative,
                           .fallback = optional,
                           .doc =
                               "Depth in nodes, up to 1, at which fluid and cells meet under the surface of a cell, so "
                               "that it drags like one of its own size. Default: what the kernel adds to the radius of "
                               "a sphere, 0.277, 0.365 or 0.485 for 2, 3 or 4 points; with `lineage` none."};
inline constexpr Key forcing_iterations{
    .name = "forcing_iterations",
    .kind = Kind::integer,
    .range = Range::positive,
    .fallback = "1",
    .doc = "With `lineage`: iterations of the force that makes the fluid follow the cells, in every fluid step."};
inline constexpr Key cell_every{.name = "cell_every",
                                .kind = Kind::integer,
                                .range = Range::positive,
                                .fallback = "1",
                                .doc = "Fluid steps per step of the cell solver."};

// [contact]
inline constexpr Key range{
    .name = "range",
    .dimension = Dimension::length(),
    .range = Range::non_negative,
    .fallback = optional,
    .doc = "Distance between the surfaces of two cells below which they repel; 0: never. Default: `dx`."};
inline constexpr Key strength{.name = "strength",
                              .dimension = Dimension::stress(),
                              .range = Range::non_negative,
                              .fallback = optional,
                              .doc =
                                  "Pressure between two surfaces at touch, falling as (1 - distance/range)^2. "
                                  "Default: 50 Pa, or 30 times the viscous stress of the imposed flow where that is "
                                  "known and more, at most 500 Pa."};
inline constexpr Key wall_range{
    .name = "wall_range",
    .dimension = Dimension::length(),
    .range = Range::non_negative,
    .fallback = optional,
    .doc = "Distance between a cell and a wall below which the wall repels it; 0: never. Default: `dx`."};
inline constexpr Key wall_strength{.name = "wall_strength",
                                   .dimension = Dimension::stress(),
                                   .range = Range::non_negative,
                                   .fallback = optional,
                                   .doc = "Pressure between a cell and a wall at touch. Default: as of `strength`."};
inline constexpr Key attraction{
    .name = "attraction",
    .dimension = Dimension::surface_modulus(),
    .range = Range::non_negative,
    .fallback = "0 uN/m",
    .doc = "Work per area (1 uN/m = 1 uJ/m2) of parting two cells, by a Morse attraction beyond `range`: aggregation."};
inline constexpr Key attraction_width{.name = "attraction_width",
                                      .dimension = Dimension::length(),
                                      .range = Range::positive,
                                      .fallback = "0.1 um",
                                      .doc = "Width of that attraction, which ends four widths beyond `range`."};

// [[contact.pairs]]
inline constexpr Key first{.name = "first", .kind = Kind::text, .doc = "Name of a type of cells."};
inline constexpr Key second{
    .name = "second", .kind = Kind::text, .doc = "Name of a type of cells, the same or another, or `wall`."};
inline constexpr Key pair_range{.name = "range",
                                .dimension = Dimension::length(),
                                .range = Range::non_negative,
                                .fallback = optional,
                                .doc = "Between these, in place of that of `[contact]`; so are the others."};
inline constexpr Key pair_strength{.name = "strength",
                                   .dimension = Dimension::stress(),
                                   .range = Range::non_negative,
                                   .fallback = optional,
                                   .doc = "Pressure at touch."};
inline constexpr Key pair_attraction{.name = "attraction",
                                     .dimension = Dimension::surface_modulus(),
                                     .range = Range::non_negative,
                                     .fallback = optional,
                                     .doc = "Work per area of parting them: aggregation, or adhesion to a wall."};
inline constexpr Key pair_attraction_width{.name = "attraction_width",
                                           .dimension = Dimension::length(),
                                           .range = Range::positive,
                                           .fallback = optional,
                                           .doc = "Width of that attraction."};

// [solver]
inline constexpr Key tolerance{.name = "tolerance",
                               .dimension = Dimension::force(),
                               .range = Range::positive,
                               .fallback = optional,
                               .doc = "Largest residual force of a converged cell. Default: the cell solver's."};
inline constexpr Key residual_bound{.name = "residual_bound",
                                    .dimension = Dimension::force(),
                                    .range = Range::positive,
                                    .fallback = optional,
                                    .doc =
                                        "At the iteration cap, a smaller residual is a warning and a larger one a "
                                        "failure. Default: the cell solver's."};
inline constexpr Key max_iterations{.name = "max_iterations",
                                    .kind = Kind::integer,
                                    .range = Range::positive,
                                    .fallback = optional,
                                    .doc = "Iterations allowed in one step of a cell. Default: the cell solver's."};
inline constexpr Key newton_iterations{.name = "newton_iterations",
                                       .kind = Kind::integer,
                                       .range = Range::non_negative,
                                       .fallback = optional,
                                       .doc =
                                           "Iterations of Newton's method allowed after those; 0: none. Default: the "
                                           "cell solver's."};
inline constexpr Key precision{.name = "precision",
                               .kind = Kind::choice,
                               .choices = "double mixed float",
                               .fallback = "double",
                               .doc =
                                   "Numbers of the cell solver; `mixed`: single precision for matrices and search "
                                   "history only."};

// [run]
inline constexpr Key steps{.name = "steps",
                           .kind = Kind::integer,
                           .range = Range::non_negative,
                           .fallback = optional,
                           .doc = "Fluid steps of the run. With `time` too they may shorten it, not go beyond."};
inline constexpr Key time{.name = "time",
                          .dimension = Dimension::time(),
                          .range = Range::non_negative,
                          .fallback = optional,
                          .doc = "Duration of the run, rounded to whole steps."};

// [output]
inline constexpr Key cells_every{
    .name = "cells_every",
    .dimension = Dimension::time(),
    .range = Range::non_negative,
    .fallback = "0 us",
    .doc = "Time between cell files (VTU), in whole steps; 0: at the start and the end only."};
inline constexpr Key fluid_every{.name = "fluid_every",
                                 .dimension = Dimension::time(),
                                 .range = Range::non_negative,
                                 .fallback = "0 us",
                                 .doc = "The same for the fluid (VTI)."};
inline constexpr Key table_every{.name = "table_every",
                                 .dimension = Dimension::time(),
                                 .range = Range::non_negative,
                                 .fallback = "0 us",
                                 .doc = "The same for the lines of `cells.csv`."};
inline constexpr Key cells{.name = "cells", .kind = Kind::boolean, .fallback = "true", .doc = "Write cell files."};
inline constexpr Key fluid{.name = "fluid", .kind = Kind::boolean, .fallback = "true", .doc = "Write fluid files."};
inline constexpr Key into_box{.name = "into_box",
                              .kind = Kind::boolean,
                              .fallback = "true",
                              .doc =
                                  "Cell files show each cell whole, moved by whole periods so that its middle lies in "
                                  "the box. `false`: where it has travelled to."};

inline constexpr Key format{.name = "format",
                            .kind = Kind::choice,
                            .choices = "vtu vtkhdf both",
                            .fallback = "vtu",
                            .doc =
                                "Of cells and fluid: `vtu`: a VTU or VTI file for each time, and a PVD over them; "
                                "`vtkhdf`: one HDF5 file for all times, which needs ParaView 5.12 or newer."};
inline constexpr Key checkpoint_every{
    .name = "checkpoint_every",
    .kind = Kind::integer,
    .range = Range::non_negative,
    .fallback = "0",
    .doc = "Fluid steps between checkpoints, from which `npfem resume` goes on; 0: only when the run is stopped."};
inline constexpr Key checkpoint_keep{.name = "checkpoint_keep",
                                     .kind = Kind::integer,
                                     .range = Range::positive,
                                     .fallback = "2",
                                     .doc =
                                         "Checkpoints that are kept, the newest ones. There must be room for one "
                                         "more: an old one goes when the new one is complete."};

}  // namespace npfem::flow::keys

namespace npfem::flow {

/// One table of a scene file.
struct SceneSection {
  const char* path;   ///< "" for the top level, "domain", "cells" (an array), "cells.positions" (an array inside)
  const char* title;  ///< as in the reference page
  const char* about;
  std::vector<text::Key> keys;
};

std::vector<SceneSection> scene_sections();

/// The reference page of scene files, in Markdown.
std::string scene_reference();

}  // namespace npfem::flow
