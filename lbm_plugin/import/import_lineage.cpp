// SPDX-License-Identifier: MPL-2.0
#include "import/import_lineage.h"

#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include "file.h"
#include "geometry/stl_file.h"
#include "import/lineage_cells.h"
#include "import/lineage_parameters.h"
#include "import/lineage_walls.h"
#include "npfem/npfem.hpp"
#include "quantity.h"
#include "scene/scene.h"
#include "toml_reader.h"

namespace npfem::flow {
namespace {

namespace fs = std::filesystem;
using text::Dimension;
using text::format_number;

std::string in_quotes(const std::string& word) {
  return text::toml_string(word);
}

std::string quantity(double value, const Dimension& dimension) {
  return in_quotes(text::format_quantity(value, dimension));
}

std::string lengths(const Vec3& v) {
  const Dimension um = Dimension::length();
  return "[" + quantity(v[0], um) + ", " + quantity(v[1], um) + ", " + quantity(v[2], um) + "]";
}

std::string um(double value) {
  return text::format_quantity(value, "um");
}

/// One type of body: its folder and model.
struct Body {
  std::string name;
  const LineageBodyParameters& parameters;
  fs::path folder;
  std::shared_ptr<const api::Model> model;
};

class Importer {
 public:
  Importer(const fs::path& path, const fs::path& scene_path, const std::string& coupling)
      : folder_(fs::absolute(path).parent_path()),
        path_(path),
        scene_path_(scene_path),
        coupling_(coupling),
        xml_(LineageXml::parse(text::read_file(path.string()), path.string())),
        p_(read_lineage_parameters(xml_)) {}

  LineageImport run() {
    read_bodies();
    place_walls();
    read_cells();
    note_the_rest();
    // made with full paths and without its cells file it must be a scene already
    try {
      parse_scene(scene({}), "the scene made of it");
    } catch (const text::InputError& error) {
      throw text::InputError(path_.string() + ": gives a scene that cannot be used: " + error.what());
    }
    return {scene(fs::absolute(scene_path_).parent_path()), std::move(cells_), std::move(notes_)};
  }

 private:
  bool by_lineage() const { return coupling_ == "lineage"; }
  void note(const std::string& text) { notes_.push_back(text); }

  // ---- bodies ----

  Body read_body(const std::string& name, const std::string& kind, const LineageBodyParameters& parameters) {
    const std::string key = "Case_Study_" + kind;
    Body body{name, parameters, folder_ / "Case_Studies" / parameters.case_study, nullptr};
    if (!fs::is_directory(body.folder)) xml_.fail(key, "there is no folder \"" + body.folder.string() + "\"");
    try {
      body.model = std::make_shared<const api::Model>(
          api::Model::load_lineage(body.folder.string(), density_of(parameters), parameters.volume_weight));
    } catch (const api::Failure& failure) {
      xml_.fail(key, failure.what());
    }
    return body;
  }

  /// The fluid inside a cell is there already, except in the lineage's own scheme, which does not count it.
  double density_of(const LineageBodyParameters& body) const {
    return by_lineage() ? body.density : body.density - p_.density;
  }

  void read_bodies() {
    if (!p_.with_bodies) return;
    bodies_.push_back(read_body("rbc", "RBC", p_.rbc));
    bodies_.push_back(read_body("platelet", "PLT", p_.platelet));
  }

  // ---- walls and domain ----

  std::optional<LineageWall> read_wall() {
    const std::string key = "System_Setup/wallStlFileName";
    if (p_.wall_file.empty()) return std::nullopt;
    try {
      wall_path_ = (folder_ / p_.wall_file).lexically_normal();
      const std::optional<LineageWall> wall = recognised(read_stl(wall_path_.string()));
      if (!wall) xml_.fail(key, "is neither two planes across y, nor a tube along z, nor a closed body");
      return wall;
    } catch (const text::FileError& error) {
      xml_.fail(key, error.what());
    }
  }

