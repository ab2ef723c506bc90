// SPDX-License-Identifier: MPL-2.0
// npfem bench: how fast cell solver, fluid and coupled runs are, and how wrong.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>

#include "bench/cells.h"
#include "bench/machine.h"
#include "bench/suites.h"
#include "file.h"
#include "interrupt.h"
#include "nearest.h"
#include "quantity.h"
#include "session.h"

namespace npfem::app {

void bench::say(const std::string& line) {
  std::fprintf(stderr, "%s\n", line.c_str());
}

namespace {

using bench::Json;

struct BenchOptions {
  std::string suite, json, plot;
  bool quick = false;
  std::vector<int> meshes, batches, threads;
  std::vector<std::string> precisions;
};

const std::vector<std::string> suites{"cells", "work-precision", "convergence", "fluid", "ibm", "coupled"};

void require_known(const std::string& option, const std::string& word, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), word) == words.end())
    throw text::InputError(option + " \"" + word + "\" does not exist" + text::suggestion(word, words));
}

void require_range(const std::string& option, const std::vector<int>& values, int largest) {
  for (const int value : values) {
    if (value < 1 || value > largest)
      throw text::InputError(option + " " + std::to_string(value) + ": allowed are whole numbers from 1 to " +
                             std::to_string(largest));
  }
}

/// A file that could not be written in the end had better be found before the measurement.
void require_writable(const std::string& path) {
  if (path.empty()) return;
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw text::InputError("cannot write \"" + path + "\": there is no folder " + folder.string());
  if (std::filesystem::is_directory(path, error))
    throw text::InputError("cannot write \"" + path + "\": it is a folder");
  if (::access(folder.c_str(), W_OK) != 0)
    throw text::InputError("cannot write \"" + path + "\": no permission to write into " + folder.string());
}

void check(const BenchOptions& options) {
  require_known("--suite", options.suite, suites);
  for (const std::string& word : options.precisions) require_known("--precision", word, bench::precision_names);
  for (const int mesh : options.meshes) {
    if (mesh != 66 && mesh != 258 && mesh != 1026 && mesh != 4098)
      throw text::InputError("--mesh " + std::to_string(mesh) + ": allowed are 66, 258, 1026, 4098 (vertices)");
  }
  require_range("--batch", options.batches, 1000000);
  require_range("--threads", options.threads, 4096);
  if (!options.plot.empty() && options.suite != "work-precision")
    throw text::InputError("--plot is for --suite work-precision");
  if (options.suite != "cells" && !(options.meshes.empty() && options.batches.empty()))
    throw text::InputError("--mesh and --batch are for --suite cells");
  if ((options.suite == "convergence" || options.suite == "work-precision") && !options.threads.empty())
    throw text::InputError("--threads is for the suites cells, fluid, ibm and coupled");
  require_writable(options.json);
  require_writable(options.plot);
}

bench::Plan plan_of(const BenchOptions& options) {
  const auto chosen = [&](const std::vector<int>& given, std::vector<int> all, std::vector<int> few) {
    if (!given.empty()) return given;
    return options.quick ? few : all;
  };
  bench::Plan plan;
  plan.quick = options.quick;
  plan.meshes = chosen(options.meshes, {66, 258, 1026}, {66});
  plan.batches = chosen(options.batches, {1, 8, 64, 512, 4096}, {1, 64});
  std::vector<int> threads{1};
  if (bench::core_count() > 1) threads.push_back(bench::core_count());
  plan.threads = chosen(options.threads, threads, {1});
  for (const std::string& word : options.precisions) {
    const auto found = std::find(bench::precision_names.begin(), bench::precision_names.end(), word);
    plan.precisions.push_back(static_cast<int>(found - bench::precision_names.begin()));
  }
  if (plan.precisions.empty()) plan.precisions = options.quick ? std::vector<int>{0, 2} : std::vector<int>{0, 1, 2};
  return plan;
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

Json describe_run(const BenchOptions& options, const bench::FmaPeak& peak) {
  const Json build = Json::parse(api::text_of([](char* b, std::int32_t n) { return npfem_build_info(b, n); }));
  return {{"commit", NPFEM_COMMIT},
          {"version", build.at("version")},
          {"compiler", build.at("compiler")},
          {"machine",
           {{"cpu", bench::cpu_name()},
            {"cores", bench::core_count()},
            {"instruction_set", peak.instruction_set},
            {"peak_gflops_double", peak.double_gflops},
            {"peak_gflops_float", peak.float_gflops},
            {"load", bench::load_average()}}},
          {"suite", options.suite},
          {"date", date()}};
}

/// Five digits: a measurement has no more.
void round_numbers(Json& json) {
  if (json.is_number_float()) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.5g", json.get<double>());
    json = std::strtod(digits, nullptr);
  } else if (json.is_structured()) {
    for (Json& part : json) round_numbers(part);
  }
}

