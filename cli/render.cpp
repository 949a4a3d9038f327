#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "number_arguments.h"
#include "option_use.h"
#include "picture_format.h"
#include "print_facts.h"
#include "render_film.h"
#include "render_options.h"
#include "slices_argument.h"
#include "wheatstone/app/annotate.h"
#include "wheatstone/app/write_values.h"
#include "wheatstone/display/compose.h"
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

void check_screen(const LenticularScreen& screen, int width, int height) {
  if (screen.width != width || screen.height != height)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--interleave: the screen has {0}x{1} pixels, expected --size {0}x{1}", screen.width,
                            screen.height));
}

void write_interleaved(const RenderArguments& arguments, const RenderedParticles& result, const Progress& progress) {
  const LenticularScreen screen = find_lenticular(arguments.interleave);
  check_screen(screen, result.stack.width, result.stack.height);
  const int views = static_cast<int>(result.rig.positions.size());
  const InterleavedView interleaved = render_interleaved(
      result.stack, result.rig.positions,
      [&](int y, std::span<std::uint16_t> three) { views_of_row(screen, views, y, three); }, progress, result.focus);
  write_image(arguments.output, interleaved.picture);
}

ViewsOutput output_of(const RenderArguments& arguments) {
  return {arguments.output, {arguments.file, arguments.interleave}, arguments.format};
}

