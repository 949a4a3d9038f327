#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "command.h"
#include "film_facts.h"
#include "option_use.h"
#include "print_facts.h"
#include "quilt_facts.h"
#include "typed_options.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/multiview_exr.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/matching/eye_order.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/not_a_pair.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/describe_image.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The smallest and largest of the known disparities seen.
struct DisparityRange {
  float nearest = -std::numeric_limits<float>::infinity();
  float farthest = std::numeric_limits<float>::infinity();
  std::size_t known = 0;

  void add(float disparity) {
    if (std::isnan(disparity)) return;
    nearest = std::max(nearest, disparity);
    farthest = std::min(farthest, disparity);
    ++known;
  }
};

void put_range(ordered_json& facts, const DisparityRange& range) {
  if (range.known == 0) return;
  facts["farthest_disparity_px"] = range.farthest;
  facts["nearest_disparity_px"] = range.nearest;
}

ordered_json facts_of_disparity(const fs::path& path, std::optional<float> scale) {
  const Image<float> disparity = read_disparity(path, scale);
  DisparityRange range;
  for (const float value : disparity.pixels()) range.add(value);
  ordered_json facts = {{"kind", "disparity"}, {"width", disparity.width()}, {"height", disparity.height()}};
  facts["known_share"] = static_cast<double>(range.known) / static_cast<double>(disparity.pixels().size());
  put_range(facts, range);
  return facts;
}

ordered_json facts_of_painting(const fs::path& path) {
  const Painting painting = read_painting(path);
  DisparityRange range;
  for (const float disparity : disparities_of_marks(painting)) range.add(disparity);
  const MarkCount marks = count_marks(painting);
  ordered_json facts = {{"kind", "painting"}, {"width", width_of(painting)}, {"height", height_of(painting)}};
  facts[std::string(marks.kind)] = marks.count;
  put_range(facts, range);
  facts["texture"] = painting.relief.depth_px > 0;
  const ViewRange known = known_views(painting.surfaces);
  if (painting.surfaces.seen.empty()) {
    facts["views"] = "of two eyes";
  } else {
    facts["views"] = {{"first", known.first.eye_separations()}, {"last", known.last.eye_separations()}};
  }
  ordered_json layers = ordered_json::array();
  for (const Layer& layer : layers_of(painting))
    layers.push_back(
        {{"radius_px", layer.radius_px}, {"strokes", count_strokes(layer)}, {"points", layer.points.size()}});
  if (!layers.empty()) facts["layers"] = std::move(layers);
  return facts;
}

ordered_json facts_of_picture(const ImageDescription& picture) {
  ordered_json facts = {{"kind", "picture"}, {"format", picture.format}};
  facts["width"] = picture.width;
  facts["height"] = picture.height;
  facts["channels"] = picture.channels;
  facts["has_alpha"] = picture.has_alpha;
  facts["bits"] = picture.bits;
  facts["is_float"] = picture.is_float;
  facts["exif_orientation"] = picture.orientation;
  return facts;
}

/// How deep a pair is, and how that suits who looks at a display, with the middle of its depth on the screen.
void put_depth(ordered_json& facts, const StereoPair& pair, const std::string& display_name) {
  constexpr double outliers = 0.01;
  const Image<float> disparity = match(pair, {}).geometry.left_disparity;
  const float farthest = disparity_percentile(disparity, outliers);
  const float nearest = disparity_percentile(disparity, 1 - outliers);
  facts["farthest_disparity_px"] = farthest;
  facts["nearest_disparity_px"] = nearest;
  ViewingGeometry viewing = viewing_of(find_display(display_name));
  viewing.width_px = pair.left.width();  // the whole picture fills the screen's width
  const float parallax_mm = (nearest - farthest) / 2 * viewing.pixel_pitch_mm();
  const float near_mm = -perceived_depth_mm(viewing, -parallax_mm);
  const float far_mm = perceived_depth_mm(viewing, parallax_mm);
  facts["display"] = display_name;
  facts["before_screen_mm"] = near_mm;
  facts["behind_screen_mm"] = far_mm;
  facts["total_parallax_percent"] = 100 * (nearest - farthest) / static_cast<float>(pair.left.width());
  const std::vector<std::string> warnings = discomforts(viewing, near_mm, far_mm);
  facts["comfort"] = warnings.empty() ? "comfortable" : fmt::format("{}", fmt::join(warnings, "; "));
}

