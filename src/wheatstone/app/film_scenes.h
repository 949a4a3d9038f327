#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "wheatstone/progress.h"
#include "wheatstone/ranks/ranks.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone {

/// A film from cut to cut. Frames are counted from 0.
struct FilmScenes {
  std::vector<std::int64_t> begins;  ///< the first frame of each scene
  std::int64_t frames = 0;           ///< of the film
};

/// Reads a film to its end and tells its cuts, as rotoscope_frame does. Ranks share the looking: each decodes all
/// frames and compares some of them. `look` gets each frame that this rank compares, in order, and whether a cut is
/// before it. Throws as the reader does.
FilmScenes find_scenes(StereoFilmReader& film, const Ranks& ranks = {}, const Progress& progress = {},
                       const std::function<void(const StereoFrame& frame, bool is_cut)>& look = {});

/// Frames of one scene, which one rank paints.
struct ScenePart {
  std::int64_t begin = 0, end = 0;
  int rank = 0;
};

/// Divides the frames after the first `done` among ranks, scene by scene in order. Each scene goes to the rank with the
/// least work so far, so that all ranks advance together; the first rank also writes all frames.
std::vector<ScenePart> deal_out_scenes(const FilmScenes& film, std::int64_t done, int ranks);

}  // namespace wheatstone
