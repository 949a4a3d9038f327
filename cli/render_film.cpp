#include "render_film.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "display_argument.h"
#include "film_argument.h"
#include "number_arguments.h"
#include "option_use.h"
#include "print_facts.h"
#include "slices_argument.h"
#include "typed_options.h"
#include "wheatstone/app/particle_frames.h"
#include "wheatstone/app/render_film.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/error.h"
#include "wheatstone/files/input_guard.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto film_group = "Film";
constexpr std::array<std::pair<std::string_view, Distribution>, 2> distributions{
    {{"particles", Distribution::particles}, {"frames", Distribution::frames}}};

bool reads_slices(const RenderArguments& arguments) { return fs::path(arguments.file).extension() == ".exr"; }

/// What a frame becomes, and the name of the film.
void choose_output(RenderArguments& arguments, const RenderParticlesOptions& options, const CLI::App& command,
                   RenderFilmOptions& film) {
  if (!arguments.quilt.empty()) {
    film.quilt = quilt_for(arguments.quilt, options.views);
  } else if (!arguments.interleave.empty()) {
    film.screen = find_lenticular(arguments.interleave);
  } else if (!arguments.display.empty() && find_display(arguments.display).lenses.screen_width_px > 0) {
    film.screen = find_lenticular(arguments.display);
  }
  const bool two_eyes = !film.quilt && !film.screen;
  if (two_eyes && options.views > 2)
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("a film of {} views needs --quilt or --interleave, or a --display that has one", options.views));
  if (!two_eyes) refuse_options(command, {"--output-layout"}, "with many views", "it works with two");
  if (two_eyes && options.views == 2)
    film.writing.layout =
        film_layout_option("--output-layout", arguments.film.output_layout).value_or(StereoLayout::left_right);
  if (!was_given(command, "--output")) arguments.output = "film";
  const double aspect = arguments.aspect > 0 ? arguments.aspect : static_cast<double>(options.width) / options.height;
  arguments.output = name_of_film(arguments.output, film.quilt, aspect);
  if (two_eyes) return;
  const FilmDisplay display{
      .views = {.width = options.width, .height = options.height}, .quilt = film.quilt, .screen = film.screen};
  choose_coding(command, display, film.writing);
}

/// All that was typed or is a default and decides what is in the frames.
std::string recipe_of(const CLI::App& command) {
  std::istringstream lines(command.config_to_str(true, false));
  std::string recipe = fmt::format("wheatstone {}\n", WHEATSTONE_VERSION);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("output=") && !line.starts_with("resume=") && !line.starts_with("checkpoint=") &&
        !line.starts_with("distribute="))
      recipe += line + "\n";
  return recipe;
}

/// The frames, each of its own file of slices. Gives their number where none was asked for.
FrameSource frames_of_slices(const RenderArguments& arguments, const CLI::App& command,
                             const RenderParticlesOptions& options, int& count) {
  const std::optional<FramePattern> pattern = frame_pattern(arguments.file);
  if (!pattern)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: is one file of slices, expected a pattern as slices_%04d.exr", arguments.file));
  refuse_options(command, {"--orbit", "--camera", "--frames"}, "on slices (.exr)", "the camera stays where it was");
  const std::vector<std::int64_t> numbers = numbers_without_hole(*pattern);
  count = static_cast<int>(numbers.size());
  return [pattern = *pattern, first = numbers.front(), &command, options](int frame, const Progress& progress) {
    return render_slice_file(pattern.file(first + frame), command, options, progress);
  };
}

FrameSource frames_of_particles(const RenderArguments& arguments, const RenderParticlesOptions& options, int& count,
                                const Progress& progress) {
  ParticleFramesOptions wanted{
      .particles = options, .count = arguments.film.frames, .orbit_deg = arguments.film.orbit_deg};
  if (!arguments.film.camera.empty()) wanted.path = read_camera_path(arguments.film.camera);
  const auto frames = std::make_shared<ParticleFrames>(arguments.file, wanted, progress);
  count = frames->count();
  return [frames](int frame, const Progress& of_frame) { return frames->frame(frame, of_frame); };
}

void tell(const RenderArguments& arguments, const RenderedFilm& film, const Session& session) {
  if (session.json) {
    print_facts({{"output", arguments.output},
                 {"frames", film.frames},
                 {"resumed_frames", film.resumed_frames},
                 {"skipped_frames", film.skipped_frames},
                 {"particles", film.last.particles},
                 {"views", film.last.rig.positions.size()},
                 {"method", name_of(film.last.rendered.method)},
                 {"reason", film.last.rendered.reason},
                 {"least", film.last.least},
                 {"most", film.last.most},
                 {"ranks", session.ranks.count()},
                 {"notes", film.notes}},
                session);
    return;
  }
  fmt::print(session.output, "rendered         {} frames", film.frames);
  if (film.resumed_frames > 0) fmt::print(session.output, ", the first {} by an earlier run", film.resumed_frames);
  if (film.skipped_frames > 0) fmt::print(session.output, ", of which {} were there", film.skipped_frames);
  fmt::print(session.output, "\n");
  if (session.verbose && film.last.particles > 0)
    fmt::print(session.output, "method           {}\n", film.last.rendered.reason);
  for (const std::string& note : film.notes) fmt::print(session.output, "note             {}\n", note);
  fmt::print(session.output, "written to       {}\n", arguments.output);
}

}  // namespace

