#include "render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "device_option.h"
#include "number_arguments.h"
#include "option_use.h"
#include "output_option.h"
#include "picture_format.h"
#include "typed_options.h"
#include "wheatstone/app/render_limits.h"
#include "wheatstone/app/write_values.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

constexpr std::array<std::pair<std::string_view, Method>, 4> methods{{{"auto", Method::automatic},
                                                                      {"exact", Method::exact},
                                                                      {"incremental", Method::incremental},
                                                                      {"layered", Method::layered}}};
constexpr std::array<std::pair<std::string_view, SliceFilter>, 3> filters{
    {{"nearest", SliceFilter::nearest}, {"linear", SliceFilter::linear}, {"centroid", SliceFilter::centroid}}};
constexpr std::array<std::pair<std::string_view, Look>, 2> looks{{{"mass", Look::mass}, {"thesis", Look::thesis}}};
constexpr std::array<std::pair<std::string_view, Blend>, 2> blends{{{"add", Blend::add}, {"over", Blend::over}}};
constexpr std::array<std::pair<std::string_view, Kernel>, 2> kernels{
    {{"gaussian", Kernel::gaussian}, {"cubic-spline", Kernel::cubic_spline}}};
constexpr std::array<std::pair<std::string_view, Stretch>, 3> stretches{
    {{"asinh", Stretch::asinh}, {"log", Stretch::log}, {"linear", Stretch::linear}}};
constexpr std::array<std::pair<std::string_view, bool>, 2> projections{
    {{"perspective", false}, {"orthographic", true}}};
constexpr std::array<std::pair<std::string_view, SizeRule>, 5> size_rules{
    {{"auto", SizeRule::automatic},
     {"density", SizeRule::density},
     {"denser-smaller", SizeRule::denser_smaller},
     {"denser-larger", SizeRule::denser_larger},
     {"smoothing-length", SizeRule::smoothing_length}}};

constexpr auto particles_group = "Particles", appearance_group = "Appearance", views_group = "Views and depth",
               method_group = "Method and output";

/// "sphere:X,Y,Z,R" or "box:X0,Y0,Z0,X1,Y1,Z1"; nothing of something else. `expected` is for the message.
Cut parse_region(const std::string& option, const std::string& text, std::string_view expected) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view kind = std::string_view(text).substr(0, colon);
  const std::string_view rest = std::string_view(text).substr(std::min(colon + 1, text.size()));
  if (kind == "sphere") {
    const auto n = parse_numbers(option, rest, {',', 4, coordinate_range, expected});
    if (n[3] > 0) return Sphere{{n[0], n[1], n[2]}, n[3]};
  } else if (kind == "box") {
    const auto n = parse_numbers(option, rest, {',', 6, coordinate_range, expected});
    if (n[0] < n[3] && n[1] < n[4] && n[2] < n[5]) return Box{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  }
  throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected {}", option, text, expected));
}

/// "auto", "all", "99.9%", or a region as above.
Fit parse_fit(const std::string& text) {
  constexpr std::string_view expected = "auto, all, 99.9%, sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1";
  if (text == "auto") return {};
  if (text == "all") return FitAll{};
  if (text.ends_with('%'))
    return FitShare{parse_numbers("--fit", text.substr(0, text.size() - 1), {',', 1, {1, 100}, expected})[0] / 100};
  const Cut region = parse_region("--fit", text, expected);
  if (const Sphere* sphere = std::get_if<Sphere>(&region)) return *sphere;
  return std::get<Box>(region);
}

