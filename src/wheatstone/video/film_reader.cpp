#include "wheatstone/video/film_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "wheatstone/error.h"
#include "wheatstone/video/animated_webp_internal.h"
#include "wheatstone/video/decoded_film_internal.h"
#include "wheatstone/video/read_sequence_internal.h"

namespace wheatstone {
namespace {

using Source = std::variant<DecodedFilm, PictureSequence, AnimatedWebp>;

Source source_of(const std::filesystem::path& path, const FilmReaderOptions& options) {
  if (auto pattern = frame_pattern(path)) return PictureSequence(path, std::move(*pattern), options.sequence_rate);
  if (is_webp(path)) return AnimatedWebp(path);
  return DecodedFilm(path, options.threads);
}

void check(const FilmReaderOptions& options) {
  if (options.every < 1) {
    throw Error(ErrorKind::wrong_usage, fmt::format("every: {}, expected 1 or more", options.every));
  }
  if (options.sequence_rate.numerator < 1 || options.sequence_rate.denominator < 1) {
    throw Error(ErrorKind::wrong_usage,
                fmt::format("sequence rate: {}/{}, expected more than 0", options.sequence_rate.numerator,
                            options.sequence_rate.denominator));
  }
  if (options.from_s && options.to_s && !(*options.from_s < *options.to_s)) {
    throw Error(ErrorKind::wrong_usage,
                fmt::format("to: {} s, expected more than from, {} s", *options.to_s, *options.from_s));
  }
}

}  // namespace

struct FilmReader::Implementation {
  Implementation(const std::filesystem::path& path, const FilmReaderOptions& wanted)
      : options(wanted), source(source_of(path, wanted)) {
    if (options.from_s) std::visit([&](auto& film) { film.seek_before(*options.from_s); }, source);
  }

  FrameTime time() const {
    return std::visit([](const auto& film) { return film.time(); }, source);
  }
  const FilmFacts& facts() const {
    return std::visit([](const auto& film) -> const FilmFacts& { return film.facts(); }, source);
  }

  /// Goes to the next frame that is wanted.
  bool advance() {
    while (!past_end && std::visit([](auto& film) { return film.step(); }, source)) {
      // Some mercy: 1/3 s is no number of milliseconds.
      const double tick = facts().time_base.value();
      const double seconds = static_cast<double>(time().pts) * tick + std::min(0.5 * tick, 0.0005);
      if (options.from_s && seconds < *options.from_s) continue;
      if (options.to_s && seconds >= *options.to_s) break;
      if (wanted_seen++ % options.every == 0) return true;
    }
    past_end = true;
    return false;
  }

  FilmReaderOptions options;
  Source source;
  std::int64_t wanted_seen = 0;
  bool past_end = false;
};

FilmReader::FilmReader(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
FilmReader::FilmReader(FilmReader&&) noexcept = default;
FilmReader& FilmReader::operator=(FilmReader&&) noexcept = default;
FilmReader::~FilmReader() = default;

const FilmFacts& FilmReader::facts() const { return implementation_->facts(); }

bool FilmReader::read(Frame& frame) {
  if (!implementation_->advance()) return false;
  std::visit([&](auto& film) { film.convert(frame.picture); }, implementation_->source);
  const auto convert_deep = [&](auto& film) {
    if constexpr (requires { film.convert_deep(frame.deep); }) film.convert_deep(frame.deep);
  };
  if (implementation_->options.deep) std::visit(convert_deep, implementation_->source);
  const FrameTime time = implementation_->time();
  frame.pts = time.pts;
  frame.duration = time.duration * implementation_->options.every;
  frame.time_base = facts().time_base;
  return true;
}

std::int64_t FilmReader::skip(std::int64_t frames) {
  std::int64_t skipped = 0;
  while (skipped < frames && implementation_->advance()) ++skipped;
  return skipped;
}

void FilmReader::skip_rest() {
  if (auto* const film = std::get_if<DecodedFilm>(&implementation_->source)) film->pass_over_rest();
  implementation_->past_end = true;
}

std::optional<std::string> FilmReader::loss() const {
  return std::visit([](const auto& film) { return film.loss(); }, implementation_->source);
}

FilmReader open_film(const std::filesystem::path& path, const FilmReaderOptions& options) {
  check(options);
  return FilmReader(std::make_unique<FilmReader::Implementation>(path, options));
}

}  // namespace wheatstone
