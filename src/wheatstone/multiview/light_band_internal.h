#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "wheatstone/multiview/splat_internal.h"

namespace wheatstone {

/// Light on a band of scan lines, with a margin on either side into which splats may spill. A pixel has four channels,
/// red, green, blue and, where splats absorb, how much, or of mass two (channels_in). Four or eight pixels are a cache
/// line.
class LightBand {
 public:
  static constexpr int margin = 48;  ///< the widest splat, and a vector
  static constexpr int most_channels = 4;

  LightBand() = default;
  /// Bands that are written in turn lie at different places within a page (see `friendly`). `number` tells them apart.
  LightBand(int left, int right, int rows, int channels, int number = 0)
      : left_(left),
        right_(right),
        rows_(rows),
        channels_(channels),
        lines_a_row_(friendly(((right - left + 2 * margin) * channels + 15) / 16)),
        first_line_(number % 8 * 8 + number % 2 * 4),
        lines_(static_cast<std::size_t>(lines_a_row_) * rows + first_line_) {}

  int left() const { return left_; }
  int right() const { return right_; }
  int rows() const { return rows_; }
  int channels() const { return channels_; }
  int width_with_margins() const { return lines_a_row_ * 16 / channels_; }                  ///< a multiple of 16
  std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(lines_a_row_) * 16; }  ///< floats a row
  /// Column `left()` of a row; columns from −margin to width + margin may be written. Aligned as cache lines are.
  float* row(int row) {
    return lines_[static_cast<std::size_t>(row) * lines_a_row_ + first_line_].values +
           std::ptrdiff_t{margin} * channels_;
  }
  const float* row(int row) const { return const_cast<LightBand*>(this)->row(row); }
  void darken() {
    if (lit_) std::ranges::fill(lines_, Line{});
    lit_ = false;
  }
  /// The light of a band of the same rows and columns.
  void add(const LightBand& band) {
    if (!band.lit_) return;
    const std::size_t lines = static_cast<std::size_t>(lines_a_row_) * rows_;
    for (std::size_t line = 0; line < lines; ++line)
      for (int i = 0; i < 16; ++i)
        lines_[first_line_ + line].values[i] += band.lines_[band.first_line_ + line].values[i];
    lit_ = true;
  }
  /// All that is stored, for a band of the same shape.
  std::span<std::byte> bytes() { return std::as_writable_bytes(std::span(lines_)); }
  /// True if anything was drawn since the band was dark; code that draws calls note_light().
  bool lit() const { return lit_; }
  void note_light() { lit_ = true; }
  /// Code that made all of the band dark itself calls this.
  void note_dark() { lit_ = false; }

 private:
  /// A processor takes a load for one that depends on a store 4096 bytes away. Rows that are an odd multiple of 512
  /// bytes long lie farthest apart in that sense: eight rows of a wide splat do not touch each other.
  static constexpr int friendly(int lines) { return (lines + 7) / 16 * 16 + 8; }

  struct alignas(64) Line {
    float values[16] = {};
  };
  int left_ = 0, right_ = 0, rows_ = 0, channels_ = most_channels;
  int lines_a_row_ = 0;
  std::size_t first_line_ = 0;
  std::vector<Line> lines_;
  bool lit_ = false;
};

/// Adds splats to a band whose first row is `top` in the picture.
void deposit(Deposit kind, std::span<const Splat> splats, int top, LightBand& band);

/// Two depth planes, and what lies between them.
struct PlanePair {
  float parallax_px;  ///< of the nearer one
  float spacing_px;   ///< from it to the farther one
};

/// Adds each splat between two planes to both, weighted by its distances, so that its centre is right in every view. A
/// splat within a quarter of the spacing from a plane is added to that plane alone; this moves it by at most 1/8 px in
/// an eye's view if planes are 1 px apart.
void deposit_between(Deposit kind, std::span<const Splat> splats, int top, const PlanePair& planes, LightBand& nearer,
                     LightBand& farther);

/// Adds splats to one band a view: each splat's fragments, moved by its parallax times the view's distance from the
/// central view. The bands
/// are of one shape.
void deposit_in_views(Deposit kind, std::span<const Splat> splats, int top, std::span<const ViewPosition> views,
                      std::span<LightBand> bands);

}  // namespace wheatstone
