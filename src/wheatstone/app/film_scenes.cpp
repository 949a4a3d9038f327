#include "wheatstone/app/film_scenes.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "wheatstone/app/painted_film.h"
#include "wheatstone/motion/flow.h"

namespace wheatstone {

FilmScenes find_scenes(StereoFilmReader& film, const Ranks& ranks, const Progress& progress,
                       const std::function<void(const StereoFrame& frame, bool is_cut)>& look) {
  // Frames are compared in runs, which ranks take in turn.
  constexpr std::int64_t run = 16;
  std::vector<std::int64_t> cuts;
  std::int64_t next = 0;
  StereoFrame frame, before;
  for (std::int64_t first = run * ranks.rank(); next >= 0; first += run * ranks.count()) {
    // The frame before the run tells whether the run begins with a cut.
    const std::int64_t from = std::max<std::int64_t>(first - 1, 0);
    if (next < from) next += film.skip(from - next);
    for (; next >= from && next < first + run && film.read(frame); ++next) {
      report(progress, "looking for cuts", share_of_film(film.facts(), next));
      const bool is_cut = next > from && find_cut(before.left, frame.left).cut;
      if (is_cut) cuts.push_back(next);
      if (look) look(frame, is_cut);
      std::swap(before, frame);
    }
    if (next < first + run) break;
  }
  FilmScenes scenes;
  for (const std::int64_t frames : ranks.from_all(next)) scenes.frames = std::max(scenes.frames, frames);
  if (scenes.frames > 0) scenes.begins.push_back(0);
  for (const Ranks::Bytes& of_rank : ranks.from_all(Ranks::bytes_of(std::span<const std::int64_t>(cuts)))) {
    cuts.resize(of_rank.size() / sizeof(std::int64_t));
    if (!cuts.empty()) std::memcpy(cuts.data(), of_rank.data(), of_rank.size());
    scenes.begins.insert(scenes.begins.end(), cuts.begin(), cuts.end());
  }
  std::ranges::sort(scenes.begins);
  return scenes;
}

std::vector<ScenePart> deal_out_scenes(const FilmScenes& film, std::int64_t done, int ranks) {
  std::vector<ScenePart> parts;
  std::vector<std::int64_t> given(static_cast<std::size_t>(ranks), 0);
  // To write a frame takes about a tenth of the time that painting it takes (docs/scale.md).
  given.front() = (film.frames - done) / 10;
  for (std::size_t i = 0; i < film.begins.size(); ++i) {
    const std::int64_t begin = std::max(film.begins[i], done);
    const std::int64_t end = i + 1 < film.begins.size() ? film.begins[i + 1] : film.frames;
    if (begin >= end) continue;
    const auto least = std::ranges::min_element(given);
    *least += end - begin;
    parts.push_back({begin, end, static_cast<int>(least - given.begin())});
  }
  return parts;
}

}  // namespace wheatstone