void add_render_film_options(CLI::App& command, RenderFilmArguments& arguments) {
  const auto text = [&](const char* name, std::string& value, const char* help) {
    return command.add_option(name, value, help)->group(film_group);
  };
  add_number(command, "--frames", arguments.frames, {1, 10'000'000},
             "Number of frames of a film, from the first snapshot of a series (snap_%03d.hdf5) to the last; one a "
             "snapshot by default")
      ->default_str("")
      ->group(film_group);
  add_number(command, "--orbit", arguments.orbit_deg, {-36'000, 36'000},
             "Degrees that the camera turns around the middle of the views during the film")
      ->default_str("")
      ->group(film_group);
  text("--camera", arguments.camera, "Keyframes of the camera and of time: FILE.toml");
  text("--rate", arguments.rate, "Frames per second, for example 25 or 24000/1001")->capture_default_str();
  text("--output-layout", arguments.output_layout, "Stereo layout of a film of two views; side by side by default");
  add_film_coding_options(command, arguments.writing, film_group);
  add_film_resume_options(command, arguments.resume, arguments.checkpoint, film_group);
  text("--frame-range", arguments.frame_range,
       "Make these of the frames only, as numbered pictures (frame_%04d.png): 1-240x2,300");
  add_choice<Distribution>(command, "--distribute", arguments.distribute, distributions,
                           "What the processes of mpirun share: the particles of each frame, or whole frames")
      ->group(film_group);
  command.add_flag("--skip-existing", arguments.skip_existing, "Leave numbered pictures alone that are there already")
      ->group(film_group);
}

bool makes_film(const CLI::App& command, const RenderArguments& arguments) {
  return frame_pattern(arguments.file) || was_given(command, "--frames") || was_given(command, "--orbit") ||
         was_given(command, "--camera");
}

void refuse_film_options(const CLI::App& command) {
  refuse_group(command, film_group, {}, "on one moment of one snapshot", "it works on films: --frames, or a series");
}

void run_render_film(const RenderArguments& given, const CLI::App& command, const Session& session) {
  RenderArguments arguments = given;
  RenderParticlesOptions options = render_options_from(arguments);
  options.slices = !arguments.save_slices.empty();
  options.without_views = false;
  refuse_options(command, {"--format", "--values", "--annotate"}, "on a film", "it works on pictures");
  if (!arguments.save_slices.empty() && !frame_pattern(arguments.save_slices))
    throw Error(ErrorKind::wrong_usage, fmt::format("--save-slices: is '{}', expected a name with a number for the "
                                                    "frames of a film, as slices_%04d.exr",
                                                    arguments.save_slices));
  RenderFilmOptions film{.writing = arguments.film.writing,
                         .slices = arguments.save_slices,
                         .frames_between_checkpoints = arguments.film.checkpoint,
                         .resume = arguments.film.resume,
                         .made_by = recipe_of(command),
                         .made_from = {arguments.file},
                         .skip_existing = arguments.film.skip_existing};
  if (!arguments.film.camera.empty()) film.made_from.emplace_back(arguments.film.camera);
  choose_output(arguments, options, command, film);
  check_not_an_input(arguments.output, film.made_from);
  check_distinct_outputs(
      std::array<NamedOutput, 2>{{{"--output", arguments.output}, {"--save-slices", arguments.save_slices}}});
  film.writing.frame_rate = parse_frame_rate("--rate", arguments.film.rate);
  film.ranks = session.ranks;
  film.whole_frames = reads_slices(arguments) || arguments.film.distribute == Distribution::frames;
  if (!film.whole_frames) options.rendering.ranks = session.ranks;
  const FrameSource source = reads_slices(arguments)
                                 ? frames_of_slices(arguments, command, options, film.frames)
                                 : frames_of_particles(arguments, options, film.frames, session.progress);
  if (!arguments.film.frame_range.empty())
    film.only = parse_frame_range(arguments.film.frame_range, film.frames, "--frame-range");
  tell_what_film_keeps(arguments.output);
  const RenderedFilm result =
      make_or_say_how_to_continue([&] { return render_film(source, arguments.output, film, session.progress); });
  session.ranks.meet();
  if (session.ranks.first()) tell(arguments, result, session);
}

}  // namespace wheatstone::cli
