#pragma once

#include <filesystem>

namespace wheatstone {

/// The folder of real photographs, films and snapshots that tests use where it is there; not part of the project.
std::filesystem::path shared_data();

}  // namespace wheatstone
