#pragma once

#include <optional>

namespace wheatstone::viewer {

struct HeadFilterOptions {
  double smoothing_s = 0.1;  ///< time constant of a head that rests; 0: none
  double prediction_s = 0;   ///< how far ahead the position is told
  friend bool operator==(const HeadFilterOptions&, const HeadFilterOptions&) = default;
};

/// Steadies a measured position without lagging behind one that moves: the one-euro filter (Casiez et al., CHI 2012),
/// whose time constant falls with speed, and what the speed makes of the position some time ahead.
class HeadFilter {
 public:
  /// The position, in eye separations, that is measured at a time, which never goes back. Returns the steadied one.
  double add(double position, double time_s, const HeadFilterOptions& options);
  void forget() { before_.reset(); }

 private:
  struct Measured {
    double time_s, position, steadied, speed;
  };
  std::optional<Measured> before_;
};

}  // namespace wheatstone::viewer
