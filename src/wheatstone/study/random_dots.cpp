#include "wheatstone/study/random_dots.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "wheatstone/image/colour.h"
#include "wheatstone/study/draw_lots_internal.h"

namespace wheatstone {
namespace {

/// Whether a place, in mm from the middle, lies on the ring.
bool on_ring(float x, float y, float diameter, RingGap gap) {
  const float thickness = diameter / 5;
  const float radius = std::hypot(x, y);
  if (radius > diameter / 2 || radius < diameter / 2 - thickness) return false;
  // Turned so that the gap is on the right.
  const float along = gap == RingGap::right ? x : gap == RingGap::left ? -x : gap == RingGap::below ? y : -y;
  const float across = gap == RingGap::right || gap == RingGap::left ? y : x;
  return !(along > 0 && std::abs(across) < thickness / 2);
}

/// Screen parallax, in mm, of what is seen under this angle less than the screen's: near ones are crossed.
float parallax_mm(float disparity_arcsec, const StudyScreen& screen) {
  const float angle = disparity_arcsec / 3600 * std::numbers::pi_v<float> / 180;
  return -angle * screen.viewing_distance_mm;
}

/// Share of pixel `i` between two places on its axis.
float covered(int i, float from, float to) {
  return std::clamp(std::min(to, static_cast<float>(i + 1)) - std::max(from, static_cast<float>(i)), 0.0f, 1.0f);
}

/// Brings a square dot over light that is linear.
void put_dot(Image<float>& light, float x, float y, float size, float brightness) {
  const float left = x - size / 2, top = y - size / 2;
  for (int j = std::max(0, static_cast<int>(top)); j < light.height() && static_cast<float>(j) < top + size; ++j)
    for (int i = std::max(0, static_cast<int>(left)); i < light.width() && static_cast<float>(i) < left + size; ++i) {
      const float share = covered(i, left, left + size) * covered(j, top, top + size);
      light(i, j) += share * (brightness - light(i, j));
    }
}

Image<Rgb8> encoded(const Image<float>& light) {
  Image<Rgb8> picture(light.width(), light.height());
  std::ranges::transform(light.pixels(), picture.pixels().begin(), [](float value) {
    const std::uint8_t code = srgb_from_linear(value);
    return Rgb8{code, code, code};
  });
  return picture;
}

}  // namespace

StereoPair random_dot_stereogram(const RandomDotOptions& options, const StudyScreen& screen, RingGap gap,
                                 std::uint64_t seed) {
  const float pitch = screen.pixel_pitch_mm();
  const float dot = options.dot_mm / pitch;
  const float ring_parallax = parallax_mm(options.disparity_arcsec, screen) / pitch;
  const auto width = static_cast<float>(screen.width_px), height = static_cast<float>(screen.height_px);
  const int count = static_cast<int>(options.dots_share * width * height / (dot * dot));
  Image<float> left(screen.width_px, screen.height_px, 0.5f), right = left;
  Lots lots({seed, 0x646f7473});
  for (int i = 0; i < count; ++i) {
    const float x = lots.unit() * width, y = lots.unit() * height;
    const float brightness = lots.below(2) == 0 ? 0.05f : 0.9f;
    const bool raised = on_ring((x - width / 2) * pitch, (y - height / 2) * pitch, options.ring_mm, gap);
    const float half = raised ? ring_parallax / 2 : 0;
    put_dot(left, x - half, y, dot, brightness);
    put_dot(right, x + half, y, dot, brightness);
  }
  return {encoded(left), encoded(right)};
}

}  // namespace wheatstone
