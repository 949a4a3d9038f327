#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "command_table.h"
#include "inputs.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/retouch_strokes.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/retouched_right.h"

namespace wheatstone::viewer {
namespace {

/// A painting is open, and its photograph, whose depth is known.
bool can_retouch_depth(const Viewer& viewer) {
  const auto* const content = std::get_if<PaintedContent>(&viewer.session().opened.content);
  return content != nullptr && content->painting && content->photograph && content->photograph->geometry &&
         !viewer.session().film;
}

bool can_retouch_strokes(const Viewer& viewer) {
  const auto* const content = std::get_if<PaintedContent>(&viewer.session().opened.content);
  return content != nullptr && content->painting && has_strokes_to_retouch(*content->painting) &&
         !viewer.session().film;
}

bool can_retouch(const Viewer& viewer) { return can_retouch_depth(viewer) || can_retouch_strokes(viewer); }

bool is_of_strokes(RetouchTool tool) { return tool >= RetouchTool::paint; }

void set_tool(Viewer& viewer, const Words& words) {
  viewer.session().retouch.tool = static_cast<RetouchTool>(place_among(retouch_tool_names, words[0], "tool"));
}

/// The touch that the chosen tool does at a place of the left view, where that disparity lies.
Touch touch_of(const Session& session, const SeenPlace& at, float pressure) {
  const RetouchBrush& brush = session.retouch;
  const float strength = pressure * brush.strength;
  const float farthest = session.opened.depth ? session.opened.depth->farthest_px : at.disparity_px;
  const float nearest = session.opened.depth ? session.opened.depth->nearest_px : at.disparity_px;
  Touch touch{.x = at.x, .y = at.y, .radius_px = brush.radius_px, .colour = brush.colour};
  const auto is = [&](Retouch kind, float amount) {
    touch.kind = kind;
    touch.amount = amount;
  };
  constexpr float detail_levels = 40, smoothed_over = 1.f / 3;
  switch (brush.tool) {
    case RetouchTool::off:
      throw Error(ErrorKind::wrong_usage, "no tool is chosen; choose one with retouch");
    case RetouchTool::nearer:
      is(Retouch::shift, strength);
      break;
    case RetouchTool::farther:
      is(Retouch::shift, -strength);
      break;
    case RetouchTool::smooth:
      is(Retouch::smooth, smoothed_over * brush.radius_px);
      break;
    case RetouchTool::flatten:
      is(Retouch::set, brush.begun_at_px.value_or(at.disparity_px));
      break;
    case RetouchTool::fill_far:
      is(Retouch::fill, farthest);
      break;
    case RetouchTool::fill_near:
      is(Retouch::fill, nearest);
      break;
    case RetouchTool::lasso_nearer:
      is(Retouch::shift_area, brush.strength);
      break;
    case RetouchTool::lasso_farther:
      is(Retouch::shift_area, -brush.strength);
      break;
    case RetouchTool::lasso_flatten:
      is(Retouch::set_area, brush.begun_at_px.value_or(at.disparity_px));
      break;
    case RetouchTool::finer:
      is(Retouch::detail, detail_levels * strength);
      break;
    case RetouchTool::coarser:
      is(Retouch::detail, -detail_levels * strength);
      break;
    case RetouchTool::paint:
      is(Retouch::paint, 0);
      break;
    case RetouchTool::erase:
      is(Retouch::erase, 0);
      break;
    case RetouchTool::recolour:
      is(Retouch::recolour, 0);
      break;
    case RetouchTool::pick:
      break;
  }
  return touch;
}

/// Takes the colour of the brush from the picture.
void pick_colour(Viewer& viewer, double x, double y) {
  const Frame* const frame = viewer.frame();
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  if (frame == nullptr || !frame->picture.contains(column, row)) return;
  viewer.session().retouch.colour = frame->picture(column, row);
}

void set_colour(Viewer& viewer, const Words& words) {
  const std::optional<Rgb8> colour = colour_of_code(words[0]);
  if (!colour) throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no colour, expected one as 3366FF", words[0]));
  viewer.session().retouch.colour = *colour;
}

std::string colour_now(const Viewer& viewer) {
  const Rgb8 colour = viewer.session().retouch.colour;
  return fmt::format("{:02X}{:02X}{:02X}", colour.r, colour.g, colour.b);
}

/// At X Y, with the PRESSURE of a pen. A stroke of the hand begins, or goes on; one that begins beside the picture
/// begins where it first meets it.
void do_touch(Viewer& viewer, const Words& words, bool goes_on) {
  Session& session = viewer.session();
  std::optional<float>& begun_at_px = session.retouch.begun_at_px;
  if (!goes_on) begun_at_px.reset();
  const double x = number_of(words[0]), y = number_of(words[1]);
  const float pressure = words.size() > 2 ? static_cast<float>(number_of(words[2], 0, 1)) : 1;
  const RetouchTool tool = session.retouch.tool;
  if (tool == RetouchTool::pick) return pick_colour(viewer, x, y);
  if (is_of_strokes(tool) && !can_retouch_strokes(viewer))
    throw Error(ErrorKind::wrong_usage, "there is no painting of strokes to retouch");
  if (!is_of_strokes(tool) && !can_retouch_depth(viewer))
    throw Error(ErrorKind::wrong_usage, "there is no photograph to retouch, or it is not painted yet");
  const std::optional<SeenPlace> at = is_of_strokes(tool) ? seen_at(viewer, x, y) : seen_in_left(viewer, x, y);
  if (!at) return viewer.tell("the depth is not known there");
  const bool begins = !begun_at_px;
  if (begins) begun_at_px = at->disparity_px;
  Touch touch = touch_of(session, *at, pressure);
  touch.goes_on = !begins;
  if (touch.kind == Retouch::detail && !reads_detail(session.state.style))
    throw Error(ErrorKind::wrong_usage, fmt::format("the style {} paints all places alike; oil reads the detail map",
                                                    session.state.style.name));
  viewer.touch(touch);
}

/// Where the left and the right picture of a map are saved.
std::array<std::filesystem::path, 2> pictures_beside(const std::filesystem::path& map) {
  const auto named = [&map](const char* eye) {
    return map.parent_path() / fmt::format("{}_{}.png", map.stem().string(), eye);
  };
  return {named("left"), named("right")};
}

/// Writes the disparity as it was retouched, and beside it the pictures that it belongs to where no file has them.
/// Returns whether it did. Throws as check_not_an_input where a picture would replace one of `inputs`.
bool write_retouched(const std::filesystem::path& path, const Item& inputs, const Photograph& photograph,
                     std::span<const Touch> touches) {
  const StereoGeometry& found = photograph.found ? *photograph.found : *photograph.geometry;
  Image<float> disparity = found.left_disparity;
  retouch_disparity(touches, photograph.pictures.left, disparity);
  const Image<Rgb8> right = retouched_right(photograph.pictures, found, geometry_from_left(disparity));
  const bool writes_pictures = photograph.is_rectified || !right.empty();
  const std::array pictures = pictures_beside(path);
  if (writes_pictures)
    for (const std::filesystem::path& picture : pictures) check_not_an_input(picture, inputs);
  write_disparity(path, disparity);
  if (!writes_pictures) return false;
  write_image(pictures[0], photograph.pictures.left);
  write_image(pictures[1], right.empty() ? photograph.pictures.right : right);
  return true;
}

void save_disparity(Viewer& viewer, const Words& words) {
  if (!can_retouch_depth(viewer)) throw Error(ErrorKind::wrong_usage, "there is no photograph whose depth is known");
  const std::shared_ptr<const Photograph> photograph =
      std::get<PaintedContent>(viewer.session().opened.content).photograph;
  const std::filesystem::path path = words[0];
  const Item& inputs = *open_item(viewer.session());
  check_not_an_input(path, inputs);
  const auto wrote_pictures = std::make_shared<bool>(false);
  viewer.save(
      path,
      [path, inputs, photograph, wrote_pictures, touches = state_of(viewer).touches] {
        *wrote_pictures = write_retouched(path, inputs, *photograph, touches);
      },
      [&viewer, path, wrote_pictures, touches = state_of(viewer).touches] {
        if (touches == state_of(viewer).touches) viewer.session().has_unsaved_work = false;
        const auto [left, right] = pictures_beside(path);
        if (*wrote_pictures)
          viewer.tell(fmt::format("saved {}, and the pictures that it belongs to, {} and {}", path.string(),
                                  left.filename().string(), right.filename().string()));
      });
}

constexpr Command retouch_table[] = {
    // name, arguments, menu, text, keys
    {"retouch",
     "off|nearer|farther|smooth|flatten|fill-far|fill-near|lasso-nearer|lasso-farther|lasso-flatten|finer|coarser|"
     "paint|erase|recolour|pick",
     "Retouch",
     "Brush: the pointer changes depth, where the painting is fine, or its strokes",
     "",
     set_tool,
     {.now =
          [](const Viewer& v) {
            return std::string(retouch_tool_names[static_cast<std::size_t>(v.session().retouch.tool)]);
          },
      .applies = can_retouch,
      .icon = "retouch"}},
    {"brush-radius",
     "PIXELS",
     "Retouch",
     "Radius of the brush: in pixels of the picture",
     "",
     [](Viewer& v, const Words& w) { v.session().retouch.radius_px = static_cast<float>(number_of(w[0], 1, 500)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().retouch.radius_px); },
      .range = {2, 200, 1},
      .applies = can_retouch}},
    {"brush-strength",
     "AMOUNT",
     "Retouch",
     "Strength of the brush: pixels of disparity a touch",
     "",
     [](Viewer& v, const Words& w) { v.session().retouch.strength = static_cast<float>(number_of(w[0], 0, 100)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().retouch.strength); },
      .range = {0, 10, 0.1},
      .applies = can_retouch}},
    {"brush-colour",
     "COLOUR",
     "Retouch",
     "Colour of the brush, as 3366FF",
     "",
     set_colour,
     {.now = colour_now, .applies = can_retouch_strokes}},
    {"touch",
     "X Y [PRESSURE]",
     "Retouch",
     "Touch a place with the brush",
     "",
     [](Viewer& v, const Words& w) { do_touch(v, w, false); },
     {.applies = can_retouch, .is_for_scripts = true}},
    {"touch-on",
     "X Y [PRESSURE]",
     "Retouch",
     "Go on with the brush: undone together with what it began with",
     "",
     [](Viewer& v, const Words& w) { do_touch(v, w, true); },
     {.applies = can_retouch, .is_for_scripts = true}},
    {"untouched",
     "",
     "Retouch",
     "Depth, detail and strokes as they were found",
     "",
     [](Viewer& v, const Words&) {
       state_of(v).touches.clear();
       v.paint();
     },
     {.applies = [](const Viewer& v) { return !v.session().state.touches.empty(); }, .begins_group = true}},
    {"save-disparity", "FILE", "Retouch", "Save the disparity…", "", save_disparity, {.applies = can_retouch_depth}},
};

}  // namespace

std::span<const Command> retouch_commands() { return retouch_table; }

}  // namespace wheatstone::viewer
