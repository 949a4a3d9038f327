#include <fmt/format.h>
#include <fmt/ostream.h>

#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.h"
#include "numbers_argument.h"
#include "output_option.h"
#include "size_argument.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/files/input_guard.h"
#include "wheatstone/files/temporary_file.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/pictures/write_image.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

struct Arguments {
  std::string file;
  std::string output = "views";
  RenderParticlesOptions options;
  std::string size = "640x360";
  std::string splat = "2,6";
  std::string display, centre, cut, depth_map;
  std::string cold, hot;
  std::string quilt, interleave, save_slices;
  double aspect = 0;  // of the display; 0: a view's own
};

const std::map<std::string, Method> methods{{"auto", Method::automatic},
                                            {"exact", Method::exact},
                                            {"incremental", Method::incremental},
                                            {"layered", Method::layered}};
const std::map<std::string, SliceFilter> filters{
    {"nearest", SliceFilter::nearest}, {"linear", SliceFilter::linear}, {"centroid", SliceFilter::centroid}};
const std::map<std::string, SizeRule> size_rules{{"denser-smaller", SizeRule::denser_smaller},
                                                 {"denser-larger", SizeRule::denser_larger},
                                                 {"smoothing-length", SizeRule::smoothing_length}};

std::string name_of(Method method) {
  for (const auto& [name, known] : methods)
    if (known == method) return name;
  return {};
}

Rgb8 parse_colour(const std::string& option, const std::string& text) {
  unsigned value = 0;
  const std::size_t first = text.starts_with('#') ? 1 : 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + first, end, value, 16);
  if (error != std::errc{} || stop != end || text.size() - first != 6)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected a colour such as 3366FF", option, text));
  return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 0xFF),
          static_cast<std::uint8_t>(value & 0xFF)};
}

/// "0:-80,0.4:0,1:80": shares of the scene's depth, and millimetres behind the screen.
std::vector<PerceivedDepth::Region> parse_depth_map(const std::string& text) {
  std::vector<PerceivedDepth::Region> regions;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::vector<float> pair = parse_numbers("--depth-map", text.substr(at, comma - at), ':', 2);
    regions.push_back({pair[0], pair[1]});
    at = comma + 1;
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const bool rises =
        i == 0 || (regions[i].share > regions[i - 1].share && regions[i].behind_mm >= regions[i - 1].behind_mm);
    if (!rises || regions[i].share < 0 || regions[i].share > 1)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--depth-map: is '{}', expected rising SHARE:MM pairs, shares from 0 to 1", text));
  }
  return regions;
}

/// What a display by name asks for, where the user does not say otherwise.
Arguments for_display(const Arguments& given, const CLI::App& command) {
  Arguments arguments = given;
  if (given.display.empty()) return arguments;
  const DisplayPreset& display = find_display(given.display);
  const auto unless_given = [&](const char* option, auto& value, const auto& preset) {
    if (command.count(option) == 0) value = preset;
  };
  RenderParticlesOptions& options = arguments.options;
  ViewingGeometry& viewing = options.depth.viewing;
  unless_given("--views", options.views, display.views);
  unless_given("--span", options.span, span_of(display, viewing.eye_separation_mm));
  unless_given("--size", arguments.size, fmt::format("{}x{}", display.view_width_px, display.view_height_px));
  unless_given("--distance", viewing.viewing_distance_mm, display.viewing_distance_mm);
  unless_given("--screen-width", viewing.screen_width_mm, display.screen_width_mm);
  // Depth that a small screen can show: as much of the width as a desk's screen has with 10 cm either way.
  const float depth_mm = std::min(100.f, 0.27f * display.screen_width_mm);
  unless_given("--near", options.depth.near_mm, depth_mm);
  unless_given("--far", options.depth.far_mm, depth_mm);
  arguments.aspect = display.aspect;
  if (display.quilt_columns > 0 && given.interleave.empty())
    unless_given("--quilt", arguments.quilt, fmt::format("{}x{}", display.quilt_columns, display.quilt_rows));
  return arguments;
}

