#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

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

/// Where a head is and where it looks, as OpenTrack's output "UDP over network" tells it.
struct HeadPose {
  double x_cm = 0, y_cm = 0, z_cm = 0;  ///< to the right, up, away from the screen
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

/// A packet is these six numbers, little-endian, in this order; none where it has another size or a number is not
/// finite.
std::optional<HeadPose> parse_opentrack(std::span<const std::byte> packet);

/// Receives a head's position from OpenTrack or whatever speaks like it.
class HeadTracker {
 public:
  /// Listens on a UDP port, from any machine; 0: one that is free. Throws Error{cannot_read_write} where it is taken.
  explicit HeadTracker(std::uint16_t port);
  ~HeadTracker();
  HeadTracker(const HeadTracker&) = delete;
  HeadTracker& operator=(const HeadTracker&) = delete;

  std::uint16_t port() const { return port_; }
  /// The steadied position to the right of the middle, in eye separations, from all that has arrived; none where
  /// nothing has. Does not block.
  std::optional<float> newest(double now_s, const HeadFilterOptions& options);
  /// How far from the screen the last position lies behind the one that the tracker was centred at, in cm; 0 where
  /// nothing has arrived. Not steadied.
  double farther_cm() const { return farther_cm_; }
  /// Nothing has come for a second, or ever.
  bool is_silent(double now_s) const;

 private:
  int descriptor_ = -1;
  std::uint16_t port_ = 0;
  HeadFilter filter_;
  std::optional<double> heard_at_s_;
  double farther_cm_ = 0;
};

}  // namespace wheatstone::viewer
