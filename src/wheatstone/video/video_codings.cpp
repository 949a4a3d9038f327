#include "wheatstone/video/video_codings_internal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "wheatstone/error.h"
#include "wheatstone/video/libav_functions_internal.h"

namespace wheatstone {

std::span<const VideoCoding> video_codings() {
  using Names = std::vector<std::string_view>;
  static const Names eight_bits = {"yuv420p", "yuv422p", "yuv444p"};
  static const Names ten_bits = {"yuv420p10le", "yuv422p10le", "yuv444p10le"};
  static const Names lossless = {"bgr0",        "yuv420p",     "yuv422p",     "yuv444p",
                                 "yuv420p10le", "yuv422p10le", "yuv444p10le", "gbrp16le"};
  static const Names in_all = {".mp4", ".m4v", ".mov", ".mkv", ".mk3d"}, in_mkv = {".mkv", ".mk3d"};
  static const Names in_mov = {".mov", ".mkv", ".mk3d"}, in_webm = {".webm", ".mp4", ".mkv", ".mk3d"};
  // x265 3.5 that codes several frames at a time gives other bytes every time; its rows are coded by a pool of threads
  // all the same.
  static const std::vector<VideoCoding> all = {
      {"h264", "libx264", 51, 16, 4, eight_bits, in_all},
      {"hevc", "libx265", 51, 18, 1, eight_bits, in_all},
      {"hevc-10", "libx265", 51, 18, 1, ten_bits, in_all},
      {"prores-hq", "prores_ks", 0, 0, 4, {"yuv422p10le"}, in_mov},
      {"prores-4444", "prores_ks", 0, 0, 4, {"yuv444p10le"}, in_mov},
      {"dnxhr", "dnxhd", 0, 0, 4, {"yuv422p10le", "yuv422p", "yuv444p10le"}, in_mov, 256, 120},
      {"av1", "libaom-av1", 63, 20, 4, {"yuv420p10le", "yuv444p10le", "yuv420p", "yuv444p"}, in_webm},
      {"vp9", "libvpx-vp9", 63, 20, 4, {"yuv420p", "yuv444p", "yuv420p10le", "yuv444p10le"}, in_webm},
      {"ffv1", "ffv1", 0, 0, 4, lossless, in_mkv},
  };
  return all;
}

std::span<const std::string_view> film_codecs() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const VideoCoding& coding : video_codings()) all.push_back(coding.name);
    return all;
  }();
  return names;
}

const VideoCoding& coding_of(const FilmWriterOptions& options) {
  const auto found = std::ranges::find(video_codings(), std::string_view(options.codec), &VideoCoding::name);
  if (found == video_codings().end())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("codec: {}, expected one of {}", options.codec, fmt::join(film_codecs(), ", ")));
  return *found;
}

void check_encoder(const VideoCoding& coding) {
  if (libav().avcodec_find_encoder_by_name(std::string(coding.encoder).c_str()) == nullptr)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("codec: {} is not in this installation's libavcodec ({})", coding.name, coding.encoder));
}

AVPixelFormat pixel_format_of(const FilmWriterOptions& options) {
  const VideoCoding& coding = coding_of(options);
  const std::string name(options.pixel_format.empty() ? coding.formats.front() : options.pixel_format);
  if (std::ranges::find(coding.formats, name) == coding.formats.end())
    throw Error(ErrorKind::wrong_usage, fmt::format("pixel format: {}, expected {} for {}", name,
                                                    fmt::join(coding.formats, ", "), coding.name));
  return libav().av_get_pix_fmt(name.c_str());
}

std::span<const std::string_view> encoder_presets() {
  static constexpr std::array<std::string_view, 10> presets = {
      "ultrafast", "superfast", "veryfast", "faster", "fast", "medium", "slow", "slower", "veryslow", "placebo"};
  return presets;
}

}  // namespace wheatstone