  void place_walls() {
    using Kind = LineageWall::Kind;
    wall_ = read_wall();
    const bool obstacle = wall_ && (wall_->kind == Kind::box || wall_->kind == Kind::body);
    const bool tube = p_.flow == LineageParameters::Flow::tube;
    if (wall_ && !obstacle && tube != (wall_->kind == Kind::tube)) {
      xml_.fail("System_Setup/wallStlFileName", tube ? "holds two planes, but Poiseuille_Flow is in a tube"
                                                     : "holds a tube, but this flow is between planes");
    }
    if (tube) {
      place_tube(obstacle);
    } else {
      place_plates(obstacle);
    }
    note("The lineage puts walls at STL vertices by force; here the nearest nodes of the lattice are solid.");
  }

  void place_tube(bool obstacle) {
    const double across = std::min(p_.size[0], p_.size[1]);
    radius_ = wall_ && !obstacle ? wall_->radius : 0.5 * (across - 4 * p_.dx);  // (min(nx, ny) - 5)/2 nodes
    radius_ = 0.5 * fitted("The tube is", 2 * radius_);
    const Vec3 axis = wall_ && !obstacle ? wall_->middle : scale(0.5, p_.size);
    shift_ = {radius_ - axis[0], radius_ - axis[1], 0};
    room_ = {2 * radius_, 2 * radius_, p_.size[2]};
    note("The box is as wide as the tube: positions are those of the lineage plus (" + um(shift_[0]) + ", " +
         um(shift_[1]) + ", 0 um).");
  }

  /// The width between walls, which an STL file (in single precision) may put anywhere.
  double fitted(const std::string& what, double width) {
    const double whole = whole_spacings(width, p_.dx);
    if (std::abs(whole - width) > 1e-3 * p_.dx) {
      note(what + " " + um(whole) + " wide, a whole number of dx_p, instead of " + um(width) + ".");
    }
    return whole;
  }

  void place_plates(bool obstacle) {
    // the lineage's plates without STL: on the first and last nodes in shear, two nodes inside them in Poiseuille flow
    const double margin = p_.flow == LineageParameters::Flow::shear ? 0 : 1.5 * p_.dx;
    const bool planes = wall_ && !obstacle;
    const double low = planes ? wall_->low : margin;
    const double high = planes ? wall_->high : p_.size[1] - margin;
    shift_ = {0, -low, 0};
    room_ = {p_.size[0], fitted("The room between the plates is", high - low), p_.size[2]};
    if (low != 0) note("The box ends at the walls: positions are those of the lineage plus (0, " + um(-low) + ", 0).");
    if (p_.flow != LineageParameters::Flow::shear || p_.packing) return;
    note(
        "The plates move with -1/2 and +1/2 of their relative speed, the lineage's with 0 and 1: its cells drift "
        "along z by half of it more.");
    if (planes && high - low != p_.size[1]) {
      note("The shear rate is the one asked for; the lineage moves its wall at y = " + um(high) +
           " as if it stood at " + um(p_.size[1]) + ", which shears by " +
           text::format_rounded(100 * (p_.size[1] / (high - low) - 1)) + " % more.");
    }
  }

  // ---- cells ----

  void read_cells() {
    if (bodies_.empty()) return;
    if (p_.packing) return count_packed_cells();
    if (p_.restart) return read_checkpoint();
    const std::string key = "System_Setup/pos_filename";
    const fs::path path = folder_ / p_.position_file;
    try {
      placings_ = parse_placings(text::read_file(path.string()), path.string());
    } catch (const text::FileError& error) {
      xml_.fail(key, error.what());
    }
    for (const LineagePlacing& placing : placings_) ++counts_[static_cast<std::size_t>(placing.type)];
  }

  void count_packed_cells() {
    if (!(p_.rbc_per_platelet > 0)) {
      xml_.fail("System_Setup/RBCsToPLT", xml_.text("System_Setup/RBCsToPLT") + " must be greater than 0");
    }
    const double pi = std::acos(-1.0);
    const bool tube = p_.flow == LineageParameters::Flow::tube;
    const double room =
        tube ? pi * radius_ * radius_ * p_.size[2] : p_.size[0] * p_.size[1] * p_.size[2];  // walls not taken out
    counts_[0] = static_cast<int>(p_.haematocrit * room / bodies_[0].model->measure("rest_volume"));
    counts_[1] = static_cast<int>(counts_[0] / p_.rbc_per_platelet);
    note("As many cells as the lineage takes: its haematocrit is of red cells alone, in the whole box.");
    note(
        "CellPacking/offset, max_time and dt_p steer the lineage's packing only; npfem pack stops when no two cells "
        "overlap.");
  }

