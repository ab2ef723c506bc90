// SPDX-License-Identifier: MPL-2.0
#include "immersed_boundary/transfer_loops.h"
