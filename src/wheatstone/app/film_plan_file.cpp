#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "wheatstone/app/field_file_internal.h"
#include "wheatstone/app/film_plan_file_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr FieldFile plan_format{"WSPLAN 1", "plan the film again"};
constexpr auto plan_name = "plan";
constexpr auto of_shot = "", of_outgoing = "outgoing_", of_masks = "mask_",
               of_outside = "outside_";  ///< beginnings of the names of files

std::string marks_name(const std::string& of, std::int64_t number) {
  return fmt::format("{}marks_{:06}.wst", of, number);
}

std::string picture_name(const std::string& of, std::int64_t number, std::size_t place) {
  return fmt::format("{}{}_{:06}.png", of, place == 0 ? "left" : "right", number);
}

template <class Pixel>
void write_pictures(const std::vector<Image<Pixel>>& pictures, const std::string& of, std::int64_t number,
                    const OutputFolder& folder) {
  for (std::size_t i = 0; i < pictures.size(); ++i) write_image(folder.file(picture_name(of, number, i)), pictures[i]);
}

std::vector<Image<Rgb8>> read_pictures(const fs::path& folder, const std::string& of, std::int64_t number,
                                       std::size_t count) {
  std::vector<Image<Rgb8>> pictures;
  for (std::size_t i = 0; i < count; ++i) pictures.push_back(read_image(folder / picture_name(of, number, i)));
  return pictures;
}

/// Whether a painting can be shown so: those who draw it trust these numbers.
bool can_be_shown(const PlannedShowing& showing) {
  constexpr int largest_side_px = 65535;
  constexpr std::size_t most_views = 4096;
  const auto is_side = [](int side) { return side >= 0 && side <= largest_side_px; };
  const Placement& placement = showing.placement;
  bool holds = !showing.views.empty() && showing.views.size() <= most_views && is_side(placement.width) &&
               is_side(placement.height) && placement.scale > 0 && std::isfinite(placement.scale) &&
               std::isfinite(placement.left) && std::isfinite(placement.top) &&
               std::isfinite(placement.zero_parallax_px) && !(showing.quilt && showing.screen) &&
               showing.device <= Device::automatic;
  for (const ViewPosition view : showing.views) holds = holds && std::isfinite(view.eye_separations());
  if (const auto& covered = showing.covered)
    holds = holds && 0 <= covered->left && covered->left <= covered->right && covered->right <= placement.width &&
            0 <= covered->top && covered->top <= covered->bottom && covered->bottom <= placement.height;
  if (const auto& quilt = showing.quilt)
    holds = holds && is_side(quilt->columns) && is_side(quilt->rows) &&
            std::size_t(quilt->columns) * std::size_t(quilt->rows) == showing.views.size();
  if (const auto& screen = showing.screen)
    holds = holds && is_side(screen->width) && is_side(screen->height) && std::isfinite(screen->pitch) &&
            std::isfinite(screen->center) && screen->dpi > 0 && std::isfinite(screen->dpi) && screen->slope != 0 &&
            std::isfinite(screen->slope);
  const auto are_pictures = [&](std::int32_t count) {
    return count == 0 || (count <= 2 && std::size_t(count) == showing.views.size());
  };
  if (showing.is_masked)
    holds = holds && showing.views.size() <= 2 && !showing.quilt && !showing.screen && are_pictures(showing.outside) &&
            (showing.paints_outside || showing.outside > 0);
  return holds && are_pictures(showing.backgrounds);
}

void check_plan(const FilmPlan& plan, const FieldReader& reader) {
  reader.expect(!plan.frames.empty() && plan.frames_per_segment > 0 && !plan.film.empty() &&
                plan.writing.layout <= StereoLayout::alternating);
  for (const FrameInPlan& frame : plan.frames) {
    reader.expect(can_be_shown(frame.shot) && frame.time_base.numerator > 0 && frame.time_base.denominator > 0);
    if (frame.outgoing) reader.expect(can_be_shown(*frame.outgoing) && frame.share >= 0 && frame.share <= 1);
  }
}

PlannedShowing planned_showing(const FrameShowing& showing) {
  const Presentation& presentation = showing.presentation;
  PlannedShowing planned{.views = presentation.views,
                         .placement = presentation.placement,
                         .covered = presentation.covered,
                         .quilt = {},
                         .screen = {},
                         .device = presentation.device,
                         .deep = presentation.deep,
                         .backgrounds = static_cast<std::int32_t>(showing.backgrounds.size())};
  if (const auto& composition = presentation.composition) {
    if (const auto* const quilt = std::get_if<QuiltLayout>(&*composition))
      planned.quilt = *quilt;
    else
      planned.screen = std::get<LenticularScreen>(*composition);
  }
  if (const auto& outside = showing.outside) {
    planned.is_masked = true;
    planned.paints_outside = outside->painting.has_value();
    planned.outside = static_cast<std::int32_t>(outside->pictures.size());
  }
  return planned;
}