void add_particle_options(CLI::App& command, RenderArguments& arguments) {
  CloudChoice& choice = arguments.options.choice;
  const auto text = [&](const char* name, std::string& value, const char* help) {
    return command.add_option(name, value, help)->group(particles_group);
  };
  text("--type", choice.type,
       "Particle type of a GADGET snapshot: gas, halo, disk, bulge, stars, bndry or 0 to 5; gas by default");
  text("--position", choice.position, "Dataset or columns of the positions: /Coordinates, or x,y,z");
  text("--density", choice.density, "Dataset or column of the density");
  text("--temperature", choice.temperature, "Dataset or column of the temperature, which sets the colours");
  text("--smoothing-length", choice.smoothing_length, "Dataset or column of the smoothing length");
  text("--mass", choice.mass, "Dataset or column of the mass; each particle counts 1 where there is none");
  text("--centre", arguments.centre, "Point X,Y,Z of a periodic box that is moved to the middle of the views");
  text("--select", arguments.selection, "Keep the particles in sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1 only");
  add_number(command, "--subsample", arguments.options.selection.every, every_range, "Keep every Nth particle")
      ->group(particles_group);
  add_number(command, "--neighbours", arguments.options.neighbours, neighbours_range,
             "Particles in a kernel, from which the density is estimated where the file has none")
      ->group(particles_group);
  CLI::Option* stream = command
                            .add_flag("--stream", arguments.options.stream,
                                      "Read the file twice, in chunks: memory does not grow with the file")
                            ->group(particles_group);
  add_number(command, "--chunk", arguments.options.chunk, {1000, 1 << 30}, "Particles per chunk with --stream")
      ->needs(stream)
      ->group(particles_group);
}

void add_appearance_options(CLI::App& command, RenderArguments& arguments) {
  Appearance& appearance = arguments.options.appearance;
  const auto number = [&](const char* name, float& value, NumberRange range, const char* help) {
    add_number(command, name, value, range, help)->group(appearance_group);
  };
  add_choice<Look>(command, "--look", appearance.look, looks,
                   "What is shown: mass, whose column density is the brightness; or the light of Hassaine's thesis")
      ->group(appearance_group);
  command
      .add_option("--quantity", arguments.options.quantity,
                  "Show numbers in the colours of a map: column-density, or the mean of temperature, density, "
                  "velocity-x or any dataset or column along each line of sight, weighted by mass")
      ->group(appearance_group);
  add_choice<Stretch>(command, "--stretch", arguments.options.rendering.tone.stretch, stretches,
                      "How numbers between --least and --most become brightness")
      ->group(appearance_group);
  number("--least", arguments.options.least, coordinate_range,
         "Column density, or quantity, where brightness begins; 0 or the 1st percentile by default");
  number("--most", arguments.options.most, coordinate_range,
         "Column density, or quantity, where brightness ends; the 99.9th percentile by default");
  add_choice<Kernel>(command, "--kernel", appearance.kernel, kernels, "How a particle's mass is spread")
      ->group(appearance_group);
  command
      .add_option("--splat", arguments.splat,
                  "Smallest and largest splat diameter in pixels: MIN,MAX; 2,6 by default. The largest counts for the "
                  "size rules denser-smaller and denser-larger")
      ->group(appearance_group);
  add_choice<SizeRule>(command, "--size-rule", appearance.size_rule, size_rules, "What sets the size of a splat")
      ->group(appearance_group);
  number("--opacity", appearance.opacity, opacity_range, "Opacity of the densest particles");
  number("--least-opacity", appearance.least_opacity, least_opacity_range,
         "Opacity of the least dense particles, as a fraction of --opacity");
  number("--density-slope", appearance.density_slope, density_slope_range,
         "Slope of the sigmoid that turns density into opacity, per factor of ten in density");
  number("--density-shift", appearance.density_shift, density_shift_range,
         "Centre of that sigmoid, in factors of ten above the median density");
  CLI::Option* map = command
                         .add_option("--colours", appearance.colour_map,
                                     "Colour map: inferno, magma, plasma, viridis, cividis, turbo, twilight, hot, jet, "
                                     "bone")
                         ->group(appearance_group);
  command.add_option("--cold", arguments.cold, "Colour of the coldest particles")
      ->excludes(map)
      ->group(appearance_group);
  command.add_option("--hot", arguments.hot, "Colour of the hottest particles")->excludes(map)->group(appearance_group);
  number("--coldest", appearance.coldest, coordinate_range,
         "Temperature where the colours begin; 2nd percentile by default");
  number("--hottest", appearance.hottest, coordinate_range, "Temperature where they end; 98th percentile by default");
  command
      .add_flag("--annotate", arguments.annotate,
                "Draw a scale bar, the colours with their limits and units, and the redshift into each view")
      ->group(method_group);
  command.add_flag("!--linear-colours", appearance.logarithmic, "Map the temperature to colours linearly")
      ->group(appearance_group);
  number("--exposure", arguments.options.rendering.exposure, exposure_range,
         "Factor on the light before tone mapping; from the central view by default");
  add_choice<Blend>(command, "--blend", appearance.blend, blends,
                    "How particles that lie behind each other come together: their light is added, or the nearer ones "
                    "also absorb light, so that they are in front")
      ->group(appearance_group);
  number("--shine", appearance.shine, shine_range,
         "Light of highlights on the surfaces of clumps, which move from view to view, as a multiple of the particles' "
         "own");
  command
      .add_flag("--opaque", arguments.options.rendering.opaque,
                "Draw opaque particles: the nearest hides the others, instead of adding their light")
      ->group(appearance_group);
}

