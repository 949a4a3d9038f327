#include "packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <string_view>
#include <vector>

#include "numbers_argument.h"
#include "stereo_arguments.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/multiview_exr.h"
#include "wheatstone/display/wiggle.h"
#include "wheatstone/error.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct Named {
  std::string_view name;
  PackingKind kind;
};
constexpr std::array<Named, 10> plain{{{"mpo", PackingKind::mpo},
                                       {"jps", PackingKind::jps},
                                       {"views", PackingKind::views},
                                       {"wiggle", PackingKind::wiggle},
                                       {"quilt", PackingKind::quilt},
                                       {"lenticular", PackingKind::lenticular},
                                       {"exr", PackingKind::exr},
                                       {"rgbd", PackingKind::depth_beside},
                                       {"disparity", PackingKind::disparity},
                                       {"depth", PackingKind::depth}}};

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::string all_names() {
  std::string names = "anaglyph";
  for (const AnaglyphKind& kind : anaglyph_kinds()) names += fmt::format(", {}", kind.name);
  for (const std::string_view name : layout_names()) names += fmt::format(", {}", name);
  for (const Named& named : plain) names += fmt::format(", {}", named.name);
  return names;
}

QuiltLayout parse_quilt(const std::string& text) {
  const std::vector<float> numbers = parse_numbers("--quilt", text, 'x', 2);
  const QuiltLayout layout{static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
  if (layout.columns < 1 || layout.rows < 1 || layout.columns > 1000 || layout.rows > 1000)
    throw Error(ErrorKind::wrong_usage, fmt::format("--quilt: is '{}', expected COLUMNSxROWS", text));
  return layout;
}

/// By the name that was typed; nothing where there is none such.
std::optional<Packing> packing_named(const std::string& name) {
  if (name == "anaglyph") return Packing{.kind = PackingKind::anaglyph, .name = name, .anaglyph = &anaglyph_kinds()[0]};
  for (const AnaglyphKind& kind : anaglyph_kinds())
    if (name == kind.name || (!kind.ffmpeg.empty() && name == kind.ffmpeg))
      return Packing{.kind = PackingKind::anaglyph, .name = name, .anaglyph = &kind};
  for (const Named& named : plain)
    if (name == named.name) return Packing{.kind = named.kind, .name = name};
  const std::optional<StereoLayout> layout = find_stereo_layout(name);
  if (!layout || !is_packed(*layout)) return std::nullopt;
  return Packing{.kind = PackingKind::layout, .name = name, .layout = *layout};
}

std::string name_by_ending(const std::string& output) {
  const std::string ending = ending_of(output);
  if (ending == ".mpo") return "mpo";
  if (ending == ".jps") return "jps";
  if (ending == ".gif") return "wiggle";
  if (ending == ".exr") return "exr";
  if (ending.empty()) return "views";
  return {};
}

void expect_two(const Packing& packing, std::span<const Image<Rgb8>> views) {
  if (views.size() != 2)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--to {}: takes two views, but there are {}", packing.name, views.size()));
}

StereoPair pair_of(std::span<const Image<Rgb8>> views) { return {views[0], views[1]}; }

/// The left view's disparity by matching.
Image<float> disparity_between(const Packing& packing, std::span<const Image<Rgb8>> views, const Session& session) {
  const std::string name = fmt::format("--to {}", packing.name);
  const PreparedPair pair = prepare_named_pair(pair_of(views), {}, name, session);
  tell_row_warning(pair, name, session);
  return match(pair.pictures, {}, session.progress).geometry.left_disparity;
}

/// The left view's disparity by matching, or the depth that it means.
void write_matched(const Packing& packing, const PackingArguments& arguments, std::span<const Image<Rgb8>> views,
                   const std::string& output, const Session& session) {
  expect_two(packing, views);
  Image<float> disparity = disparity_between(packing, views, session);
  if (packing.kind == PackingKind::depth)
    for (float& d : disparity.pixels())
      d = d > 0 ? depth_from_disparity(d, arguments.depth_scale) : std::numeric_limits<float>::quiet_NaN();
  write_disparity(output, disparity);
}

Image<Rgb8> one_picture(const Packing& packing, const PackingArguments& arguments, std::span<const Image<Rgb8>> views,
                        const Session& session) {
  if (packing.kind == PackingKind::lenticular) return interleave(views, find_lenticular(arguments.screen));
  expect_two(packing, views);
  if (packing.kind == PackingKind::anaglyph) return anaglyph(pair_of(views), *packing.anaglyph);
  if (packing.kind == PackingKind::layout) return put_together(views[0], views[1], packing.layout);
  return depth_beside(views[0], disparity_between(packing, views, session));
}

}  // namespace