FrameOfPlan read_frame(const fs::path& folder, const PlannedShowing& planned, const std::string& of,
                       std::int64_t number) {
  FrameOfPlan frame{read_painting(folder / marks_name(of, number)), {}};
  Presentation& presentation = frame.showing.presentation;
  presentation = {.views = planned.views,
                  .placement = planned.placement,
                  .covered = planned.covered,
                  .device = planned.device,
                  .deep = planned.deep};
  if (planned.quilt) presentation.composition = *planned.quilt;
  if (planned.screen) presentation.composition = *planned.screen;
  frame.showing.backgrounds = read_pictures(folder, of, number, static_cast<std::size_t>(planned.backgrounds));
  if (!planned.is_masked) return frame;
  ShownOutside& outside = frame.showing.outside.emplace();
  for (const Image<Rgb8>& mask : read_pictures(folder, of + of_masks, number, planned.views.size()))
    outside.masks.push_back(mask_of_picture(mask));
  outside.pictures = read_pictures(folder, of + of_outside, number, static_cast<std::size_t>(planned.outside));
  if (planned.paints_outside) outside.painting = read_painting(folder / marks_name(of + of_outside, number));
  return frame;
}

}  // namespace

std::string film_plan_with_checksum(std::string_view members) {
  return field_file_of_members<FilmPlan>(plan_format, members);
}

std::string encode_film_plan(const FilmPlan& plan) { return encode_field_file(plan_format, plan); }

FilmPlan decode_film_plan(std::string_view bytes, std::string_view name) {
  return decode_field_file<FilmPlan>(plan_format, bytes, name, check_plan);
}

FilmPlan read_film_plan(const fs::path& folder, std::string_view version) {
  std::error_code ignored;
  if (!fs::exists(folder / plan_name, ignored))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is no plan of a film, expected a folder that --plan made", folder.string()));
  const std::string bytes = read_whole_file(folder / plan_name, std::numeric_limits<std::size_t>::max());
  FilmPlan plan = decode_film_plan(bytes, folder.string());
  if (plan.version != version)
    throw Error(ErrorKind::bad_input, fmt::format("{}: was planned by Wheatstone {}, expected {}; plan the film again, "
                                                  "or draw and join it with that version",
                                                  folder.string(), plan.version, version));
  return plan;
}

FilmPlanWriter::FilmPlanWriter(const fs::path& folder)
    : folder_([&] {
        std::error_code ignored;
        if (fs::exists(fs::symlink_status(folder, ignored)))
          throw Error(
              ErrorKind::wrong_usage,
              fmt::format("{}: exists already, expected no such file, because plans of two films would be mixed",
                          folder.string()));
        return folder;
      }()) {}

void FilmPlanWriter::write(const PaintedFilmFrame& frame, const StereoFrame& times) {
  FrameInPlan& added = frames_.emplace_back(FrameInPlan{.shot = planned_showing(frame.shot.showing),
                                                        .share = frame.share,
                                                        .pts = times.pts,
                                                        .time_base = times.time_base,
                                                        .duration = times.duration});
  write_painting_of(frame.shot, of_shot);
  if (!frame.outgoing) return;
  added.outgoing = planned_showing(frame.outgoing->showing);
  write_painting_of(*frame.outgoing, of_outgoing);
}

void FilmPlanWriter::write_painting_of(const PlannedFilmFrame& frame, const std::string& prefix) {
  const auto number = static_cast<std::int64_t>(frames_.size());
  write_painting(folder_.file(marks_name(prefix, number)), frame.painting);
  write_pictures(frame.showing.backgrounds, prefix, number, folder_);
  const auto& outside = frame.showing.outside;
  if (!outside) return;
  write_pictures(outside->masks, prefix + of_masks, number, folder_);
  write_pictures(outside->pictures, prefix + of_outside, number, folder_);
  if (outside->painting) write_painting(folder_.file(marks_name(prefix + of_outside, number)), *outside->painting);
}

void FilmPlanWriter::finish(FilmPlan plan) {
  plan.frames = std::move(frames_);
  write_whole_file(folder_.file(plan_name), encode_film_plan(plan));
  folder_.commit();
}

FrameOfPlan read_planned_frame(const fs::path& folder, const FilmPlan& plan, std::int64_t number) {
  return read_frame(folder, plan.frames[static_cast<std::size_t>(number - 1)].shot, of_shot, number);
}

FrameOfPlan read_outgoing_frame(const fs::path& folder, const FilmPlan& plan, std::int64_t number) {
  return read_frame(folder, *plan.frames[static_cast<std::size_t>(number - 1)].outgoing, of_outgoing, number);
}

}  // namespace wheatstone
