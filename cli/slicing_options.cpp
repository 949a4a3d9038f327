#include "slicing_options.h"

#include <string>

#include "film_argument.h"

namespace wheatstone::cli {
namespace {

constexpr Choice<SliceKeeps> slice_sides[] = {{"back", SliceKeeps::back}, {"front", SliceKeeps::front}};

Value slice_depths(std::vector<SliceDepth>& depths) {
  const auto parse = [](const std::string& option, const std::string& words) {
    return parse_slice_depths(words, option);
  };
  return parsed(depths, parse, "SHARE%|DISPARITYpx,...");
}

}  // namespace

Rows slicing_rows(Slicing& slicing, const Reasons& unless, const std::function<bool()>& planes_travel) {
  Reasons without_plane = unless;
  without_plane.push_back(
      when([&slicing, planes_travel] { return slicing.depths.empty() && !(planes_travel && planes_travel()); },
           "without a plane; it works with --slice-depth"));
  return {
      row("--slice-layer", without_default(number(slicing.finest_layer, {0, 1000})),
          "Number of the finest layer of strokes that a painting.wst shows, from the coarsest, 0", unless),
      row("--slice-depth", slice_depths(slicing.depths),
          "Plane that cuts the finest layer that is shown: its strokes before the plane are left out. A share of "
          "the way from the nearest stroke to the farthest, or a disparity; further ones are of the coarser layers",
          unless),
      row("--slice-keep", choice(slicing.keeps, slice_sides), "Side of the plane whose strokes stay", without_plane)};
}

Rows slice_film_rows(SliceFilmArguments& film, const Reasons& unless) {
  const Rows planes{
      row("--slice-from", slice_depths(film.from),
          "Write a film in which planes travel through the painting: where they are in the first frame, "
          "as for --slice-depth",
          unless, "--slice-to", {"--slice-depth"}),
      row("--slice-to", slice_depths(film.to), "Where they are in the last frame", unless, "--slice-from")};
  const Rows frames{
      row("--frames", number(film.frames, {1, 10'000'000}), "Number of frames of the film"),
      row("--rate", parsed(film.rate, parse_frame_rate, {}, "24"), "Frames per second, for example 25 or 24000/1001")};
  return under("Film", join({planes, under({}, frames,
                                           {when([&film] { return !makes_slice_film(film); },
                                                 "on a picture; it works with --slice-from and --slice-to")})}));
}

}  // namespace wheatstone::cli