RenderParticlesOptions options_of(const Arguments& arguments) {
  RenderParticlesOptions options = arguments.options;
  const std::vector<float> splat = parse_numbers("--splat", arguments.splat, ',', 2);
  take_view_size(arguments.size, options.width, options.height);
  options.appearance.smallest_px = splat[0];
  options.appearance.largest_px = splat[1];
  if (!arguments.centre.empty()) {
    const std::vector<float> centre = parse_numbers("--centre", arguments.centre, ',', 3);
    options.selection.centre = {centre[0], centre[1], centre[2]};
  }
  if (!arguments.cut.empty()) options.selection.cut = parse_cut(arguments.cut);
  if (!arguments.depth_map.empty()) options.depth.regions = parse_depth_map(arguments.depth_map);
  if (!arguments.cold.empty()) options.appearance.cold = parse_colour("--cold", arguments.cold);
  if (!arguments.hot.empty()) options.appearance.hot = parse_colour("--hot", arguments.hot);
  options.slices = !arguments.save_slices.empty() || !arguments.interleave.empty();
  options.without_views = !arguments.interleave.empty();
  return options;
}

/// Checks where the depth is, for people and for slices alike.
RenderedParticles from_slices(const Arguments& arguments, const CLI::App& command,
                              const RenderParticlesOptions& options, const Progress& progress) {
  RenderedParticles result;
  result.format = "slices";
  result.stack = read_slices(arguments.file);
  if (command.count("--near") + command.count("--far") > 0) {
    const DepthMapping mapping = mapping_for(options.depth, result.stack.width, 1, 2);
    map_depth(result.stack, mapping.points.front().parallax_px, mapping.points.back().parallax_px);
  }
  if (!std::isnan(options.rendering.exposure)) result.stack.exposure = options.rendering.exposure;
  result.rig = evenly_spaced(result.stack.width, result.stack.height, options.views, options.span);
  result.rendered = {.views = options.without_views
                                  ? std::vector<Image<Rgb8>>{}
                                  : render_slices(result.stack, result.rig, options.rendering.filter, progress),
                     .method = Method::layered,
                     .reason = "layered: the file has slices",
                     .planes = static_cast<int>(result.stack.slices.size()),
                     .exposure = result.stack.exposure};
  if (options.span > result.stack.span * 1.001f)
    result.warnings.push_back(fmt::format("the slices were made for {} eye separations, at {} their sides lack light",
                                          result.stack.span, options.span));
  return result;
}

