// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/kernel/kernel_table.h"
