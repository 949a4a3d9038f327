#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "wheatstone/app/film_plan.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/paint_film_frame_internal.h"

namespace wheatstone {

/// The plan of a film while it grows, frame by frame. It gets its name when it is whole; destroyed before, it leaves
/// nothing.
class FilmPlanWriter {
 public:
  /// Throws Error{wrong_usage} where there is something of this name.
  explicit FilmPlanWriter(const std::filesystem::path& folder);

  /// Adds the next frame; of `times` only the times count.
  void write(const PaintedFilmFrame& frame, const StereoFrame& times);

  /// `plan` without frames: those that were written are added.
  void finish(FilmPlan plan);

 private:
  void write_painting_of(const PlannedFilmFrame& frame, const std::string& prefix);

  OutputFolder folder_;
  std::vector<FrameInPlan> frames_;
};

/// A frame of a plan, counted from 1, as draw_film_frame takes it.
struct FrameOfPlan {
  Painting painting;
  FrameShowing showing;
};

/// Throws Error{bad_input}.
FrameOfPlan read_planned_frame(const std::filesystem::path& folder, const FilmPlan& plan, std::int64_t number);

/// The same of the shot that fades out in this frame.
FrameOfPlan read_outgoing_frame(const std::filesystem::path& folder, const FilmPlan& plan, std::int64_t number);

/// The description of a plan as bytes, and back, checked. Throws Error{bad_input}.
std::string encode_film_plan(const FilmPlan& plan);
FilmPlan decode_film_plan(std::string_view bytes, std::string_view name);

/// Puts the header that decode_film_plan expects before the members' bytes. For tests that change them.
std::string film_plan_with_checksum(std::string_view members);

}  // namespace wheatstone
