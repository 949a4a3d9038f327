#pragma once

#include <optional>

#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// What mpirun says to each of the processes that it starts.
struct Launch {
  int rank = 0;
  int count = 1;
};

/// Of this process; nothing where it was started without mpirun.
std::optional<Launch> mpi_launch();

/// All processes of the launch; alone where there is one. Called once. The last copy of the result ends MPI.
/// Throws Error{cannot_read_write} where the program has no module for MPI, or it cannot be loaded.
Ranks start_ranks(const Launch& launch);

}  // namespace wheatstone