  void read_checkpoint() {
    const std::string key = "CheckPointing/CP_OutputDir";
    const fs::path folder = (folder_ / p_.checkpoint_folder).lexically_normal();
    if (!fs::is_directory(folder)) {
      xml_.fail(key, "there is no folder \"" + folder.string() + "\"; unpack the archive of the start set there");
    }
    counts_ = {p_.rbc_count, p_.platelet_count};
    if (counts_[0] + counts_[1] == 0) xml_.fail("CheckPointing/numRBC", "and numPLT are 0: a restart needs cells");
    const LineageCheckpoint checkpoint(folder, counts_[0] + counts_[1]);
    int id = 0;
    for (std::size_t type = 0; type < bodies_.size(); ++type) {
      const api::Model& model = *bodies_[type].model;
      if (counts_[type] == 0) continue;
      StoredCells stored{bodies_[type].name, model.vertices(), hash_of_mesh(model.triangles()), {}};
      for (int n = 0; n < counts_[type]; ++n, ++id) {
        const std::vector<double> xyz = checkpoint.positions(id, stored.vertices);
        for (std::size_t i = 0; i < xyz.size(); ++i) stored.positions.push_back(xyz[i] + shift_[i % 3]);
      }
      cells_.push_back(std::move(stored));
    }
    if (checkpoint.iteration() < 0) {
      note("Cells start deformed, as the start set has them; the lineage starts from undeformed ones fitted to it.");
    } else {
      note("Cells start as after step " + std::to_string(checkpoint.iteration()) +
           " of the lineage, but at rest and in a fluid at rest: its fluid checkpoint is not read.");
    }
    note("Start positions have the six digits of the files.");
  }

  // ---- the scene ----

  void note_the_rest() {
    if (!by_lineage() && !bodies_.empty()) {
      note("Coupling " + in_quotes(coupling_) +
           ": Calpha, Cbeta, vel_cap, inamuro_iT and the settings of the lineage's "
           "solver (m, tol, ...) have no counterpart.");
      note("Bodies weigh what they exceed the fluid by: the lattice holds the fluid inside them already.");
    }
    if (by_lineage()) note("No vertex is slowed down: vel_cap has no counterpart.");
    if (!bodies_.empty()) {
      note(
          "A contact presses with weight x threshold per vertex area at touch and ends at the threshold; the "
          "lineage pulls the whole vertex to a point beyond it.");
    }
    if (by_lineage() && (p_.rbc.alpha != p_.platelet.alpha || p_.rbc.beta != p_.platelet.beta)) {
      xml_.fail("ShapeOp_PLT/Calpha", "Calpha and Cbeta must be those of ShapeOp_RBC for the coupling \"lineage\"");
    }
    if (p_.size_is_rounded) note("lx_p, ly_p, lz_p are rounded to whole numbers of dx_p, as the lineage does.");
    note_unknown_keys();
    if (!p_.all_cells_written) note("Every cell is written, not a share of them (dump_..._ratio_...).");
    note("Periods are whole: the lineage's cells move by one node less than the box when they cross a periodic face.");
    note("particleEnvelopeWidth has no counterpart; OutputDir is given to npfem run: -o " + p_.output_folder + ".");
  }

  /// Those of the lineage that steer nothing here are known too.
  void note_unknown_keys() {
    static const std::set<std::string> without_effect{"System_Setup/particleEnvelopeWidth", "System_Setup/vel_cap",
                                                      "System_Setup/vel_cap_fin", "ShapeOp_General/beta_morse"};
    std::string unknown;
    for (const std::string& path : xml_.unused()) {
      if (!without_effect.contains(path) && !path.starts_with("CellPacking/"))
        unknown += (unknown.empty() ? "" : ", ") + path;
    }
    if (!unknown.empty()) note("Unknown to the lineage and to this program, without effect: " + unknown + ".");
  }

  std::string relative(const fs::path& path, const fs::path& from) const {
    const fs::path full = fs::absolute(path).lexically_normal();
    return in_quotes((from.empty() ? full : full.lexically_relative(from)).string());
  }

