#include "wheatstone/video/film_writer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <new>
#include <optional>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/video/film_file_internal.h"
#include "wheatstone/video/frame_steps_internal.h"
#include "wheatstone/video/sequence_file_internal.h"
#include "wheatstone/video/video_codings_internal.h"
#include "wheatstone/video/video_encoder_internal.h"

namespace wheatstone {

bool writes_deep(const std::filesystem::path& path, const FilmWriterOptions& options) {
  if (!frame_pattern(path)) return is_deep(pixel_format_of(options));
  return ending_of(path) == ".exr" || options.pixel_format == sixteen_bits;
}

bool may_write_deep(const std::filesystem::path& path, const FilmWriterOptions& options) {
  return writes_deep(path, options) || takes_sixteen_bits(path);
}

void keep_bits(const FilmFacts& source, const std::filesystem::path& path, FilmWriterOptions& options) {
  if (frame_pattern(path) && takes_sixteen_bits(path) && is_deep(libav().av_get_pix_fmt(source.pixel_format.c_str())))
    options.pixel_format = sixteen_bits;
}

struct FilmWriter::Implementation {
  Implementation(const std::filesystem::path& name, const FilmWriterOptions& wanted)
      : path(name), options(wanted), steps(name) {
    if (auto pattern = frame_pattern(path)) {
      check_no_pictures(path, *pattern);
      const std::string hidden = fmt::format(".{}frames.{}.partial", pattern->before, ::getpid());
      sequence.emplace(*pattern, pattern->folder / hidden, options.layout);
      if (!options.side_streams_from.empty()) notes.emplace_back("numbered pictures hold no audio and no subtitles");
      return;
    }
    check_encoding(options);
    check_container(path, options);
    film.emplace(path, options, notes);
  }

  void begin(const Frame& frame) {
    const int width = frame.picture.width(), height = frame.picture.height();
    if (options.frame_rate.numerator <= 0 && frame.duration > 0) {
      const double rate = 1 / (static_cast<double>(frame.duration) * frame.time_base.value());
      options.frame_rate = from_av(libav().av_d2q(rate, 100000));
    }
    encoder.emplace(options, width, height, frame.time_base);
    note_padding(frame.picture, encoder->context(), notes);
    const OwnedParameters coded = parameters_of(encoder->context());
    film->begin(*coded, frame.time_base);
  }

  std::filesystem::path path;
  FilmWriterOptions options;
  FrameSteps steps;
  std::vector<std::string> notes;
  std::optional<SequenceFile> sequence;
  std::optional<FilmFile> film;
  std::optional<VideoEncoder> encoder;
};

FilmWriter::FilmWriter(const std::filesystem::path& path, const FilmWriterOptions& options)
    : implementation_(std::make_unique<Implementation>(path, options)) {}
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter& FilmWriter::operator=(FilmWriter&&) noexcept = default;
FilmWriter::~FilmWriter() = default;

void FilmWriter::write(const Frame& frame) {
  Implementation& own = *implementation_;
  own.steps.check(frame);
  if (own.sequence) {
    own.sequence->add(frame);
    return;
  }
  if (!own.encoder) own.begin(frame);
  own.encoder->send(frame, [&](AVPacket& packet) { own.film->add(packet); });
}

void FilmWriter::finish() {
  Implementation& own = *implementation_;
  own.steps.check_any();
  if (own.sequence) {
    own.sequence->finish();
    return;
  }
  own.encoder->drain([&](AVPacket& packet) { own.film->add(packet); });
  own.film->finish();
}

const std::vector<std::string>& FilmWriter::notes() const { return implementation_->notes; }

}  // namespace wheatstone
