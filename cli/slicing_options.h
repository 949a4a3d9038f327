#pragma once

#include <functional>
#include <vector>

#include "options.h"
#include "wheatstone/marks/slicing.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::cli {

/// --slice-layer, --slice-depth and --slice-keep of a painting. `planes_travel` says whether there are planes without
/// --slice-depth.
Rows slicing_rows(Slicing& slicing, const Reasons& unless, const std::function<bool()>& planes_travel = {});

/// Planes that travel through a painting, as they are typed.
struct SliceFilmArguments {
  std::vector<SliceDepth> from, to;
  int frames = 120;
  Rational rate{24, 1};
};

/// Whether a film of them is wanted.
inline bool makes_slice_film(const SliceFilmArguments& arguments) {
  return !arguments.from.empty() || !arguments.to.empty();
}

/// --slice-from, --slice-to, --frames and --rate.
Rows slice_film_rows(SliceFilmArguments& film, const Reasons& unless);

}  // namespace wheatstone::cli
