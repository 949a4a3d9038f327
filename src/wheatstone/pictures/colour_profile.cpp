#include <lcms2.h>
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "wheatstone/pictures/colour_profile_internal.h"
#include "wheatstone/pictures/heif_pictures.h"

namespace wheatstone {

namespace {

// The largest printer profiles have a few MB.
constexpr std::size_t most_profile_bytes = std::size_t{16} << 20;

std::size_t big_endian(std::string_view bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return number;
}

std::size_t little_endian(std::string_view bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return number;
}

/// What a zlib stream holds; empty where it is damaged or longer than any profile.
std::string inflated(std::string_view packed) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string plain;
  int state = Z_OK;
  while (state == Z_OK && plain.size() < most_profile_bytes) {
    constexpr std::size_t step = 1 << 16;
    const std::size_t before = plain.size();
    plain.resize(before + step);
    stream.next_out = reinterpret_cast<Bytef*>(plain.data() + before);
    stream.avail_out = step;
    state = inflate(&stream, Z_NO_FLUSH);
    plain.resize(plain.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END ? plain : std::string();
}

/// PNG 1.2, sec. 4.2.2.4: a name, a zero, the method (0), the packed profile.
std::string png_profile(std::string_view bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - 12) return {};
    const std::string_view type = bytes.substr(at + 4, 4);
    if (type == "IDAT") return {};
    if (type == "iCCP") {
      const std::string_view chunk = bytes.substr(at + 8, length);
      const std::size_t end_of_name = chunk.find('\0');
      if (end_of_name == std::string_view::npos || chunk.size() < end_of_name + 2) return {};
      return inflated(chunk.substr(end_of_name + 2));
    }
    at += length + 12;
  }
  return {};
}

/// WebP container specification: chunks of a name, a little-endian length and data padded to an even length.
std::string webp_profile(std::string_view bytes) {
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t length = little_endian(bytes, at + 4);
    if (length > bytes.size() - at - 8) return {};
    if (bytes.substr(at, 4) == "ICCP") return std::string(bytes.substr(at + 8, length));
    at += 8 + length + length % 2;
  }
  return {};
}

}  // namespace

std::string embedded_profile(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return png_profile(bytes);
  if (bytes.starts_with("RIFF") && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP") return webp_profile(bytes);
  if (is_heif(bytes)) return heif_profile(bytes);
  return {};
}

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

template <class Pixel>
Transform transform_from(std::string_view bytes, bool grey) {
  constexpr bool deep = std::is_same_v<Pixel, Rgb16>;
  constexpr cmsUInt32Number rgb = deep ? TYPE_RGB_16 : TYPE_RGB_8, levels = deep ? TYPE_GRAY_16 : TYPE_GRAY_8;
  const Profile from(cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
  if (!from || cmsGetColorSpace(from.get()) != (grey ? cmsSigGrayData : cmsSigRgbData)) return nullptr;
  const Profile srgb(cmsCreate_sRGBProfile());
  return Transform(cmsCreateTransform(from.get(), grey ? levels : rgb, srgb.get(), rgb, INTENT_RELATIVE_COLORIMETRIC,
                                      cmsFLAGS_BLACKPOINTCOMPENSATION));
}

template <class Pixel>
void convert(const Transform& transform, std::span<const Pixel> from, std::span<Pixel> to, bool grey) {
  const auto count = static_cast<cmsUInt32Number>(from.size());
  if (!grey) {
    cmsDoTransform(transform.get(), from.data(), to.data(), count);
    return;
  }
  std::vector<decltype(Pixel::r)> levels(from.size());
  std::transform(from.begin(), from.end(), levels.begin(), [](Pixel colour) { return colour.r; });
  cmsDoTransform(transform.get(), levels.data(), to.data(), count);
}

/// Most cameras write an sRGB profile of their own making: pixels that would only move by rounding stay.
template <class Pixel>
bool changes_colours(const Transform& transform, bool grey) {
  using Code = decltype(Pixel::r);
  constexpr int level = std::numeric_limits<Code>::max() / 255;
  constexpr int step = 17;
  std::vector<Pixel> asked;
  for (int r = 0; r <= 255; r += step)
    for (int g = grey ? r : 0; g <= (grey ? r : 255); g += step)
      for (int b = grey ? r : 0; b <= (grey ? r : 255); b += step)
        asked.push_back({static_cast<Code>(r * level), static_cast<Code>(g * level), static_cast<Code>(b * level)});
  std::vector<Pixel> given(asked.size());
  convert<Pixel>(transform, asked, given, grey);
  constexpr int rounding = 2 * level;
  return !std::equal(asked.begin(), asked.end(), given.begin(), [](Pixel a, Pixel b) {
    return std::abs(a.r - b.r) <= rounding && std::abs(a.g - b.g) <= rounding && std::abs(a.b - b.b) <= rounding;
  });
}

/// None where the profile does not fit, or changes nothing.
template <class Pixel>
Transform transform_that_changes(std::string_view profile, bool grey) {
  if (!is_whole(profile)) return nullptr;
  Transform transform = transform_from<Pixel>(profile, grey);
  return transform && changes_colours<Pixel>(transform, grey) ? std::move(transform) : nullptr;
}

template <class Pixel>
void bring_any_to_srgb(Image<Pixel>& picture, std::string_view profile, bool grey) {
  if (picture.empty()) return;
  const Transform transform = transform_that_changes<Pixel>(profile, grey);
  if (!transform) return;
  for (int y = 0; y < picture.height(); ++y) convert<Pixel>(transform, picture.row(y), picture.row(y), grey);
}

}  // namespace

void bring_to_srgb(Image<Rgb8>& picture, std::string_view profile, bool grey) {
  bring_any_to_srgb(picture, profile, grey);
}

void bring_to_srgb(Image<Rgb16>& picture, std::string_view profile, bool grey) {
  bring_any_to_srgb(picture, profile, grey);
}

std::string profile_with_primaries(const std::array<std::array<double, 2>, 4>& primaries) {
  const auto as_lcms = [](const std::array<double, 2>& at) { return cmsCIExyY{at[0], at[1], 1}; };
  const auto& [red, green, blue, white] = primaries;
  const cmsCIExyYTRIPLE colours{as_lcms(red), as_lcms(green), as_lcms(blue)};
  const cmsCIExyY white_point = as_lcms(white);
  // IEC 61966-2-1.
  constexpr std::array<double, 5> srgb_curve{2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  const std::unique_ptr<cmsToneCurve, decltype(&cmsFreeToneCurve)> curve(
      cmsBuildParametricToneCurve(nullptr, 4, srgb_curve.data()), &cmsFreeToneCurve);
  if (!curve) throw std::bad_alloc();
  std::array<cmsToneCurve*, 3> curves{curve.get(), curve.get(), curve.get()};
  const Profile profile(cmsCreateRGBProfile(&white_point, &colours, curves.data()));
  cmsUInt32Number size = 0;
  if (!profile || cmsSaveProfileToMem(profile.get(), nullptr, &size) == 0) return {};
  std::string bytes(size, '\0');
  if (cmsSaveProfileToMem(profile.get(), bytes.data(), &size) == 0) return {};
  // ICC.1, sec. 7.2.8: when it was made. Profiles are compared, and the same picture gives the same bytes.
  constexpr std::string_view a_date("\x07\xd0\0\x01\0\x01\0\0\0\0\0\0", 12);  // 1 January 2000
  return bytes.replace(24, a_date.size(), a_date);
}

bool describes_other_colours(std::string_view profile) {
  return transform_that_changes<Rgb8>(profile, false) != nullptr;
}

}  // namespace wheatstone
