#include "wheatstone/app/detail_map.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/pictures/find_faces.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {
namespace {

/// By how much fineness rises on a face: what makes a small one a face is a few pixels wide.
float rise_for(const PixelBox& face, int picture_width) {
  constexpr float large_share = 0.3f, for_large = 0.05f, for_each_halving = 0.08f, most = 0.4f;
  const float halvings = std::log2(large_share * static_cast<float>(picture_width) / static_cast<float>(face.width));
  return std::clamp(for_large + for_each_halving * halvings, for_large, most);
}

/// An ellipse over the face, whole to 0.6 of its axes, fading to its rim.
void raise(const PixelBox& face, float rise, Image<std::uint8_t>& detail) {
  const float half_width = 0.55f * static_cast<float>(face.width), half_height = 0.7f * static_cast<float>(face.height);
  const float middle_x = static_cast<float>(face.left) + static_cast<float>(face.width) / 2;
  const float middle_y = static_cast<float>(face.top) + static_cast<float>(face.height) / 2;
  const int top = std::max(static_cast<int>(middle_y - half_height), 0);
  const int bottom = std::min(static_cast<int>(middle_y + half_height) + 1, detail.height());
  const int left = std::max(static_cast<int>(middle_x - half_width), 0);
  const int right = std::min(static_cast<int>(middle_x + half_width) + 1, detail.width());
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const float distance = std::hypot((static_cast<float>(x) + 0.5f - middle_x) / half_width,
                                        (static_cast<float>(y) + 0.5f - middle_y) / half_height);
      constexpr float whole = 0.6f;
      const float share = std::clamp((1 - distance) / (1 - whole), 0.f, 1.f);
      const auto raised = static_cast<std::uint8_t>(static_cast<float>(even_detail) + 255 * rise * share);
      detail(x, y) = std::max(detail(x, y), raised);
    }
  }
}

}  // namespace

Image<std::uint8_t> detail_of_faces(ImageView<const Rgb8> photograph) {
  constexpr int widest_px = 1200;
  const auto faces = find_faces(photograph, std::min(photograph.width(), widest_px));
  if (!faces || faces->empty()) return {};
  Image<std::uint8_t> detail(photograph.width(), photograph.height(), even_detail);
  for (const PixelBox& face : *faces) raise(face, rise_for(face, photograph.width()), detail);
  return detail;
}

Image<std::uint8_t> read_detail_map(const std::filesystem::path& file) {
  const Image<Rgb8> picture = read_image(file);
  Image<std::uint8_t> map(picture.width(), picture.height());
  std::ranges::transform(picture.pixels(), map.pixels().begin(),
                         [](Rgb8 c) { return static_cast<std::uint8_t>((c.r + c.g + c.b) / 3); });
  return map;
}

}  // namespace wheatstone
