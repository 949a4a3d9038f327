#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "commands.h"
#include "render_arguments.h"
#include "render_film.h"
#include "slices_argument.h"
#include "wheatstone/app/annotate.h"
#include "wheatstone/app/render_model_file.h"
#include "wheatstone/app/write_values.h"
#include "wheatstone/display/compose.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/files/temporary_file.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/pictures/write_image.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

void check_screen(const LenticularScreen& screen, int width, int height) {
  if (screen.width != width || screen.height != height)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--interleave: the screen has {0}x{1} pixels, expected --size {0}x{1}", screen.width,
                            screen.height));
}

void write_interleaved(const RenderArguments& arguments, const RenderedParticles& result, const Progress& progress) {
  const LenticularScreen screen = find_lenticular(arguments.interleave);
  if (!result.rendered.views.empty()) {
    write_image(arguments.output, interleave(result.rendered.views, screen));
    return;
  }
  check_screen(screen, result.stack.width, result.stack.height);
  const int views = static_cast<int>(result.rig.positions.size());
  const InterleavedView interleaved = render_interleaved(
      result.stack, result.rig.positions,
      [&](int y, std::span<std::uint16_t> three) { views_of_row(screen, views, y, three); }, progress, result.focus);
  write_image(arguments.output, interleaved.picture);
}

ViewsOutput output_of(const RenderArguments& arguments) {
  return {arguments.output,
          {arguments.file, arguments.interleave, arguments.options.model.choice.texture},
          arguments.format};
}

/// Writes the views and says where.
std::string write_views(const RenderArguments& arguments, const RenderedParticles& result, const Session& session) {
  if (!arguments.interleave.empty()) {
    write_interleaved(arguments, result, session.progress);
    return arguments.output;
  }
  const std::vector<Image<Rgb8>>& views = result.rendered.views;
  const Device device = arguments.options.rendering.device;
  if (arguments.quilt)
    return write_quilt(compose(views, *arguments.quilt, device), *arguments.quilt, arguments.aspect,
                       output_of(arguments));
  if (!arguments.display.empty() && find_display(arguments.display).lenses.screen_width_px > 0)
    return write_lenticular(compose(views, find_lenticular(arguments.display), device), output_of(arguments));
  write_view_folder(views, output_of(arguments), session.progress);
  return arguments.output;
}

/// Writes the views as numbers: one under the name that was given, several under numbered ones.
void write_all_values(const RenderArguments& arguments, const RenderedParticles& result) {
  const std::filesystem::path name = arguments.values;
  const Scene& scene = result.scene;
  const ValueAxes axes{.name = result.units.name,
                       .unit = result.units.value,
                       .length_unit = result.units.length,
                       .camera = scene.camera,
                       .depth = scene.splat_style.size_depth};
  for (std::size_t v = 0; v < result.values.size(); ++v) {
    const ViewValues& of_view = result.values[v];
    std::filesystem::path file = name;
    if (result.values.size() > 1)
      file.replace_filename(fmt::format("{}_{:03}{}", name.stem().string(), v, name.extension().string()));
    write_values(file, of_view.mean.empty() ? of_view.column : of_view.mean, axes);
  }
}

/// Writes what was asked for: the slices get their name when the views have theirs. Says where the views are.
std::string write_output(const RenderArguments& arguments, const RenderedParticles& result, const Session& session) {
  write_all_values(arguments, result);
  if (arguments.save_slices.empty()) return write_views(arguments, result, session);
  TemporaryFile slices(arguments.save_slices);
  write_slices(slices, result.stack);
  std::string written = write_views(arguments, result, session);
  slices.commit();
  return written;
}

const char* word_of(DensitySource source) {
  return source == DensitySource::file ? "file" : source == DensitySource::neighbours ? "neighbours" : "grid";
}

std::string text_of(DensitySource source) {
  if (source == DensitySource::neighbours) return "density: estimated from the neighbours of each particle";
  if (source == DensitySource::file) return {};
  return fmt::format("density: estimated from a grid of {} cells a side, because not all particles are held",
                     DensityGrid::side);
}

/// What is told of a number of particles, where there are any.
std::string some(std::uint64_t count, const char* words) {
  return count > 0 ? fmt::format(fmt::runtime(words), count) : "";
}

Report report_of_model(const RenderedParticles& result, const std::string& written, const Session& session) {
  return {{{"output", written},
           {"format", result.format},
           {"triangles", result.triangles},
           {"degenerate", result.degenerate, some(result.degenerate, "left out: {} triangles without an area")},
           {"views", result.rig.positions.size()},
           {"method", name_of(result.rendered.method)},
           {"warnings", result.warnings, lines("note: ", result.warnings)},
           {"reason", result.rendered.reason, session.verbose ? fmt::format("method: {}", result.rendered.reason) : ""},
           only_text(fmt::format("written to {}", written))}};
}

