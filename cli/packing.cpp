#include "packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>
#include <vector>

#include "display_argument.h"
#include "stereo_arguments.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/stereo_card.h"
#include "wheatstone/display/wiggle.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/film_files.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

std::string all_names() {
  std::string names;
  for (const PackingFormat& format : packing_formats())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

const PackingFormat* format_named(std::string_view name) {
  for (const PackingFormat& format : packing_formats())
    if (name == format.name || (!format.alias.empty() && name == format.alias)) return &format;
  const std::optional<StereoLayout> layout = find_stereo_layout(name);  // by one of its other names
  if (!layout || !is_packed(*layout)) return nullptr;
  return format_named(layout_name(*layout));
}

/// By the output's ending; empty where no format has it.
std::string_view name_by_ending(const std::string& output) {
  const std::string ending = ending_of(output);
  if (ending.empty()) return "views";
  for (const PackingFormat& format : packing_formats())
    if (format.ending == ending) return format.name;
  return {};
}

StereoPair pair_of(std::span<const Image<Rgb8>> views) { return {views[0], views[1]}; }

/// The left view, rectified where its rows need that, and its disparity by matching.
struct MatchedView {
  Image<Rgb8> picture;
  Image<float> disparity;
};

MatchedView matched_view(const PackingJob& job) {
  const std::string name = fmt::format("--to {}", job.packing.name);
  PreparedPair pair = prepare_named_pair(pair_of(job.views), {.rectify = job.arguments.rectify}, name, job.session);
  tell_of_rows(pair, name, job.session);
  Image<float> disparity = match(pair.pictures, {}, job.session.progress).geometry.left_disparity;
  return {std::move(pair.pictures.left), std::move(disparity)};
}

/// A format that is one picture of the views.
template <class Make>
auto one_picture(Make make) {
  return [make](const PackingJob& job) {
    write_image(job.output.name, make(job), job.output.notes);
    return job.output.name;
  };
}

/// A format that one call writes.
template <class Write>
auto one_file(Write write) {
  return [write](const PackingJob& job) {
    write(job);
    return job.output.name;
  };
}

/// Of a format that has a composition.
Image<Rgb8> composed(const PackingJob& job) {
  if (!job.composed.empty()) return job.composed;
  return compose(job.views, job.packing.format->composition(job.packing));
}

void add_anaglyphs(std::vector<PackingFormat>& formats) {
  const auto add = [&](std::string_view name, std::string_view alias, const AnaglyphKind& kind) {
    formats.push_back({name, alias, "", 2, one_picture(composed), [kind](const Packing&) { return kind; }});
  };
  add("anaglyph", "", anaglyph_kinds().front());
  for (const AnaglyphKind& kind : anaglyph_kinds()) add(kind.name, kind.ffmpeg, kind);
}

void add_layouts(std::vector<PackingFormat>& formats) {
  for (const LayoutTraits& traits : stereo_layouts()) {
    if (!is_packed(traits.layout)) continue;
    formats.push_back({traits.name, traits.ffmpeg, "", 2, one_picture(composed),
                       [layout = traits.layout](const Packing&) { return layout; }});
  }
}

void add_stereo_files(std::vector<PackingFormat>& formats) {
  formats.push_back({"mpo", "", ".mpo", 0, one_file([](const PackingJob& job) {
                       const std::vector<ImageView<const Rgb8>> views(job.views.begin(), job.views.end());
                       write_mpo(job.output.name, views, job.arguments.quality, job.output.notes);
                     })});
  formats.push_back({"jps", "", ".jps", 2, one_file([](const PackingJob& job) {
                       write_jps(job.output.name, job.views[0], job.views[1], StereoLayout::right_left,
                                 job.arguments.quality, job.output.notes);
                     })});
  formats.push_back(
      {"exr", "", ".exr", 0, one_file([](const PackingJob& job) { write_multiview_exr(job.output.name, job.views); })});
}

void add_many_views(std::vector<PackingFormat>& formats) {
  formats.push_back({"views", "", "", 0, one_file([](const PackingJob& job) {
                       write_view_folder(job.views, job.output, job.session.progress);
                     })});
  formats.push_back({"wiggle", "", ".gif", 0, one_file([](const PackingJob& job) {
                       write_wiggle(job.output.name, job.views, job.arguments.seconds);
                     })});
  formats.push_back({"quilt", "", "", 0,
                     [](const PackingJob& job) {
                       return write_quilt(composed(job), *job.packing.quilt, job.packing.aspect, job.output);
                     },
                     [](const Packing& packing) { return *packing.quilt; }});
  formats.push_back(
      {"lenticular", "", "", 0, one_picture(composed), [](const Packing& packing) { return *packing.screen; }});
}

void add_matched(std::vector<PackingFormat>& formats) {
  formats.push_back({"rgbd", "", "", 2, one_picture([](const PackingJob& job) {
                       const MatchedView view = matched_view(job);
                       return depth_beside(view.picture, view.disparity);
                     })});
  formats.push_back({"disparity", "", "", 2, one_file([](const PackingJob& job) {
                       write_disparity(job.output.name, matched_view(job).disparity);
                     })});
  formats.push_back({"depth", "", "", 2, one_file([](const PackingJob& job) {
                       Image<float> depth = matched_view(job).disparity;
                       for (float& d : depth.pixels())
                         d = d > 0 ? depth_from_disparity(d, job.arguments.depth_scale)
                                   : std::numeric_limits<float>::quiet_NaN();
                       write_disparity(job.output.name, depth);
                     })});
}

/// A PDF, or a picture with the card's size in its notes.
void write_card(const PackingJob& job) {
  const StereoPair pair = pair_of(job.views);
  const StereoCardOptions options{.caption = job.caption, .framing = job.arguments.framing, .dpi = job.arguments.dpi};
  if (ending_of(job.output.name) == ".pdf") return write_whole_file(job.output.name, stereo_card_pdf(pair, options));
  PictureNotes notes = job.output.notes;
  notes.pixels_an_inch = options.dpi;
  write_image(job.output.name, stereo_card_picture(pair, options), notes);
}

Reason only_with(const PackingArguments& a, const std::string& output, std::vector<std::string_view> formats,
                 const char* where) {
  return [&a, &output, formats = std::move(formats), where] {
    const Packing packing = find_packing(a, output);
    const bool works = std::ranges::find(formats, packing.format->name) != formats.end();
    return works ? "" : fmt::format("with --to {}; {}", packing.name, where);
  };
}

/// What a display takes: a quilt, or one picture under its lenses.
void take_display(const PackingArguments& arguments, Packing& packing) {
  const DisplayPreset& display = find_display(arguments.display);
  if (display.quilt_columns > 0) {
    packing.quilt = QuiltLayout{display.quilt_columns, display.quilt_rows};
    packing.aspect = display.aspect;
  }
  if (display.lenses.screen_width_px > 0) packing.screen = lenticular_screen_of(display);
  if (!packing.quilt && !packing.screen)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--display: {} takes neither quilts nor lenticular pictures; choose a format with --to",
                            arguments.display));
}

