#include "render_arguments.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "device_option.h"
#include "display_argument.h"
#include "film_argument.h"
#include "wheatstone/app/render_limits.h"
#include "wheatstone/app/write_values.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/video/frame_sequence.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

constexpr std::array<Choice<Method>, 4> methods{{{name_of(Method::automatic), Method::automatic},
                                                 {name_of(Method::exact), Method::exact},
                                                 {name_of(Method::incremental), Method::incremental},
                                                 {name_of(Method::layered), Method::layered}}};
constexpr std::array<Choice<SliceFilter>, 3> filters{
    {{"nearest", SliceFilter::nearest}, {"linear", SliceFilter::linear}, {"centroid", SliceFilter::centroid}}};
constexpr std::array<Choice<Look>, 2> looks{{{"mass", Look::mass}, {"thesis", Look::thesis}}};
constexpr std::array<Choice<Blend>, 2> blends{{{"add", Blend::add}, {"over", Blend::over}}};
constexpr std::array<Choice<Kernel>, 2> kernels{
    {{"gaussian", Kernel::gaussian}, {"cubic-spline", Kernel::cubic_spline}}};
constexpr std::array<Choice<Stretch>, 3> stretches{
    {{"asinh", Stretch::asinh}, {"log", Stretch::log}, {"linear", Stretch::linear}}};
constexpr NumberRange annotation_range_mm{-1e4, 1e5};
constexpr std::array<Choice<bool>, 2> projections{{{"perspective", false}, {"orthographic", true}}};
constexpr std::array<Choice<SizeRule>, 5> size_rules{{{"auto", SizeRule::automatic},
                                                      {"density", SizeRule::density},
                                                      {"denser-smaller", SizeRule::denser_smaller},
                                                      {"denser-larger", SizeRule::denser_larger},
                                                      {"smoothing-length", SizeRule::smoothing_length}}};
constexpr std::array<Choice<Distribution>, 2> distributions{
    {{"particles", Distribution::particles}, {"frames", Distribution::frames}}};

constexpr auto method_heading = "Method and output";

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
Fit parse_fit(const std::string& option, const std::string& text) {
  constexpr std::string_view expected = "auto, all, 99.9%, sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1";
  if (text == "auto") return {};
  if (text == "all") return FitAll{};
  if (text.ends_with('%'))
    return FitShare{parse_numbers(option, text.substr(0, text.size() - 1), {',', 1, {1, 100}, expected})[0] / 100};
  const Cut region = parse_region(option, text, expected);
  if (const Sphere* sphere = std::get_if<Sphere>(&region)) return *sphere;
  return std::get<Box>(region);
}

Value selected_region(Cut& cut) {
  return parsed(cut, [](const std::string& option, const std::string& words) {
    return parse_region(option, words, "sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1");
  });
}

Value point(std::optional<std::array<double, 3>>& place) {
  return parsed(place, [](const std::string& option, const std::string& words) {
    const auto n = parse_numbers(option, words, {',', 3, coordinate_range, "X,Y,Z"});
    return std::array<double, 3>{n[0], n[1], n[2]};
  });
}

Value point_of_screen(std::optional<std::array<double, 2>>& place) {
  return parsed(place, [](const std::string& option, const std::string& words) {
    const auto n = parse_numbers(option, words, {',', 2, {0, 1}, "X,Y"});
    return std::array<double, 2>{n[0], n[1]};
  });
}

Value splat_sizes(Appearance& appearance) {
  return {[&appearance](const std::string& option, const std::vector<std::string>& words) {
    const auto n = parse_numbers(option, words.front(), {',', 2, {0, SplatStyle::widest_px}, "MIN,MAX"});
    if (!(n[0] > 0 && n[0] <= n[1]))
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected MIN,MAX with 0 < MIN <= MAX <= {}", option,
                                                      words.front(), SplatStyle::widest_px));
    appearance.smallest_px = static_cast<float>(n[0]);
    appearance.largest_px = static_cast<float>(n[1]);
  }};
}

