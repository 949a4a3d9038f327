#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "wheatstone/particles/cloud_source.h"

namespace wheatstone {

/// The number of a snapshot's particle type: gas, halo, disk, bulge, stars, bndry, or the number itself. Throws
/// Error{wrong_usage}.
int snapshot_type(const std::string& name);

/// All files of a snapshot in `count` parts, of which `path` is one: "snap.3.hdf5" stands beside "snap.0.hdf5". Throws
/// Error{bad_input} naming the first that is missing.
std::vector<std::filesystem::path> snapshot_files(const std::filesystem::path& path, int count);

/// Whether an open HDF5 file is a snapshot: it has groups PartType0 and so on.
bool is_snapshot_hdf5(std::int64_t file);

CloudSource open_gadget_hdf5(const std::filesystem::path& path, const CloudChoice& choice);

}  // namespace wheatstone
