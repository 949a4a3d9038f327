#include "wheatstone/app/film_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "wheatstone/app/film_beside_internal.h"
#include "wheatstone/app/slow_ends_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/matching/monocular_network.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// The depth of a grey picture.
Image<float> depth_of_picture(const Image<Rgb8>& picture) {
  Image<float> depth(picture.width(), picture.height());
  std::ranges::transform(picture.pixels(), depth.pixels().begin(),
                         [](Rgb8 pixel) { return static_cast<float>(pixel.r + pixel.g + pixel.b) / 3; });
  return depth;
}

bool is_grey(const Image<Rgb8>& picture) {
  // Largest mean difference of colour channels that lossy coding adds to a grey picture.
  constexpr double most_levels = 6;
  double sum = 0;
  for (const Rgb8 pixel : picture.pixels())
    sum += std::max({pixel.r, pixel.g, pixel.b}) - std::min({pixel.r, pixel.g, pixel.b});
  return sum <= most_levels * static_cast<double>(picture.pixels().size());
}

void check_shape(const fs::path& depth, const FilmFacts& found, const MainFilm& of) {
  const auto shape = [](const FilmFacts& facts) { return static_cast<double>(facts.width) / facts.height; };
  const double rounding = 1.0 / std::min(found.width, found.height);
  if (std::abs(shape(found) / shape(of.facts) - 1) > std::max(0.01, rounding))
    refuse_film_beside(depth, fmt::format("is {}x{} pixels, expected the shape of {}, {}x{}", found.width, found.height,
                                          of.film.string(), of.facts.width, of.facts.height));
}

/// Looks for a frame with near and far points: most often the first.
void check_any_depth(const fs::path& depth, const FilmReaderOptions& reading, DepthKind kind) {
  FilmReader film = open_film(depth, reading);
  bool any = false;
  for (Frame frame; film.read(frame);) {
    any = true;
    if (!is_grey(frame.picture)) refuse_film_beside(depth, "is in colour, expected grey for depth");
    if (inverse_depth_range(depth_of_picture(frame.picture), kind)) return;
  }
  // A film without frames is reported elsewhere.
  if (any) refuse_film_beside(depth, "its depth is the same everywhere, expected near and far points");
}

}  // namespace

MadePair make_film_pair(const Image<Rgb8>& picture, ImageView<const float> depth,
                        const DisparityFromDepthOptions& options, bool scene_begins,
                        std::optional<InverseDepthRange>& scene) {
  const std::optional<InverseDepthRange> now = inverse_depth_range(depth, options.kind);
  if (!now) return make_pair_from_single_view(picture, Image<float>(picture.width(), picture.height(), 0));
  if (!scene || scene_begins) {
    scene = now;
  } else {
    widen_slowly(now->farthest, now->nearest, scene->farthest, scene->nearest);
  }
  DisparityFromDepthOptions of_scene = options;
  of_scene.range = scene;
  return make_pair_from_single_view(picture, disparity_from_depth(depth, picture, of_scene));
}

FilmDepth depth_of_film(const fs::path& depth, const MainFilm& of, DepthKind kind) {
  check_any_depth(depth, of.reading, kind);
  // A std::function can be copied; a reader cannot.
  const auto film = std::make_shared<FilmBeside>(depth, of);
  check_shape(depth, film->facts(), of);
  return [film](std::int64_t frame, const Image<Rgb8>& /*picture*/) { return depth_of_picture(film->at(frame)); };
}

FilmDepth depth_of_network(const fs::path& model) {
  const auto network = std::make_shared<MonocularNetwork>(model);
  return [network, model](std::int64_t frame, const Image<Rgb8>& picture) {
    Image<float> depth = network->depth_of(picture);
    if (frame == 0 && !inverse_depth_range(depth, DepthKind::inverse))
      refuse_film_beside(model, "finds the same depth everywhere in the first frame, expected near and far points");
    return depth;
  };
}

}  // namespace wheatstone