bool is_without_planes(const RenderArguments& a) {
  return a.options.rendering.method == Method::exact || a.options.rendering.method == Method::incremental;
}

bool is_sized_by_rank(const RenderArguments& a) {
  const SizeRule rule = a.options.appearance.size_rule;
  return rule == SizeRule::denser_smaller || rule == SizeRule::denser_larger;
}

/// Whether a frame is put together of many views.
bool is_composed(const RenderArguments& a) {
  if (a.quilt || !a.interleave.empty()) return true;
  if (a.display.empty()) return false;
  const DisplayPreset& display = find_display(a.display);
  return display.quilt_columns > 0 || display.lenses.screen_width_px > 0;
}

Reason on_slices(const RenderArguments& a) {
  return when([&a] { return reads_slices(a); }, "on slices (.exr); it works on particles and models");
}

Reason on_model(const RenderArguments& a) {
  return when([&a] { return reads_model(a); }, "on a model of triangles; it works on particles");
}

/// Of an option that works on particles only.
Reason beside_particles(const RenderArguments& a) {
  return [&a] {
    return reads_slices(a)  ? "on slices (.exr); it works on particles"
           : reads_model(a) ? "on a model of triangles; it works on particles"
                            : "";
  };
}

Reason beside_models(const RenderArguments& a) {
  return when([&a] { return !reads_model(a); }, "on what is no model; it works on models of triangles");
}

Reason on_film(const RenderArguments& a) {
  return when([&a] { return makes_film(a); }, "on a film; it works on pictures");
}

/// What an option that gives particles the thesis's look rules out.
Reason with_thesis(const RenderArguments& a, const char* where) {
  return [&a, where] {
    const std::string option = option_of_thesis(a);
    return option.empty() ? "" : fmt::format("with {}; {}", option, where);
  };
}

Reason with_look_thesis(const RenderArguments& a) {
  return [&a] {
    const std::string option = option_of_thesis(a).empty() ? "--look thesis" : option_of_thesis(a);
    return is_thesis(a) ? fmt::format("with {}; it works with --look mass", option) : "";
  };
}

Reason without_planes(const RenderArguments& a) {
  return [&a] {
    return is_without_planes(a)
               ? fmt::format("with --method {}; it works with --method layered", name_of(a.options.rendering.method))
               : "";
  };
}

Rows particle_rows(RenderArguments& a) {
  CloudChoice& choice = a.options.choice;
  return under(
      "Particles",
      {row("--type", text(choice.type),
           "Particle type of a GADGET snapshot: gas, halo, disk, bulge, stars, bndry or 0 to 5; gas by default"),
       row("--type-colours",
           parsed(
               choice.type_colours,
               [](const std::string& option, const std::string& words) { return parse_type_colours(words, option); },
               "TYPE=COLOUR,..."),
           "Draw several types of a GADGET snapshot, each in a colour of its own: gas=FFB347:6,halo=3B5BDB; a number "
           "multiplies the light that a type's mass gives",
           {when([&a] { return !a.options.quantity.empty(); },
                 "with --quantity; the colours are those of numbers, not of types")},
           {}, {"--type"}),
       row("--position", text(choice.position), "Dataset or columns of the positions: /Coordinates, or x,y,z"),
       row("--density", text(choice.density), "Dataset or column of the density"),
       row("--temperature", text(choice.temperature), "Dataset or column of the temperature, which sets the colours"),
       row("--smoothing-length", text(choice.smoothing_length), "Dataset or column of the smoothing length"),
       row("--mass", text(choice.mass), "Dataset or column of the mass; each particle counts 1 where there is none"),
       row("--centre", point(a.options.selection.centre),
           "Point X,Y,Z of a periodic box that is moved to the middle of the views"),
       row("--select", selected_region(a.options.selection.cut),
           "Keep the particles in sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1 only"),
       row("--where", parsed(choice.where, parse_where, "CONDITION"),
           "Keep the particles for which a condition holds, as 'Temperature > 1e6 and Density < 1e-3': quantities by "
           "the names that info tells, numbers in the file's own units, < <= > >= == !=, and, or, not, parentheses"),
       row("--subsample", number(a.options.selection.every, every_range), "Keep every Nth particle"),
       row("--neighbours", number(a.options.neighbours, neighbours_range),
           "Particles in a kernel, from which the density is estimated where the file has none"),
       row("--stream", flag(a.options.stream), "Read the file twice, in chunks: memory does not grow with the file"),
       row("--chunk", number(a.options.chunk, {1000, 1 << 30}), "Particles per chunk with --stream", {}, "--stream")},
      {beside_particles(a)});
}

