#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "wheatstone/stereo/disparity_from_depth.h"
#include "wheatstone/stereo/single_view.h"
#include "wheatstone/video/film_reader.h"

namespace wheatstone {

/// Makes the pair of a frame of one eye and its depth. All frames of a scene have one scale: `scene` is the range of
/// depth of its first frame, widened slowly by what later frames show. A frame of which nothing is known, or whose
/// depth is the same everywhere, lies as far as the farthest point. Throws as disparity_from_depth.
MadePair make_film_pair(const Image<Rgb8>& picture, ImageView<const float> depth,
                        const DisparityFromDepthOptions& options, bool scene_begins,
                        std::optional<InverseDepthRange>& scene);

/// Gives the depth of a film's frames, which are asked for in their order.
using FilmDepth = std::function<Image<float>(std::int64_t frame, const Image<Rgb8>& picture)>;

/// A film that others are read beside, frame for frame, and how it is read.
struct MainFilm {
  std::filesystem::path film;
  const FilmFacts& facts;
  const FilmReaderOptions& reading;
};

/// Of a film of depth in grey, or numbered pictures. Throws Error{bad_input} that names it where it is no film, has not
/// as many frames as the film or not its shape, is in colour, or its depth is the same everywhere in all frames; and
/// while frames are asked for, where it ends before the film.
FilmDepth depth_of_film(const std::filesystem::path& depth, const MainFilm& of, DepthKind kind);

/// By a network (matching/monocular_network.h), which is asked once a frame. Throws as that does, and Error{bad_input}
/// where it finds the same depth everywhere in the first frame.
FilmDepth depth_of_network(const std::filesystem::path& model);

}  // namespace wheatstone
