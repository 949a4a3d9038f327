#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "commands.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/matching/eye_order.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/not_a_pair.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/find_layout.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/video/film_files.h"
#include "wheatstone/video/film_reader.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// The smallest and largest of the known disparities seen.
struct FoundDisparityRange {
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

void put_range(Json& facts, const FoundDisparityRange& range) {
  if (range.known == 0) return;
  facts["farthest_disparity_px"] = range.farthest;
  facts["nearest_disparity_px"] = range.nearest;
}

Json facts_of_disparity(const fs::path& path, std::optional<float> scale) {
  const Image<float> disparity = read_disparity(path, scale);
  FoundDisparityRange range;
  for (const float value : disparity.pixels()) range.add(value);
  Json facts = {{"kind", "disparity"}, {"width", disparity.width()}, {"height", disparity.height()}};
  facts["known_share"] = static_cast<double>(range.known) / static_cast<double>(disparity.pixels().size());
  put_range(facts, range);
  return facts;
}

Json facts_of_painting(const fs::path& path) {
  const Painting painting = read_painting(path);
  FoundDisparityRange range;
  for (const float disparity : disparities_of_marks(painting)) range.add(disparity);
  const MarkCount marks = count_marks(painting);
  Json facts = {{"kind", "painting"}, {"width", width_of(painting)}, {"height", height_of(painting)}};
  facts[std::string(marks.kind)] = marks.count;
  put_range(facts, range);
  facts["texture"] = painting.relief.depth_px > 0;
  const ViewRange known = known_views(painting.surfaces);
  if (painting.surfaces.seen.empty()) {
    facts["views"] = "of two eyes";
  } else {
    facts["views"] = {{"first", known.first.eye_separations()}, {"last", known.last.eye_separations()}};
  }
  Json layers = Json::array();
  for (const Layer& layer : layers_of(painting))
    layers.push_back(
        {{"radius_px", layer.radius_px}, {"strokes", count_strokes(layer)}, {"points", layer.points.size()}});
  if (!layers.empty()) facts["layers"] = std::move(layers);
  return facts;
}

Json facts_of_picture(const ImageDescription& picture) {
  Json facts = {{"kind", "picture"}, {"format", picture.format}};
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
void put_depth(Json& facts, const StereoPair& pair, const std::string& display_name) {
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
void put_views(Json& facts, const fs::path& path, const std::string& layout, const std::string& display) {
  const ReadViewsOptions options = layout.empty() ? ReadViewsOptions() : options_for_layout(layout);
  try {
    if (layout.empty() && !is_stereo_file_name(path) && carries_depth(path)) {
      facts["depth"] = find_carried_depth(path)->how;
      return;
    }
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

/// Reads the particles that a file has, and counts those that are chosen.
std::uint64_t count_chosen(const CloudSource& source, const Progress& progress) {
  constexpr std::size_t chunk = 1 << 16;
  std::uint64_t read = 0, chosen = 0;
  for (Cloud some = source.next(chunk); some.size() > 0; some = source.next(chunk)) {
    read += some.size();
    chosen += static_cast<std::uint64_t>(std::ranges::count(some.chosen, std::uint8_t{1}));
    if (source.count) report(progress, "reading", static_cast<double>(read) / static_cast<double>(*source.count));
    if (source.reuse) source.reuse(std::move(some));
  }
  return chosen;
}

Json facts_of_particles(const fs::path& path, const CloudChoice& choice, const Session& session) {
  const CloudSource source = open_cloud(path, choice);
  Json facts = {{"kind", "particles"}, {"format", source.format}};
  if (source.count) facts["particles"] = *source.count;
  if (choice.where) facts["chosen"] = count_chosen(source, session.progress);
  if (source.box_size > 0) facts["box_size"] = source.box_size;
  if (source.redshift) facts["redshift"] = *source.redshift;
  if (source.time && !source.redshift) facts["time"] = *source.time;
  facts["bytes"] = source.bytes;
  facts["fields"] = fmt::format("{}", fmt::join(source.fields, ", "));
  std::vector<std::string> units;
  for (const auto& [name, unit] : source.units) units.push_back(fmt::format("{}: {}", name, unit));
  if (!units.empty()) facts["units"] = fmt::format("{}", fmt::join(units, ", "));
  return facts;
}

/// What a model has, of the materials that its triangles have.
Json facts_of_model(const fs::path& path, const Session& session) {
  const ReadModel read = read_model(path, {}, session.progress);
  const Model& model = read.model;
  Json facts = {{"kind", "model"}, {"format", read.format}};
  facts["triangles"] = model.triangles.size();
  facts["vertices"] = model.positions.size();
  const ModelBounds bounds = bounds_of(model);
  const auto [x, y, z] = bounds.size();
  const auto [middle_x, middle_y, middle_z] = bounds.middle();
  facts["size"] = fmt::format("{:.6g} x {:.6g} x {:.6g}", x, y, z);
  facts["middle"] = fmt::format("{:.10g},{:.10g},{:.10g}", middle_x, middle_y, middle_z);
  facts["normals"] = read.has_normals ? "of the file" : "made";
  facts["vertex_colours"] = !model.colours.empty();
  if (read.degenerate > 0) facts["triangles_without_area"] = read.degenerate;
  facts["bytes"] = read.bytes;
  std::vector<std::size_t> triangles(model.materials.size());
  for (const std::uint32_t material : model.material_of) ++triangles[material];
  Json materials = Json::array();
  for (std::size_t m = 0; m < triangles.size(); ++m) {
    if (triangles[m] == 0) continue;
    const ModelMaterial& material = model.materials[m];
    Json of_material = {{"name", material.name}, {"triangles", triangles[m]}};
    if (material.texture >= 0) {
      const Image<Rgb8>& texture = model.textures[static_cast<std::size_t>(material.texture)];
      of_material["texture"] = fmt::format("{}x{}", texture.width(), texture.height());
    }
    materials.push_back(std::move(of_material));
  }
  facts["materials"] = std::move(materials);
  if (!read.warnings.empty()) facts["note"] = fmt::format("{}", fmt::join(read.warnings, "; "));
  return facts;
}

Json facts_of_slices(const fs::path& path) {
  const SliceStack stack = read_slices(path);
  Json facts = {{"kind", "slices"}, {"width", stack.width}, {"height", stack.height}};
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

/// Where the name says that the picture is a quilt, its views; false where it does not.
bool put_quilt(Json& facts, const fs::path& path, int width, int height) {
  const std::optional<NamedQuilt> quilt = quilt_of_name(path.filename().string());
  if (!quilt) return false;
  const auto [columns, rows] = quilt->layout;
  facts["quilt"] = fmt::format("{}x{}", columns, rows);
  facts["views"] = columns * rows;
  facts["view_width"] = width / columns;
  facts["view_height"] = height / rows;
  facts["view_aspect"] = quilt->aspect;
  return true;
}

void put(Json& facts, const char* name, const std::string& value) {
  if (!value.empty()) facts[name] = value;
}

Json facts_of_side_streams(const FilmFacts& film) {
  Json all = Json::array();
  for (const SideStream& stream : film.side_streams) {
    Json facts = {{"kind", stream.kind}, {"codec", stream.codec}};
    put(facts, "language", stream.language);
    if (stream.channels > 0) facts["channels"] = stream.channels;
    if (stream.sample_rate > 0) facts["sample_rate"] = stream.sample_rate;
    all.push_back(std::move(facts));
  }
  return all;
}

/// What a film says of itself.
Json facts_of_film(const fs::path& path) {
  const FilmReader reader = open_film(path);
  const FilmFacts& film = reader.facts();
  Json facts = {{"kind", "film"}, {"container", film.container}};
  put(facts, "codec", film.codec);
  put(facts, "pixel_format", film.pixel_format);
  put_quilt(facts, path, film.width, film.height);
  facts["width"] = film.width;
  facts["height"] = film.height;
  if (film.pixel_aspect != Rational{1, 1}) {
    facts["pixel_aspect"] = fmt::format("{}:{}", film.pixel_aspect.numerator, film.pixel_aspect.denominator);
  }
  if (film.rotation_degrees != 0) facts["rotation_applied_degrees"] = film.rotation_degrees;
  facts["layout"] = film.layout_how.empty() ? std::string("unsaid") : std::string(layout_name(film.layout));
  put(facts, "layout_from", film.layout_how);
  if (film.frame_rate.numerator > 0) facts["frames_per_second"] = film.frame_rate.value();
  if (film.frame_count) facts["frames"] = *film.frame_count;
  if (film.duration_s > 0) facts["duration_s"] = film.duration_s;
  if (film.projection != "flat") put(facts, "projection", film.projection);
  if (film.interlaced) facts["interlaced"] = "frames are deinterlaced when they are read (bwdif)";
  put(facts, "comment", film.comment);
  put(facts, "colour_matrix", film.colour.matrix);
  put(facts, "colour_range", film.colour.range);
  put(facts, "colour_primaries", film.colour.primaries);
  put(facts, "colour_transfer", film.colour.transfer);
  if (!film.side_streams.empty()) facts["side_streams"] = facts_of_side_streams(film);
  return facts;
}

/// Whether a file holds particles by its content; or should, by its name: then what is wrong with it is told.
bool is_particles(const fs::path& path) {
  constexpr const char* endings[] = {".hdf5", ".h5",  ".ply", ".las", ".npy",   ".npz",
                                     ".fits", ".csv", ".txt", ".dat", ".gadget"};
  return std::ranges::find(endings, path.extension().string()) != std::end(endings) || holds_particles(path);
}

/// What --device can be, with the name of the graphics processor, or why there is none.
Json facts_of_devices() {
  Json facts{{"kind", "devices"}, {"cpu", fmt::format("{} threads", std::thread::hardware_concurrency())}};
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
  std::string type, layout, display;
  std::optional<Condition> where;
};

enum class DescribedKind { devices, film, painting, model, particles, disparity, views, slices, quilt, picture };

DescribedKind described_kind_of(const InfoArguments& a) {
  if (a.devices) return DescribedKind::devices;
  if (a.file.empty()) throw Error(ErrorKind::wrong_usage, "FILE is missing, expected a file or --devices");
  const fs::path path = a.file;
  if (is_film(path)) return DescribedKind::film;
  if (path.extension() == ".wst") return DescribedKind::painting;
  if (is_model(path)) return DescribedKind::model;
  if (is_particles(path)) return DescribedKind::particles;
  if (a.scale) return DescribedKind::disparity;
  const ImageDescription picture = describe_image(path);
  if (is_multiview_exr(path)) return DescribedKind::views;
  if (picture.format == "openexr" && picture.channels == 4) return DescribedKind::slices;
  if (picture.is_float && picture.channels == 1)
    return DescribedKind::disparity;  // one channel of floats is no photograph
  return a.layout.empty() && quilt_of_name(path.filename().string()) ? DescribedKind::quilt : DescribedKind::picture;
}

std::string_view described_situation(DescribedKind kind) {
  constexpr std::array<std::string_view, 10> words{
      "with --devices",          "on a film", "on a painting (.wst)", "on a model",  "on particles", "on disparities",
      "on a multi-view OpenEXR", "on slices", "on a quilt",           "on a picture"};
  return words[static_cast<std::size_t>(kind)];
}

Json facts_of(const InfoArguments& arguments, const Session& session) {
  const fs::path path = arguments.file;
  switch (described_kind_of(arguments)) {
    case DescribedKind::devices:
      return facts_of_devices();
    case DescribedKind::film:
      return facts_of_film(path);
    case DescribedKind::painting:
      return facts_of_painting(path);
    case DescribedKind::model:
      return facts_of_model(path, session);
    case DescribedKind::particles:
      return facts_of_particles(path, {.type = arguments.type, .where = arguments.where}, session);
    case DescribedKind::disparity:
      return facts_of_disparity(path, arguments.scale);
    case DescribedKind::views: {
      const std::vector<Image<Rgb8>> views = read_multiview_exr(path);
      return {{"kind", "views"}, {"views", views.size()}, {"width", views[0].width()}, {"height", views[0].height()}};
    }
    case DescribedKind::slices:
      return facts_of_slices(path);
    case DescribedKind::quilt:
    case DescribedKind::picture:
      break;
  }
  const ImageDescription picture = describe_image(path);
  Json facts = facts_of_picture(picture);
  if (arguments.layout.empty() && put_quilt(facts, path, picture.width, picture.height)) return facts;
  put_views(facts, path, arguments.layout, arguments.display);
  if (!facts.contains("views") && !arguments.display.empty())
    throw Error(ErrorKind::wrong_usage, "--display: has no effect on a picture of one view; it works on two");
  return facts;
}

std::string as_text(const Json& value) {
  if (value.is_null()) return "not known";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : json_text(value, -1);
}

/// "name: value", and a line for each of several.
std::string line_of(const std::string& name, const Json& value) {
  std::string label = name;
  std::replace(label.begin(), label.end(), '_', ' ');
  if (!value.is_array()) return fmt::format("{}: {}", label, as_text(value));
  std::string text = label + ":";
  for (const Json& entry : value) {
    text += "\n";
    for (const auto& [key, part] : entry.items()) text += fmt::format("  {} {}", key, as_text(part));
  }
  return text;
}

Report run_info(const InfoArguments& arguments, const Session& session) {
  if (!arguments.display.empty()) find_display(arguments.display);
  Report report;
  const Json facts = facts_of(arguments, session);
  for (const auto& [name, value] : facts.items()) report.facts.push_back({name, value, line_of(name, value)});
  return report;
}

Rows info_rows(InfoArguments& a) {
  const auto only = [&a](std::vector<DescribedKind> kinds, const char* where) {
    return only_on<DescribedKind>([&a] { return described_kind_of(a); }, std::move(kinds), described_situation, where);
  };
  return {
      row("FILE", text(a.file),
          "Picture, disparity (.pfm, .exr, or any with --scale), film, numbered pictures (frame_%04d.png), painting "
          "(.wst), particles, model or slices",
          {when([&a] { return a.devices; }, "with --devices")}),
      row("--devices", flag(a.devices), "List the devices that can compute: the values of --device"),
      row("--scale", number(a.scale, {1e-9, 1e9}), "Read the picture as disparities: value / SCALE pixels",
          {only({DescribedKind::disparity}, "it works on pictures")}),
      row("--type", text(a.type), "Particle type of a GADGET snapshot: gas, halo, disk, bulge, stars, bndry or 0 to 5",
          {only({DescribedKind::particles}, "it works on particles")}),
      row("--where", parsed(a.where, parse_where, "CONDITION"),
          "Count the particles for which a condition holds, as 'Temperature > 1e6 and Density < 1e-3'; as for 'render'",
          {only({DescribedKind::particles}, "it works on particles")}),
      row("--layout", text(a.layout), "Layout of a picture that holds both views, as for 'paint'",
          {only({DescribedKind::picture}, "it works on pictures")}),
      row("--display", text(a.display), "Also match the views and report their depth and comfort on this display",
          {only({DescribedKind::picture}, "it works on pictures of two views")})};
}

}  // namespace

Command info_command() {
  return make_command("info", "Describe a picture, disparity file, film, painting, particle file, model or slices",
                      info_rows, run_info,
                      R"(Examples:
  wheatstone info left.png
  wheatstone info photograph.mpo --display desk-stereo
  wheatstone info universe.hdf5 --where 'Temperature > 1e5'
  wheatstone info --devices)");
}

}  // namespace wheatstone::cli
