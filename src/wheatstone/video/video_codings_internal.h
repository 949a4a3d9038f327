#pragma once

// The codecs that films are written with, by the names that studios use.

#include <span>
#include <string>
#include <string_view>
#include <vector>

extern "C" {
#include <libavutil/pixfmt.h>
}

#include "wheatstone/video/film_writer.h"

namespace wheatstone {

/// One line of the table of codecs.
struct VideoCoding {
  std::string_view name;
  std::string_view encoder;  ///< libav's name
  double most_crf;           ///< 0: it has no constant rate factor
  double usual_crf;
  int threads;                               ///< bytes may depend on their number: fixed, not the machine's
  std::vector<std::string_view> formats;     ///< of pixels, in libav's names; the first is the usual one
  std::vector<std::string_view> containers;  ///< endings
  int least_width = 1, least_height = 1;     ///< of the frames that it takes
};

std::span<const VideoCoding> video_codings();

/// The coding of that name. Throws Error{wrong_usage} that lists all.
const VideoCoding& coding_of(const FilmWriterOptions& options);

/// Throws Error{wrong_usage} that names the codec where libavcodec here has no such encoder.
void check_encoder(const VideoCoding& coding);

/// Throws Error{wrong_usage} where the codec does not take the format that is asked for.
AVPixelFormat pixel_format_of(const FilmWriterOptions& options);

/// The efforts that `preset` may name, from the least to the most.
std::span<const std::string_view> encoder_presets();

}  // namespace wheatstone
