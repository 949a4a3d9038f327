#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
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

/// What an HDF5 snapshot tells of its units: those of length, mass and velocity, h, and those of the datasets of a
/// group, in cgs with powers of the scale factor a and of h: "6.77e-22 g cm^-3 a^-3 h^2".
std::vector<std::pair<std::string, std::string>> snapshot_units(std::int64_t file, std::int64_t group);

/// The first attribute above 0 of these names, in any of the groups of an open HDF5 snapshot that tell of the whole.
std::optional<double> snapshot_number(std::int64_t file, std::initializer_list<const char*> names);

/// The unit of length of an open HDF5 snapshot in cm, and that of velocity in cm/s, which may be that of length over
/// that of time; nothing where it does not tell them.
std::optional<double> snapshot_length_cm(std::int64_t file);
std::optional<double> snapshot_velocity_cm_s(std::int64_t file, std::optional<double> length_cm);

/// When a snapshot was taken.
struct SnapshotTime {
  /// The scale factor of a universe that expands, else in the simulation's own unit; nothing where the header is
  /// silent.
  std::optional<double> time;
  /// What the velocities are multiplied by to become changes of position in a unit of that time.
  double rate_of_velocity = 1;
};

/// Whether a snapshot's time is the scale factor of a universe that expands, as GADGET has it; the headers of others
/// have a redshift, too.
inline bool is_scale_factor(double time, double redshift) { return std::abs(time * (1 + redshift) - 1) < 1e-3; }

/// As an open HDF5 snapshot tells it in its header and in the attributes of its datasets, which `group` holds.
SnapshotTime snapshot_time(std::int64_t file, std::int64_t group);

/// Opens the types of CloudChoice::type_colours as one cloud. Throws as open_cloud.
CloudSource open_types(const std::filesystem::path& path, const CloudChoice& choice);

CloudSource open_gadget_hdf5(const std::filesystem::path& path, const CloudChoice& choice);

}  // namespace wheatstone
