#include <lcms2.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "wheatstone/pictures/colour_profile_internal.h"

namespace wheatstone {
namespace {

struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
struct DeleteTransform {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};
using Profile = std::unique_ptr<void, CloseProfile>;
using Transform = std::unique_ptr<void, DeleteTransform>;

/// ICC.1, sec. 7.2.2: a profile begins with its own length.
bool is_whole(std::string_view profile) {
  if (profile.size() < 128) return false;
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<std::uint8_t>(profile[i]);
  return length <= profile.size();
}

Transform transform_from(std::string_view bytes, bool grey) {
  const Profile from(cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
  if (!from || cmsGetColorSpace(from.get()) != (grey ? cmsSigGrayData : cmsSigRgbData)) return nullptr;
  const Profile srgb(cmsCreate_sRGBProfile());
  return Transform(cmsCreateTransform(from.get(), grey ? TYPE_GRAY_8 : TYPE_RGB_8, srgb.get(), TYPE_RGB_8,
                                      INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_BLACKPOINTCOMPENSATION));
}

void convert(const Transform& transform, std::span<const Rgb8> from, std::span<Rgb8> to, bool grey) {
  const auto count = static_cast<cmsUInt32Number>(from.size());
  if (!grey) {
    cmsDoTransform(transform.get(), from.data(), to.data(), count);
    return;
  }
  std::vector<std::uint8_t> levels(from.size());
  std::transform(from.begin(), from.end(), levels.begin(), [](Rgb8 colour) { return colour.r; });
  cmsDoTransform(transform.get(), levels.data(), to.data(), count);
}

/// Most cameras write an sRGB profile of their own making: pixels that would only move by rounding stay.
bool changes_colours(const Transform& transform, bool grey) {
  constexpr int step = 17;
  std::vector<Rgb8> asked;
  for (int r = 0; r <= 255; r += step)
    for (int g = grey ? r : 0; g <= (grey ? r : 255); g += step)
      for (int b = grey ? r : 0; b <= (grey ? r : 255); b += step)
        asked.push_back({static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)});
  std::vector<Rgb8> given(asked.size());
  convert(transform, asked, given, grey);
  constexpr int rounding = 2;
  return !std::equal(asked.begin(), asked.end(), given.begin(), [](Rgb8 a, Rgb8 b) {
    return std::abs(a.r - b.r) <= rounding && std::abs(a.g - b.g) <= rounding && std::abs(a.b - b.b) <= rounding;
  });
}

}  // namespace

void bring_to_srgb(Image<Rgb8>& picture, std::string_view profile, bool grey) {
  if (!is_whole(profile) || picture.empty()) return;
  const Transform transform = transform_from(profile, grey);
  if (!transform || !changes_colours(transform, grey)) return;
  for (int y = 0; y < picture.height(); ++y) convert(transform, picture.row(y), picture.row(y), grey);
}

}  // namespace wheatstone