/// Where a picture's views are and how that is known; nothing of an ordinary picture.
void put_views(ordered_json& facts, const fs::path& path, const std::string& layout, const std::string& display) {
  const ReadViewsOptions options = layout.empty() ? ReadViewsOptions() : options_for_layout(layout);
  try {
    const std::optional<ViewsFile> file = find_views(path, options);
    if (!file) return;
    facts["stereo"] = describe_views(*file);
    facts["layout"] = file->scan     ? std::string(traits_of(*file->scan).name)
                      : file->layout ? std::string(layout_name(*file->layout))
                                     : file->kind;
    facts["layout_known"] = how_known_words(file->how_known);
    facts["views"] = file->views.size();
    facts["view_width"] = file->views.front().width();
    facts["view_height"] = file->views.front().height();
    if (file->views.size() != 2) return;
    const StereoPair pair{file->views[0], file->views[1]};
    facts["same_scene"] = !not_a_pair(pair);
    facts["eyes_look_swapped"] = nullptr;
    if (const EyeOrder eyes = eye_order(pair); eyes != EyeOrder::undecided)
      facts["eyes_look_swapped"] = eyes == EyeOrder::swapped;
    if (!display.empty()) put_depth(facts, pair, display);
  } catch (const Error& error) {
    // The picture can be told of, its views cannot: why is what one asks for.
    if (!layout.empty()) throw;
    facts["stereo"] = error.what();
  }
}

ordered_json facts_of_particles(const fs::path& path, const std::string& type) {
  const CloudSource source = open_cloud(path, {.type = type});
  ordered_json facts = {{"kind", "particles"}, {"format", source.format}};
  if (source.count) facts["particles"] = *source.count;
  if (source.box_size > 0) facts["box_size"] = source.box_size;
  if (source.redshift) facts["redshift"] = *source.redshift;
  facts["bytes"] = source.bytes;
  facts["fields"] = fmt::format("{}", fmt::join(source.fields, ", "));
  std::vector<std::string> units;
  for (const auto& [name, unit] : source.units) units.push_back(fmt::format("{}: {}", name, unit));
  if (!units.empty()) facts["units"] = fmt::format("{}", fmt::join(units, ", "));
  return facts;
}

ordered_json facts_of_slices(const fs::path& path) {
  const SliceStack stack = read_slices(path);
  ordered_json facts = {{"kind", "slices"}, {"width", stack.width}, {"height", stack.height}};
  facts["slices"] = stack.slices.size();
  facts["span_in_eye_separations"] = stack.span;
  if (stack.tone.look == Look::thesis) {
    facts["exposure"] = stack.tone.exposure;
  } else {
    facts["least"] = stack.tone.least;
    facts["most"] = stack.tone.most;
  }
  if (!stack.slices.empty()) {
    facts["nearest_parallax_px"] = stack.slices.front().parallax_px;
    facts["farthest_parallax_px"] = stack.slices.back().parallax_px;
  }
  return facts;
}

/// Whether a file holds particles by its content; or should, by its name: then what is wrong with it is told.
bool is_particles(const fs::path& path) {
  constexpr const char* endings[] = {".hdf5", ".h5",  ".ply", ".las", ".npy",   ".npz",
                                     ".fits", ".csv", ".txt", ".dat", ".gadget"};
  return std::ranges::find(endings, path.extension().string()) != std::end(endings) || holds_particles(path);
}

/// What --device can be, with the name of the graphics processor, or why there is none.
ordered_json facts_of_devices() {
  ordered_json facts{{"kind", "devices"}, {"cpu", fmt::format("{} threads", std::thread::hardware_concurrency())}};
  try {
    const GpuFacts gpu = gpu_facts();
    facts["gpu"] = gpu.name;
    facts["opengl"] = gpu.version;
    facts["imitated_by_the_cpu"] = gpu.imitated;
    facts["largest_buffer_bytes"] = gpu.largest_buffer;
    facts["auto"] = gpu.imitated ? "cpu" : "gpu where the work is worth it, else cpu";
  } catch (const Error& error) {
    facts["gpu"] = error.what();
    facts["auto"] = "cpu";
  }
  return facts;
}

struct InfoArguments {
  std::string file;
  bool devices = false;
  std::optional<float> scale;
  std::string type;
  std::string layout;
  std::string display;
};

