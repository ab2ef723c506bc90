// SPDX-License-Identifier: MPL-2.0
// Compiles every energy of the library into a kernel, in double and in float: proof that the physics needs no second
// text for a GPU.
#include "energies/energy_list.h"
#include "energies/membrane_viscosity.h"

namespace npfem {

template <class E, class R>
__global__ void element_kernel(const Vec3<R>* x, const typename E::template Rest<R>* rest,
                               const typename E::template Params<R>* params, Vec3<R>* gradient, R* energy) {
  const int e = blockIdx.x * blockDim.x + threadIdx.x;
  Vec3<R> corner[E::num_vertices], slope[E::num_vertices];
  for (int i = 0; i < E::num_vertices; ++i) corner[i] = x[E::num_vertices * e + i];
  energy[e] = E::energy_gradient(corner, rest[e], params[e], slope);
  for (int i = 0; i < E::num_vertices; ++i) gradient[E::num_vertices * e + i] = slope[i];
}

template <class G, class R>
__global__ void group_kernel(const Vec3<R>* x, const int* offsets, const typename G::template Rest<R>* rest,
                             const typename G::template Params<R>* params, Vec3<R>* gradient, R* energy) {
  const int g = blockIdx.x * blockDim.x + threadIdx.x;
  const int begin = offsets[g], count = offsets[g + 1] - begin;
  energy[g] = G::energy_gradient(x + begin, count, rest[g], params[g], gradient + begin);
}

template <class E, class R>
__global__ void cell_kernel(const CellSums<R>* sums, const CellRest<R>* rest,
                            const typename E::template Params<R>* params, CellResponse<R>* response) {
  const int c = blockIdx.x * blockDim.x + threadIdx.x;
  response[c] = E::respond(sums[c], rest[c], params[c]);
}

template <class R>
__global__ void viscosity_kernel(const Vec3<R>* x, const Vec3<R>* last_move, const Vec3<R>* move, const R* past,
                                 const MembraneViscosity::Params<R>* per_time, Vec3<R>* gradient) {
  const int e = 3 * (blockIdx.x * blockDim.x + threadIdx.x);
  const Vec3<R> corner[3] = {x[e], x[e + 1], x[e + 2]};
  const Vec3<R> last[3] = {last_move[e], last_move[e + 1], last_move[e + 2]};
  const Vec3<R> step[3] = {move[e], move[e + 1], move[e + 2]};
  Vec3<R> slope[3];
  MembraneViscosity::energy_gradient(step, MembraneViscosity::start(corner, last, *past), *per_time, slope);
  for (int i = 0; i < 3; ++i) gradient[e + i] = slope[i];
}

/// Names each kernel, which makes the compiler produce its device code.
template <class... Es>
void element_kernels(TypeList<Es...>, const void** kernels) {
  ((*kernels++ = reinterpret_cast<const void*>(&element_kernel<Es, double>)), ...);
  ((*kernels++ = reinterpret_cast<const void*>(&element_kernel<Es, float>)), ...);
}
template <class... Gs>
void group_kernels(TypeList<Gs...>, const void** kernels) {
  ((*kernels++ = reinterpret_cast<const void*>(&group_kernel<Gs, double>)), ...);
  ((*kernels++ = reinterpret_cast<const void*>(&group_kernel<Gs, float>)), ...);
}
template <class... Es>
void cell_kernels(TypeList<Es...>, const void** kernels) {
  ((*kernels++ = reinterpret_cast<const void*>(&cell_kernel<Es, double>)), ...);
  ((*kernels++ = reinterpret_cast<const void*>(&cell_kernel<Es, float>)), ...);
}

void all_kernels(const void** kernels) {
  element_kernels(ElementEnergies{}, kernels);
  group_kernels(GroupEnergies{}, kernels);
  cell_kernels(CellEnergies{}, kernels);
  *kernels++ = reinterpret_cast<const void*>(&viscosity_kernel<double>);
  *kernels++ = reinterpret_cast<const void*>(&viscosity_kernel<float>);
}

}  // namespace npfem
