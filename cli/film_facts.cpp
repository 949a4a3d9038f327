#include "film_facts.h"

#include <fmt/format.h>

#include <string>

#include "quilt_facts.h"
#include "wheatstone/video/film_reader.h"

namespace wheatstone::cli {
namespace {

using nlohmann::ordered_json;

void put(ordered_json& facts, const char* name, const std::string& value) {
  if (!value.empty()) facts[name] = value;
}

ordered_json facts_of_side_streams(const FilmFacts& film) {
  ordered_json all = ordered_json::array();
  for (const SideStream& stream : film.side_streams) {
    ordered_json facts = {{"kind", stream.kind}, {"codec", stream.codec}};
    put(facts, "language", stream.language);
    if (stream.channels > 0) facts["channels"] = stream.channels;
    if (stream.sample_rate > 0) facts["sample_rate"] = stream.sample_rate;
    all.push_back(std::move(facts));
  }
  return all;
}

}  // namespace

ordered_json facts_of_film(const std::filesystem::path& path) {
  const FilmReader reader = open_film(path);
  const FilmFacts& film = reader.facts();
  ordered_json facts = {{"kind", "film"}, {"container", film.container}};
  put(facts, "codec", film.codec);
  put(facts, "pixel_format", film.pixel_format);
  put_quilt(facts, path, film.width, film.height);
  facts["width"] = film.width;
  facts["height"] = film.height;
  if (film.pixel_aspect != Rational{1, 1}) {
    facts["pixel_aspect"] = fmt::format("{}:{}", film.pixel_aspect.numerator, film.pixel_aspect.denominator);
  }
  if (film.rotation_degrees != 0) facts["rotation_applied_degrees"] = film.rotation_degrees;
  facts["layout"] = film.layout_how.empty() ? std::string("unsaid") : std::string(layout_name(film.layout));
  put(facts, "layout_from", film.layout_how);
  if (film.frame_rate.numerator > 0) facts["frames_per_second"] = film.frame_rate.value();
  if (film.frame_count) facts["frames"] = *film.frame_count;
  if (film.duration_s > 0) facts["duration_s"] = film.duration_s;
  put(facts, "comment", film.comment);
  put(facts, "colour_matrix", film.colour.matrix);
  put(facts, "colour_range", film.colour.range);
  put(facts, "colour_primaries", film.colour.primaries);
  put(facts, "colour_transfer", film.colour.transfer);
  if (!film.side_streams.empty()) facts["side_streams"] = facts_of_side_streams(film);
  return facts;
}

}  // namespace wheatstone::cli
