#include "depth_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/matching/monocular_network.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::cli {
namespace {

constexpr std::array<Choice<DepthKind>, 2> depth_kinds{
    {{"inverse", DepthKind::inverse}, {"metric", DepthKind::metric}}};

void check_size(ImageView<const Rgb8> picture, const std::string& name) {
  constexpr int least_side_px = 16;
  if (picture.width() < least_side_px || picture.height() < least_side_px)
    throw Error(ErrorKind::bad_input, fmt::format("{}: is {}x{} pixels, expected at least {}x{}", name, picture.width(),
                                                  picture.height(), least_side_px, least_side_px));
}

CarriedDepth read_both(const StereoArguments& photograph, const DepthArguments& arguments, const Session& session) {
  if (!arguments.file.empty())
    return {read_image(photograph.left), read_depth(arguments.file), arguments.kind, arguments.file};
  if (!arguments.model.empty()) {
    Image<Rgb8> picture = read_image(photograph.left);
    report(session.progress, "finding the depth", 0);
    Image<float> depth = depth_by_network(picture, arguments.model);
    return {std::move(picture), std::move(depth), DepthKind::inverse, arguments.model};
  }
  if (photograph.layout == depth_layout) return read_depth_beside(photograph.left);
  std::optional<CarriedDepth> found = find_carried_depth(photograph.left);
  if (!found) throw Error(ErrorKind::bad_input, fmt::format("{}: has no depth of its own", photograph.left));
  return std::move(*found);
}

Rows rows_with(DepthArguments& a, const char* depth, const char* model, const Reason& no_depth, Reason no_map = {}) {
  const Reason by_network =
      when([&a] { return !a.model.empty(); }, "with --depth-model; a network gives inverse depth");
  if (!no_map) no_map = when([&a] { return !has_depth(a); }, "without --depth");
  return under(
      "One picture and its depth",
      {row("--depth", text(a.file), depth), row("--depth-model", text(a.model), model, {}, {}, {"--depth"}),
       row("--depth-is", choice(a.kind, depth_kinds),
           "Meaning of the depth values: inverse, nearer is brighter; metric, a length, farther is larger",
           {std::move(no_map), by_network}),
       row("--strength", share(a.strength, {0.1, 30}, "3%"),
           "Disparity from the farthest point to the nearest, in % of the width; 3% is comfortable on any screen",
           {no_depth})});
}

}  // namespace

Rows depth_rows(DepthArguments& a, const Reason& no_depth, Reason no_map) {
  return rows_with(
      a,
      "Depth of the one picture that is given: PNG with 8 or 16 bits, PFM or EXR. A picture's own depth (HEIC "
      "portraits, Google's depth maps) is used without it, and with --layout rgbd the depth beside the picture",
      "Network (.onnx) that finds the depth of the one picture that is given, as MiDaS and Depth Anything do", no_depth,
      std::move(no_map));
}

Rows film_depth_rows(DepthArguments& a) {
  return rows_with(
      a, "Depth of a film of one eye: a film in grey, or numbered pictures, with as many frames",
      "Network (.onnx) that finds the depth of each frame of a film of one eye, as MiDaS and Depth Anything do",
      when([&a] { return !has_depth(a); }, "without --depth"));
}

bool has_depth(const DepthArguments& arguments) { return !arguments.file.empty() || !arguments.model.empty(); }

std::string option_of(const DepthArguments& arguments) { return arguments.model.empty() ? "--depth" : "--depth-model"; }

SinglePicture read_single_picture(const StereoArguments& photograph, const DepthArguments& arguments,
                                  const Session& session) {
  report(session.progress, "reading", 0);
  SinglePicture read;
  read.strength = arguments.strength;
  CarriedDepth found = read_both(photograph, arguments, session);
  check_size(found.picture, photograph.left);
  if (photograph.max_size > 0 && std::max(found.picture.width(), found.picture.height()) > photograph.max_size) {
    read.whole = {found.picture.width(), found.picture.height()};
    found.picture = reduced(found.picture, reduced_size(read.whole, photograph.max_size));
  }
  const std::string name = arguments.carried ? photograph.left : found.how;
  const bool is_flat = !inverse_depth_range(found.depth, found.kind);
  try {
    Image<float> disparity =
        disparity_from_depth(found.depth, found.picture, {.kind = found.kind, .strength = read.strength});
    read.pair = make_pair_from_single_view(std::move(found.picture), std::move(disparity));
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", name, error.what()));
  }
  if (arguments.carried)
    remark(session, fmt::format("{}: one picture, with the depth of {}", photograph.left, found.how));
  if (is_flat)
    remark(session, fmt::format("warning: {}: the depth is the same everywhere: both eyes get the same picture", name));
  return read;
}

}  // namespace wheatstone::cli