/// Writes the views and says where.
std::string write_views(const RenderArguments& arguments, const RenderedParticles& result, const Session& session) {
  if (!arguments.interleave.empty()) {
    write_interleaved(arguments, result, session.progress);
    return arguments.output;
  }
  const std::vector<Image<Rgb8>>& views = result.rendered.views;
  const Device device = arguments.options.rendering.device;
  if (!arguments.quilt.empty()) {
    const QuiltLayout layout = quilt_for(arguments.quilt, static_cast<int>(views.size()));
    return write_quilt(compose(views, layout, device), layout, arguments.aspect, output_of(arguments));
  }
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

/// What --verbose adds.
void tell_how(const RenderedParticles& result, const Session& session) {
  fmt::print(session.output, "method: {}\nplanes: {}\ndevice: {}\n", result.rendered.reason, result.rendered.planes,
             result.rendered.device);
  if (result.rendered.tone.look == Look::thesis) {
    fmt::print(session.output, "exposure: {:.4g}\n", result.rendered.exposure);
  } else {
    fmt::print(session.output, "shown: {} from {:.4g} to {:.4g} {}\n", result.units.name, result.least, result.most,
               result.units.value);
  }
}

const char* word_of(DensitySource source) {
  return source == DensitySource::file ? "file" : source == DensitySource::neighbours ? "neighbours" : "grid";
}

void tell(const RenderedParticles& result, const std::string& written, const Session& session) {
  if (session.json) {
    nlohmann::ordered_json facts{{"output", written},
                                 {"format", result.format},
                                 {"particles", result.particles},
                                 {"dropped", result.dropped},
                                 {"weightless", result.weightless},
                                 {"mended", result.mended},
                                 {"extreme", result.extreme},
                                 {"outside", result.outside},
                                 {"density_from", word_of(result.density)},
                                 {"views", result.rig.positions.size()},
                                 {"method", name_of(result.rendered.method)},
                                 {"reason", result.rendered.reason},
                                 {"device", result.rendered.device},
                                 {"planes", result.rendered.planes},
                                 {"ranks", session.ranks.count()},
                                 {"warnings", result.warnings}};
    if (result.rendered.tone.look == Look::thesis) {
      facts["exposure"] = result.rendered.exposure;
    } else {
      facts["least"] = result.least;
      facts["most"] = result.most;
      facts["unit"] = result.units.value;
    }
    print_facts(facts, session);
    return;
  }
  if (result.dropped > 0)
    fmt::print(session.output, "skipped: {} particles without a finite position\n", result.dropped);
  if (result.weightless > 0)
    fmt::print(session.output, "skipped: {} particles without a mass or without what is shown\n", result.weightless);
  if (result.mended > 0)
    fmt::print(session.output,
               "set to the smallest positive value: {} densities or temperatures that are not above 0\n",
               result.mended);
  if (result.extreme > 0)
    fmt::print(session.output,
               "set to the limits of single precision, 1.2e-38 and 3.4e38: {} densities or temperatures beyond them\n",
               result.extreme);
  if (result.outside > 0)
    fmt::print(session.output, "outside what the views are framed by (--fit): {} of {} particles\n", result.outside,
               result.particles);
  if (result.density == DensitySource::neighbours)
    fmt::print(session.output, "density: estimated from the neighbours of each particle\n");
  if (result.density == DensitySource::grid)
    fmt::print(session.output,
               "density: estimated from a grid of {} cells a side, because not all particles are held\n",
               DensityGrid::side);
  for (const std::string& warning : result.warnings) fmt::print(session.output, "note: {}\n", warning);
  if (session.verbose) tell_how(result, session);
  fmt::print(session.output, "written to {}\n", written);
}

/// What cannot be written or makes no sense is said before the long work.
void check_output(const RenderArguments& arguments, const RenderParticlesOptions& options, const CLI::App& command,
                  bool slices) {
  const ViewsOutput output = output_of(arguments);
  check_views_output(output);
  check_not_an_input(arguments.save_slices, output.inputs);
  check_not_an_input(arguments.values, output.inputs);
  check_distinct_outputs(std::array<NamedOutput, 3>{
      {{"--output", arguments.output}, {"--save-slices", arguments.save_slices}, {"--values", arguments.values}}});
  if (!arguments.interleave.empty()) {
    const LenticularScreen screen = find_lenticular(arguments.interleave);
    if (!slices) check_screen(screen, options.width, options.height);
    check_picture_ending("--output", arguments.output);
    return;
  }
  if (arguments.quilt.empty()) return;
  quilt_for(arguments.quilt, options.views);
  if (std::filesystem::path(arguments.output).has_extension()) check_picture_ending("--output", arguments.output);
  check_format_fits(command, output_of(arguments));
}

void run_render(const RenderArguments& given, const CLI::App& command, const Session& session) {
  const bool slices = std::filesystem::path(given.file).extension() == ".exr";
  refuse_options_without_effect(command, given, slices);
  const RenderArguments arguments = for_display(given, command);
  if (makes_film(command, arguments)) return run_render_film(arguments, command, session);
  refuse_film_options(command);
  RenderParticlesOptions options = render_options_from(arguments);
  options.rendering.ranks = session.ranks;
  check_output(arguments, options, command, slices);
  const bool only_first = slices && !session.ranks.first();  // slices are read and drawn in one place
  if (only_first) return session.ranks.meet();
  RenderedParticles result = slices ? render_slice_file(arguments.file, command, options, session.progress)
                                    : render_particles(arguments.file, options, session.progress);
  session.ranks.meet();
  if (!session.ranks.first()) return;
  if (arguments.annotate) annotate(result, result.rendered.views);
  tell(result, write_output(arguments, result, session), session);
}

}  // namespace

void add_render_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", "Render the views of a particle data set");
  add_render_options(*command, *arguments);
  add_render_film_options(*command, arguments->film);
  command->footer(
      "Views are written as view_000.png, the leftmost, and so on.\n\n"
      "Examples:\n"
      "  wheatstone synth universe -o universe.hdf5\n"
      "  wheatstone render universe.hdf5 --views 9 -o views\n"
      "  wheatstone render universe.hdf5 --display looking-glass-portrait -o universe\n"
      "  wheatstone render universe.hdf5 --save-slices slices.exr && wheatstone render slices.exr --views 45\n"
      "  wheatstone synth universe --particles 100000 --times 0.4,0.6,0.8 -o snap_%03d.hdf5\n"
      "  wheatstone render snap_%03d.hdf5 --frames 24 --orbit 90 -o film.mp4");
  command->callback([arguments, command, &session] { run_render(*arguments, *command, session); });
}

}  // namespace wheatstone::cli
