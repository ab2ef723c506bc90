// SPDX-License-Identifier: MPL-2.0
// Asks the immersed boundary, without a scene, what its kernels keep and how they drag. Prints JSON numbers, lattice
// units.
//
//   validate_immersed_boundary kernel POINTS
//   validate_immersed_boundary drag POINTS RADIUS BOX TAU INSET
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "coupling/surface_inset.h"
#include "flows.h"
#include "geometry/vec3.h"
#include "immersed_boundary/immersed_boundary.h"

namespace npfem::flow {
namespace {

/// A periodic lattice with vertices at random places in its middle, where positions need no unwrapping.
class KernelProbe {
 public:
  explicit KernelProbe(int points)
      : split_({12, 10, 9}, {true, true, true}, 1),
        lattice_(self_, split_, flows::periodic(), {}),
        boundary_(points, lattice_) {
    for (int v = 0; v < count_; ++v) {
      const Vec3 position = add({6, 5, 4.5}, flows::random_vector(v, 1, 2.0)), force = flows::random_vector(v, 2, 1.0);
      positions_.insert(positions_.end(), position.begin(), position.end());
      forces_.insert(forces_.end(), force.begin(), force.end());
    }
    all_.resize(static_cast<std::size_t>(count_));
    std::iota(all_.begin(), all_.end(), 0);
    velocities_.resize(positions_.size());
  }

  /// Largest difference of the interpolated velocity from a flow that is linear in space.
  double error_in(const Vec3& uniform, double rate) {
    lattice_.initialise([&](int, int iy, int) { return FluidState{0, add(uniform, {rate * (iy + 0.5), 0, 0})}; });
    interpolate();
    double worst = 0;
    for (std::size_t v = 0; v < all_.size(); ++v) {
      const Vec3 exact = add(uniform, {rate * positions_[3 * v + 1], 0, 0});
      for (std::size_t a = 0; a < 3; ++a) worst = std::max(worst, std::abs(velocities_[3 * v + a] - exact[a]));
    }
    return worst;
  }

  struct Defects {
    double force = 0, torque = 0, power = 0;
  };
  /// What spreading changes: total force and torque about the origin over the sum of their sizes; power of the node
  /// forces in a random flow against that of the vertices.
  Defects defects() {
    lattice_.initialise([this](int ix, int iy, int iz) {
      return FluidState{0, flows::random_vector(split_.global_id(ix, iy, iz), 7, 0.1)};
    });
    interpolate();
    lattice_.clear_force();
    boundary_.spread(positions_, forces_);
    Vec3 force{}, torque{};
    double power = 0, forces = 0, torques = 0, powers = 0;
    lattice_.nodes().for_each_fluid_node([&](int ix, int iy, int iz) {
      const Vec3 f = lattice_.force_at(ix, iy, iz);
      force = add(force, f);
      torque = add(torque, cross({ix + 0.5, iy + 0.5, iz + 0.5}, f));
      power += dot(f, lattice_.velocity_at(ix, iy, iz));
    });
    for (std::size_t v = 0; v < all_.size(); ++v) {
      const Vec3 f = at(forces_, v), moment = cross(at(positions_, v), f);
      const double work = dot(f, at(velocities_, v));
      force = subtract(force, f);
      torque = subtract(torque, moment);
      power -= work;
      forces += norm(f);
      torques += norm(moment);
      powers += std::abs(work);
    }
    return {norm(force) / forces, norm(torque) / torques, std::abs(power) / powers};
  }

 private:
  static Vec3 at(const std::vector<double>& xyz, std::size_t v) { return {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]}; }
  void interpolate() {
    lattice_.update_velocity();
    boundary_.interpolate(positions_, all_, velocities_);
  }

  const int count_ = 1000;
  SerialCommunicator self_;
  Decomposition split_;
  Lattice lattice_;
  ImmersedBoundary boundary_;
  std::vector<double> positions_, forces_, velocities_;
  std::vector<int> all_;
};

void kernel(int points) {
  KernelProbe probe(points);
  const double uniform = probe.error_in({0.01, -0.02, 0.03}, 0) / 0.03;
  const double shear = probe.error_in({}, 0.01) / 0.1;
  const KernelProbe::Defects defects = probe.defects();
  std::printf(
      "{\"uniform_flow\": %.17g, \"shear_flow\": %.17g, \"force\": %.17g, \"torque\": %.17g, \"power\": %.17g}\n",
      uniform, shear, defects.force, defects.torque, defects.power);
}

/// F / (mu U) of a sphere in a periodic cubic box: a surface of vertices under uniform traction, the fluid holds the
/// opposite body force; U relative to the fluid as a whole. Fluid and sphere meet `inset`
/// times the excess of the kernel under the vertices; scenes have 1.
void drag(int points, double radius, int box, double tau, double inset) {
  SerialCommunicator self;
  const double total_force = 1e-4, volume = std::pow(box, 3);
  Lattice lattice(self, Decomposition({box, box, box}, {true, true, true}, 1), flows::periodic(),
                  {tau, 3.0 / 16.0, {0, 0, -total_force / volume}});
  ImmersedBoundary boundary(points, lattice);

  flow::Setup setup;
  setup.types = {capsules::capsule("icosphere", 3, radius, capsules::neo_hookean(1))};
  setup.cells = {CellStart{}};
  const CellType& sphere = setup.types[0];
  const std::vector<double> area = sphere.model->get("rest_area");
  const double whole = std::accumulate(area.begin(), area.end(), 0.0);
  std::vector<double> positions = sphere.shape, forces(positions.size()), velocities(positions.size());
  for (double& x : positions) x += 0.5 * box + 0.21;  // not a place of symmetry among the nodes
  for (std::size_t v = 0; v < area.size(); ++v) forces[3 * v + 2] = total_force * area[v] / whole;
  std::vector<int> all(area.size());
  std::iota(all.begin(), all.end(), 0);

  std::vector<VertexId> ids;
  for (std::size_t v = 0; v < area.size(); ++v) ids.push_back({0, static_cast<int>(v)});
  SurfaceInset surface(setup, inset * kernel_excess(points));
  const auto placed = surface.place(ids, positions);
  const std::vector<double> markers(placed.begin(), placed.end());
  surface.to_markers(forces);

  lattice.clear_force();
  boundary.spread(markers, forces);
  const double viscous_time = box * box / (4 * std::numbers::pi * std::numbers::pi * lattice.viscosity());
  for (int i = 0; i < 10 * viscous_time; ++i) lattice.step();

  lattice.update_velocity();
  boundary.interpolate(markers, all, velocities);
  surface.to_vertices(velocities);
  double speed = -lattice.momentum()[2] / volume;
  for (std::size_t v = 0; v < area.size(); ++v) speed += velocities[3 * v + 2] * area[v] / whole;
  std::printf("{\"force_over_viscosity_speed\": %.17g}\n", total_force / (lattice.viscosity() * speed));
}

int run(int count, char** words) {
  const std::string what = count > 1 ? words[1] : "";
  if (what == "kernel" && count == 3) {
    kernel(std::stoi(words[2]));
  } else if (what == "drag" && count == 7) {
    drag(std::stoi(words[2]), std::stod(words[3]), std::stoi(words[4]), std::stod(words[5]), std::stod(words[6]));
  } else {
    std::fputs("validate_immersed_boundary kernel POINTS | drag POINTS RADIUS BOX TAU INSET\n", stderr);
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace npfem::flow

int main(int count, char** words) {
  try {
    return npfem::flow::run(count, words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "validate_immersed_boundary: %s\n", error.what());
    return 2;
  }
}
