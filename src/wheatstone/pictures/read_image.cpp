#include "wheatstone/pictures/read_image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "wheatstone/pictures/animated_png_internal.h"
#include "wheatstone/pictures/colour_profile_internal.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/upright.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// The channels that are shown, as numbers of the file's channels; alpha is -1 where there is none.
struct ShownChannels {
  int r = 0, g = 0, b = 0, alpha = -1;
};

ShownChannels shown_channels(const StoredPicture& picture) {
  ShownChannels shown;
  shown.alpha = picture.alpha_channel;
  if (picture.channels < 3) return shown;
  // EXR may hold its channels in any order.
  const auto channel_named = [&](std::string_view name) {
    const auto& names = picture.channel_names;
    const auto found = std::ranges::find(names, name);
    return found != names.end() ? static_cast<int>(found - names.begin()) : -1;
  };
  const std::array<int, 3> named = {channel_named("R"), channel_named("G"), channel_named("B")};
  const bool all_named = std::ranges::all_of(named, [](int channel) { return channel >= 0; });
  shown.r = all_named ? named[0] : 0;
  shown.g = all_named ? named[1] : 1;
  shown.b = all_named ? named[2] : 2;
  return shown;
}

template <class Code>
Code code_of(float value) {
  constexpr float white = std::numeric_limits<Code>::max();
  return static_cast<Code>(std::lround(white * std::clamp(std::isnan(value) ? 0.0f : value, 0.0f, 1.0f)));
}

float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// What is done to every pixel on its way to sRGB over white.
struct Conversion {
  ShownChannels shown;
  bool linear = false;         ///< float values in linear light
  bool premultiplied = false;  ///< colour is already multiplied by alpha
};

Conversion conversion_of(const StoredPicture& picture) {
  Conversion conversion;
  conversion.shown = shown_channels(picture);
  const bool is_float = picture.kind.is_float;
  const std::string encoding = picture.value_of<std::string>("oiio:ColorSpace", is_float ? "Linear" : "sRGB");
  conversion.linear = is_float && encoding != "sRGB";
  conversion.premultiplied = picture.value_of("oiio:UnassociatedAlpha", 0) == 0;
  return conversion;
}

template <class Pixel>
void convert_row(std::span<const float> values, int channels, const Conversion& how, std::span<Pixel> out) {
  const auto encoded = [&](float value) { return how.linear ? srgb_from_linear(std::max(value, 0.0f)) : value; };
  for (std::size_t x = 0; x < out.size(); ++x) {
    const float* pixel = values.data() + x * channels;
    const float alpha = how.shown.alpha < 0 ? 1.0f : std::clamp(pixel[how.shown.alpha], 0.0f, 1.0f);
    const auto over_white = [&](int channel) {
      const float colour = how.premultiplied ? pixel[channel] : pixel[channel] * alpha;
      // Light adds up linearly: a linear picture meets its white before it is encoded.
      return code_of<decltype(Pixel::r)>(encoded(colour + 1 - alpha));
    };
    out[x] = {over_white(how.shown.r), over_white(how.shown.g), over_white(how.shown.b)};
  }
}

template <class Pixel>
Image<Pixel> read_converted(const fs::path& path, PictureReader& reader) {
  const StoredPicture& stored = reader.picture();
  Image<Pixel> picture(stored.width, stored.height);
  if constexpr (std::is_same_v<Pixel, Rgb8>) {
    if (stored.channels == 3 && stored.kind == bytes_kind && stored.alpha_channel < 0) {
      if (!reader.read(&picture.pixels().data()->r)) refuse_damaged(path, reader.complaint());
      return picture;
    }
  }
  const std::size_t row_values = static_cast<std::size_t>(stored.width) * static_cast<std::size_t>(stored.channels);
  const auto values = std::make_unique_for_overwrite<float[]>(row_values * static_cast<std::size_t>(stored.height));
  if (!reader.read(0, stored.height, stored.channels, values.get())) refuse_damaged(path, reader.complaint());
  const Conversion how = conversion_of(stored);
  for (int y = 0; y < stored.height; ++y)
    convert_row<Pixel>({values.get() + static_cast<std::size_t>(y) * row_values, row_values}, stored.channels, how,
                       picture.row(y));
  return picture;
}

/// Where `profile` is given, the profile of colours that are no sRGB is put there, and they stay as they are.
template <class Pixel = Rgb8>
Image<Pixel> read_opened(const fs::path& path, const OpenPicture& open, std::string* profile = nullptr) {
  const StoredPicture& stored = open.reader->picture();
  Image<Pixel> picture = read_converted<Pixel>(path, *open.reader);
  // JPEG's decoder complains of stray bytes between the markers: they come from cameras and are harmless.
  const std::string complaint = open.reader->complaint();
  if (!complaint.empty() && open.reader->format() != "jpeg") refuse_damaged(path, complaint);
  const bool is_grey = stored.channels < 3, is_linear = conversion_of(stored).linear;
  if (profile != nullptr && !is_grey && !is_linear)
    *profile = open.colour_profile;
  else if (!is_linear)
    bring_to_srgb(picture, open.colour_profile, is_grey);
  return upright(std::move(picture), stored.value_of("Orientation", 1));
}

