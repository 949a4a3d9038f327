#include "wheatstone/app/eyes_in_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "wheatstone/display/anaglyph.h"
#include "wheatstone/error.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone {

EyesInFilm find_eyes_in_film(const std::string& option, std::string_view name) {
  if (name == "two-files") return {{}, {}, true};
  if (name == "anaglyph") return {{}, std::string(anaglyph_kinds().front().name)};
  for (const AnaglyphKind& kind : anaglyph_kinds())
    if (name == kind.name || (!kind.ffmpeg.empty() && name == kind.ffmpeg)) return {{}, std::string(kind.name)};
  const std::optional<StereoLayout> layout = find_stereo_layout(name);
  if (layout) return {layout, {}};
  throw Error(ErrorKind::wrong_usage,
              fmt::format("{}: there is no layout '{}' of films, expected two-files, anaglyph or one of {}", option,
                          name, stereo_layout_names()));
}

std::filesystem::path film_of_eye(const std::filesystem::path& film, ViewPosition eye) {
  const std::string word = eye == left_eye ? "left" : "right";
  const std::string stem = film.stem().string();
  const std::size_t number = stem.find('%');  // of numbered pictures: the eye goes before it
  if (number == std::string::npos)
    return film.parent_path() / fmt::format("{}_{}{}", stem, word, film.extension().string());
  return film.parent_path() /
         fmt::format("{}{}_{}{}", stem.substr(0, number), word, stem.substr(number), film.extension().string());
}

void keep_full_colour(FilmWriterOptions& writing) {
  const std::string_view codec = writing.codec;
  if (!writing.pixel_format.empty()) return;
  if (codec == "h264" || codec == "hevc" || codec == "vp9") writing.pixel_format = "yuv444p";
  if (codec == "hevc-10" || codec == "av1" || codec == "dnxhr") writing.pixel_format = "yuv444p10le";
}

Image<Rgb8> put_into_frame(const StereoPair& eyes, StereoLayout layout, std::string_view anaglyph_name) {
  if (anaglyph_name.empty()) return put_together(eyes.left, eyes.right, layout);
  const auto kind = std::ranges::find(anaglyph_kinds(), anaglyph_name, &AnaglyphKind::name);
  if (kind == anaglyph_kinds().end())
    throw Error(ErrorKind::wrong_usage, fmt::format("there is no anaglyph '{}'", anaglyph_name));
  return anaglyph({eyes.left, eyes.right}, *kind);
}

std::vector<Frame> frames_of_films(Frame frame, std::size_t films) {
  std::vector<Frame> all;
  if (films == 1) {
    all.push_back(std::move(frame));
    return all;
  }
  StereoPair eyes = cut_apart(frame.picture, StereoLayout::left_right, "a frame");
  std::pair<Image<Rgb16>, Image<Rgb16>> deep;
  if (!frame.deep.empty()) deep = cut_apart(frame.deep, StereoLayout::left_right, "a frame");
  all.push_back({std::move(eyes.left), frame.pts, frame.time_base, frame.duration, std::move(deep.first)});
  all.push_back({std::move(eyes.right), frame.pts, frame.time_base, frame.duration, std::move(deep.second)});
  return all;
}

}  // namespace wheatstone