QuiltLayout parse_quilt(const std::string& text, int views) {
  const std::vector<float> numbers = parse_numbers("--quilt", text, 'x', 2);
  const QuiltLayout layout{static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
  if (layout.columns < 1 || layout.rows < 1 || layout.columns * layout.rows != views)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--quilt: {} has another number of places than there are views, {}", text, views));
  return layout;
}

void check_screen(const LenticularScreen& screen, int width, int height) {
  if (screen.width != width || screen.height != height)
    throw Error(ErrorKind::wrong_usage, fmt::format("--interleave: the screen has {0}x{1} pixels, give --size {0}x{1}",
                                                    screen.width, screen.height));
}

void write_interleaved(const Arguments& arguments, const RenderedParticles& result, const Progress& progress) {
  const LenticularScreen screen = find_lenticular(arguments.interleave);
  check_screen(screen, result.stack.width, result.stack.height);
  const int views = static_cast<int>(result.rig.positions.size());
  const InterleavedView interleaved = render_interleaved(
      result.stack, result.rig.positions,
      [&](int y, std::span<std::uint16_t> three) { views_of_row(screen, views, y, three); }, progress);
  write_image(arguments.output, interleaved.picture);
}

ViewsOutput output_of(const Arguments& arguments) { return {arguments.output, {arguments.file, arguments.interleave}}; }

/// Writes the views and says where.
std::string write_views(const Arguments& arguments, const RenderedParticles& result, const Session& session) {
  if (!arguments.interleave.empty()) {
    write_interleaved(arguments, result, session.progress);
    return arguments.output;
  }
  const std::vector<Image<Rgb8>>& views = result.rendered.views;
  if (!arguments.quilt.empty()) {
    const QuiltLayout layout = parse_quilt(arguments.quilt, static_cast<int>(views.size()));
    return write_quilt(views, layout, arguments.aspect, output_of(arguments));
  }
  if (!arguments.display.empty() && find_display(arguments.display).lenses.screen_width_px > 0)
    return write_lenticular(views, find_lenticular(arguments.display), output_of(arguments));
  write_view_folder(views, output_of(arguments), session.progress);
  return arguments.output;
}

/// Writes what was asked for: the slices get their name when the views have theirs. Says where the views are.
std::string write_output(const Arguments& arguments, const RenderedParticles& result, const Session& session) {
  if (arguments.save_slices.empty()) return write_views(arguments, result, session);
  TemporaryFile slices(arguments.save_slices);
  write_slices(slices, result.stack);
  std::string written = write_views(arguments, result, session);
  slices.commit();
  return written;
}

void tell(const RenderedParticles& result, const std::string& written, const Session& session) {
  if (session.json) {
    nlohmann::ordered_json facts{{"output", written},
                                 {"format", result.format},
                                 {"particles", result.particles},
                                 {"dropped", result.dropped},
                                 {"mended", result.mended},
                                 {"density_estimated", result.density_estimated},
                                 {"views", result.rig.positions.size()},
                                 {"method", name_of(result.rendered.method)},
                                 {"reason", result.rendered.reason},
                                 {"planes", result.rendered.planes},
                                 {"exposure", result.rendered.exposure},
                                 {"warnings", result.warnings}};
    fmt::print(session.output, "{}\n", facts.dump(2));
    return;
  }
  if (result.dropped > 0)
    fmt::print(session.output, "left out: {} particles without a finite position\n", result.dropped);
  if (result.mended > 0)
    fmt::print(session.output, "taken as the least there is: {} densities or temperatures that are not above 0\n",
               result.mended);
  if (result.density_estimated) fmt::print(session.output, "density: estimated from each particle's neighbours\n");
  for (const std::string& warning : result.warnings) fmt::print(session.output, "note: {}\n", warning);
  if (session.verbose)
    fmt::print(session.output, "method: {}\nplanes: {}\nexposure: {:.4g}\n", result.rendered.reason,
               result.rendered.planes, result.rendered.exposure);
  fmt::print(session.output, "written to {}\n", written);
}

void run(const Arguments& given, const CLI::App& command, const Session& session) {
  const Arguments arguments = for_display(given, command);
  const RenderParticlesOptions options = options_of(arguments);
  // What cannot be written or makes no sense is said before the long work.
  if (!arguments.quilt.empty()) parse_quilt(arguments.quilt, options.views);
  const ViewsOutput output = output_of(arguments);
  check_views_output(output);
  check_not_an_input(arguments.save_slices, output.inputs);
  const bool slices = std::filesystem::path(arguments.file).extension() == ".exr";
  if (!arguments.interleave.empty()) {
    const LenticularScreen screen = find_lenticular(arguments.interleave);
    if (!slices) check_screen(screen, options.width, options.height);
    if (std::filesystem::path(arguments.output).extension().empty())
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--interleave: -o is '{}', expected a picture's name", arguments.output));
  }
  const RenderedParticles result = slices ? from_slices(arguments, command, options, session.progress)
                                          : render_particles(arguments.file, options, session.progress);
  tell(result, write_output(arguments, result, session), session);
}

void add_particle_options(CLI::App& command, Arguments& arguments) {
  CloudChoice& choice = arguments.options.choice;
  const std::string group = "Particles";
  command.add_option("--type", choice.type, "Of a snapshot: gas, halo, disk, bulge, stars, bndry or 0 to 5")
      ->capture_default_str()
      ->group(group);
  command.add_option("--position", choice.position, "Dataset or columns of the positions: /Coordinates, or x,y,z")
      ->group(group);
  command.add_option("--density", choice.density, "Dataset or column of the density")->group(group);
  command.add_option("--temperature", choice.temperature, "Dataset or column that the colours follow")->group(group);
  command.add_option("--smoothing-length", choice.smoothing_length, "Dataset or column")->group(group);
  command.add_option("--centre", arguments.centre, "X,Y,Z to move to the middle of a periodic box")->group(group);
  command.add_option("--cut", arguments.cut, "Keep only sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1")->group(group);
  command.add_option("--every", arguments.options.selection.every, "Keep one particle of so many")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
      ->group(group);
  command.add_option("--neighbours", arguments.options.neighbours, "For density where the file has none")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str()
      ->group(group);
  command.add_flag("--stream", arguments.options.stream, "Never hold all particles: read the file twice, in chunks")
      ->group(group);
  command.add_option("--chunk", arguments.options.chunk, "Particles in memory with --stream")
      ->check(CLI::Range(std::size_t{1000}, std::size_t{1} << 30))
      ->capture_default_str()
      ->group(group);
}

void add_look_options(CLI::App& command, Arguments& arguments) {
  Appearance& splat_style = arguments.options.appearance;
  const std::string group = "Look";
  command.add_option("--splat", arguments.splat, "Smallest and largest diameter in pixels")
      ->capture_default_str()
      ->group(group);
  command.add_option("--size-rule", splat_style.size_rule, "denser-smaller, denser-larger or smoothing-length")
      ->transform(CLI::CheckedTransformer(size_rules, CLI::ignore_case))
      ->group(group);
  command.add_option("--opacity", splat_style.opacity, "Of the densest")->capture_default_str()->group(group);
  command.add_option("--least-opacity", splat_style.least_opacity, "Of the thinnest, as a share")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--density-slope", splat_style.density_slope,
                  "Steepness of the sigmoid, for a factor of ten in density")
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--density-shift", splat_style.density_shift,
                  "Its middle, in factors of ten above the median density")
      ->capture_default_str()
      ->group(group);
  command.add_option("--colours", splat_style.colour_map, "A colour map by name: inferno, viridis, turbo ...")
      ->group(group);
  command.add_option("--cold", arguments.cold, "Colour of the coldest: 2860FF if not given")->group(group);
  command.add_option("--hot", arguments.hot, "Colour of the hottest: FF781E if not given")->group(group);
  command.add_option("--coldest", splat_style.coldest, "Where the colours begin; 2nd percentile if not given")
      ->group(group);
  command.add_option("--hottest", splat_style.hottest, "Where they end; 98th percentile if not given")->group(group);
  command.add_flag("!--linear-colours", splat_style.logarithmic, "Colours by temperature, not by its logarithm")
      ->group(group);
  command.add_option("--exposure", arguments.options.rendering.exposure, "From the central view if not given")
      ->check(CLI::PositiveNumber)
      ->group(group);
  command.add_flag("--opaque", arguments.options.rendering.opaque, "The nearest particle hides the others")
      ->group(group);
}

