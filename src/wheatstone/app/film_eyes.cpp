#include "wheatstone/app/film_eyes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "wheatstone/drawing/draw.h"

namespace wheatstone {
namespace {

constexpr std::string_view beginning_of_note = "The eyes were moved for looking at";

}  // namespace

bool are_moved(const FilmEyes& eyes) { return eyes.separation < 1 || eyes.zero_parallax_px != 0; }

FilmEyes comfortable_eyes(PictureSize frame, const DepthEnds& ends, float depth_budget) {
  const auto width = static_cast<float>(frame.width);
  const float budget_px = depth_budget * width, before_px = budget_px / 3, behind_px = budget_px - before_px;
  const float depth_px = std::max(ends.nearest_px - ends.farthest_px, 1e-3f);
  FilmEyes eyes;
  float scale = 1;
  // What is cropped where the pictures are shifted, and enlarged to fill the frame again, depends on the eyes.
  for (int step = 0; step < 4; ++step) {
    eyes.separation = std::min(budget_px / (depth_px * scale), 1.f);
    const float shown = eyes.separation * scale;
    const float least = ends.nearest_px - before_px / shown, most = ends.farthest_px + behind_px / shown;
    eyes.zero_parallax_px = std::clamp(0.f, std::min(least, most), most);
    scale = width / std::max(width - eyes.separation * std::abs(eyes.zero_parallax_px), width / 2);
  }
  eyes.placement = {.width = frame.width,
                    .height = frame.height,
                    .scale = static_cast<double>(scale),
                    .left = frame.width * (1 - 1 / static_cast<double>(scale)) / 2,
                    .top = frame.height * (1 - 1 / static_cast<double>(scale)) / 2,
                    .zero_parallax_px = eyes.zero_parallax_px};
  return eyes;
}

FilmEyePictures draw_for_eyes(const Painting& painting, const FilmEyes& eyes, Device device) {
  const std::array views{ViewPosition(-eyes.separation / 2), ViewPosition(eyes.separation / 2)};
  std::vector<DrawnView> drawn = draw(prepare(painting, {.placement = eyes.placement}, device), views);
  DrawnView &left = drawn.front(), &right = drawn.back();
  return {std::move(left.picture), std::move(right.picture), left.bare_share, right.bare_share};
}

std::string moved_eyes_note(std::int64_t frames, double least_separation) {
  return fmt::format("{} in {} frames, nearest together at {:.2f} of their distance", beginning_of_note, frames,
                     least_separation);
}

bool tells_moved_eyes(std::string_view comment) { return comment.starts_with(beginning_of_note); }

}  // namespace wheatstone
