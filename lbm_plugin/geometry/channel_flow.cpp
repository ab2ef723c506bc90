// SPDX-License-Identifier: MPL-2.0
#include "geometry/channel_flow.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "geometry/section_flow.h"

namespace npfem::flow {
namespace {

/// A grid over the domain, as fine as the lattice or coarser: an estimate need not cost more than a few steps.
struct Sections {
  Sections(const Domain& its_domain, std::size_t along)
      : domain(its_domain), axis(along), u(along == 0 ? 1 : 0), v(along == 2 ? 1 : 2) {
    constexpr int most = 128;
    const int coarser = (*std::max_element(domain.nodes.begin(), domain.nodes.end()) + most - 1) / most;
    spacing = coarser * domain.dx;
    for (std::size_t a = 0; a < 3; ++a) counts[a] = std::max(1, domain.nodes[a] / coarser);
  }

  std::vector<bool> fluid(int number) const {
    std::vector<bool> open;
    for (int q = 0; q < counts[v]; ++q) {
      for (int p = 0; p < counts[u]; ++p) {
        Vec3 at{};
        at[axis] = (number + 0.5) * spacing;
        at[u] = (p + 0.5) * spacing;
        at[v] = (q + 0.5) * spacing;
        open.push_back(domain.wall_distance(at).distance > 0);
      }
    }
    return open;
  }

  SectionFlow flow(const std::vector<bool>& open) const {
    return section_flow(open, {counts[u], counts[v]}, {domain.periodic()[u], domain.periodic()[v]});
  }

  const Domain& domain;
  std::size_t axis, u, v;
  double spacing = 0;  // um
  std::array<int, 3> counts{};
};

}  // namespace

std::optional<ChannelFlow> channel_flow(const Domain& domain, std::size_t axis) {
  const Sections sections(domain, axis);
  const double h = sections.spacing;
  ChannelFlow whole{.narrowest_area = std::numeric_limits<double>::infinity()};
  std::vector<bool> open, before;
  SectionFlow flow{};
  for (int number = 0; number < sections.counts[axis]; ++number) {
    open = sections.fluid(number);
    if (open != before) flow = sections.flow(open);
    before = open;
    if (flow.nodes == 0) return std::nullopt;
    const double area = static_cast<double>(flow.nodes) * h * h;
    whole.widest_area = std::max(whole.widest_area, area);
    whole.narrowest_area = std::min(whole.narrowest_area, area);
    whole.resistance += h / (area * flow.mean * h * h);
    whole.fastest = std::max(whole.fastest, *std::max_element(flow.profile.begin(), flow.profile.end()) / area);
    whole.steepest = std::max(whole.steepest, flow.steepest / (h * area));
  }
  return whole;
}

}  // namespace npfem::flow
