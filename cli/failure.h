#pragma once

#include <exception>

#include "wheatstone/ranks/ranks.h"

namespace wheatstone::cli {

/// What a run ends with after an exception: its exit code and the line that says why. Lack of memory has one line,
/// whoever says so: also a thread that cannot be started. What is no error of ours nor of the system is internal.
/// Null: a library gave up without an exception, because the system had no memory for its threads.
Ranks::Failure failure_of(const std::exception_ptr& thrown);

}  // namespace wheatstone::cli
