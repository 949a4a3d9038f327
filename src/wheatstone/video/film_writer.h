#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/film_reader.h"
#include "wheatstone/video/frame.h"

namespace wheatstone {

/// How a film is coded and what it carries. FilmFacts of a source give colour, frame_rate and pixel_aspect.
struct FilmWriterOptions {
  std::string codec = "h264";     ///< one of film_codecs
  std::optional<double> crf;      ///< quality of h264, hevc, av1 and vp9, 0 (best) to 51 or 63; else the usual one
  std::string preset = "medium";  ///< effort of these: "ultrafast" to "placebo"
  std::string pixel_format;       ///< "yuv420p", "yuv422p10le", "bgr0" (RGB) and so on. Empty: the codec's usual one
  StereoLayout layout = StereoLayout::mono;  ///< written wherever the container and the codec can say it
  Rational frame_rate;          ///< on average, for the encoder's planning; each frame's own time is what counts
  Rational pixel_aspect{1, 1};  ///< what the layout asks for goes before it
  std::string comment;          ///< that the film carries; empty: none
  ColourTags colour;            ///< RGB is converted with this matrix and range, and tagged so

  std::string projection = "source";  ///< "360", "180" (equirectangular), "flat"; "source": as side_streams_from says

  /// Film whose audio and subtitles are copied, bit for bit, with its chapters and timecode; empty: none.
  std::filesystem::path side_streams_from;
  bool copy_audio = true;
  bool copy_subtitles = true;
  double start_s = 0;           ///< this moment of the source becomes the film's beginning
  std::optional<double> end_s;  ///< of the source: side streams end here
};

/// The codecs that films are written with: "h264", "prores-hq" and so on.
std::span<const std::string_view> film_codecs();

/// The pixel format of numbered pictures with 16 bits a channel, which PNG and TIFF take.
inline constexpr const char* sixteen_bits = "gbrp16le";

/// Whether frames of a film at `path` are written with more than 8 bits a channel, if they have them: by the codec's
/// pixels, or as numbered pictures in OpenEXR or of sixteen_bits.
bool writes_deep(const std::filesystem::path& path, const FilmWriterOptions& options);

/// The same before the source is known, for which keep_bits may choose sixteen_bits.
bool may_write_deep(const std::filesystem::path& path, const FilmWriterOptions& options);

/// Chooses sixteen_bits for numbered PNGs and TIFFs of a source that has more than 8 bits.
void keep_bits(const FilmFacts& source, const std::filesystem::path& path, FilmWriterOptions& options);

/// What of the audio and subtitles of `options.side_streams_from` a film at `path` would leave out because its
/// container cannot take it: a sentence a stream. Found out by writing the beginning of each stream to memory.
std::vector<std::string> side_streams_left_out(const std::filesystem::path& path, const FilmWriterOptions& options);

/// Writes a film (.mp4, .m4v, .mov, .mkv, .webm), or numbered pictures where the name holds one %d, %04d or the like
/// (from 1 on). The film appears under its name when it is whole; destroyed before `finish`, the writer leaves nothing.
/// The same frames and options give the same bytes on any machine with the same libraries.
class FilmWriter {
 public:
  /// Throws Error{wrong_usage} where options do not fit together or the ending, or where pictures of such names exist;
  /// Error{cannot_read_write} where the folder cannot be written.
  explicit FilmWriter(const std::filesystem::path& path, const FilmWriterOptions& options = {});
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;
  ~FilmWriter();

  /// Adds a frame. The first one settles size and time base. Times are kept exactly in MP4 and QuickTime, to the
  /// nearest millisecond in Matroska. Throws Error{wrong_usage} where size or time base change or time does not
  /// advance, Error{cannot_read_write} where the disk is full.
  void write(const Frame& frame);

  /// Ends the film and gives it its name. Throws Error{cannot_read_write}, and Error{wrong_usage} where no frame was
  /// written.
  void finish();

  /// What the user should know: padding, streams left out, metadata that the container cannot hold.
  const std::vector<std::string>& notes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace wheatstone