  /// `folder`: of the scene file, that its paths start from; empty: full paths, and no cells file.
  std::string scene(const fs::path& folder) const {
    std::string t = "# Made by npfem import from \"" + path_.filename().string() +
                    "\" of Palabos-npFEM. What differs from its run:\n";
    for (const std::string& line : notes_) t += "# - " + line + "\n";
    t += "schema_version = 1\ntitle = " + in_quotes(path_.stem().string() + " of Palabos-npFEM") + "\n";
    t += domain_text(folder) + fluid_text() + flow_text();
    for (std::size_t type = 0; type < bodies_.size(); ++type) {
      if (counts_[type] > 0) t += body_text(type, folder);
    }
    if (!cells_.empty() && !folder.empty()) {
      t += "\n[placement]\nfile = " + in_quotes(cells_file_of(scene_path_).filename().string()) + "\n";
    }
    return t + coupling_text() + contact_text() + run_text();
  }

  std::string domain_text(const fs::path& folder) const {
    const Dimension length = Dimension::length();
    const bool tube = p_.flow == LineageParameters::Flow::tube;
    const bool shear = p_.flow == LineageParameters::Flow::shear;
    std::string t = "\n[domain]\n";
    t += tube ? "kind = \"tube\"\ndiameter = " + quantity(room_[0], length) +
                    "\nlength = " + quantity(room_[2], length) + "\n"
              : std::string("kind = ") + (shear ? "\"shear_box\"" : "\"plates\"") + "\nsize = " + lengths(room_) + "\n";
    t += "dx = " + quantity(p_.dx, length) + "\n";
    if (wall_ && wall_->kind == LineageWall::Kind::box) {
      t += "\n[[domain.solids]]                      # " + wall_path_.filename().string() +
           "\nshape = \"box\"\ncentre = " + lengths(add(wall_->middle, shift_)) + "\nsize = " + lengths(wall_->size) +
           "\n";
    }
    if (wall_ && wall_->kind == LineageWall::Kind::body) {
      t += "\n[[domain.solids]]\nshape = \"surface\"\nsurface = " + relative(wall_path_, folder) +
           "\nsurface_shift = " + lengths(shift_) + "\n";
    }
    return t;
  }

  std::string fluid_text() const {
    std::string t = "\n[fluid]\ndensity = " + quantity(p_.density, Dimension::density()) +
                    "\nkinematic_viscosity = " + quantity(p_.viscosity, Dimension::kinematic_viscosity()) + "\n";
    if (p_.packing) {
      t += "tau = 1                                # no fluid takes part in packing\n";
    } else {
      t += p_.tau > 0 ? "tau = " + format_number(p_.tau) + "\n"
                      : "time_step = " + quantity(p_.time_step, Dimension::time()) + "\n";
    }
    if (by_lineage()) t += "collision = \"regularised\"\n";
    return t;
  }

  std::string flow_text() const {
    std::string t = "\n[flow]\n";
    if (p_.flow == LineageParameters::Flow::shear) {
      t += "shear_rate = " + quantity(p_.shear_rate, Dimension::rate()) + "\n";
    } else if (p_.centre_velocity != 0) {
      t += "centre_velocity = " + quantity(p_.centre_velocity, Dimension::velocity()) + "\n";
    }
    return t + "axis = \"z\"\nstart = \"rest\"\n";
  }

  std::string body_text(std::size_t type, const fs::path& folder) const {
    const Body& body = bodies_[type];
    std::string t = "\n[[cells]]\nname = " + in_quotes(body.name) + "\nbody_folder = " + relative(body.folder, folder) +
                    "\nbody_density = " + quantity(density_of(body.parameters), Dimension::density()) +
                    "\nvolume_weight = " + quantity(body.parameters.volume_weight, Dimension::surface_modulus()) + "\n";
    if (placings_.empty()) return t + "count = " + std::to_string(counts_[type]) + "\n";
    t += "positions = [\n";
    for (const LineagePlacing& placing : placings_) {
      if (placing.type != static_cast<int>(type)) continue;
      t += "  { centre = " + lengths(add(placing.centre, shift_)) + ", rotate = [";
      for (std::size_t a = 0; a < 3; ++a) {
        t += (a > 0 ? ", \"" : "\"") + format_number(placing.degrees[a]) + " deg\"";
      }
      t += "] },\n";
    }
    return t + "]\n";
  }

