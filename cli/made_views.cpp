#include "made_views.h"

#include <fmt/format.h>

#include <utility>

#include "stereo_arguments.h"
#include "wheatstone/app/display_views.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/find_layout.h"

namespace wheatstone::cli {
namespace {

const DisplayPreset* display_of(const PackingArguments& arguments) {
  const std::string& name = arguments.display.empty() ? arguments.screen : arguments.display;
  for (const DisplayPreset& display : display_presets())
    if (display.name == name) return &display;
  return nullptr;
}

}  // namespace

MeasuredPhotograph measure_photograph(const MadeViews& wanted, const Session& session) {
  const std::vector<std::string>& files = wanted.input.files;
  const StereoArguments photograph{.left = files.front(),
                                   .right = files.size() > 1 ? files[1] : "",
                                   .layout = wanted.input.layout,
                                   .swap = wanted.input.swap,
                                   .rectify = wanted.packing.rectify,
                                   .max_size = wanted.max_size};
  if (has_own_depth(wanted.input, wanted.depth)) {
    DepthArguments depth = wanted.depth;
    depth.carried = !has_depth(depth);
    SinglePicture single = read_single_picture(photograph, depth, session);
    return {std::move(single.pair.pictures), std::move(single.pair.geometry), "made of one picture and its depth"};
  }
  ReadPhotograph read = read_photographs(photograph, false, session);
  MatchedPair matched = match(read.pair.pictures, {}, session.progress);
  tell_of_match(read, measure_match(read.pair.pictures, matched, {}), session);
  return {std::move(read.pair.pictures), std::move(matched.geometry), "made of a matched pair"};
}

bool has_own_depth(const ViewsArguments& input, const DepthArguments& depth) {
  if (input.files.size() != 1 || !is_photograph(input)) return false;
  if (has_depth(depth) || input.layout == depth_layout) return true;
  return input.layout.empty() && !input.swap && !is_stereo_file_name(input.files.front()) &&
         carries_depth(input.files.front());
}

int views_of_photograph(const ViewsArguments& input, const Packing& packing, const PackingArguments& arguments) {
  if (input.views > 0) return input.views;
  if (packing.format->name == "quilt") return views_wanted(packing);
  const DisplayPreset* const display = display_of(arguments);
  // Two views under many lenses' worth of places are what they are; a display that is named has its own number.
  return packing.format->name == "lenticular" && display != nullptr && !arguments.display.empty() ? display->views : 2;
}

bool makes_views(const ViewsArguments& input, const Packing& packing, const PackingArguments& arguments,
                 const DepthArguments& depth) {
  if (!is_photograph(input)) return false;
  return views_of_photograph(input, packing, arguments) > 2 || has_own_depth(input, depth);
}

ReadViews make_views(const MadeViews& wanted, const Packing& packing, const Session& session) {
  MeasuredPhotograph subject = measure_photograph(wanted, session);
  const int count = views_of_photograph(wanted.input, packing, wanted.packing);
  ReadViews made;
  made.how = subject.how;
  const DisplayPreset* const display = display_of(wanted.packing);
  const bool is_pair = count == 2 && packing.format->name != "quilt" && !wanted.given("--span");
  if (is_pair) {
    made.views = {std::move(subject.pictures.left), std::move(subject.pictures.right)};
    return made;
  }
  DisplayViewsOptions options;
  if (display != nullptr) options = views_of_display(*display);
  options.views = count;
  options.framing = wanted.packing.framing;
  double stretch = 1;
  if (display == nullptr) {
    options.width = subject.pictures.left.width();
    options.height = subject.pictures.left.height();
  } else {
    stretch = static_cast<double>(options.width) / options.height / display->aspect;
  }
  if (wanted.given("--span")) options.span = wanted.input.span;
  if (wanted.given("--zero-parallax")) options.zero_parallax_px = wanted.zero_parallax_px;
  made.views = draw_photograph_views(subject.pictures, subject.geometry, options, stretch, session.progress);
  return made;
}

}  // namespace wheatstone::cli