void add_camera_options(CLI::App& command, RenderArguments& arguments) {
  command
      .add_option("--look-at", arguments.look_at,
                  "Point X,Y,Z in the middle of the views, around which the camera turns; that of all particles by "
                  "default")
      ->group(views_group);
  Framing& framing = arguments.options.framing;
  const auto number = [&](const char* name, float& value, NumberRange range, const char* help) {
    add_number(command, name, value, range, help)->group(views_group);
  };
  command
      .add_option("--fit", arguments.fit,
                  "What the views show and the depth is mapped to: all particles; the middle share of them along each "
                  "axis, as 99.9%; sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1; auto: all, but for a few that lie far out")
      ->capture_default_str()
      ->group(views_group);
  number("--azimuth", framing.azimuth_deg, {-360, 360}, "Direction that the camera looks from, in degrees");
  number("--elevation", framing.elevation_deg, elevation_range, "Height of the camera above the horizon, in degrees");
  number("--fov", framing.field_of_view_deg, field_of_view_range, "Horizontal field of view, in degrees");
  number("--zoom", framing.zoom, zoom_range, "Magnification: 2 shows half as much");
  add_choice<bool>(command, "--projection", framing.orthographic, projections,
                   "Perspective, or orthographic: everything is as large as at the point that is looked at, and the "
                   "views are sheared")
      ->group(views_group);
}

void add_depth_options(CLI::App& command, RenderArguments& arguments) {
  PerceivedDepth& depth = arguments.options.depth;
  const auto length = [&](const char* name, float& value, NumberRange range, const char* help) {
    add_length(command, name, value, range, help)->group(views_group);
  };
  length("--near", depth.near_mm, near_range_mm, "Depth in front of the screen, in mm");
  length("--far", depth.far_mm, far_range_mm, "Depth behind the screen, in mm");
  length("--eye", depth.viewing.eye_separation_mm, eye_range_mm,
         "Eye separation, or the width of a viewing window, in mm");
  length("--distance", depth.viewing.viewing_distance_mm, distance_range_mm, "Viewing distance, in mm");
  length("--screen-width", depth.viewing.screen_width_mm, screen_width_range_mm, "Width of the screen, in mm");
  CLI::Option* mapping =
      command
          .add_option("--depth-mapping", arguments.depth_mapping,
                      "Depth mapping by regions: SHARE:MM,... where SHARE is 0 for the nearest and 1 for the farthest "
                      "particle, and MM is the depth behind the screen")
          ->group(views_group);
  CLI::Option* focus = command
                           .add_option("--focus", arguments.focus,
                                       "Point X,Y of the screen around which there is more depth than elsewhere, as "
                                       "shares of its width and height from the upper left: 0.5,0.5 is the middle")
                           ->group(views_group);
  add_number(command, "--focus-radius", arguments.focus_radius, {0.001, 10},
             "Radius of that area, as a share of the width")
      ->needs(focus)
      ->group(views_group);
  add_number(command, "--focus-gain", arguments.focus_gain, {0, 10}, "Factor on the depth at that point")
      ->needs(focus)
      ->group(views_group);
  command.add_flag("--smooth-depth", depth.smooth, "Interpolate the depth mapping with a smooth monotone curve")
      ->needs(mapping)
      ->group(views_group);
}

