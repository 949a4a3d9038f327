#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "number_arguments.h"
#include "option_use.h"
#include "picture_format.h"
#include "print_facts.h"
#include "render_options.h"
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

/// The views of depth planes that were written before.
RenderedParticles from_slices(const RenderArguments& arguments, const CLI::App& command,
                              const RenderParticlesOptions& options, const Progress& progress) {
  RenderedParticles result;
  result.format = "slices";
  result.stack = read_slices(arguments.file);
  if (was_given(command, "--near") || was_given(command, "--far")) {
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
    result.warnings.push_back(
        fmt::format("the slices were made for a span of {} eye separations; with {} the sides of the views lack light",
                    result.stack.span, options.span));
  return result;
}

QuiltLayout quilt_for(const std::string& text, int views) {
  const Size size = parse_size("--quilt", text, {1, 1000}, "COLUMNSxROWS");
  if (size.width * size.height != views)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--quilt: is '{}', expected as many places as there are views, {}", text, views));
  return {size.width, size.height};
}

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
      [&](int y, std::span<std::uint16_t> three) { views_of_row(screen, views, y, three); }, progress);
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
  if (!arguments.quilt.empty()) {
    const QuiltLayout layout = quilt_for(arguments.quilt, static_cast<int>(views.size()));
    return write_quilt(views, layout, arguments.aspect, output_of(arguments));
  }
  if (!arguments.display.empty() && find_display(arguments.display).lenses.screen_width_px > 0)
    return write_lenticular(views, find_lenticular(arguments.display), output_of(arguments));
  write_view_folder(views, output_of(arguments), session.progress);
  return arguments.output;
}

/// Writes what was asked for: the slices get their name when the views have theirs. Says where the views are.
std::string write_output(const RenderArguments& arguments, const RenderedParticles& result, const Session& session) {
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
                                 {"extreme", result.extreme},
                                 {"outside", result.outside},
                                 {"density_estimated", result.density_estimated},
                                 {"views", result.rig.positions.size()},
                                 {"method", name_of(result.rendered.method)},
                                 {"reason", result.rendered.reason},
                                 {"planes", result.rendered.planes},
                                 {"exposure", result.rendered.exposure},
                                 {"warnings", result.warnings}};
    print_facts(facts, session);
    return;
  }
  if (result.dropped > 0)
    fmt::print(session.output, "skipped: {} particles without a finite position\n", result.dropped);
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
  if (result.density_estimated) fmt::print(session.output, "density: estimated from the neighbours of each particle\n");
  for (const std::string& warning : result.warnings) fmt::print(session.output, "note: {}\n", warning);
  if (session.verbose)
    fmt::print(session.output, "method: {}\nplanes: {}\nexposure: {:.4g}\n", result.rendered.reason,
               result.rendered.planes, result.rendered.exposure);
  fmt::print(session.output, "written to {}\n", written);
}

/// What cannot be written or makes no sense is said before the long work.
void check_output(const RenderArguments& arguments, const RenderParticlesOptions& options, const CLI::App& command,
                  bool slices) {
  const ViewsOutput output = output_of(arguments);
  check_views_output(output);
  check_not_an_input(arguments.save_slices, output.inputs);
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

void run(const RenderArguments& given, const CLI::App& command, const Session& session) {
  const bool slices = std::filesystem::path(given.file).extension() == ".exr";
  refuse_options_without_effect(command, given, slices);
  const RenderArguments arguments = for_display(given, command);
  const RenderParticlesOptions options = render_options_from(arguments);
  check_output(arguments, options, command, slices);
  const RenderedParticles result = slices ? from_slices(arguments, command, options, session.progress)
                                          : render_particles(arguments.file, options, session.progress);
  tell(result, write_output(arguments, result, session), session);
}

}  // namespace

void add_render_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", "Render the views of a particle data set");
  add_render_options(*command, *arguments);
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
