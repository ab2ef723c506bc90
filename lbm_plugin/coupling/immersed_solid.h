// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "coupling/vertex_exchange.h"
#include "geometry/vec3.h"

namespace npfem::flow {

/// A cell whose last step failed on this rank. It keeps the state it had before that step.
struct LocalFailure {
  int id;
  int type;
  std::string reason;
};

/// What one step of the cell solver did on this rank.
struct CellStepReport {
  std::vector<LocalFailure> failures;
  std::int64_t cell_steps = 0;
  std::int64_t iterations = 0;
  double worst_residual = 0;  ///< pN, over the cells that did not fail
};

/// What a coupling asks of the bodies in a fluid: the cells of npfem (CellPopulation) or any other solid made of
/// vertices. Each rank has some of the bodies; to the coupling their vertices are flat arrays in order of (body,
/// vertex), in um, us, fg and pN. A step takes delta, which the solid knows.
///
/// Fields have the names they have in npfem.h. The coupling writes, one value per vertex and component,
///   ambient_velocity   u, of the fluid at the vertices,
///   external_force     of contacts, and contact_stiffness, by which those give way within the step,
/// and reads position, velocity, held_force, the force F on the fluid in the last step, and elastic_force, -dE/dx as of
/// the last evaluate(). A scheme that moves the vertices itself writes position and velocity, and held_force.
class ImmersedSolid {
 public:
  virtual ~ImmersedSolid() = default;

  /// The vertices on this rank.
  virtual std::span<const VertexId> vertices() const = 0;
  virtual void read(const char* field, std::vector<double>& values) const = 0;
  virtual void write(const char* field, std::span<const double> values) = 0;

  /// Mass of fluid (fg) that moves with each vertex, given their rest areas (um2).
  using MassOfAreas = std::function<std::vector<double>(std::span<const double> rest_areas)>;
  /// Lets the vertices carry that mass m_f, now and later, on whatever rank they are.
  virtual void carry_fluid(const MassOfAreas& mass) = 0;

  /// Elastic forces at the present positions.
  virtual void evaluate() = 0;
  /// The end of a step of delta is where m_s dv/dt + m_f (v - u)/delta + f_old = external force - dE/dx, f_old being
  /// the force held so far; then F = f_old + m_f (v - u)/delta is held, with v the new velocity. An approximate
  /// solution keeps momentum as long as the elastic forces that it has used add up to zero.
  virtual CellStepReport step() = 0;

  /// Whether vertices have mass m_s of their own, beside that of the fluid, and this rank's sum of m_s v, fg um/us.
  virtual bool has_solid_mass() const { return false; }
  virtual Vec3 solid_momentum() const { return {}; }
  /// This rank's sum of the loads on the vertices that the coupling does not know of, for example weight, pN: for the
  /// momentum audit alone.
  virtual Vec3 own_loads() const { return {}; }
};

/// visit(body, first, count) for every body among these vertices: its id and its range of them.
template <class Visit>
void for_each_body(std::span<const VertexId> vertices, Visit&& visit) {
  for (std::size_t first = 0, end = 0; first < vertices.size(); first = end) {
    while (end < vertices.size() && vertices[end].cell == vertices[first].cell) ++end;
    visit(vertices[first].cell, first, end - first);
  }
}

}  // namespace npfem::flow
