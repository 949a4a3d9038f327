#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "wheatstone/particles/cloud.h"

namespace wheatstone {

/// What a snapshot's header says.
struct SnapshotHeader {
  std::uint64_t particles = 0;
  double box_size = 0;  ///< kpc/h
  double redshift = 0;
  double mass_of_a_particle = 0;  ///< 1e10 Msun/h
  bool motion = false;            ///< also IDs and velocities, of a flat universe of cosmology.h
};

/// Writes gas as a GADGET-4 HDF5 snapshot, chunk by chunk: position, density, internal energy from temperature, and
/// smoothing length, each one block of the file. The file appears when it is committed.
class GadgetWriter {
 public:
  /// Throws Error{cannot_read_write}.
  GadgetWriter(const std::filesystem::path& path, const SnapshotHeader& header);
  ~GadgetWriter();
  GadgetWriter(GadgetWriter&&) noexcept;
  GadgetWriter& operator=(GadgetWriter&&) noexcept;

  /// The cloud has density, temperature and smoothing length; with motion IDs, and rates for a scale factor. Throws
  /// Error{cannot_read_write}.
  void add(const Cloud& cloud);
  /// All particles of the header have been added. Throws Error{cannot_read_write}.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wheatstone
