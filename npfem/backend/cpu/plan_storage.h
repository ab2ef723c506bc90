// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "backend/cpu/cell_plan.h"
#include "model/model.h"

namespace npfem::cpu {

/// Owns what a CellPlan points to: the model's numbers in type R, its vertices renumbered.
template <class R>
class PlanStorage {
 public:
  /// `order[k]`: the model's vertex that the kernels know as k.
  PlanStorage(const Model& model, std::span<const int> order);
  PlanStorage(const PlanStorage&) = delete;
  PlanStorage& operator=(const PlanStorage&) = delete;

  const CellPlan<R>& plan() const { return plan_; }

 private:
  template <class E>
  void add_membrane(const Model& model, std::span<const int> place);
  template <class E>
  void add_elements(const Model& model, std::span<const int> place);
  template <class G>
  void add_groups(const Model& model, std::span<const int> place);
  template <class T>
  T* keep(std::vector<T> values);

  std::vector<int> rank_;  // of each of the model's vertices on a walk over the surface
  CellPlan<R> plan_;
  std::vector<TriangleGroup<MembraneEnergies, R>> groups_;
  std::deque<std::shared_ptr<void>> kept_;
};

extern template class PlanStorage<double>;
extern template class PlanStorage<float>;

}  // namespace npfem::cpu