void add_view_options(CLI::App& command, RenderArguments& arguments) {
  RenderParticlesOptions& options = arguments.options;
  std::string names;
  for (const DisplayPreset& display : display_presets()) names += fmt::format(" {}", display.name);
  command
      .add_option("--display", arguments.display,
                  "Set views, span, size, distance, depth and quilt for a display:" + names)
      ->group(views_group);
  add_number(command, "--views", options.views, view_count_range, "Number of views")->group(views_group);
  add_number(command, "--span", options.span, view_span_range,
             "Distance from the first view to the last, in eye separations")
      ->group(views_group);
  command.add_option("--size", arguments.size, "Size of a view: WIDTHxHEIGHT")
      ->capture_default_str()
      ->group(views_group);
  add_camera_options(command, arguments);
  add_depth_options(command, arguments);
}

void add_method_options(CLI::App& command, RenderArguments& arguments) {
  RenderOptions& rendering = arguments.options.rendering;
  add_choice<Method>(command, "--method", rendering.method, methods, "Rendering method; --verbose tells which was used")
      ->group(method_group);
  add_device_option(command, rendering.device, "What renders")->group(method_group);
  add_choice<SliceFilter>(command, "--filter", rendering.filter, filters, "Depth-plane filter of the layered method")
      ->group(method_group);
  add_number(command, "--planes", rendering.planes, {1, planes_range.most},
             "Number of depth planes; one per pixel of parallax by default")
      ->default_str("")
      ->group(method_group);
  CLI::Option* quilt =
      command.add_option("--quilt", arguments.quilt, "Write one quilt of COLUMNSxROWS views")->group(method_group);
  CLI::Option* interleave = command
                                .add_option("--interleave", arguments.interleave,
                                            "Write one picture for a lenticular screen: its name, or a calibration "
                                            "(.json)")
                                ->excludes(quilt)
                                ->group(method_group);
  command
      .add_option("--values", arguments.values,
                  "Also write the views as numbers with their units: FILE.fits, .exr or .npy; of several views, "
                  "FILE_000.fits and so on")
      ->check(not_empty())
      ->group(method_group);
  command.add_option("--save-slices", arguments.save_slices, "Also write the depth planes: FILE.exr")
      ->check(not_empty())
      ->group(method_group);
  add_picture_format(command, arguments.format, "File format of the views or the quilt")
      ->excludes(interleave)
      ->group(method_group);
}

void refuse_for_slices(const CLI::App& command) {
  constexpr auto situation = "on slices (.exr)", where = "it works on particles";
  refuse_group(command, particles_group, {}, situation, where);
  refuse_group(command, appearance_group, {"--exposure"}, situation, where);
  refuse_group(command, views_group,
               {"--display", "--views", "--span", "--near", "--far", "--eye", "--distance", "--screen-width", "--focus",
                "--focus-radius", "--focus-gain"},
               situation, where);
  refuse_options(command, {"--method", "--device", "--planes", "--values", "--annotate"}, situation, where);
  if (!was_given(command, "--near") && !was_given(command, "--far"))
    refuse_options(command, {"--eye", "--distance", "--screen-width"}, "on slices (.exr) whose depth stays as it is",
                   "it works with --near or --far");
}

/// The option with which particles are drawn in the thesis's look without --look; empty: none.
std::string option_of_thesis(const RenderArguments& arguments) {
  if (arguments.options.rendering.opaque) return "--opaque";
  return arguments.options.appearance.blend == Blend::over ? "--blend over" : "";
}

