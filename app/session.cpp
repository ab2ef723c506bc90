// SPDX-License-Identifier: MPL-2.0
#include "session.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <vector>

#include "file.h"
#include "quantity.h"

namespace npfem::app {
namespace {

/// The message of bad input that `work` met; empty where there was none.
std::string bad_input_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const text::InputError& error) {
    return error.what();
  } catch (const text::FileError& error) {
    return error.what();
  } catch (const std::invalid_argument& error) {
    return error.what();
  } catch (const api::Failure& failure) {
    if (!is_bad_input(failure)) throw;
    return failure.what();
  }
  return "";
}

void share(Session& session, const std::string& message) {
  try {
    session.communicator.agree(message);
  } catch (const std::runtime_error& error) {
    throw text::InputError(error.what());
  }
}

}  // namespace

bool is_bad_input(const api::Failure& failure) {
  switch (failure.status()) {
    case NPFEM_ERROR_ARGUMENT:
    case NPFEM_ERROR_INPUT:
    case NPFEM_ERROR_NAME:
    case NPFEM_ERROR_IO:
    case NPFEM_ERROR_UNAVAILABLE:
      return true;
    default:
      return false;
  }
}

double share_on_this_machine(Session& session) {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  const flow::Bytes own(std::as_bytes(std::span(name)).begin(), std::as_bytes(std::span(name)).end());
  const std::vector<flow::Bytes> names = session.communicator.all_gather(own);
  return static_cast<double>(std::count(names.begin(), names.end(), own)) / static_cast<double>(names.size());
}

void on_all_ranks(Session& session, const std::function<void()>& work) {
  share(session, bad_input_of(work));
}

void on_first_rank(Session& session, const std::function<void()>& work) {
  share(session, session.first() ? bad_input_of(work) : "");
}

}  // namespace npfem::app
