#include "wheatstone/app/film_presentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/slow_ends_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone {
namespace {

constexpr std::string_view beginning_of_note = "The eyes were moved for looking at";

DisplayComposition composition_of(const FilmDisplay& display) {
  if (display.quilt) return *display.quilt;
  if (display.screen) return *display.screen;
  throw Error(ErrorKind::wrong_usage, "the display takes neither quilts nor lenticular pictures");
}

/// Those of one view or two, or of a composition.
FramePictures frame_pictures(Presented shown) {
  if (!shown.composed.empty()) return std::move(shown.composed);
  if (shown.views.size() == 1) return std::move(shown.views.front());
  return StereoPair{std::move(shown.views.front()), std::move(shown.views.back())};
}

Presented presented(std::vector<DrawnView> drawn) {
  Presented shown;
  for (DrawnView& view : drawn) {
    shown.worst_bare_share = std::max(shown.worst_bare_share, view.bare_share);
    shown.views.push_back(std::move(view.picture));
    if (!view.deep.empty()) shown.deep.push_back(std::move(view.deep));
  }
  return shown;
}

/// Puts `share`, 0..1, of a picture over the rest of another one of its size.
template <class Pixel>
void mix(const Image<Pixel>& outgoing, float share, Image<Pixel>& picture) {
  using Level = decltype(Pixel::r);
  const auto mixed = [share](Level from, Level to) {
    return static_cast<Level>(std::lround(static_cast<float>(from) + share * static_cast<float>(to - from)));
  };
  std::ranges::transform(outgoing.pixels(), picture.pixels(), picture.pixels().begin(), [&](Pixel from, Pixel to) {
    return Pixel{mixed(from.r, to.r), mixed(from.g, to.g), mixed(from.b, to.b)};
  });
}

}  // namespace

void follow_depth(const DepthEnds& frame, bool scene_begins, SceneDepth& scene) {
  if (scene_begins) {
    scene = {frame, frame};
    return;
  }
  widen_slowly(frame.farthest_px, frame.nearest_px, scene.ends.farthest_px, scene.ends.nearest_px);
}

ViewRange planned_views(PictureSize frame, const SceneDepth& scene, const DisplayViewsOptions& options) {
  const float half = plan_display(frame, scene.first, options).span / 2;
  return {ViewPosition(-half), ViewPosition(half)};
}

Presentation for_display(PictureSize frame, const SceneDepth& scene, const FilmDisplay& display, Device device) {
  Presentation presentation = plan_display(frame, scene.ends, display.views).presentation;
  presentation.composition = composition_of(display);
  presentation.device = device;
  return presentation;
}

Frame frame_in_film(DrawnFrame drawn, StereoLayout layout, std::string_view anaglyph) {
  Frame frame;
  if (const auto* const eyes = std::get_if<StereoPair>(&drawn.pictures))
    frame.picture = put_into_frame(*eyes, layout, anaglyph);
  else
    frame.picture = std::get<Image<Rgb8>>(std::move(drawn.pictures));
  if (drawn.deep.size() == 1) frame.deep = std::move(drawn.deep.front());
  if (drawn.deep.size() == 2 && anaglyph.empty()) frame.deep = put_together(drawn.deep[0], drawn.deep[1], layout);
  return frame;
}

void dissolve_from(const Frame& outgoing, float share, Frame& frame) {
  mix(outgoing.picture, share, frame.picture);
  if (same_size(outgoing.deep, frame.deep)) return mix(outgoing.deep, share, frame.deep);
  frame.deep = {};
}

DrawnFrame draw_film_frame(const Painting& painting, const FrameShowing& showing, std::vector<DrawnView> drawn) {
  Presentation presentation = showing.presentation;
  presentation.backgrounds.assign(showing.backgrounds.begin(), showing.backgrounds.end());
  Presented shown = drawn.empty() ? present(painting, presentation) : presented(std::move(drawn));
  double worst_bare_share = shown.worst_bare_share;
  if (const auto& outside = showing.outside) {
    shown.deep.clear();  // the pictures outside have 8 bits
    Presented painted;
    if (outside->painting) {
      presentation.backgrounds.assign(outside->pictures.begin(), outside->pictures.end());
      painted = present(*outside->painting, presentation);
      worst_bare_share = std::max(worst_bare_share, painted.worst_bare_share);
    }
    const std::vector<Image<Rgb8>>& pictures = outside->painting ? painted.views : outside->pictures;
    for (std::size_t i = 0; i < shown.views.size(); ++i) show_in_mask(outside->masks[i], pictures[i], shown.views[i]);
  }
  std::vector<Image<Rgb16>> deep = std::move(shown.deep);
  return {frame_pictures(std::move(shown)), worst_bare_share, std::move(deep)};
}

std::string moved_eyes_note(std::int64_t frames, double least_separation) {
  if (frames == 0) return {};
  return fmt::format("{} in {} frames, nearest together at {:.2f} of their distance", beginning_of_note, frames,
                     least_separation);
}

bool tells_moved_eyes(std::string_view comment) { return comment.starts_with(beginning_of_note); }

}  // namespace wheatstone
