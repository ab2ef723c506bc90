// SPDX-License-Identifier: MPL-2.0
// Another solid in this fluid: a sphere of point masses and springs sinks through a periodic box of water, held up by
// nothing but the drag, which is compared with that in an array of spheres (Hasimoto, J. Fluid Mech. 5 (1959) 317).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "communicator/serial_communicator.h"
#include "coupling/coupling.h"
#include "coupling/fluid_link.h"
#include "geometry/vec3.h"
#include "simulation/start.h"

using namespace npfem::flow;
namespace {
constexpr double radius = 4, dx = 1, delta = 0.5;         // um, us
constexpr double density = 1000, viscosity = 1;           // fg/um3, um2/us: water
constexpr double stiffness = 100, mass = 20, weight = 1;  // of a spring pN/um; of all vertices: fg, pN
constexpr int box = 32;                                   // um

// Vertices on a sphere, each joined to its neighbours and to the one opposite.
class Springs final : public ImmersedSolid {
 public:
  explicit Springs(std::vector<double> start) : count_(start.size() / 3) {
    for (std::size_t a = 0; a < count_; ++a) {
      for (std::size_t b = a + 1; b < count_; ++b) {
        const double length = distance(a, b, start);
        if (length < 0.2 * radius || length > 1.999 * radius) springs_.push_back({a, b, length});
      }
      vertices_.push_back({0, static_cast<int>(a)});
    }
    for (double& x : start) x += 0.5 * box + 0.2;
    for (const char* field : {"velocity", "held_force", "elastic_force"}) fields_[field].assign(start.size(), 0.0);
    fields_["position"] = std::move(start);
  }

  std::span<const VertexId> vertices() const override { return vertices_; }
  void read(const char* field, std::vector<double>& values) const override { values = fields_.at(field); }
  void write(const char* field, std::span<const double> values) override {
    fields_[field].assign(values.begin(), values.end());
  }
  void carry_fluid(const MassOfAreas& mass_of) override {
    const double share = 4 * std::numbers::pi * radius * radius / static_cast<double>(count_);
    fluid_mass_ = mass_of(std::vector(count_, share));
  }
  void evaluate() override { add_spring_forces(fields_["position"], fields_["elastic_force"]); }
  bool has_solid_mass() const override { return true; }
  Vec3 solid_momentum() const override { return scale(mass, mean("velocity")); }
  Vec3 own_loads() const override { return {0, 0, -weight}; }

  // With the springs as they are at x_n: soft enough for that, 16 k delta^2 < m_f.
  CellStepReport step() override {
    evaluate();
    const double own = mass / static_cast<double>(count_);
    auto &x = fields_["position"], &v = fields_["velocity"], &held = fields_["held_force"];
    const auto &u = fields_["ambient_velocity"], &elastic = fields_["elastic_force"], &load = fields_["external_force"];
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double carried = fluid_mass_[i / 3];
      const double outer = load[i] + elastic[i] - (i % 3 == 2 ? weight / static_cast<double>(count_) : 0);
      v[i] = (own * v[i] + carried * u[i] + delta * (outer - held[i])) / (own + carried);
      held[i] += carried * (v[i] - u[i]) / delta;
      x[i] += delta * v[i];
    }
    return {.failures = {}, .cell_steps = 1};
  }

  Vec3 mean(const char* field) const {
    Vec3 sum{};
    for (std::size_t i = 0; i < 3 * count_; ++i) sum[i % 3] += fields_.at(field)[i];
    return scale(1.0 / static_cast<double>(count_), sum);
  }
  double strain() const {  // the largest, of all springs
    double worst = 0;
    for (const auto& [a, b, rest] : springs_) {
      worst = std::max(worst, std::abs(distance(a, b, fields_.at("position")) / rest - 1));
    }
    return worst;
  }

 private:
  struct Spring {
    std::size_t a, b;
    double rest;
  };
  static Vec3 between(std::size_t a, std::size_t b, const std::vector<double>& x) {
    return {x[3 * b] - x[3 * a], x[3 * b + 1] - x[3 * a + 1], x[3 * b + 2] - x[3 * a + 2]};
  }
  static double distance(std::size_t a, std::size_t b, const std::vector<double>& x) { return norm(between(a, b, x)); }
  void add_spring_forces(const std::vector<double>& x, std::vector<double>& force) const {
    std::fill(force.begin(), force.end(), 0.0);
    for (const auto& [a, b, rest] : springs_) {
      const Vec3 d = between(a, b, x);
      const Vec3 pull = scale(stiffness * (1 - rest / norm(d)), d);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        force[3 * a + axis] += pull[axis];
        force[3 * b + axis] -= pull[axis];
      }
    }
  }

  std::size_t count_;
  std::vector<Spring> springs_;
  std::vector<VertexId> vertices_;
  std::map<std::string, std::vector<double>> fields_;
  std::vector<double> fluid_mass_;
};
}  // namespace

int main() {
  const auto mesh = npfem::api::Mesh::generate("icosphere", 3, 2 * radius);
  std::vector<double> positions(3 * static_cast<std::size_t>(mesh.vertices()));
  npfem::api::check(npfem_mesh_get_positions(mesh.handle(), positions.data(), static_cast<int>(positions.size())));
  Springs sphere(positions);
  Setup setup;
  setup.domain.nodes = {box, box, box};
  setup.domain.dx = dx;
  setup.time_step = delta;
  setup.density = density;
  setup.kinematic_viscosity = viscosity;
  setup.body_force = {0, 0, weight / (box * box * box)};  // so that the whole stays where it is
  const Units units{dx, delta, density};
  SerialCommunicator self;
  LatticeOptions options = lattice_options(setup, units);
  options.node_force = true;
  Lattice lattice(self, {setup.domain.nodes, setup.domain.periodic(), 1}, lattice_geometry(setup.domain, units),
                  options);
  MomentumAudit audit;
  FluidLink fluid(setup, units, self, lattice, audit);
  const auto coupling = Coupling::create(setup, sphere, fluid);

  coupling->hold_present_forces();
  audit.start(lattice);
  for (int step = 0; step < 600; ++step) coupling->advance();
  lattice.update_velocity();
  const double mean_flow = lattice.momentum()[2] * units.velocity() / (box * box * box);
  const double speed = mean_flow - sphere.mean("velocity")[2];  // um/us, down
  const double a = radius + 0.64 * dx;  // the kernel's width drags too: so much with radius 3 in a box of 18 um
  const double c = 4.0 / 3.0 * std::numbers::pi * std::pow(a / box, 3);
  const double array = 1 / (1 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c);
  const double ratio = weight / (6 * std::numbers::pi * density * viscosity * a * array * speed);
  const double momentum = audit.error(lattice, self);
  std::printf("speed %.4g um/s, drag over Hasimoto's %.3f, strain %.1e, momentum error %.1e\n", 1e6 * speed, ratio,
              sphere.strain(), momentum);
  return std::abs(ratio - 1) < 0.02 && sphere.strain() < 0.02 && momentum < 1e-10 ? 0 : 1;
}
