// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>

namespace npfem::flow {

/// view.py, which lies in every output folder: shows the run in ParaView, cells by type and a slice of the fluid. It
/// names no path but those beside it, so that the folder can be moved.
std::string view_script();

}  // namespace npfem::flow