Value picture_file(std::filesystem::path& file) { return of_type("FILE", text(file)); }

Rows model_rows(RenderArguments& a) {
  ModelOptions& model = a.options.model;
  constexpr static std::array<Choice<UpAxis>, 3> axes{
      {{"auto", UpAxis::by_format}, {"y", UpAxis::y}, {"z", UpAxis::z}}};
  constexpr static std::array<Choice<int>, 2> sample_counts{{{"4", 4}, {"8", 8}}};
  const Reason others = beside_models(a);
  return under(
      "Models",
      {row("--up", choice(model.choice.up, axes),
           "Axis of the model that is up; auto: y in OBJ and glTF, z in PLY and STL", {others}),
       row("--crease", number(model.choice.crease_deg, crease_range_deg),
           "Where a model has no normals, triangles that meet at a larger angle, in degrees, have an edge "
           "between them",
           {others}),
       row("--texture", picture_file(model.choice.texture), "Picture for a model that names none", {others}),
       row("!--no-textures", flag(model.choice.textures), "Leave textures out", {others}, {}, {"--texture"}),
       row("--background", parsed(model.background, parse_colour, "COLOUR", "#3a3e44"), "Colour around a model",
           {others}),
       row("--samples", choice(model.samples, sample_counts), "Samples of a pixel, against jagged edges", {others}),
       row("--points", flag(a.points), "Draw the vertices of a PLY file as particles, without its faces")});
}

/// The thesis's appearance and that of mass have options of their own.
Reason with_look_mass(const RenderArguments& a) {
  return when([&a] { return !reads_slices(a) && !is_thesis(a); }, "with --look mass; it works with --look thesis");
}

Rows look_rows(RenderArguments& a) {
  Appearance& appearance = a.options.appearance;
  const Reason mass = with_look_mass(a);
  const Reason thesis = with_look_thesis(a);
  const Reason mass_by_size =
      when([&a] { return !is_thesis(a) && !is_sized_by_rank(a); },
           "with --look mass; it works with --look thesis, or with --size-rule denser-smaller or denser-larger");
  const Reason slices = beside_particles(a);
  return {
      row("--look", choice(appearance.look, looks),
          "What is shown: mass, whose column density is the brightness; or the light of Hassaine's thesis",
          {slices,
           [&a] {
             return a.options.appearance.look == Look::mass
                        ? with_thesis(a, "such particles are drawn in --look thesis")()
                        : "";
           }}),
      row("--quantity", text(a.options.quantity),
          "Show numbers in the colours of a map: column-density, or the mean of temperature, density, velocity-x or "
          "any dataset or column along each line of sight, weighted by mass",
          {slices, thesis}),
      row("--stretch", choice(a.options.rendering.tone.stretch, stretches),
          "How numbers between --least and --most become brightness", {slices, thesis}),
      row("--least", number(a.options.least, coordinate_range),
          "Column density, or quantity, where brightness begins; 0 or the 1st percentile by default", {slices, thesis}),
      row("--most", number(a.options.most, coordinate_range),
          "Column density, or quantity, where brightness ends; the 99.9th percentile by default", {slices, thesis}),
      row("--kernel", choice(appearance.kernel, kernels), "How a particle's mass is spread", {slices, thesis}),
      row("--splat", splat_sizes(appearance),
          "Smallest and largest splat diameter in pixels: MIN,MAX; 2,6 by default. The largest counts for the size "
          "rules denser-smaller and denser-larger",
          {slices}),
      row("--size-rule", choice(appearance.size_rule, size_rules), "What sets the size of a splat", {slices}),
      row("--opacity", number(appearance.opacity, opacity_range), "Opacity of the densest particles", {slices, mass}),
      row("--least-opacity", number(appearance.least_opacity, least_opacity_range),
          "Opacity of the least dense particles, as a fraction of --opacity", {slices, mass}),
      row("--density-slope", number(appearance.density_slope, density_slope_range),
          "Slope of the sigmoid that turns density into opacity, per factor of ten in density", {slices, mass_by_size}),
      row("--density-shift", number(appearance.density_shift, density_shift_range),
          "Centre of that sigmoid, in factors of ten above the median density", {slices, mass_by_size})};
}

