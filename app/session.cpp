// SPDX-License-Identifier: MPL-2.0
#include "session.h"

#include <stdexcept>

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

void on_all_ranks(Session& session, const std::function<void()>& work) {
  share(session, bad_input_of(work));
}

void on_first_rank(Session& session, const std::function<void()>& work) {
  share(session, session.first() ? bad_input_of(work) : "");
}

}  // namespace npfem::app
