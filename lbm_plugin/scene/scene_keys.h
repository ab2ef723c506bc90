// SPDX-License-Identifier: MPL-2.0
// Every key of a scene file, described once: the reader fetches values through these, and the reference page is printed
// from them.
#pragma once

#include <string>
#include <vector>

#include "key.h"

namespace npfem::flow::keys {

using text::Dimension;
using text::Key;
using text::Kind;
using text::optional;
using text::Range;
using text::required;

// top level
inline constexpr Key schema_version{"schema_version", Kind::integer, Dimension::none(), Range::positive, "", required,
                                    "Version of this format: 1."};
inline constexpr Key title{"title", Kind::text, Dimension::none(), Range::any, "", "untitled",
                           "One line about the scene, repeated in the summary."};

// [domain]
inline constexpr Key kind{"kind", Kind::choice, Dimension::none(), Range::any, "tube shear_box plates periodic_box",
                          required,
                          "`tube`: round, along z, periodic in z. `shear_box`: plates at y = 0 and y = size moving "
                          "along x, periodic in x and z. `plates`: the same at rest. `periodic_box`: no walls."};
inline constexpr Key size{"size", Kind::vector3, Dimension::length(), Range::positive, "", optional,
                          "Lengths along x, y, z; all kinds but the tube. Whole multiples of `dx`."};
inline constexpr Key diameter{"diameter", Kind::quantity, Dimension::length(), Range::positive, "", optional,
                              "Of the tube. A whole multiple of `dx`."};
inline constexpr Key length{"length", Kind::quantity, Dimension::length(), Range::positive, "", optional,
                            "Of the tube. A whole multiple of `dx`."};
inline constexpr Key dx{"dx", Kind::quantity, Dimension::length(), Range::positive, "", required,
                        "Distance of the lattice nodes."};

// [fluid]
inline constexpr Key density{"density", Kind::quantity, Dimension::density(), Range::positive, "", "1025 kg/m3",
                             "Of the fluid, inside and outside of the cells."};
inline constexpr Key kinematic_viscosity{"kinematic_viscosity", Kind::quantity, Dimension::kinematic_viscosity(),
                                         Range::positive, "", optional, "Either this or `dynamic_viscosity`."};
inline constexpr Key dynamic_viscosity{"dynamic_viscosity", Kind::quantity, Dimension::dynamic_viscosity(),
                                       Range::positive, "", optional, "Either this or `kinematic_viscosity`."};
inline constexpr Key time_step{"time_step", Kind::quantity, Dimension::time(), Range::positive, "", optional,
                               "Of the fluid. Either this or `tau`."};
inline constexpr Key tau{"tau", Kind::quantity, Dimension::none(), Range::positive, "", optional,
                         "Relaxation time in time steps, above 0.5; sets the time step. Either this or `time_step`."};
inline constexpr Key magic_parameter{"magic_parameter", Kind::quantity, Dimension::none(), Range::positive, "",
                                     "0.1875",
                                     "Of the two-relaxation-time collision; 3/16 puts flat walls exactly half-way."};

// [flow]
inline constexpr Key shear_rate{"shear_rate", Kind::quantity, Dimension::rate(), Range::non_negative, "", optional,
                                "Of the shear box: relative speed of the plates over their distance."};
inline constexpr Key mean_velocity{"mean_velocity", Kind::quantity, Dimension::velocity(), Range::non_negative, "",
                                   optional,
                                   "Tube and plates: sets the body force that would drive the fluid without cells at "
                                   "this mean velocity, along z in a tube and along x between plates."};
inline constexpr Key centre_velocity{"centre_velocity", Kind::quantity, Dimension::velocity(), Range::non_negative, "",
                                     optional, "The same, by the velocity in the middle."};
inline constexpr Key pressure_gradient{"pressure_gradient", Kind::quantity, Dimension::force_density(),
                                       Range::non_negative, "", optional, "The same, by the pressure drop per length."};
inline constexpr Key start{"start", Kind::choice, Dimension::none(), Range::any, "rest developed", "rest",
                           "The fluid starts at `rest`, or in the steady flow without cells (`developed`)."};

// [[cells]]
inline constexpr Key name{"name", Kind::text, Dimension::none(), Range::any, "", required, "Of this type of cell."};
inline constexpr Key material{"material", Kind::text, Dimension::none(), Range::any, "", required,
                              "A preset (`rbc`, `platelet`, ...) or the path of a material file, from the scene."};
inline constexpr Key level{"level", Kind::integer, Dimension::none(), Range::non_negative, "", optional,
                           "Refinement of the mesh: 2, 3, 4 give 66, 258, 1026 vertices. Default: the material's."};
inline constexpr Key mesh{"mesh", Kind::text, Dimension::none(), Range::any, "", optional,
                          "Path of a mesh file (.off .obj .stl .ply, um), from the scene. Default: the material's "
                          "shape."};
inline constexpr Key haematocrit{"haematocrit", Kind::quantity, Dimension::none(), Range::fraction, "", optional,
                                 "Volume of these cells over the volume open to the fluid; met within half a cell."};
inline constexpr Key count{"count", Kind::integer, Dimension::none(), Range::non_negative, "", optional,
                           "Number of these cells, placed at random."};
inline constexpr Key ratio{"ratio", Kind::quantity, Dimension::none(), Range::non_negative, "", optional,
                           "Number of these cells per cell of the type `ratio_to`, placed at random."};
inline constexpr Key ratio_to{"ratio_to", Kind::text, Dimension::none(), Range::any, "", optional,
                              "Name of a type listed before."};

// [[cells.positions]]
inline constexpr Key centre{"centre", Kind::vector3, Dimension::length(), Range::any, "", required,
                            "Where the middle of the cell starts."};
inline constexpr Key rotate{"rotate", Kind::vector3, Dimension::angle(), Range::any, "",
                            "[\"0 deg\", \"0 deg\", \"0 deg\"]",
                            "Turns about the fixed axes x, then y, then z; a red cell or platelet has its axis along "
                            "z before."};

// [placement]
inline constexpr Key seed{"seed", Kind::integer, Dimension::none(), Range::non_negative, "", "1",
                          "Of the random placement."};
inline constexpr Key gap{"gap", Kind::quantity, Dimension::length(), Range::non_negative, "", "0.3 um",
                         "Least distance between the surfaces of cells placed at random, and to the walls."};

// [coupling]
inline constexpr Key scheme{"scheme", Kind::choice, Dimension::none(), Range::any, "implicit peskin", "implicit",
                            "`implicit`: stable for any stiffness of the membrane. `peskin`: explicit, the yardstick "
                            "while it is stable."};
inline constexpr Key kernel{"kernel", Kind::integer, Dimension::none(), Range::positive, "", "4",
                            "Width of the immersed-boundary kernel in nodes: 2, 3 or 4."};
inline constexpr Key cell_every{"cell_every", Kind::integer, Dimension::none(), Range::positive, "", "1",
                                "Fluid steps per step of the cell solver."};

// [repulsion]
inline constexpr Key range{"range", Kind::quantity, Dimension::length(), Range::non_negative, "", optional,
                           "Distance of two vertices of different cells below which they repel; 0: never. Default: `dx`."};
inline constexpr Key strength{"strength", Kind::quantity, Dimension::force(), Range::non_negative, "", "2 pN",
                              "Force between two vertices at contact, falling as (1 - distance/range)^2."};
inline constexpr Key wall_range{"wall_range", Kind::quantity, Dimension::length(), Range::non_negative, "", optional,
                                "Distance of a vertex from a wall below which the wall repels it; 0: never. Default: "
                                "`dx`."};
inline constexpr Key wall_strength{"wall_strength", Kind::quantity, Dimension::force(), Range::non_negative, "",
                                   "2 pN", "Force between a vertex and a wall at contact."};

// [solver]
inline constexpr Key tolerance{"tolerance", Kind::quantity, Dimension::force(), Range::positive, "", optional,
                               "Largest residual force of a converged cell. Default: the cell solver's."};
inline constexpr Key residual_bound{"residual_bound", Kind::quantity, Dimension::force(), Range::positive, "", optional,
                                    "At the iteration cap, a smaller residual is a warning and a larger one a failure. "
                                    "Default: the cell solver's."};
inline constexpr Key max_iterations{"max_iterations", Kind::integer, Dimension::none(), Range::positive, "", optional,
                                    "Iterations allowed in one step of a cell. Default: the cell solver's."};

// [run]
inline constexpr Key steps{"steps", Kind::integer, Dimension::none(), Range::non_negative, "", optional,
                           "Fluid steps of the run. With `time` too, whichever comes first."};
inline constexpr Key time{"time", Kind::quantity, Dimension::time(), Range::non_negative, "", optional,
                          "Duration of the run, rounded to whole steps."};

// [output]
inline constexpr Key cells_every{"cells_every", Kind::quantity, Dimension::time(), Range::non_negative, "", "0 us",
                                 "Time between cell files (VTU), in whole steps; 0: at the start and the end only."};
inline constexpr Key fluid_every{"fluid_every", Kind::quantity, Dimension::time(), Range::non_negative, "", "0 us",
                                 "The same for the fluid (VTI)."};
inline constexpr Key table_every{"table_every", Kind::quantity, Dimension::time(), Range::non_negative, "", "0 us",
                                 "The same for the lines of `cells.csv`."};
inline constexpr Key cells{"cells", Kind::boolean, Dimension::none(), Range::any, "", "true", "Write cell files."};
inline constexpr Key fluid{"fluid", Kind::boolean, Dimension::none(), Range::any, "", "true", "Write fluid files."};
inline constexpr Key into_box{"into_box", Kind::boolean, Dimension::none(), Range::any, "", "true",
                              "Cell files show each cell whole, moved by whole periods so that its middle lies in the "
                              "box. `false`: where it has travelled to."};

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