  std::string coupling_text() const {
    std::string t = "\n[coupling]\nscheme = " + in_quotes(coupling_) +
                    "\nkernel = 4\ncell_every = " + std::to_string(p_.solve_every) + "\n";
    if (!by_lineage()) return t;
    t += "forcing_iterations = " + std::to_string(p_.forcing_iterations) + "\n";
    const auto& s = p_.solver;
    t += "\n[lineage]\nalpha = " + format_number(p_.rbc.alpha) + "\nbeta = " + quantity(p_.rbc.beta, Dimension::time());
    t += "\nhistory = " + std::to_string(s.history) + "\nmax_iterations = " + std::to_string(s.max_iterations);
    t += "\nmax_line_search = " + std::to_string(s.max_line_search) + "\nattempts = " + std::to_string(s.attempts);
    t += "\nwindow = " + std::to_string(s.window) + "\ntolerance = " + format_number(s.tolerance);
    t += "\narmijo = " + format_number(s.armijo) + "\ncurvature = " + format_number(s.curvature);
    return t + "\n";
  }

  /// Pressure at touch: the spring of a vertex at full threshold over the area of the vertex.
  double touch_pressure(const LineageParameters::Contact& contact, const Body& body) const {
    const double area = body.model->measure("rest_area") / body.model->vertices();
    return contact.range * contact.weight / area;
  }

  std::string contact_text() const {
    if (bodies_.empty()) return "";
    const auto stress = [](double pascal) { return quantity(pascal, Dimension::stress()); };
    const auto three_digits = [](double value) { return std::stod(text::format_rounded(value)); };
    const double like = three_digits(touch_pressure(p_.like, bodies_[0]));
    std::string t = "\n[contact]\nrange = " + quantity(p_.like.range, Dimension::length()) +
                    "\nstrength = " + stress(like) + "\nwall_range = " + quantity(p_.like.range, Dimension::length()) +
                    "\nwall_strength = " + stress(like) + "\n";
    if (counts_[0] > 0 && counts_[1] > 0) {
      t += "\n[[contact.pairs]]\nfirst = \"rbc\"\nsecond = \"platelet\"\nrange = " +
           quantity(p_.unlike.range, Dimension::length()) +
           "\nstrength = " + stress(three_digits(touch_pressure(p_.unlike, bodies_[0]))) + "\n";
    }
    return t;
  }

  std::string run_text() const {
    const double step = p_.step();
    const Dimension time = Dimension::time();
    if (p_.packing) return "\n[run]\nsteps = 0\n";
    std::string t = "\n[run]\ntime = " + quantity(p_.duration, time) + "\n";
    const std::string cells_every = quantity(step * p_.output_every, time);
    t += "\n[output]\ncells = " + std::string(p_.write_cells ? "true" : "false") + "\ncells_every = " + cells_every +
         "\nfluid = false                          # the lineage writes none\n";
    t += "table_every = " + (p_.write_centres ? quantity(step * p_.solve_every, time) : cells_every) + "\n";
    return t + "checkpoint_every = " + std::to_string(p_.checkpoint_every) + "\n";
  }

  fs::path folder_, path_, scene_path_;
  std::string coupling_;
  LineageXml xml_;
  LineageParameters p_;
  std::vector<Body> bodies_;
  fs::path wall_path_;
  std::optional<LineageWall> wall_;
  double radius_ = 0;  // um, of a tube
  Vec3 shift_{};       // from the lineage's positions to ours, um
  Vec3 room_{};        // size of our box, um
  std::vector<LineagePlacing> placings_;
  std::array<int, 2> counts_{};  // red cells, platelets
  std::vector<StoredCells> cells_;
  std::vector<std::string> notes_;
};

}  // namespace

LineageImport import_lineage(const fs::path& parameters, const fs::path& scene_path, const std::string& coupling) {
  return Importer(parameters, scene_path, coupling).run();
}

fs::path cells_file_of(const fs::path& scene_path) {
  fs::path path = scene_path;
  return path.replace_extension(".cells");
}

}  // namespace npfem::flow