/// The format's name, as it is typed or follows from the other options.
std::string chosen_name(const PackingArguments& arguments, const Packing& packing, const std::string& output) {
  if (!arguments.to.empty()) return arguments.to;
  if (packing.quilt) return "quilt";
  if (packing.screen) return "lenticular";
  if (is_film(output)) return "left-right";
  const std::string_view name = name_by_ending(output);
  if (name.empty()) {
    std::string endings;
    for (const PackingFormat& format : packing_formats())
      if (!format.ending.empty()) endings += fmt::format("{}, ", format.ending);
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("{}: the ending names no format, expected {}no ending for views; or choose one with --to: {}",
                    output, endings, all_names()));
  }
  return std::string(name);
}

}  // namespace

std::span<const PackingFormat> packing_formats() {
  static const std::vector<PackingFormat> formats = [] {
    std::vector<PackingFormat> all;
    add_anaglyphs(all);
    add_layouts(all);
    add_stereo_files(all);
    add_many_views(all);
    add_matched(all);
    all.push_back({"card", "", ".pdf", 2, one_file(write_card)});
    all.push_back({"slices", "", "", 0, {}});
    return all;
  }();
  return formats;
}

Reason unless_matched(const PackingArguments& a, const std::string& output) {
  return only_with(a, output, {"rgbd", "disparity", "depth", "slices"},
                   "it works with disparity, depth, rgbd and slices, which match the views");
}

Reason if_matched(const PackingArguments& a, const std::string& output) {
  return [&a, &output, unless = unless_matched(a, output)] {
    const std::string words =
        fmt::format("with --to {}; it works where the views are shown", find_packing(a, output).name);
    return unless().empty() ? words : "";
  };
}

Reason if_card(const PackingArguments& a, const std::string& output) {
  return when([&a, &output] { return sets_caption(find_packing(a, output)); }, "with --to card, which has a mount");
}