Rows colour_rows(RenderArguments& a) {
  Appearance& appearance = a.options.appearance;
  const Reason types = when([&a] { return !a.options.choice.type_colours.empty(); },
                            "with --type-colours; each type has a colour of its own");
  const Reasons reasons{beside_particles(a), types,
                        when([&a] { return !a.options.quantity.empty(); },
                             "with --quantity; the colours are those of --colours between --least and --most")};
  return {
      row("--colours", text(appearance.colour_map),
          "Colour map: inferno, magma, plasma, viridis, cividis, turbo, twilight, hot, jet, bone",
          {beside_particles(a), types}),
      row("--cold", parsed(appearance.cold, parse_colour), "Colour of the coldest particles", reasons, {},
          {"--colours"}),
      row("--hot", parsed(appearance.hot, parse_colour), "Colour of the hottest particles", reasons, {}, {"--colours"}),
      row("--coldest", number(appearance.coldest, coordinate_range),
          "Temperature where the colours begin; 2nd percentile by default", reasons),
      row("--hottest", number(appearance.hottest, coordinate_range),
          "Temperature where they end; 98th percentile by default", reasons),
      row("!--linear-colours", flag(appearance.logarithmic), "Map the temperature to colours linearly", reasons)};
}

Rows light_rows(RenderArguments& a) {
  Appearance& appearance = a.options.appearance;
  const Reason mass = with_look_mass(a), slices = beside_particles(a);
  return {row("--exposure", number(a.options.rendering.exposure, exposure_range),
              "Factor on the light before tone mapping; from the central view by default", {mass, on_model(a)}),
          row("--blend", choice(appearance.blend, blends),
              "How particles that lie behind each other come together: their light is added, or the nearer ones also "
              "absorb light, so that they are in front",
              {slices, mass,
               when([&a] { return a.options.rendering.opaque; },
                    "with --opaque; it works on particles that are seen through")}),
          row("--shine", number(appearance.shine, shine_range),
              "Light of highlights on the surfaces of clumps, which move from view to view, as a multiple of the "
              "particles' own; or on a model's surfaces, of the lamp's",
              {on_slices(a), with_thesis(a, "it works on particles that add their light"),
               when([&a] { return !a.options.quantity.empty(); },
                    "with --quantity; it works on pictures, not on numbers")}),
          row("--opaque", flag(a.options.rendering.opaque),
              "Draw opaque particles: the nearest hides the others, instead of adding their light", {slices})};
}

Rows camera_rows(RenderArguments& a) {
  Framing& framing = a.options.framing;
  return under(
      {},
      {row("--look-at", point(a.options.look_at),
           "Point X,Y,Z in the middle of the views, around which the camera turns; that of all particles by default",
           {when([&a] { return a.options.selection.centre.has_value(); },
                 "with --centre; the centre is what the views look at")}),
       row("--fit", parsed(a.options.fit, parse_fit, {}, "auto"),
           "What the views show and the depth is mapped to: all particles; the middle share of them along each axis, "
           "as 99.9%; sphere:X,Y,Z,R or box:X0,Y0,Z0,X1,Y1,Z1; auto: all, but for a few that lie far out",
           {on_model(a)}),
       row("--azimuth", number(framing.azimuth_deg, {-360, 360}), "Direction that the camera looks from, in degrees"),
       row("--elevation", number(framing.elevation_deg, elevation_range),
           "Height of the camera above the horizon, in degrees"),
       row("--fov", number(framing.field_of_view_deg, field_of_view_range), "Horizontal field of view, in degrees"),
       row("--zoom", number(framing.zoom, zoom_range), "Magnification: 2 shows half as much; 1 by default on a model"),
       row("--projection", choice(framing.orthographic, projections),
           "Perspective, or orthographic: everything is as large as at the point that is looked at, and the views are "
           "sheared")},
      {on_slices(a)});
}

