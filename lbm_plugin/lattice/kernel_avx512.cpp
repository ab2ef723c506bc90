// SPDX-License-Identifier: MPL-2.0
#include "lattice/kernel/kernel_table.h"
