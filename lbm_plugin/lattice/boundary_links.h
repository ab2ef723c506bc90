// SPDX-License-Identifier: MPL-2.0
#pragma once

// What happens to the populations that leave the fluid, link by link.
//
//   velocity   half-way bounce-back, moving walls after Ladd (1994): the population returns with 6 w_i (c_i . u)
//              subtracted. An inlet is a wall through which fluid is pushed;
//   pressure   anti-bounce-back (Ginzburg, Verhaeghe & d'Humieres 2008, Commun. Comput. Phys. 3, 427): the population
//              returns with its sign changed and  2 e_i + (2 - 1/tau) n_i  added, e_i the even part of the equilibrium
//              at the given density and the velocity of the node, n_i the even part of its departure from equilibrium:
//              fluid passes, the pressure is the given one, and the viscous stress is left as it is. In a developed
//              flow through the face, whose stress changes along the diagonal links, the pressure is met at the last
//              node, half a node spacing inside the face.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice/geometry.h"
#include "lattice/kernels.h"
#include "lattice/node_map.h"

namespace npfem::flow {

class BoundaryLinks {
 public:
  BoundaryLinks(const NodeMap& nodes, const Geometry& geometry);

  // Multiplies velocity or density deviation of one boundary from now on: what varies in time.
  void set_factor(int boundary, double factor) { factors_[static_cast<std::size_t>(boundary)] = factor; }

  double factor(int boundary) const { return factors_[static_cast<std::size_t>(boundary)]; }

  // Before the collision of the step that `fields` describes: what pressure faces need to know of it.
  template <class Real>
  void look_ahead(const FluidFields<Real>& fields);
  // After it: turns round what has left the fluid.
  template <class Real>
  void turn_back(const FluidFields<Real>& fields);

  // Momentum given to the fluid by the boundaries in the last step: for each link -c_i (leaving + returning). The
  // pressure of the density 1 is left out: it sums to zero over all links of all ranks.
  const Vec3& impulse() const { return impulse_; }
  // visit(boundary, direction towards it, population that has come back, 6 w_i c_i . u) for every velocity link of the
  // step just done; the step to come is `odd_step`.
  template <class Real, class Visit>
  void for_each_returned(const Real* populations, bool odd_step, Visit visit) const {
    for (const Link& link : links_) {
      // What waits for its node lies where nodes look for it: upwards links at the far place, the others at the near
      // one.
      const bool up = link.direction % 2 == 1;
      const Real returned = populations[link.near_even + (up ? far_shift(odd_step) : near_shift(odd_step))];
      visit(link.boundary, link.direction, double{returned}, link.term * factor(link.boundary));
    }
  }
  int boundaries() const { return static_cast<int>(factors_.size()); }

 private:
  // From a fluid node along direction i to a node that is not. The pair of populations of a link has its two places at
  // one end of it (kernels.h): the leaving one is found in one of them, and is expected back in the other.
  struct Link {
    std::ptrdiff_t near_even;  // index of the near place in even steps
    std::int32_t direction;
    std::int32_t boundary;
    double term;  // at factor 1: 6 w_i c_i . u of a velocity link, rho - 1 of a pressure link
  };
  struct PressureLink {
    Link link;
    NodeNumber node;
    std::array<NodeNumber, 9> far_nodes;  // x + c_i for the nine pairs: they keep half of its populations
    double added;                         // to the reversed population in this step
  };
  struct Plane {
    std::size_t first_link, first_pressure_link;
  };

  void add_link(const NodeMap& nodes, const Geometry& geometry, const Index3& node, int direction);
  template <class Real>
  void turn_back_plane(const FluidFields<Real>& fields, std::size_t plane);

  std::vector<Link> links_;
  std::vector<PressureLink> pressure_links_;
  std::vector<Plane> planes_;  // of constant z, and one more behind the last
  std::vector<double> factors_;
  std::vector<Vec3> plane_impulses_;  // by plane of constant z: added up in that order
  Vec3 impulse_{};
};

}  // namespace npfem::flow