Report report_of(const RenderedParticles& result, const std::string& written, const Session& session) {
  if (result.triangles > 0) return report_of_model(result, written, session);
  const RenderedViews& rendered = result.rendered;
  Report report{
      {{"output", written},
       {"format", result.format},
       {"particles", result.particles},
       {"unchosen", result.unchosen, some(result.unchosen, "left out by --where: {} particles")},
       {"dropped", result.dropped, some(result.dropped, "skipped: {} particles without a finite position")},
       {"weightless", result.weightless,
        some(result.weightless, "skipped: {} particles without a mass or without what is shown")},
       {"mended", result.mended,
        some(result.mended, "set to the smallest positive value: {} densities or temperatures that are not above 0")},
       {"extreme", result.extreme,
        some(result.extreme,
             "set to the limits of single precision, 1.2e-38 and 3.4e38: {} densities or temperatures beyond them")},
       {"outside", result.outside,
        result.outside > 0 ? fmt::format("outside what the views are framed by (--fit): {} of {} particles",
                                         result.outside, result.particles)
                           : ""},
       {"density_from", word_of(result.density), text_of(result.density)},
       {"views", result.rig.positions.size()},
       {"method", name_of(rendered.method)},
       {"ranks", session.ranks.count()},
       {"warnings", result.warnings, lines("note: ", result.warnings)},
       {"reason", rendered.reason, session.verbose ? fmt::format("method: {}", rendered.reason) : ""},
       {"planes", rendered.planes, session.verbose ? fmt::format("planes: {}", rendered.planes) : ""},
       {"device", rendered.device, session.verbose ? fmt::format("device: {}", rendered.device) : ""}}};
  const auto add = [&](Fact fact) { report.facts.push_back(std::move(fact)); };
  if (rendered.tone.look == Look::thesis) {
    add({"exposure", rendered.exposure, session.verbose ? fmt::format("exposure: {:.4g}", rendered.exposure) : ""});
  } else {
    add({"least", result.least,
         session.verbose ? fmt::format("shown: {} from {:.4g} to {:.4g} {}", result.units.name, result.least,
                                       result.most, result.units.value)
                         : ""});
    add({"most", result.most});
    add({"unit", result.units.value});
  }
  add(only_text(fmt::format("written to {}", written)));
  return report;
}

/// What cannot be written or makes no sense is said before the long work.
void check_output(const RenderArguments& arguments, const RenderParticlesOptions& options) {
  const ViewsOutput output = output_of(arguments);
  if (arguments.annotate) check_annotation(arguments.annotation, options.depth.viewing);
  check_views_output(output);
  check_not_an_input(arguments.save_slices, output.inputs);
  check_not_an_input(arguments.values, output.inputs);
  check_distinct_outputs(std::array<NamedOutput, 3>{
      {{"--output", arguments.output}, {"--save-slices", arguments.save_slices}, {"--values", arguments.values}}});
  if (!arguments.interleave.empty()) {
    const LenticularScreen screen = find_lenticular(arguments.interleave);
    if (!reads_slices(arguments)) check_screen(screen, options.width, options.height);
    check_picture_ending("--output", arguments.output);
    return;
  }
  if (!arguments.quilt) return;
  check_quilt(*arguments.quilt, options.views);
  if (std::filesystem::path(arguments.output).has_extension()) check_picture_ending("--output", arguments.output);
  check_format_fits(arguments.given, output_of(arguments));
}

Report run_render(const RenderArguments& given, const Session& session) {
  const RenderArguments arguments = for_display(given);
  if (makes_film(arguments)) return run_render_film(arguments, session);
  RenderParticlesOptions options = render_options_from(arguments);
  options.rendering.ranks = session.ranks;
  check_output(arguments, options);
  const bool slices = reads_slices(arguments);
  const bool model = reads_model(arguments);
  // Slices and models are read and drawn in one place.
  const bool only_first = (slices || model) && !session.ranks.first();
  if (only_first) {
    session.ranks.meet();
    return {};
  }
  RenderedParticles result = slices  ? render_slice_file(arguments.file, arguments.given, options, session.progress)
                             : model ? render_model_file(arguments.file, options, session.progress)
                                     : render_particles(arguments.file, options, session.progress);
  session.ranks.meet();
  if (!session.ranks.first()) return {};
  if (arguments.annotate)
    for (std::string& note : annotate(result, result.rendered.views, arguments.annotation))
      result.warnings.push_back(std::move(note));
  return report_of(result, write_output(arguments, result, session), session);
}

}  // namespace

Command render_command() {
  return make_command("render", "Render the views of a particle data set or of a model", render_rows, run_render,
                      R"(Views are written as view_000.png, the leftmost, and so on.

Examples:
  wheatstone synth universe -o universe.hdf5
  wheatstone render universe.hdf5 --views 9 -o views
  wheatstone render universe.hdf5 --display looking-glass-portrait -o universe
  wheatstone render universe.hdf5 --where 'Temperature > 1e5 and Density < 1e-7' -o hot
  wheatstone render universe.hdf5 --save-slices slices.exr && wheatstone render slices.exr --views 45
  wheatstone render model.glb --display looking-glass-portrait -o model
  wheatstone synth universe --particles 100000 --times 0.4,0.6,0.8 -o snap_%03d.hdf5
  wheatstone render snap_%03d.hdf5 --frames 24 --orbit 90 -o film.mp4)");
}

}  // namespace wheatstone::cli