Rows depth_mapping_rows(RenderArguments& a) {
  PerceivedDepth& depth = a.options.depth;
  const Reason mapped = when([&a] { return !a.options.depth.regions.empty(); },
                             "with --depth-mapping; the mapping says where the depth ends");
  const Reason kept = when(
      [&a] { return reads_slices(a) && !a.given("--near") && !a.given("--far") && a.options.depth.regions.empty(); },
      "on slices (.exr) whose depth stays as it is; it works with --near, --far or --depth-mapping");
  return {row("--near", length(depth.near_mm, near_range_mm), "Depth in front of the screen, in mm", {mapped}),
          row("--far", length(depth.far_mm, far_range_mm), "Depth behind the screen, in mm", {mapped}),
          row("--eye", length(depth.viewing.eye_separation_mm, eye_range_mm),
              "Eye separation, or the width of a viewing window, in mm", {kept}),
          row("--distance", length(depth.viewing.viewing_distance_mm, distance_range_mm), "Viewing distance, in mm",
              {kept}),
          row("--screen-width", length(depth.viewing.screen_width_mm, screen_width_range_mm),
              "Width of the screen, in mm", {kept}),
          row("--depth-mapping", depth_regions(depth.regions),
              "Depth mapping by regions: SHARE:MM,... where SHARE is 0 for the nearest and 1 for the farthest "
              "particle or slice, and MM is the depth behind the screen"),
          row("--focus", point_of_screen(a.focus),
              "Point X,Y of the screen around which there is more depth than elsewhere, as shares of its width and "
              "height from the upper left: 0.5,0.5 is the middle",
              {without_planes(a), on_model(a)}),
          row("--focus-radius", number(a.focus_radius, {0.001, 10}), "Radius of that area, as a share of the width", {},
              "--focus"),
          row("--focus-gain", number(a.focus_gain, {0, 10}), "Factor on the depth at that point", {}, "--focus"),
          row("--smooth-depth", flag(depth.smooth), "Interpolate the depth mapping with a smooth monotone curve",
              {on_slices(a)}, "--depth-mapping")};
}

Rows view_rows(RenderArguments& a) {
  const Rows views{row("--display", text(a.display),
                       "Set views, span, size, distance, depth and quilt for a display:" + display_names()),
                   row("--views", number(a.options.views, view_count_range), "Number of views"),
                   row("--span", number(a.options.span, view_span_range),
                       "Distance from the first view to the last, in eye separations"),
                   row("--size", size(a.size, view_side_range), "Size of a view: WIDTHxHEIGHT", {on_slices(a)})};
  return under("Views and depth", join({views, camera_rows(a), depth_mapping_rows(a)}));
}

