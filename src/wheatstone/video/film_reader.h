#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/frame.h"

namespace wheatstone {

struct FilmReaderOptions {
  std::optional<double> from_s;      ///< leave out what is shown before
  std::optional<double> to_s;        ///< leave out what is shown then or later
  int every = 1;                     ///< of what is left, deliver the first and every so many-th after it
  int threads = 0;                   ///< of the decoder; 0: as many as the machine has. The frames are the same on any
  Rational sequence_rate = {24, 1};  ///< frames a second of a sequence of pictures, which does not say
  bool deep = false;                 ///< also deliver Frame::deep, of films with more than 8 bits a channel
};

/// A stream beside the pictures.
struct SideStream {
  int index = 0;     ///< in the file
  std::string kind;  ///< "audio" or "subtitles"
  std::string codec;
  std::string language;  ///< empty where unknown
  int channels = 0;      ///< of audio
  int sample_rate = 0;
};

/// What is known of a film before its frames are read.
struct FilmFacts {
  std::string container;  ///< "mp4", "matroska", "sequence" and so on
  std::string codec;
  std::string pixel_format;
  int width = 0;  ///< of the frames delivered: after turning
  int height = 0;
  Rational pixel_aspect{1, 1};              ///< as stored: width of a pixel over its height
  int rotation_degrees = 0;                 ///< clockwise; was applied
  Rational frame_rate;                      ///< on average; 0/1 where unknown
  Rational time_base{1, 1};                 ///< of the frames' pts
  double duration_s = 0;                    ///< of the whole film, 0 where unknown
  std::optional<std::int64_t> frame_count;  ///< of the whole film, where it says
  StereoLayout layout = StereoLayout::mono;
  std::string layout_how;   ///< "Matroska StereoMode", … ; empty where the film says nothing of it
  std::string projection;   ///< the sphere that it lies on: "360", "180", "other"; "flat": none; empty: it is no film
  std::string comment;      ///< that the film carries; empty: none
  bool interlaced = false;  ///< its frames are stored as fields; they are delivered whole (bwdif)
  ColourTags colour;
  std::vector<SideStream> side_streams;
};

/// Delivers the frames of a film, or of a numbered sequence of pictures, in the order in which they are shown. Needs
/// memory for a few frames, however long the film is.
class FilmReader {
 public:
  FilmReader(FilmReader&&) noexcept;
  FilmReader& operator=(FilmReader&&) noexcept;
  ~FilmReader();

  const FilmFacts& facts() const;

  /// The next frame, turned upright, as sRGB (see docs/films.md for what is not converted). False at the end. The
  /// picture given is reused where its size fits. Throws Error{bad_input} where the size of the pictures changes on the
  /// way.
  bool read(Frame& frame);

  /// Passes over so many frames of those that `read` would deliver, decoding but not converting them. Returns how many
  /// there were.
  std::int64_t skip(std::int64_t frames);

  /// Passes over all that remains, of films without decoding it: `loss` then tells of a film that breaks off, but not
  /// of damaged pictures.
  void skip_rest();

  /// After the last frame: what is missing or damaged, in words; nothing where the film was whole.
  std::optional<std::string> loss() const;

 private:
  struct Implementation;
  explicit FilmReader(std::unique_ptr<Implementation> implementation);
  friend FilmReader open_film(const std::filesystem::path& path, const FilmReaderOptions& options);
  std::unique_ptr<Implementation> implementation_;
};

/// Opens a film (MP4, QuickTime, Matroska, WebM, AVI, MPEG and the like) or, where the name holds one %d, %04d or the
/// like, a sequence of numbered pictures, whose numbers may begin anywhere but must have no holes.
/// Throws Error{bad_input} where it is no film, has no pictures, its codec is unknown, nothing can be decoded, or a
/// sequence has a hole; Error{wrong_usage} where an option makes no sense.
FilmReader open_film(const std::filesystem::path& path, const FilmReaderOptions& options = {});

}  // namespace wheatstone
