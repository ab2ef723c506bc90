// SPDX-License-Identifier: MPL-2.0
// npfem pack: the cells of a scene, packed without a fluid, and a scene that starts with them.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "file.h"
#include "interrupt.h"
#include "lattice/threads.h"
#include "placement/cells_file.h"
#include "placement/pack_cells.h"
#include "scene/make_cells.h"
#include "scene/scene.h"
#include "scene_options.h"
#include "session.h"

namespace npfem::app {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

struct PackOptions {
  SceneOptions scene;
  std::string output;
  bool overwrite = false, quiet = false, json = false;

  std::string cells_path() const { return beside(".cells"); }
  std::string summary_path() const { return beside(".json"); }

 private:
  std::string beside(const char* ending) const {
    return std::filesystem::path(output).replace_extension(ending).string();
  }
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One line that rewrites itself on a terminal, a new line every few seconds elsewhere.
class PackLine {
 public:
  explicit PackLine(bool shown) : shown_(shown) {}

  void show(const flow::PackProgress& at) {
    if (!shown_ || seconds_since(last_) < (terminal_ ? 0.2 : 5.0)) return;
    last_ = Clock::now();
    std::fprintf(stderr, "%s%s cells, step %d: deepest overlap %.3g um%s", terminal_ ? "\r" : "", at.phase, at.steps,
                 at.overlap, terminal_ ? "   " : "\n");
    std::fflush(stderr);
    begun_ = true;
  }
  void finish() const {
    if (begun_ && terminal_) std::fputc('\n', stderr);
  }