void add_packing_options(CLI::App& command, PackingArguments& arguments) {
  command.add_option("--to", arguments.to,
                     fmt::format("{}; or ffmpeg's names (arcd, sbsl, irl ...). By the output's ending if not given: "
                                 ".mpo, .jps, .gif, .exr, none for views",
                                 all_names()));
  command.add_option("--screen", arguments.screen, "Lenticular: a screen's name, or its calibration (.json)");
  auto* quilt = command.add_option("--quilt", arguments.quilt, "Quilt: COLUMNSxROWS");
  command.add_option("--display", arguments.display, "Quilt: of this display")->excludes(quilt);
  command.add_option("--quality", arguments.quality, "Of JPEGs in MPO and JPS")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      .add_option("--depth-scale", arguments.depth_scale,
                  "Depth is this divided by disparity: camera separation times focal length in pixels")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--seconds", arguments.seconds, "Wiggle: there and back")
      ->check(CLI::Range(0.05, 60.0))
      ->capture_default_str();
}

Packing find_packing(const PackingArguments& arguments, const std::string& output) {
  std::string name = arguments.to;
  if (name.empty() && !(arguments.quilt.empty() && arguments.display.empty())) name = "quilt";
  if (name.empty() && !arguments.screen.empty()) name = "lenticular";
  if (name.empty()) name = name_by_ending(output);
  if (name.empty())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: the name does not tell what to pack, give --to: {}", output, all_names()));
  std::optional<Packing> found = packing_named(name);
  if (!found) throw Error(ErrorKind::wrong_usage, fmt::format("--to: is '{}', expected one of: {}", name, all_names()));
  if (found->kind == PackingKind::lenticular) {
    if (arguments.screen.empty())
      throw Error(ErrorKind::wrong_usage,
                  "--to lenticular: needs --screen, a screen's name or its calibration (.json)");
    find_lenticular(arguments.screen);
  }
  if (found->kind == PackingKind::quilt) {
    if (!arguments.display.empty()) {
      const DisplayPreset& display = find_display(arguments.display);
      if (display.quilt_columns == 0)
        throw Error(ErrorKind::wrong_usage, fmt::format("--display: {} takes no quilts", arguments.display));
      found->quilt = QuiltLayout{display.quilt_columns, display.quilt_rows};
      found->aspect = display.aspect;
    } else if (!arguments.quilt.empty()) {
      found->quilt = parse_quilt(arguments.quilt);
    } else {
      throw Error(ErrorKind::wrong_usage, "--to quilt: needs --quilt COLUMNSxROWS, or --display NAME");
    }
  }
  return *found;
}

int views_wanted(const Packing& packing) {
  switch (packing.kind) {
    case PackingKind::quilt:
      return packing.quilt->columns * packing.quilt->rows;
    case PackingKind::lenticular:
    case PackingKind::views:
    case PackingKind::wiggle:
    case PackingKind::mpo:
    case PackingKind::exr:
      return 0;
    default:
      return 2;
  }
}

std::string write_packed(const Packing& packing, const PackingArguments& arguments, std::span<const Image<Rgb8>> views,
                         const std::string& output, const Session& session) {
  switch (packing.kind) {
    case PackingKind::quilt:
      return write_quilt(views, *packing.quilt, packing.aspect, output);
    case PackingKind::views:
      write_view_folder(views, output, session.progress);
      break;
    case PackingKind::mpo: {
      const std::vector<ImageView<const Rgb8>> all(views.begin(), views.end());
      write_mpo(output, all, arguments.quality);
      break;
    }
    case PackingKind::jps:
      expect_two(packing, views);
      write_jps(output, views[0], views[1], StereoLayout::right_left, arguments.quality);
      break;
    case PackingKind::wiggle:
      write_wiggle(output, views, arguments.seconds);
      break;
    case PackingKind::disparity:
    case PackingKind::depth:
      write_matched(packing, arguments, views, output, session);
      break;
    case PackingKind::exr:
      write_multiview_exr(output, views);
      break;
    default:
      write_image(output, one_picture(packing, arguments, views, session));
  }
  return output;
}

}  // namespace wheatstone::cli