/// What belongs to the other look has no effect.
void refuse_for_look(const CLI::App& command, const RenderArguments& arguments) {
  const Appearance& appearance = arguments.options.appearance;
  const std::string option = option_of_thesis(arguments);
  if (!option.empty())
    refuse_options(command, {"--shine"}, "with " + option, "it works on particles that add their light");
  if (!arguments.options.quantity.empty())
    refuse_options(command, {"--shine"}, "with --quantity", "it works on pictures, not on numbers");
  if (!option.empty() && appearance.look == Look::mass)
    refuse_options(command, {"--look"}, "with " + option, "such particles are drawn in --look thesis");
  if (arguments.options.rendering.opaque)
    refuse_options(command, {"--blend"}, "with --opaque", "it works on particles that are seen through");
  if (appearance.look == Look::thesis || !option.empty()) {
    refuse_options(command, {"--quantity", "--stretch", "--least", "--most", "--values", "--kernel"},
                   "with " + (option.empty() ? "--look thesis" : option), "it works with --look mass");
    return;
  }
  refuse_options(command, {"--opacity", "--least-opacity", "--exposure", "--blend"}, "with --look mass",
                 "it works with --look thesis");
  const bool by_rank =
      appearance.size_rule == SizeRule::denser_smaller || appearance.size_rule == SizeRule::denser_larger;
  if (!by_rank)
    refuse_options(command, {"--density-slope", "--density-shift"}, "with --look mass",
                   "it works with --look thesis, or with --size-rule denser-smaller or denser-larger");
  if (!arguments.options.quantity.empty())
    refuse_options(command, {"--cold", "--hot", "--coldest", "--hottest", "--linear-colours"}, "with --quantity",
                   "the colours are those of --colours between --least and --most");
}

void refuse_for_particles(const CLI::App& command, const RenderArguments& arguments) {
  refuse_for_look(command, arguments);
  const RenderOptions& rendering = arguments.options.rendering;
  const bool makes_slices = !arguments.save_slices.empty() || !arguments.interleave.empty();
  const bool other_method = rendering.method == Method::exact || rendering.method == Method::incremental;
  if (makes_slices && other_method)
    refuse_options(command, {"--method"}, "with --save-slices or --interleave", "these render depth planes");
  if (makes_slices)
    refuse_options(command, {"--device"}, "with --save-slices or --interleave", "depth planes are rendered by the cpu");
  if (other_method)
    refuse_options(command, {"--filter", "--planes", "--focus"},
                   fmt::format("with --method {}", name_of(rendering.method)), "it works with --method layered");
  if (rendering.opaque && !makes_slices)
    refuse_options(command, {"--filter"}, "with --opaque", "it works on particles that add their light");
  if (!arguments.interleave.empty()) refuse_options(command, {"--annotate"}, "with --interleave", "it works on views");
  if (!arguments.centre.empty())
    refuse_options(command, {"--look-at"}, "with --centre", "the centre is what the views look at");
  if (!arguments.depth_mapping.empty())
    refuse_options(command, {"--near", "--far"}, "with --depth-mapping", "the mapping says where the depth ends");
}

}  // namespace

std::string name_of(Method method) {
  const auto* const found = std::ranges::find(methods, method, [](const auto& entry) { return entry.second; });
  return std::string(found->first);
}

QuiltLayout quilt_for(const std::string& text, int views) {
  const Size size = parse_size("--quilt", text, {1, 1000}, "COLUMNSxROWS");
  if (size.width * size.height != views)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--quilt: is '{}', expected as many places as there are views, {}", text, views));
  return {size.width, size.height};
}

void add_render_options(CLI::App& command, RenderArguments& arguments) {
  command
      .add_option(
          "FILE", arguments.file,
          "GADGET snapshot (HDF5 or binary), any HDF5, PLY, LAS, NumPy (.npy, .npz), FITS or text; or slices (.exr)")
      ->required();
  add_output_option(command, arguments.output, "Folder for the views; or the name of the quilt or picture");
  add_particle_options(command, arguments);
  add_appearance_options(command, arguments);
  add_view_options(command, arguments);
  add_method_options(command, arguments);
}

void refuse_options_without_effect(const CLI::App& command, const RenderArguments& arguments, bool input_is_slices) {
  if (input_is_slices) {
    refuse_for_slices(command);
  } else {
    refuse_for_particles(command, arguments);
  }
}