Rows packing_rows(PackingArguments& a, const std::string& output) {
  const auto only = [&a, &output](std::vector<std::string_view> formats, const char* where) {
    return only_with(a, output, std::move(formats), where);
  };
  const Reason named_by_ending = [&a, &output] {
    const Packing packing = find_packing(a, output);
    const bool is_picture =
        !is_one_of(packing.format->name, {"mpo", "jps", "wiggle", "exr", "disparity", "depth", "slices"});
    const bool is_named = packing.format->name == "views" || (is_picture && !fs::path(output).has_extension());
    return is_named ? "" : fmt::format("with --to {}; the ending of the output says the format", packing.name);
  };
  return {
      row("--to", text(a.to),
          fmt::format("Output format: {}; or ffmpeg's names (arcd, sbsl, irl ...). Chosen by the ending of the output "
                      "by default: .mpo, .jps, .gif, .exr, .pdf for card, none for views. Films: anaglyphs, layouts of "
                      "two eyes, or two-files, "
                      "a film for each eye",
                      all_names())),
      row("--screen", text(a.screen), "Lenticular screen: the name of a display with lenses, or a calibration (.json)",
          {only({"lenticular"}, "it works with lenticular")}),
      row("--quilt", quilt_layout(a.quilt), "Quilt layout: COLUMNSxROWS", {only({"quilt"}, "it works with quilt")}),
      row("--display", text(a.display), "Quilt or lenticular picture for this display",
          {only({"quilt", "lenticular"}, "it works with quilt and lenticular")}, {}, {"--quilt"}),
      row("--format", picture_format(a.format), "File format of views, or of a quilt without an ending",
          {named_by_ending}),
      row("--quality", number(a.quality, {1, 100}), "JPEG quality of MPO and JPS",
          {only({"mpo", "jps"}, "it works with mpo and jps")}),
      rectify_row(a.rectify, {unless_matched(a, output)}),
      row("--depth-scale", number(a.depth_scale, {1e-9, 1e9}),
          "Depth times disparity: camera separation times focal length in pixels",
          {only({"depth"}, "it works with depth")}),
      row("--seconds", number(a.seconds, {0.05, 60}), "Period of a wiggle animation, in seconds",
          {only({"wiggle"}, "it works with wiggle")}),
      row("--dpi", number(a.dpi, {30, 2400}), "Pixels an inch of a stereo card; of a PDF, at most",
          {only({"card"}, "it works with card")})};
}

Packing find_packing(const PackingArguments& arguments, const std::string& output) {
  Packing packing{.format = nullptr, .name = {}, .quilt = {}, .aspect = 0, .screen = {}};
  if (!arguments.display.empty()) take_display(arguments, packing);
  if (arguments.quilt) packing.quilt = arguments.quilt;
  if (!arguments.screen.empty()) packing.screen = find_lenticular(arguments.screen);
  packing.name = chosen_name(arguments, packing, output);
  packing.format = format_named(packing.name);
  if (packing.format == nullptr)
    throw Error(ErrorKind::wrong_usage, fmt::format("--to: is '{}', expected one of: {}", packing.name, all_names()));
  if (packing.format->name == "lenticular" && !packing.screen)
    throw Error(ErrorKind::wrong_usage,
                "--to lenticular: needs --screen, the name of a display with lenses or its calibration (.json)");
  if (packing.format->name == "quilt" && !packing.quilt)
    throw Error(ErrorKind::wrong_usage, "--to quilt: needs --quilt COLUMNSxROWS, or --display NAME");
  return packing;
}

std::string ending_for(const Packing& packing, const PackingArguments& arguments, bool format_is_given) {
  const std::string_view name = packing.format->name;
  if (is_one_of(name, {"views", "quilt"})) return {};
  if (is_one_of(name, {"disparity", "depth"})) return ".pfm";
  const bool is_fixed = !packing.format->ending.empty() && !(name == "card" && format_is_given);
  return is_fixed ? std::string(packing.format->ending) : "." + arguments.format;
}

void check_ending(const Packing& packing, const std::string& output) {
  const std::string_view name = packing.format->name;
  const bool is_picture = !is_one_of(name, {"mpo", "jps", "views", "wiggle", "exr", "disparity", "depth", "slices"}) &&
                          !(name == "card" && ending_of(output) == ".pdf");
  if (is_picture && (fs::path(output).has_extension() || name != "quilt")) check_picture_ending("--output", output);
}

bool sets_caption(const Packing& packing) { return packing.format->name == "card"; }

bool keeps_profile(const Packing& packing, const PackingArguments& arguments, const std::string& output) {
  const std::string_view name = packing.format->name;
  if (is_one_of(name, {"mpo", "jps"})) return true;
  if (name == "views") return takes_profile("view." + arguments.format);
  return (name == "card" || find_stereo_layout(name)) && takes_profile(output);
}

int views_wanted(const Packing& packing) {
  return packing.format->name == "quilt" ? packing.quilt->columns * packing.quilt->rows : packing.format->views;
}

std::string write_packed(const PackingJob& job) {
  const PackingFormat& format = *job.packing.format;
  if (job.composed.empty() && format.views != 0 && job.views.size() != static_cast<std::size_t>(format.views))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--to {}: takes two views, but there are {}", job.packing.name, job.views.size()));
  return format.write(job);
}

}  // namespace wheatstone::cli
