#include "render_film.h"

#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "display_argument.h"
#include "film_argument.h"
#include "slices_argument.h"
#include "wheatstone/app/annotate.h"
#include "wheatstone/app/particle_frames.h"
#include "wheatstone/app/render_film.h"
#include "wheatstone/app/render_model_file.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// What a frame becomes, and the name of the film.
void choose_output(RenderArguments& arguments, const RenderParticlesOptions& options, RenderFilmOptions& film) {
  if (arguments.quilt) {
    check_quilt(*arguments.quilt, options.views);
    film.quilt = arguments.quilt;
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
  if (two_eyes && options.views == 2)
    film.writing.layout = arguments.film.output_layout.value_or(StereoLayout::left_right);
  if (!arguments.given("--output")) arguments.output = "film";
  const double aspect = arguments.aspect > 0 ? arguments.aspect : static_cast<double>(options.width) / options.height;
  arguments.output = name_of_film(arguments.output, film.quilt, aspect);
  if (two_eyes) return;
  const FilmDisplay display{
      .views = {.width = options.width, .height = options.height}, .quilt = film.quilt, .screen = film.screen};
  choose_coding(arguments.given, display, film.writing);
}

/// All that was typed and decides what is in the frames.
std::string recipe_of(const Given& given) {
  std::string recipe = fmt::format("wheatstone {}\n", WHEATSTONE_VERSION);
  for (const auto& [option, words, takes] : given.options)
    if (option != "--output" && option != "--resume" && option != "--checkpoint" && option != "--distribute")
      recipe += fmt::format("{}={}\n", option, fmt::join(words, " "));
  return recipe;
}

/// The frames, each of its own file of slices. Gives their number where none was asked for.
FrameSource frames_of_slices(const RenderArguments& arguments, const RenderParticlesOptions& options, int& count) {
  const std::optional<FramePattern> pattern = frame_pattern(arguments.file);
  if (!pattern)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: is one file of slices, expected a pattern as slices_%04d.exr", arguments.file));
  const std::vector<std::int64_t> numbers = numbers_without_hole(*pattern);
  count = static_cast<int>(numbers.size());
  return [pattern = *pattern, first = numbers.front(), given = arguments.given, options](int frame,
                                                                                         const Progress& progress) {
    return render_slice_file(pattern.file(first + frame), given, options, progress);
  };
}

/// Of particles or of a model.
FrameSource frames_of_scene(const RenderArguments& arguments, const RenderParticlesOptions& options, int& count,
                            const Progress& progress) {
  ParticleFramesOptions wanted = moved(arguments.film.motion, options);
  if (reads_model(arguments)) {
    ModelFrames frames = frames_of_model(arguments.file, std::move(wanted), progress);
    count = frames.count;
    return std::move(frames.source);
  }
  const auto frames = std::make_shared<ParticleFrames>(arguments.file, wanted, progress);
  count = frames->count();
  return [frames](int frame, const Progress& of_frame) { return frames->frame(frame, of_frame); };
}

/// The frames with what --annotate draws into their views.
FrameSource annotated(FrameSource source, Annotation annotation) {
  annotation.shown_as = ShownAs::film;
  return [source = std::move(source), annotation](int frame, const Progress& progress) {
    RenderedParticles rendered = source(frame, progress);
    for (std::string& note : annotate(rendered, rendered.rendered.views, annotation))
      rendered.warnings.push_back(std::move(note));
    return rendered;
  };
}

Report report_of(const RenderArguments& arguments, const RenderedFilm& film, const Session& session) {
  const RenderedViews& rendered = film.last.rendered;
  std::string frames = fmt::format("rendered         {} frames", film.frames);
  if (film.resumed_frames > 0) frames += fmt::format(", the first {} by an earlier run", film.resumed_frames);
  if (film.skipped_frames > 0) frames += fmt::format(", of which {} were there", film.skipped_frames);
  std::vector<std::string> notes = film.notes;
  notes.insert(notes.end(), film.last.warnings.begin(), film.last.warnings.end());
  const bool tells_method = session.verbose && (film.last.particles > 0 || film.last.triangles > 0);
  return {{{"output", arguments.output},
           {"frames", film.frames, frames},
           {"resumed_frames", film.resumed_frames},
           {"skipped_frames", film.skipped_frames},
           {"particles", film.last.particles},
           {"triangles", film.last.triangles},
           {"views", film.last.rig.positions.size()},
           {"method", name_of(rendered.method)},
           {"reason", rendered.reason, tells_method ? fmt::format("method           {}", rendered.reason) : ""},
           {"least", film.last.least},
           {"most", film.last.most},
           {"ranks", session.ranks.count()},
           {"notes", notes, lines("note             ", notes)},
           only_text(fmt::format("written to       {}", arguments.output))}};
}

}  // namespace

Report run_render_film(const RenderArguments& given, const Session& session) {
  RenderArguments arguments = given;
  RenderParticlesOptions options = render_options_from(arguments);
  options.slices = !arguments.save_slices.empty();
  options.without_views = false;
  if (!arguments.save_slices.empty() && !frame_pattern(arguments.save_slices))
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format(
            "--save-slices: is '{}', expected a name with a number for the frames of a film, as slices_%04d.exr",
            arguments.save_slices));
  RenderFilmOptions film{.writing = arguments.film.writing,
                         .slices = arguments.save_slices,
                         .frames_between_checkpoints = arguments.film.checkpoint,
                         .resume = arguments.film.resume,
                         .made_by = recipe_of(given.given),
                         .made_from = {arguments.file},
                         .skip_existing = arguments.film.skip_existing};
  if (!arguments.film.motion.path.empty()) film.made_from.emplace_back(arguments.film.motion.path);
  if (!options.model.choice.texture.empty()) film.made_from.emplace_back(options.model.choice.texture);
  choose_output(arguments, options, film);
  check_not_an_input(arguments.output, film.made_from);
  check_distinct_outputs(
      std::array<NamedOutput, 2>{{{"--output", arguments.output}, {"--save-slices", arguments.save_slices}}});
  film.writing.frame_rate = arguments.film.rate;
  film.ranks = session.ranks;
  film.whole_frames =
      reads_slices(arguments) || reads_model(arguments) || arguments.film.distribute == Distribution::frames;
  if (!film.whole_frames) options.rendering.ranks = session.ranks;
  if (arguments.annotate) check_annotation(arguments.annotation, options.depth.viewing);
  FrameSource source = reads_slices(arguments) ? frames_of_slices(arguments, options, film.frames)
                                               : frames_of_scene(arguments, options, film.frames, session.progress);
  if (arguments.annotate) source = annotated(std::move(source), arguments.annotation);
  if (!arguments.film.frame_range.empty())
    film.only = parse_frame_range(arguments.film.frame_range, film.frames, "--frame-range");
  tell_what_film_keeps(arguments.output);
  const RenderedFilm result =
      make_or_say_how_to_continue([&] { return render_film(source, arguments.output, film, session.progress); });
  session.ranks.meet();
  return session.ranks.first() ? report_of(arguments, result, session) : Report();
}

}  // namespace wheatstone::cli