void add_view_options(CLI::App& command, Arguments& arguments) {
  RenderParticlesOptions& options = arguments.options;
  const std::string group = "Views and depth";
  std::string names;
  for (const DisplayPreset& display : display_presets()) names += fmt::format(" {}", display.name);
  command
      .add_option("--display", arguments.display,
                  "Views, span, size, distance, depth and quilt as a display wants them:" + names)
      ->group(group);
  command.add_option("--views", options.views, "How many, from left to right")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str()
      ->group(group);
  command.add_option("--span", options.span, "Eye separations from the first view to the last")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str()
      ->group(group);
  command.add_option("--size", arguments.size, "Of a view: WIDTHxHEIGHT")->capture_default_str()->group(group);
  const auto number = [&](const char* name, float& value, const char* what, double least, double most) {
    command.add_option(name, value, what)->check(CLI::Range(least, most))->capture_default_str()->group(group);
  };
  number("--azimuth", options.framing.azimuth_deg, "Seen from which side, in degrees", -360, 360);
  number("--elevation", options.framing.elevation_deg, "And from how high, in degrees", -90, 90);
  number("--fov", options.framing.field_of_view_deg, "Across a view, in degrees", 1, 150);
  number("--zoom", options.framing.zoom, "2 shows half as much", 0.01, 1000);
  number("--near", options.depth.near_mm, "The nearest stands so many mm before the screen", 0, 100000);
  number("--far", options.depth.far_mm, "The farthest so many mm behind it", 0, 1e9);
  number("--eye", options.depth.viewing.eye_separation_mm, "Between the eyes, or a viewing window's width, in mm", 1,
         1000);
  number("--distance", options.depth.viewing.viewing_distance_mm, "From the eyes to the screen, in mm", 1, 1e6);
  number("--screen-width", options.depth.viewing.screen_width_mm, "In mm", 1, 1e6);
  CLI::Option* map =
      command.add_option("--depth-map", arguments.depth_map, "Many regions: SHARE:MM,... from 0, nearest, to 1")
          ->group(group);
  command.add_flag("--smooth-depth", options.depth.smooth, "A smooth curve through the regions' ends")
      ->needs(map)
      ->group(group);
}

