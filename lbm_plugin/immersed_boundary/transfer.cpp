// SPDX-License-Identifier: MPL-2.0
#include "immersed_boundary/transfer.h"

#include <type_traits>

namespace npfem::flow {

namespace baseline {
const Transfer<double>* double_transfers();
const Transfer<float>* float_transfers();
}  // namespace baseline
#ifdef NPFEM_X86_KERNELS
namespace avx2 {
const Transfer<double>* double_transfers();
const Transfer<float>* float_transfers();
}  // namespace avx2
namespace avx512 {
const Transfer<double>* double_transfers();
const Transfer<float>* float_transfers();
}  // namespace avx512
#endif

NodeTable::NodeTable(const Decomposition& decomposition, const NodeMap& nodes)
    : strips(nodes.row(-NodeMap::kHalo, -NodeMap::kHalo)),
      row(static_cast<std::ptrdiff_t>(nodes.strips_per_row())),
      plane(row * (nodes.size(1) + 2 * NodeMap::kHalo)) {
  for (int axis = 0; axis < 3; ++axis) {
    begin[axis] = nodes.own().begin[static_cast<std::size_t>(axis)];
    size[axis] = nodes.size(axis);
    period[axis] = decomposition.periodic(axis) ? decomposition.nodes()[static_cast<std::size_t>(axis)] : 0;
  }
}

namespace {

template <class Real>
const Transfer<Real>* choose(const Transfer<double>* of_double, const Transfer<float>* of_float) {
  if constexpr (std::is_same_v<Real, double>) {
    return of_double;
  } else {
    return of_float;
  }
}

template <class Real>
const Transfer<Real>* transfers_of(InstructionSet instruction_set) {
#ifdef NPFEM_X86_KERNELS
  switch (instruction_set) {
    case InstructionSet::avx512:
      return choose<Real>(avx512::double_transfers(), avx512::float_transfers());
    case InstructionSet::avx2:
      return choose<Real>(avx2::double_transfers(), avx2::float_transfers());
    case InstructionSet::baseline:
      break;
  }
#endif
  return choose<Real>(baseline::double_transfers(), baseline::float_transfers());
}

}  // namespace

template <class Real>
const Transfer<Real>& transfer(InstructionSet instruction_set, int points) {
  return transfers_of<Real>(instruction_set)[points - 2];
}

template const Transfer<double>& transfer<double>(InstructionSet, int);
template const Transfer<float>& transfer<float>(InstructionSet, int);

}  // namespace npfem::flow
