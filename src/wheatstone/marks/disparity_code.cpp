#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/files/deflate.h"
#include "wheatstone/marks/disparity_code.h"
#include "wheatstone/marks/surfaces.h"

namespace wheatstone {
namespace {

constexpr int bytes_a_code = 4;
constexpr std::uint32_t unknown_code = 0xffffffff;

/// What is known of the pixels before the one at hand, in steps: it is expected to go on as they do (the median edge
/// detector of Weinberger et al. 2000, LOCO-I).
class Expectation {
 public:
  explicit Expectation(int width) : row_above_(static_cast<std::size_t>(width) + 1) {}

  void begin_row() {
    left_ = above_left_ = row_above_.front();
    x_ = 0;
  }
  std::int32_t expected() const {
    const std::int64_t above = row_above_[x_], left = left_, above_left = above_left_;
    const auto [least, most] = std::minmax(left, above);
    return static_cast<std::int32_t>(std::clamp(left + above - above_left, least, most));
  }
  /// The pixel at hand is known to be this.
  void next(std::int32_t steps) {
    above_left_ = row_above_[x_];
    row_above_[x_++] = left_ = steps;
  }

 private:
  std::vector<std::int32_t> row_above_;  ///< of those of this row that are behind
  std::int32_t left_ = 0, above_left_ = 0;
  std::size_t x_ = 0;
};

/// Small differences of either sign become small codes.
std::uint32_t code_of(std::int32_t difference) {
  return static_cast<std::uint32_t>(difference) << 1 ^ static_cast<std::uint32_t>(difference >> 31);
}
std::int32_t difference_of(std::uint32_t code) { return static_cast<std::int32_t>(code >> 1 ^ (~(code & 1) + 1)); }

}  // namespace

std::vector<std::uint8_t> encode_disparities(const KnownRuns& disparity) {
  const auto width = static_cast<std::size_t>(disparity.width());
  const std::size_t count = width * static_cast<std::size_t>(disparity.height());
  std::vector<std::uint8_t> planes(count * bytes_a_code);
  Expectation expectation(disparity.width());
  std::vector<float> row(width);
  std::size_t i = 0;
  for (int y = 0; y < disparity.height(); ++y) {
    expectation.begin_row();
    disparity.copy_row(y, row);
    for (const float d : row) {
      const std::int32_t expected = expectation.expected();
      const std::int32_t steps = std::isnan(d) ? expected : static_cast<std::int32_t>(std::lround(d * disparity_steps));
      const std::uint32_t code = std::isnan(d) ? unknown_code : code_of(steps - expected);
      for (int byte = 0; byte < bytes_a_code; ++byte)
        planes[static_cast<std::size_t>(byte) * count + i] = static_cast<std::uint8_t>(code >> (8 * byte));
      expectation.next(steps);
      ++i;
    }
  }
  return deflated(planes);
}

std::optional<KnownRuns> decode_disparities(std::span<const std::uint8_t> bytes, int width, int height) {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto inflated_planes = inflated(bytes, count * bytes_a_code);
  if (!inflated_planes) return {};
  const std::vector<std::uint8_t>& planes = *inflated_planes;
  KnownRuns disparity(width, height);
  std::vector<float> row(static_cast<std::size_t>(width));
  Expectation expectation(width);
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    expectation.begin_row();
    for (float& d : row) {
      std::uint32_t code = 0;
      for (int byte = 0; byte < bytes_a_code; ++byte)
        code |= static_cast<std::uint32_t>(planes[static_cast<std::size_t>(byte) * count + i]) << (8 * byte);
      const std::int64_t steps =
          std::int64_t{expectation.expected()} + (code == unknown_code ? 0 : difference_of(code));
      if (steps != static_cast<std::int32_t>(steps)) return {};
      d = code == unknown_code ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(steps) / disparity_steps;
      expectation.next(static_cast<std::int32_t>(steps));
      ++i;
    }
    disparity.add_row(row);
  }
  return disparity;
}

}  // namespace wheatstone