ordered_json facts_of(const InfoArguments& arguments, const CLI::App& command) {
  if (arguments.devices) {
    refuse_options(command, {"FILE", "--scale", "--type", "--layout", "--display"}, "with --devices", {});
    return facts_of_devices();
  }
  if (arguments.file.empty()) throw Error(ErrorKind::wrong_usage, "FILE is missing, expected a file or --devices");
  const fs::path path = arguments.file;
  const auto refuse = [&](const std::vector<std::string>& options, const char* situation) {
    refuse_options(command, options, situation, {});
  };
  if (!is_particles(path)) refuse({"--type"}, "on this file; it works on particles");
  const auto refuse_all = [&](const char* situation) { refuse({"--scale", "--layout", "--display"}, situation); };
  if (is_film(path)) {
    refuse_all("on a film");
    return facts_of_film(path);
  }
  if (path.extension() == ".wst") {
    refuse_all("on a painting (.wst)");
    return facts_of_painting(path);
  }
  if (is_particles(path)) {
    refuse_all("on particles");
    return facts_of_particles(path, arguments.type);
  }
  if (arguments.scale) {
    refuse({"--layout", "--display"}, "with --scale, which reads disparities");
    return facts_of_disparity(path, arguments.scale);
  }
  const ImageDescription picture = describe_image(path);
  if (is_multiview_exr(path)) {
    refuse_all("on a multi-view OpenEXR");
    const std::vector<Image<Rgb8>> views = read_multiview_exr(path);
    return {{"kind", "views"}, {"views", views.size()}, {"width", views[0].width()}, {"height", views[0].height()}};
  }
  if (picture.format == "openexr" && picture.channels == 4) {
    refuse_all("on slices");
    return facts_of_slices(path);
  }
  // One channel of floats is no photograph.
  if (picture.is_float && picture.channels == 1) {
    refuse({"--layout", "--display"}, "on disparities");
    return facts_of_disparity(path, {});
  }
  ordered_json facts = facts_of_picture(picture);
  if (arguments.layout.empty() && put_quilt(facts, path, picture.width, picture.height)) {
    refuse({"--display"}, "on a quilt; it works on two views");
    return facts;
  }
  put_views(facts, path, arguments.layout, arguments.display);
  if (!facts.contains("views")) refuse({"--display"}, "on a picture of one view; it works on two");
  return facts;
}

std::string as_text(const ordered_json& value) {
  if (value.is_null()) return "not known";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : json_text(value, -1);
}

void print_as_text(const ordered_json& facts, const Session& session) {
  for (const auto& [name, value] : facts.items()) {
    std::string label = name;
    std::replace(label.begin(), label.end(), '_', ' ');
    if (!value.is_array()) {
      fmt::print(session.output, "{}: {}\n", label, as_text(value));
      continue;
    }
    fmt::print(session.output, "{}:\n", label);
    for (const ordered_json& entry : value) {
      std::string line;
      for (const auto& [key, part] : entry.items()) line += fmt::format("  {} {}", key, as_text(part));
      fmt::print(session.output, "{}\n", line);
    }
  }
}

}  // namespace

void add_info_command(CLI::App& program, const Session& session) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command =
      program.add_subcommand("info", "Describe a picture, disparity file, film, painting, particle file or slices");
  command->add_option("FILE", arguments->file,
                      "Picture, disparity (.pfm, .exr, or any with --scale), film, numbered pictures (frame_%04d.png), "
                      "painting (.wst), particles or slices");
  command->add_flag("--devices", arguments->devices, "List what can compute: the values of --device");
  add_number(*command, "--scale", arguments->scale, {1e-9, 1e9},
             "Read the picture as disparities: value / SCALE pixels");
  command->add_option("--type", arguments->type,
                      "Particle type of a GADGET snapshot: gas, halo, disk, bulge, stars, bndry or 0 to 5");
  command->add_option("--layout", arguments->layout, "Layout of a picture that holds both views, as for 'paint'");
  command->add_option("--display", arguments->display,
                      "Also match the views and report their depth and comfort on this display");
  command->footer(
      "Examples:\n  wheatstone info left.png\n  wheatstone info photograph.mpo --display desk-stereo\n"
      "  wheatstone info --devices");
  command->callback([arguments, command, &session] {
    if (!arguments->display.empty()) find_display(arguments->display);
    const ordered_json facts = facts_of(*arguments, *command);
    if (session.json) {
      print_facts(facts, session);
    } else {
      print_as_text(facts, session);
    }
  });
}

}  // namespace wheatstone::cli
