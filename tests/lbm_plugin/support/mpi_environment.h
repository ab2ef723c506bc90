// SPDX-License-Identifier: MPL-2.0
#pragma once

// Tests that run on any number of ranks: every rank runs every test, and the run fails if one rank fails.

#include "communicator/communicator.h"

npfem::flow::Communicator& world();