RenderArguments for_display(const RenderArguments& given, const CLI::App& command) {
  RenderArguments arguments = given;
  if (given.display.empty()) return arguments;
  const DisplayPreset& display = find_display(given.display);
  const auto unless_given = [&](const char* option, auto& value, const auto& preset) {
    if (!was_given(command, option)) value = preset;
  };
  RenderParticlesOptions& options = arguments.options;
  ViewingGeometry& viewing = options.depth.viewing;
  unless_given("--views", options.views, display.views);
  unless_given("--span", options.span, span_of(display, viewing.eye_separation_mm));
  unless_given("--size", arguments.size, fmt::format("{}x{}", display.view_width_px, display.view_height_px));
  unless_given("--distance", viewing.viewing_distance_mm, display.viewing_distance_mm);
  unless_given("--screen-width", viewing.screen_width_mm, display.screen_width_mm);
  const float depth_mm = usual_depth_mm(display.screen_width_mm);
  unless_given("--near", options.depth.near_mm, depth_mm);
  unless_given("--far", options.depth.far_mm, depth_mm);
  arguments.aspect = display.aspect;
  if (display.quilt_columns > 0 && given.interleave.empty())
    unless_given("--quilt", arguments.quilt, fmt::format("{}x{}", display.quilt_columns, display.quilt_rows));
  return arguments;
}

std::optional<Focus> focus_in(const RenderArguments& arguments, const Size& size) {
  if (arguments.focus.empty()) return {};
  const auto point = parse_numbers("--focus", arguments.focus, {',', 2, {0, 1}, "X,Y"});
  const auto width = static_cast<float>(size.width);
  return Focus{.x_px = static_cast<float>(point[0]) * width,
               .y_px = static_cast<float>(point[1]) * static_cast<float>(size.height),
               .radius_px = arguments.focus_radius * width,
               .gain = arguments.focus_gain};
}

RenderParticlesOptions render_options_from(const RenderArguments& arguments) {
  RenderParticlesOptions options = arguments.options;
  const std::string splat_text = arguments.splat.empty() ? "2,6" : arguments.splat;
  const auto splat = parse_numbers("--splat", splat_text, {',', 2, {0, SplatStyle::widest_px}, "MIN,MAX"});
  if (!(splat[0] > 0 && splat[0] <= splat[1]))
    throw Error(ErrorKind::wrong_usage, fmt::format("--splat: is '{}', expected MIN,MAX with 0 < MIN <= MAX <= {}",
                                                    splat_text, SplatStyle::widest_px));
  const Size size = parse_size("--size", arguments.size, view_side_range);
  options.width = size.width;
  options.height = size.height;
  options.appearance.smallest_px = static_cast<float>(splat[0]);
  options.appearance.largest_px = static_cast<float>(splat[1]);
  if (!arguments.centre.empty()) {
    const auto centre = parse_numbers("--centre", arguments.centre, {',', 3, coordinate_range, "X,Y,Z"});
    options.selection.centre = {centre[0], centre[1], centre[2]};
  }
  if (!arguments.look_at.empty()) {
    const auto point = parse_numbers("--look-at", arguments.look_at, {',', 3, coordinate_range, "X,Y,Z"});
    options.look_at = {point[0], point[1], point[2]};
  }
  if (!arguments.selection.empty())
    options.selection.cut = parse_region("--select", arguments.selection, "sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1");
  options.fit = parse_fit(arguments.fit);
  if (!arguments.depth_mapping.empty())
    options.depth.regions = parse_depth_regions(arguments.depth_mapping, "--depth-mapping");
  options.rendering.focus = focus_in(arguments, size);
  if (!arguments.cold.empty()) options.appearance.cold = parse_colour("--cold", arguments.cold);
  if (!arguments.hot.empty()) options.appearance.hot = parse_colour("--hot", arguments.hot);
  check_render_options(options);
  if (!option_of_thesis(arguments).empty()) options.appearance.look = Look::thesis;
  options.values = !arguments.values.empty();
  if (options.values) check_values_ending("--values", arguments.values);
  options.slices = !arguments.save_slices.empty() || !arguments.interleave.empty();
  options.without_views = !arguments.interleave.empty();
  return options;
}

}  // namespace wheatstone::cli