Rows method_rows(RenderArguments& a) {
  RenderOptions& rendering = a.options.rendering;
  const Reason slices = on_slices(a);
  return under(
      method_heading,
      {row("--annotate", flag(a.annotate),
           "Draw a scale bar, the colours with their numbers and units, and the redshift, or the time, into each view",
           {beside_particles(a), when([&a] { return !a.interleave.empty(); }, "with --interleave; it works on views")}),
       row("--title", text(a.annotation.title), "Title at the top of each view", {}, "--annotate"),
       row("--annotation-depth", length(a.annotation.behind_mm, annotation_range_mm),
           "Depth of what --annotate draws: mm behind the screen, in front of it where negative", {}, "--annotate"),
       row("--method", choice(rendering.method, methods), "Rendering method; --verbose tells which was used",
           {slices, when([&a] { return makes_slices(a) && is_without_planes(a) && !reads_model(a); },
                         "with --save-slices or --interleave; these render depth planes")}),
       device_row(
           rendering.device, "What renders",
           {slices, when([&a] { return reads_model(a); }, "on a model, which the cpu renders; it works on particles"),
            when([&a] { return makes_slices(a); },
                 "with --save-slices or --interleave; depth planes are rendered by the cpu")}),
       row("--filter", choice(rendering.filter, filters), "Depth-plane filter of the layered method",
           {on_model(a), without_planes(a),
            when([&a] { return a.options.rendering.opaque && !makes_slices(a); },
                 "with --opaque; it works on particles that add their light")}),
       row("--planes", without_default(number(rendering.planes, {1, planes_range.most})),
           "Number of depth planes; one per pixel of parallax by default", {beside_particles(a), without_planes(a)}),
       row("--quilt", quilt_layout(a.quilt), "Write one quilt of COLUMNSxROWS views"),
       row("--interleave", text(a.interleave),
           "Write one picture for a lenticular screen: its name, or a calibration (.json)", {}, {}, {"--quilt"}),
       row("--values", output_name(a.values),
           "Also write the views as numbers with their units, of a model its depth: FILE.fits, .exr or .npy; of "
           "several "
           "views, FILE_000.fits and so on",
           {slices, on_film(a), with_look_thesis(a),
            when(
                [&a] {
                  return std::ranges::any_of(a.options.choice.type_colours,
                                             [](const TypeColour& type) { return type.light != 1; });
                },
                "with --type-colours that multiply light; the values are sums of mass")}),
       row("--save-slices", output_name(a.save_slices), "Also write the depth planes: FILE.exr", {on_model(a)}),
       row("--format", picture_format(a.format), "File format of the views or the quilt", {on_film(a)}, {},
           {"--interleave"})});
}

Rows film_rows(RenderArguments& a) {
  RenderFilmArguments& film = a.film;
  const Reason camera = when([&a] { return reads_slices(a); }, "on slices (.exr); the camera stays where it was");
  const Rows moving = motion_rows(film.motion,
                                  "Number of frames of a film, from the first snapshot of a series (snap_%03d.hdf5) to "
                                  "the last; one a snapshot by default",
                                  {camera});
  const Rows shown{
      row("--rate", parsed(film.rate, parse_frame_rate, {}, "24"), "Frames per second, for example 25 or 24000/1001"),
      row("--output-layout", film_layout(film.output_layout),
          "Stereo layout of a film of two views; side by side by default",
          {when([&a] { return is_composed(a); }, "with many views; it works with two")})};
  const Rows frames{
      row("--frame-range", text(film.frame_range),
          "Make these of the frames only, as numbered pictures (frame_%04d.png): 1-240x2,300"),
      row("--distribute", choice(film.distribute, distributions),
          "What the processes of mpirun share: the particles of each frame, or whole frames"),
      row("--skip-existing", flag(film.skip_existing), "Leave numbered pictures alone that are there already")};
  return under(
      "Film",
      join({moving, shown, film_coding_rows(film.writing), film_resume_rows(film.resume, film.checkpoint), frames}),
      {when([&a] { return !makes_film(a); },
            "on one moment of one snapshot; it works on films: --frames, or a series")});
}

}  // namespace

Rows render_rows(RenderArguments& a) {
  const Rows basic{
      row("FILE", required(text(a.file)),
          "GADGET snapshot (HDF5 or binary), any HDF5, PLY, LAS, NumPy (.npy, .npz), FITS or text; model (OBJ, PLY "
          "with faces, "
          "STL, glTF); or slices (.exr)"),
      row("-o,--output", output_name(a.output), "Folder for the views; or the name of the quilt or picture")};
  return join({basic, particle_rows(a), model_rows(a),
               under("Appearance", join({look_rows(a), colour_rows(a), light_rows(a)})), method_rows(a), view_rows(a),
               film_rows(a)});
}

}  // namespace wheatstone::cli