void add_method_options(CLI::App& command, Arguments& arguments) {
  RenderOptions& rendering = arguments.options.rendering;
  const std::string group = "Method and output";
  command.add_option("--method", rendering.method, "auto, exact, incremental or layered; -v says why")
      ->transform(CLI::CheckedTransformer(methods, CLI::ignore_case))
      ->group(group);
  command.add_option("--filter", rendering.filter, "Of layered: nearest, linear or centroid")
      ->transform(CLI::CheckedTransformer(filters, CLI::ignore_case))
      ->group(group);
  command.add_option("--planes", rendering.planes, "Depth planes; one for each pixel of parallax if not given")
      ->check(CLI::Range(0, 100000))
      ->group(group);
  CLI::Option* quilt =
      command.add_option("--quilt", arguments.quilt, "Write one quilt of COLUMNSxROWS views")->group(group);
  command
      .add_option("--interleave", arguments.interleave, "Write one picture for a lenticular screen: its name or .json")
      ->excludes(quilt)
      ->group(group);
  command.add_option("--save-slices", arguments.save_slices, "Also write the depth planes: FILE.exr")
      ->check(not_empty())
      ->group(group);
}

}  // namespace

void add_render_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("render", "Render the views of a particle data set");
  command
      ->add_option("FILE", arguments->file,
                   "GADGET snapshot (HDF5 or binary), any HDF5, PLY, LAS, .npy or text; or slices (.exr)")
      ->required();
  add_output_option(*command, arguments->output, "Folder for the views; or the quilt's or picture's name");
  add_particle_options(*command, *arguments);
  add_look_options(*command, *arguments);
  add_view_options(*command, *arguments);
  add_method_options(*command, *arguments);
  command->footer(
      "Views are written as view_000.png, the leftmost, and so on.\n\n"
      "Examples:\n"
      "  wheatstone synth universe -o universe.hdf5\n"
      "  wheatstone render universe.hdf5 --views 9 -o views\n"
      "  wheatstone render universe.hdf5 --display looking-glass-portrait -o universe\n"
      "  wheatstone render universe.hdf5 --save-slices slices.exr && wheatstone render slices.exr --views 45");
  command->callback([arguments, command, &session] { run(*arguments, *command, session); });
}

}  // namespace wheatstone::cli
