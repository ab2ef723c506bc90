// SPDX-License-Identifier: MPL-2.0
// The public headers stand alone and are C++.
#include "npfem/npfem.h"
#include "npfem/npfem.hpp"
#include "npfem/shapeop.h"

int main() {
  return npfem::api::Mesh::generate("sphere", 2).vertices() == 66 ? 0 : 1;
}