/// One line for each row of the results.
std::string to_text(const Json& report) {
  Json rounded = report;
  round_numbers(rounded);
  std::string text = "{\n";
  for (const auto& [key, value] : rounded.items()) {
    if (key == "results") continue;
    text += Json(key).dump() + ": " + value.dump() + ",\n";
  }
  text += "\"results\": [";
  for (std::size_t i = 0; i < rounded["results"].size(); ++i)
    text += (i == 0 ? "\n" : ",\n") + rounded["results"][i].dump();
  return text + "\n]\n}\n";
}

void warn_when_busy(double load) {
  // This program is one of those that want a core.
  if (load <= 1.5) return;
  char line[160];
  std::snprintf(
      line, sizeof line,
      "npfem: the machine is busy (load %.1f on %d cores): times of one thread are processor time and hold to "
      "some 30 %%, those of more threads do not",
      load, bench::core_count());
  bench::say(line);
}

int run_suite(const BenchOptions& options, Session& session) {
  catch_signals();
  bench::Plan plan = plan_of(options);
  plan.peak = bench::measure_fma_peak();
  Json report = describe_run(options, plan.peak);
  const double load_before = report["machine"]["load"].get<double>();
  std::printf("%s, %s: at most %.1f GFLOP/s per core in double, %.1f in float; load %.1f\n",
              report["machine"]["cpu"].get<std::string>().c_str(), plan.peak.instruction_set.c_str(),
              plan.peak.double_gflops, plan.peak.float_gflops, load_before);
  warn_when_busy(load_before);
  if (options.suite == "cells") report["results"] = bench::measure_cells(plan);
  if (options.suite == "convergence") report["results"] = bench::measure_convergence(plan);
  if (options.suite == "fluid") report["results"] = bench::measure_fluid(plan);
  if (options.suite == "ibm") report["results"] = bench::measure_ibm(plan);
  if (options.suite == "coupled") report["results"] = bench::measure_coupled(plan, session.communicator);
  if (options.suite == "work-precision") {
    report["results"] = bench::measure_work_precision(plan);
    report["recommended"] = bench::recommended(report["results"]);
  }
  report["machine"]["load_at_end"] = bench::load_average();
  warn_when_busy(bench::load_average());
  if (!options.plot.empty()) text::write_file(options.plot, bench::plot_work_precision(report["results"]));
  if (!options.json.empty()) text::write_file(options.json, to_text(report));
  return done;
}

/// What the other ranks do: a suite of several ranks needs them.
int run_beside(const BenchOptions& options, Session& session) {
  if (options.suite == "coupled") bench::measure_coupled(plan_of(options), session.communicator);
  return done;
}

}  // namespace

Action add_bench(CLI::App& program) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* command = program.add_subcommand("bench", "measure speed and error of cell solver, fluid and coupled runs");
  command->add_option("--suite", options->suite, "cells, convergence, work-precision, fluid, ibm or coupled")
      ->required();
  command->add_option("--json", options->json, "file for the results");
  command->add_option("--plot", options->plot, "file for the diagram of work-precision (SVG)");
  command->add_flag("--quick", options->quick, "a few rows only, in seconds");
  command->add_option("--mesh", options->meshes, "vertices: 66,258,1026")->delimiter(',');
  command->add_option("--batch", options->batches, "cells: 1,8,64,512,4096")->delimiter(',');
  command->add_option("--threads", options->threads, "threads: 1,2")->delimiter(',');
  command->add_option("--precision", options->precisions, "double,mixed,float")->delimiter(',');
  return [options](Session& session) {
    check(*options);
    try {
      if (!session.first()) return run_beside(*options, session);
      return run_suite(*options, session);
    } catch (const bench::Interrupted&) {
      std::cerr << "npfem: interrupted; nothing was written\n";
      return static_cast<int>(failed);
    }
  };
}

}  // namespace npfem::app
