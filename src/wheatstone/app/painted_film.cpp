#include "wheatstone/app/painted_film.h"

#include <algorithm>
#include <cmath>

namespace wheatstone {

StereoLayout layout_of_painted_film(const StereoFilmReader& source, bool a_film_an_eye) {
  const bool in_time = traits_of(source.layout()).arrangement == Arrangement::in_time;
  return a_film_an_eye || in_time ? StereoLayout::left_right : source.layout();
}

void write_as_source(const std::filesystem::path& film, const FilmFacts& facts, const FilmReaderOptions& reading,
                     FilmWriterOptions& writing) {
  writing.frame_rate = facts.frame_rate;
  writing.pixel_aspect = facts.pixel_aspect;
  writing.colour = facts.colour;
  if (!facts.projection.empty()) writing.side_streams_from = film;
  writing.start_s = reading.from_s.value_or(0);
  writing.end_s = reading.to_s;
}

std::vector<std::string> notes_on_reading(const FilmFacts& facts) {
  if (!facts.interlaced) return {};
  return {"the source is interlaced; its frames were deinterlaced (bwdif)"};
}

std::int64_t expected_frames(const FilmFacts& facts, const FilmReaderOptions& reading) {
  if (!facts.frame_count) return 0;
  auto frames = static_cast<double>(*facts.frame_count);
  const double rate = facts.frame_rate.value();
  if (rate > 0) {
    const double end_s = std::min(reading.to_s.value_or(frames / rate), frames / rate);
    frames = std::max(end_s - reading.from_s.value_or(0), 0.0) * rate;
  }
  return static_cast<std::int64_t>(std::ceil(frames / reading.every));
}

double share_of_film(const FilmFacts& facts, std::int64_t frames) {
  const double all =
      facts.frame_count ? static_cast<double>(*facts.frame_count) : facts.duration_s * facts.frame_rate.value();
  return all > 0 ? std::min(static_cast<double>(frames) / all, 1.0) : 0;
}

}  // namespace wheatstone