 private:
  bool shown_;
  bool terminal_ = isatty(STDERR_FILENO) == 1;
  bool begun_ = false;
  Clock::time_point last_ = Clock::now();
};

/// Packing is the work of one process; it takes all cores unless the user says otherwise.
int threads_to_use() {
  if (const char* asked = std::getenv("OMP_NUM_THREADS")) return std::max(1, std::atoi(asked));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

flow::Scene load(const PackOptions& options) {
  flow::Scene scene = flow::read_scene(options.scene.path, options.scene.assignments);
  for (const flow::CellsRequest& request : scene.requests) {
    if (request.positions.empty()) continue;
    request.table.fail("positions", "packing finds the places of all cells; give haematocrit, count or ratio instead");
  }
  flow::make_types(scene);
  // a cells file says where they start
  if (!scene.cells_file.empty()) flow::place_scene_cells(scene);
  return scene;
}

/// The names of the cells file and of the summary follow from that of the scene.
void require_free(const PackOptions& options) {
  if (std::filesystem::path(options.output).extension() != ".toml") {
    throw text::InputError("-o \"" + options.output +
                           "\": give the packed scene a name that ends in .toml; its cells (.cells) and the summary "
                           "(.json) are put beside it");
  }
  for (const std::string& path : {options.output, options.cells_path(), options.summary_path()}) {
    if (options.overwrite || !std::filesystem::exists(path)) continue;
    throw text::FileError("\"" + path + "\" exists; choose another name, or replace it with --overwrite");
  }
}

std::vector<flow::StoredCells> stored(const flow::Setup& setup, const std::vector<flow::CellStart>& cells) {
  std::vector<flow::StoredCells> types;
  for (const flow::CellType& type : setup.types) {
    types.push_back({type.name, type.model->vertices(), flow::hash_of_mesh(type.triangles), {}});
  }
  for (const flow::CellStart& cell : cells) {
    std::vector<double>& all = types[static_cast<std::size_t>(cell.type)].positions;
    all.insert(all.end(), cell.positions.begin(), cell.positions.end());
  }
  return types;
}

Json summary_of(const flow::Scene& scene, const std::vector<int>& counts, const flow::PackedCells& packed,
                double seconds) {
  const double volume = scene.setup.domain.fluid_volume();
  double asked = 0;
  Json types = Json::array();
  const std::vector<double> shares = flow::haematocrit_by_type(scene.setup, counts);
  for (std::size_t type = 0; type < counts.size(); ++type) {
    asked += shares[type];
    types.push_back({{"name", scene.setup.types[type].name}, {"cells", counts[type]}, {"haematocrit", shares[type]}});
  }
  Json summary{{"cells", packed.cells.size()},
               {"types", types},
               {"volume_fraction_asked", asked},
               {"volume_fraction_delivered", packed.volume / volume},
               {"seed", scene.seed},
               {"seconds", seconds},
               {"rigid_steps", packed.rigid_steps},
               {"soft_steps", packed.soft_steps},
               {"overlap_before_um", packed.overlap_before},
               {"overlap_after_um", std::max(0.0, -packed.least_gap)},
               {"least_gap_um", packed.least_gap},
               {"crossing_triangles", packed.crossings},
               {"worst_volume_error", packed.worst_volume_error},
               {"worst_area_error", packed.worst_area_error},
               {"stopped_by", "no overlap"}};
  if (std::isfinite(packed.least_wall_gap)) summary["least_wall_gap_um"] = packed.least_wall_gap;
  return summary;
}

void print(const Json& s, const std::string& path) {
  const auto number = [&s](const char* key) { return s.at(key).get<double>(); };
  for (const Json& type : s.at("types")) {
    std::printf("%d x %s, haematocrit %.4f\n", type.at("cells").get<int>(), type.at("name").get<std::string>().c_str(),
                type.at("haematocrit").get<double>());
  }
  std::printf("packed in %.1f s, %d rigid and %d soft steps; volume fraction %.4f of %.4f asked\n", number("seconds"),
              s.at("rigid_steps").get<int>(), s.at("soft_steps").get<int>(), number("volume_fraction_delivered"),
              number("volume_fraction_asked"));
  std::printf("overlap %.3g um before, least gap %.3g um after; errors: volume %.2g, area %.2g\n",
              number("overlap_before_um"), number("least_gap_um"), number("worst_volume_error"),
              number("worst_area_error"));
  std::printf("run it with: npfem run %s -o FOLDER\n", path.c_str());
}

/// The scene with its files by their full paths, so that it may lie anywhere, and with the packed cells beside it.
void write(const PackOptions& options, flow::Scene& scene, const flow::PackedCells& packed, const std::string& json) {
  const std::string cells_path = options.cells_path();
  flow::write_cells_file(cells_path, stored(scene.setup, packed.cells));
  flow::resolved_text(scene);
  scene.document.set("placement.file", text::toml_string(std::filesystem::path(cells_path).filename().string()));
  text::write_file(options.output, scene.document.to_toml());
  text::write_file(options.summary_path(), json);
}

int pack(const PackOptions& options) {
  require_free(options);
  flow::Scene scene = load(options);
  const std::vector<int> counts = flow::cell_counts(scene);
  const Clock::time_point start = Clock::now();
  const int threads = threads_to_use();
  flow::set_lattice_threads(threads);
  PackLine line(!options.quiet);
  catch_signals();
  const auto goes_on = [&line](const flow::PackProgress& at) {
    line.show(at);
    return request() == Request::none;
  };
  flow::PackedCells packed;
  try {
    packed = flow::pack_cells(scene.setup.domain, scene.setup.types,
                              {counts, scene.seed, scene.setup.cells, threads, goes_on});
  } catch (const flow::PlacementError& error) {
    line.finish();
    scene.document.root().table("placement").fail(error.what());
  }
  line.finish();
  if (packed.interrupted) {
    std::cerr << "npfem: interrupted; cells still overlap, nothing was written\n";
    return failed;
  }
  const std::string json = summary_of(scene, counts, packed, seconds_since(start)).dump(2) + "\n";
  write(options, scene, packed, json);
  if (options.json) std::cout << json;
  if (!options.json && !options.quiet) print(Json::parse(json), options.output);
  return done;
}

/// The first process packs; the others only share how it ended.
int pack_on_first_rank(Session& session, const PackOptions& options) {
  int outcome = done;
  on_first_rank(session, [&] { outcome = pack(options); });
  return session.communicator.any(outcome == failed) ? failed : done;
}

}  // namespace

Action add_pack(CLI::App& program) {
  const auto options = std::make_shared<PackOptions>();
  CLI::App* command = program.add_subcommand("pack", "pack the cells of a scene at its haematocrit");
  options->scene.add_to(*command);
  command
      ->add_option("-o,--output", options->output,
                   "the packed scene (.toml); its cells (.cells) and the summary (.json) are put beside it")
      ->required();
  command->add_flag("--overwrite", options->overwrite, "replace files that are there");
  command->add_flag("--quiet", options->quiet, "no progress, no closing lines");
  command->add_flag("--json", options->json, "print the summary as JSON");
  return [options](Session& session) { return pack_on_first_rank(session, *options); };
}

}  // namespace npfem::app
