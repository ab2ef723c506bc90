/* SPDX-License-Identifier: MPL-2.0 */
/* The public headers stand alone and are C99. */
#include "npfem/npfem.h"
#include "npfem/shapeop.h"

int main(void) {
  return npfem_abi_version() == 1 ? 0 : 1;
}
