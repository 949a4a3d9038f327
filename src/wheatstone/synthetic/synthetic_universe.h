#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/progress.h"

namespace wheatstone {

struct SyntheticUniverseOptions {
  std::uint64_t particles = 2'654'562;  ///< as many as Hassaine 2010 rendered
  double redshift = 0;                  ///< at least 0
  std::uint64_t seed = 1;
  double box_mpc_h = 100;  ///< side of the periodic box, in Mpc/h
  bool motion = false;     ///< the clouds also have IDs, from 1 on, and rates: changes in a unit of the scale factor
};

/// A universe of gas that was never simulated: a lattice displaced by the Zel'dovich approximation along a Gaussian
/// field with a cold-dark-matter spectrum (Bardeen et al. 1986; flat, Ωm = 0.31, σ8 = 0.8). The field is smoothed where
/// it has become non-linear (truncated Zel'dovich, Coles et al. 1993), so that filaments and knots stay thin. Positions
/// are in kpc/h, densities in 1e10 Msun/h a (kpc/h)³, as GADGET has them; temperature follows density, with shocks. The
/// field, of at most 256³ cells, is made once; particles then come chunk by chunk, however many.
class SyntheticUniverse {
 public:
  /// Throws Error{wrong_usage} where a number makes no sense, and what `progress` throws.
  explicit SyntheticUniverse(const SyntheticUniverseOptions& options, const Progress& progress = {});
  ~SyntheticUniverse();
  SyntheticUniverse(SyntheticUniverse&&) noexcept;
  SyntheticUniverse& operator=(SyntheticUniverse&&) noexcept;

  double box_size() const;            ///< in kpc/h
  double mass_of_a_particle() const;  ///< in 1e10 Msun/h
  /// The next particles, at most so many; an empty cloud at the end. The same bytes on any number of threads.
  Cloud next(std::size_t most);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a universe as a GADGET-4 snapshot, chunk by chunk. Throws as SyntheticUniverse and GadgetWriter do.
void write_synthetic_universe(const std::filesystem::path& file, const SyntheticUniverseOptions& options,
                              const Progress& progress = {});

/// All of it at once.
Cloud make_synthetic_universe(const SyntheticUniverseOptions& options, const Progress& progress = {});

}  // namespace wheatstone
