#include "wheatstone/app/film_shots.h"

#include <algorithm>
#include <iterator>

#include "wheatstone/files/struct_fields.h"

namespace wheatstone {

RotoscopeOptions options_of_frame(const RotoscopeOptions& options, std::span<const FilmShot> shots,
                                  std::int64_t frame) {
  RotoscopeOptions of_frame = options;
  if (shots.empty()) return of_frame;
  static_assert(field_count<FilmShot>() == 4);
  const FilmShot& shot = *std::prev(std::ranges::upper_bound(shots, frame, {}, &FilmShot::begin));
  of_frame.style = shot.style;
  of_frame.depth_budget = shot.depth_budget;
  of_frame.zero_parallax_px = shot.zero_parallax_px;
  of_frame.scene_begins = shot.begin == frame;
  return of_frame;
}

bool begins_shot(std::span<const FilmShot> shots, std::int64_t frame) {
  return std::ranges::binary_search(shots, frame, {}, &FilmShot::begin);
}

}  // namespace wheatstone