PictureInProfile in_profile(const fs::path& path, const OpenPicture& open) {
  PictureInProfile read;
  read.picture = read_opened(path, open, &read.colour_profile);
  return read;
}

std::vector<Image<Rgb8>> read_png_frames(std::string_view bytes, const fs::path& path, int most_frames) {
  const auto pngs = frames_of_png(bytes, most_frames);
  if (!pngs) refuse_damaged(path, "its frames do not each replace the whole picture, or it ends too early");
  std::vector<Image<Rgb8>> frames;
  for (const std::string& png : *pngs)
    frames.push_back(read_opened(path, open_png(png, embedded_profile(bytes), path)));
  return frames;
}

}  // namespace

Image<Rgb8> read_image(const fs::path& path) { return read_opened(path, open_picture(path)); }

Image<Rgb16> read_deep_image(const fs::path& path) {
  const OpenPicture open = open_picture(path);
  return open.reader->picture().kind.bits > 8 ? read_opened<Rgb16>(path, open) : Image<Rgb16>();
}

std::array<Image<Rgb8>, 2> read_two_images(const fs::path& first, const fs::path& second) {
  std::array<PictureInProfile, 2> pictures = read_two_in_profile(first, second);
  bring_to_one_profile(pictures, false);
  return {std::move(pictures[0].picture), std::move(pictures[1].picture)};
}

PictureInProfile read_in_profile(const fs::path& path) { return in_profile(path, open_picture(path)); }

std::array<PictureInProfile, 2> read_two_in_profile(const fs::path& first, const fs::path& second) {
  const std::array paths{&first, &second};
  std::array<PictureInProfile, 2> pictures;
  std::array<std::exception_ptr, 2> thrown;
  tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
    try {
      pictures[i] = read_in_profile(*paths[i]);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : thrown)
    if (error) std::rethrow_exception(error);
  return pictures;
}

PictureInProfile decode_jpeg_in_profile(std::string_view bytes, const fs::path& path) {
  return in_profile(path, open_jpeg(bytes, path));
}

std::string bring_to_one_profile(std::span<PictureInProfile> pictures, bool keep_shared) {
  constexpr std::size_t most_bytes = 8 << 20;  // JPEG takes twice as many
  std::string shared = keep_shared && !pictures.empty() ? pictures.front().colour_profile : std::string();
  const bool is_shared =
      std::ranges::all_of(pictures, [&](const PictureInProfile& picture) { return picture.colour_profile == shared; });
  if (is_shared && shared.size() <= most_bytes && describes_other_colours(shared)) return shared;
  tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t i) {
    bring_to_srgb(pictures[i].picture, pictures[i].colour_profile, false);
    pictures[i].colour_profile.clear();
  });
  return {};
}

bool may_be_animated(std::string_view bytes) {
  if (bytes.starts_with("GIF8") || is_animated_png(bytes)) return true;
  // RIFF, its length, WEBP; the first chunk of an animation is VP8X with a bit that says so.
  constexpr std::size_t flags_at = 20;
  constexpr unsigned char is_animated = 2;
  return bytes.size() > flags_at && bytes.starts_with("RIFF") && bytes.substr(8, 8) == "WEBPVP8X" &&
         (static_cast<unsigned char>(bytes[flags_at]) & is_animated) != 0;
}

std::vector<Image<Rgb8>> read_picture_frames(const fs::path& path, int most_frames) {
  const std::string bytes = read_picture_bytes(path);
  if (is_animated_png(bytes)) return read_png_frames(bytes, path, most_frames);
  const OpenPicture open = open_picture(path);
  std::vector<Image<Rgb8>> frames;
  while (static_cast<int>(frames.size()) < most_frames && open.reader->go_to(static_cast<int>(frames.size())))
    frames.push_back(read_opened(path, open));
  return frames;
}

Image<Rgb8> decode_jpeg(std::string_view bytes, const fs::path& path) {
  return read_opened(path, open_jpeg(bytes, path));
}

Image<Rgb8> decode_small_jpeg(std::string_view bytes, const fs::path& path) {
  constexpr int least_side = 300;
  if (!jpeg_is_whole(bytes)) refuse_damaged(path, "it ends too early");
  return read_opened(path, open_jpeg(bytes, path, least_side));
}

ImageDescription describe_image(const std::filesystem::path& path) {
  const OpenPicture open = open_picture(path);
  const StoredPicture& picture = open.reader->picture();
  ImageDescription description;
  description.format = open.reader->format();
  description.width = picture.width;
  description.height = picture.height;
  description.channels = picture.channels;
  description.has_alpha = picture.alpha_channel >= 0;
  description.bits = picture.value_of("oiio:BitsPerSample", picture.kind.bits);
  description.is_float = picture.kind.is_float;
  description.orientation = picture.value_of("Orientation", 1);
  return description;
}

}  // namespace wheatstone
