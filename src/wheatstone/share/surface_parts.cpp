#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/marks/disparity_code.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/surface_parts_internal.h"

namespace wheatstone {
namespace {

/// Disparities in fewer steps than a painting file has. They tell what hides marks, where far more than this counts.
KnownRuns rounded(KnownRuns disparity) {
  constexpr float steps_a_px = 4;
  for (float& value : disparity.values()) value = std::round(value * steps_a_px) / steps_a_px;
  return disparity;
}

/// Of what no photograph shows, only the squares of a JPEG file that known pixels lie in are needed: the others get one
/// colour.
Image<Rgb8> without_unknown_squares(const Image<Rgb8>& picture, const KnownRuns& disparity) {
  constexpr int square_px = 16;
  Image<Rgb8> result(picture.width(), picture.height(), {128, 128, 128});
  for (int top = 0; top < picture.height(); top += square_px)
    for (int left = 0; left < picture.width(); left += square_px) {
      const int bottom = std::min(top + square_px, picture.height()),
                right = std::min(left + square_px, picture.width());
      bool is_known = false;
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) is_known = is_known || !std::isnan(disparity(x, y));
      for (int y = top; is_known && y < bottom; ++y)
        for (int x = left; x < right; ++x) result(x, y) = picture(x, y);
    }
  return result;
}

}  // namespace

std::string still_of(ImageView<const Rgb8> picture) {
  constexpr std::size_t most_bytes = 60'000;
  std::string jpeg;
  for (const int quality : {60, 40, 25, 15}) {
    jpeg = encode_jpeg(picture, quality);
    if (jpeg.size() <= most_bytes) break;
  }
  return jpeg;
}

Json add_surfaces(const Surfaces& surfaces, std::vector<PagePart>& parts) {
  Json seen = Json::array();
  for (const Surface& surface : surfaces.seen) {
    parts.push_back({fmt::format("surface-{}", seen.size()), encode_disparities(rounded(surface.disparity))});
    seen.push_back({{"view", surface.view.eye_separations()},
                    {"left", surface.left_px},
                    {"width", surface.disparity.width()},
                    {"height", surface.disparity.height()},
                    {"continued", surface.continued}});
  }
  return {{"tolerance", surfaces.tolerance_px}, {"seen", seen}};
}

void add_pictures(std::span<const Image<Rgb8>> pictures, const Surfaces& surfaces, std::vector<PagePart>& parts) {
  constexpr int quality = 92;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Surface& surface = surfaces.seen[i];
    const std::string jpeg =
        encode_jpeg(surface.continued ? without_unknown_squares(pictures[i], surface.disparity) : pictures[i], quality);
    parts.push_back({fmt::format("picture-{}", i), {jpeg.begin(), jpeg.end()}});
  }
}

std::string text_of(const Json& facts) { return facts.dump(-1, ' ', true, Json::error_handler_t::replace); }

}  // namespace wheatstone
