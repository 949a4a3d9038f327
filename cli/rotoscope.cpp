#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "device_option.h"
#include "film_argument.h"
#include "rotoscope_arguments.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/app/rendered_film.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/motion/flow_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/video/film_files.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// A frame of a film that `synth film` made.
KnownFrame read_known_frame(const fs::path& folder, std::int64_t frame) {
  const auto file = [&](const char* name, std::int64_t number, const char* ending) {
    return folder / fmt::format("{}_{:04}{}", name, number, ending);
  };
  KnownFrame known;
  known.geometry = geometry_from_both(read_disparity(file("left_disparity", frame, ".pfm")),
                                      read_disparity(file("right_disparity", frame, ".pfm")));
  if (frame > 0)
    known.flow =
        FlowPair{read_flow(file("flow_forward", frame - 1, ".flo")), read_flow(file("flow_backward", frame, ".flo"))};
  return known;
}

/// How the eyes lie in a painted frame: as in the source, where a frame can hold them so.
StereoLayout layout_of_output(const RotoscopeArguments& arguments, const StereoFilmReader& source, bool two_films) {
  if (arguments.options.frames.display) return StereoLayout::mono;
  two_films = two_films || has_depth(arguments.depth);
  const EyesInFilm& asked = arguments.output_layout;
  const bool in_one_layout = asked.anaglyph.empty() && !asked.two_films;
  if (source.layout() == StereoLayout::mono && !two_films && asked.layout != StereoLayout::mono &&
      (asked.layout || !in_one_layout))
    throw Error(ErrorKind::wrong_usage, fmt::format("--output-layout: is '{}', but the film has one eye",
                                                    arguments.given.word_of("--output-layout")));
  if (!in_one_layout) return StereoLayout::mono;
  return asked.layout.value_or(layout_of_painted_film(source, two_films));
}

FilmWriterOptions writing_options(const RotoscopeArguments& arguments, const FilmFiles& film,
                                  const StereoFilmReader& source, const FilmReaderOptions& reading) {
  FilmWriterOptions writing = arguments.options.writing;
  writing.layout = layout_of_output(arguments, source, !film.right.empty());
  write_as_source(film.film, source.facts(), reading, writing);
  if (arguments.options.frames.display) {
    writing.pixel_aspect = {1, 1};
    writing.projection = "flat";
  }
  if (!arguments.output_layout.anaglyph.empty()) keep_full_colour(writing);
  if (arguments.options.frames.deep) keep_bits(source.facts(), arguments.output, writing);
  return writing;
}

double megabytes_in(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return static_cast<double>(bytes) / 1e6;
}

bool sets_screen_plane(const RotoscopeArguments& arguments) {
  return arguments.options.frames.zero_parallax_px || !arguments.shots.file.empty();
}

/// What was written, in how many frames of this run.
void add_written(const RotoscopeArguments& arguments, double frames, Report& report) {
  const auto add = [&](Fact fact) { report.facts.push_back(std::move(fact)); };
  const std::string right = arguments.options.right_film.string();
  if (!right.empty()) add({"right_output", right});
  if (const fs::path& plan = arguments.options.plan; !plan.empty()) {
    const double mb_a_frame = megabytes_in(plan) / frames;
    add({"plan", plan.string()});
    add({"plan_megabytes_a_frame", mb_a_frame, fmt::format("plan             {:.2f} MB a frame", mb_a_frame)});
    add(only_text(fmt::format("written to       {}; draw it with --draw, then --join it", plan.string())));
    return;
  }
  add(only_text(fmt::format("written to       {}{}{}", arguments.output, right.empty() ? "" : " and ", right)));
}

Report report_of(const RotoscopeArguments& arguments, const RotoscopedFilm& film, const Session& session) {
  const RotoscopeTotals& totals = film.totals;
  const RotoscopeOptions& options = arguments.options.frames;
  const auto painted = static_cast<double>(std::max<std::int64_t>(film.frames - film.resumed_frames, 1));
  std::string frames =
      fmt::format("{:16} {} frames in {} scene{}", arguments.options.plan.empty() ? "painted" : "planned", film.frames,
                  totals.scenes, totals.scenes == 1 ? "" : "s");
  if (film.resumed_frames > 0) frames += fmt::format(", the first {} by an earlier run", film.resumed_frames);
  Report report{{{"output", arguments.output},
                 {"frames", film.frames, frames},
                 {"resumed_frames", film.resumed_frames},
                 {"scenes", totals.scenes},
                 {"strokes_a_frame", film.frames > 0 ? totals.strokes / film.frames : 0},
                 {"seconds_a_frame", film.seconds / painted,
                  fmt::format("time             {:.2f} s a frame, {:.2f} core-seconds", film.seconds / painted,
                              film.core_seconds / painted)},
                 {"core_seconds_a_frame", film.core_seconds / painted},
                 {"matching_seconds_a_frame", film.times.matching_s / painted},
                 {"central_view_seconds_a_frame", film.times.central_s / painted},
                 {"flow_seconds_a_frame", film.times.flow_s / painted},
                 {"planning_seconds_a_frame", film.painting_times.planning_s / painted},
                 {"drawing_seconds_a_frame", film.painting_times.rasterising_s / painted},
                 {"popped_strokes", totals.popped_strokes}}};
  const auto add = [&](Fact fact) { report.facts.push_back(std::move(fact)); };
  if (totals.whole_strokes > 0) {
    const double survival = static_cast<double>(totals.survived_strokes) / static_cast<double>(totals.whole_strokes);
    add({"survival", survival,
         fmt::format("carried          {:.1f} % of the strokes from frame to frame, {} popped", 100 * survival,
                     totals.popped_strokes)});
  }
  if (arguments.options.plan.empty())
    add({"worst_bare_share", totals.worst_bare_share,
         fmt::format("unpainted        at most {:.3f} % of {}", 100 * totals.worst_bare_share,
                     options.display ? "a view" : "an eye")});
  if (options.display) {
    add({"views", options.display->views.views});
    add({"view_width", options.display->views.width});
    add({"view_height", options.display->views.height});
  } else {
    add({"moved_frames", totals.moved_frames});
    add({"presented_separation", totals.least_separation});
  }
  if (totals.moved_frames > 0 && (totals.least_separation < 1 || !sets_screen_plane(arguments)))
    add(only_text(fmt::format(
        "depth            reduced in {} frames, to {:.0f} % or more, to stay comfortable ({}); "
        "--depth-budget full keeps it",
        totals.moved_frames, 100 * totals.least_separation,
        arguments.shots.file.empty() ? fmt::format("{:.3g} % of width", 100 * options.depth_budget.value_or(1))
                                     : arguments.shots.file)));
  add({"ranks", session.ranks.count()});
  if (film.loss) add({"loss", *film.loss, fmt::format("source           {}", *film.loss)});
  add({"notes", film.notes, lines("note             ", film.notes)});
  add_written(arguments, painted, report);
  return report;
}

/// Depth makes a pair of a film of one eye.
void take_depth(const RotoscopeArguments& arguments, const FilmFiles& film, const StereoFilmReader& source,
                RotoscopeFilmOptions& options) {
  const FilmFacts& facts = source.facts();
  const bool says_two = !facts.layout_how.empty() && facts.layout != StereoLayout::mono && !arguments.layout;
  if (source.layout() != StereoLayout::mono || !film.right.empty() || says_two)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: belongs to a film of one eye, but {} has two",
                                                    option_of(arguments.depth), film.film.string()));
  const DepthArguments& depth = arguments.depth;
  const FilmDepth depth_of = depth.model.empty()
                                 ? depth_of_film(depth.file, {film.film, source.facts(), options.reading}, depth.kind)
                                 : depth_of_network(depth.model);
  options.known = [depth_of](std::int64_t frame, const StereoPair& eyes) {
    return KnownFrame{{}, {}, depth_of(frame, eyes.left)};
  };
  options.made_from.emplace_back(depth.model.empty() ? depth.file : depth.model);
}

void take_matching(RotoscopeArguments& arguments) {
  RotoscopeOptions& frames = arguments.options.frames;
  frames.matching = match_options_from(arguments.matching);
  // Whoever chooses a method of matching has each frame matched by it.
  frames.match_near_last = arguments.matching.quality != "best" &&
                           std::ranges::none_of(std::array{"--matcher", "--block", "--no-left-right-check", "--refine"},
                                                [&](const char* option) { return arguments.given(option); });
  frames.at_half_size = arguments.matching.quality == "fast";
}

/// A network for the optical flow.
void take_flow(RotoscopeArguments& arguments) {
  RotoscopeOptions& frames = arguments.options.frames;
  if (frames.flow == FlowMethod::onnx && frames.flow_model.empty())
    throw Error(ErrorKind::wrong_usage, "--flow: onnx needs a network, expected --flow-model FILE.onnx");
  frames.flow_model_values = *network_values_by_name(arguments.flow_values);
}

/// What a display asks for, where the user does not say otherwise.
void take_display(RotoscopeArguments& arguments) {
  arguments.options.frames.display = film_display_from(arguments.display);
  if (!arguments.options.frames.display) return;
  if (!arguments.given("--output")) arguments.output = "painted";
  arguments.output = name_of_display_film(arguments.output, arguments.display);
  choose_coding(arguments.given, *arguments.options.frames.display, arguments.options.writing);
}

/// The exact geometry and flow of a film of 'synth film'.
void take_truth(const RotoscopeArguments& arguments, const Session& session, RotoscopeFilmOptions& options) {
  if (arguments.truth.empty()) return;
  if (!session.ranks.alone()) throw Error(ErrorKind::wrong_usage, "--truth works in one process, not under mpirun");
  if (arguments.from_s || arguments.frame_step != 1)
    throw Error(ErrorKind::wrong_usage, "--truth counts all frames from the first: leave out --from and --frame-step");
  options.known = [folder = arguments.truth](std::int64_t frame, const StereoPair& /*eyes*/) {
    return read_known_frame(folder, frame);
  };
  for (const char* file :
       {"left_disparity_%04d.pfm", "right_disparity_%04d.pfm", "flow_forward_%04d.flo", "flow_backward_%04d.flo"})
    options.made_from.push_back(fs::path(arguments.truth) / file);
}

/// The depth and the motion that a renderer noted in the film's pictures.
void take_passes(const RotoscopeArguments& arguments, const FilmFiles& film, const Session& session,
                 RotoscopeFilmOptions& options) {
  if (!uses_passes(arguments)) return;
  if (!session.ranks.alone())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: its depth is read in one process, not under mpirun; --passes none matches it instead",
                            film.film.string()));
  options.known = known_of_rendered_film(film.film, options.reading, !options.on_twos);
  options.made_by += " with its passes";
  remark(session, fmt::format("{}: its depth, and its motion if it has any, are taken from its passes; --passes none "
                              "estimates them",
                              film.film.string()));
}

/// The film; or a model as a film, whose exact geometry goes into the options.
StereoFilmReader open_source(const RotoscopeArguments& arguments, const FilmFiles& film, const Session& session,
                             RotoscopeFilmOptions& options) {
  if (!is_of_model(arguments)) return open_film(film, options.reading);
  if (!session.ranks.alone())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: is a model, which is painted in one process, not under mpirun", arguments.film));
  const Rational rate = options.reading.sequence_rate;
  ModelFilm made = film_of_model_argument(film.film, arguments.model, arguments.motion, rate, session);
  options.known = std::move(made.known);
  options.frames.carrying.length_tolerance = length_tolerance_on_models;
  options.made_by += fmt::format(" of a model {}", recipe_of(arguments.model, arguments.motion, rate));
  for (const fs::path& file : {fs::path(arguments.motion.path), arguments.model.seen.model.choice.texture})
    if (!file.empty()) options.made_from.push_back(file);
  return std::move(made.source);
}

/// Frames of one film are drawn by one device: --resume compares it.
void take_device(const Session& session, RotoscopeFilmOptions& options) {
  if (options.frames.device != Device::processor && !session.ranks.alone())
    throw Error(ErrorKind::wrong_usage, "--device: works in one process, expected --device cpu under mpirun");
  options.made_by += fmt::format(", drawn by {}", settle_device(options.frames.device, session));
}

FilmFiles films_from(const RotoscopeArguments& arguments) {
  check_distinct_outputs(std::array<NamedOutput, 3>{{{"--output", arguments.output},
                                                     {"--save-marks", arguments.options.marks},
                                                     {"--preview", arguments.shots.preview}}});
  std::optional<StereoLayout> layout = arguments.layout;
  if (has_depth(arguments.depth) && !layout) layout = StereoLayout::mono;
  FilmFiles film = is_of_model(arguments) ? FilmFiles{arguments.film, {}, {}} : find_film(arguments.film, layout);
  if (!arguments.right.empty()) film = {arguments.film, arguments.right, {}};
  const fs::path depth = arguments.depth.file, model = arguments.depth.model;
  const fs::path shots = arguments.shots.file, mask = arguments.mask.file, camera = arguments.motion.path,
                 texture = arguments.model.seen.model.choice.texture;
  for (const fs::path& output :
       {fs::path(arguments.output), arguments.options.right_film, fs::path(arguments.shots.preview)})
    if (!output.empty())
      check_not_an_input(output, std::array{film.film, film.right, depth, model, arguments.options.frames.flow_model,
                                            shots, mask, camera, texture});
  return film;
}

FilmReaderOptions reading_options(const RotoscopeArguments& arguments, const FilmFiles& film, const Session& session) {
  FilmReaderOptions reading{.from_s = arguments.from_s,
                            .to_s = arguments.to_s,
                            .every = arguments.frame_step,
                            .threads = session.threads,
                            .deep = arguments.options.frames.deep};
  if (!arguments.rate) return reading;
  if (!is_of_model(arguments) && !frame_pattern(film.film))
    throw Error(ErrorKind::wrong_usage, "--rate: a film says its own, expected numbered pictures or a model");
  reading.sequence_rate = *arguments.rate;
  return reading;
}

/// A film of one eye has no depth.
void refuse_for_one_eye(const RotoscopeArguments& arguments, const FilmFiles& film) {
  if (arguments.options.frames.display)
    throw Error(
        ErrorKind::bad_input,
        fmt::format(
            "{}: has one eye, expected two, or --depth, for a display of more views (--layout says how they lie)",
            film.film.string()));
  MatchArguments matching;
  for (const Row& row : match_rows(matching)) refuse_options(arguments.given, {name_of(row)}, "on a film of one eye");
  refuse_options(arguments.given, {"--central", "--rectify", "--depth-budget", "--zero-parallax"},
                 "on a film of one eye");
}

/// The shots of a file, whose maps are sources, too.
void take_shots(const RotoscopeArguments& arguments, const FilmFiles& film, bool has_one_eye, const Session& session,
                RotoscopeFilmOptions& options) {
  if (arguments.shots.file.empty()) return;
  options.shots = shots_from(arguments.shots, film, options, {writes_marks(arguments), has_one_eye}, session);
  for (const FilmShot& shot : options.shots)
    for (const MapsKey& key : shot.maps)
      for (const fs::path& file : {key.maps.detail, key.maps.disparity})
        if (!file.empty()) options.made_from.push_back(file);
}

/// What the processes of mpirun share.
void take_ranks(const FilmFiles& film, RotoscopeFilmOptions& options, const Session& session) {
  if (session.ranks.alone()) return;
  options.ranks = session.ranks;
  StereoFilmReader looked_at = open_film(film, options.reading);
  if (options.shots.empty()) {
    options.scenes = find_scenes(looked_at, session.ranks, session.progress);
    return;
  }
  options.scenes.begins = cuts_of(options.shots);
  options.scenes.frames = looked_at.skip(std::numeric_limits<std::int64_t>::max());
}

Report run_rotoscope(const RotoscopeArguments& given, const Session& session) {
  if (!session.ranks.alone() && (is_of_plan(given.plan) || !given.options.plan.empty()))
    throw Error(ErrorKind::wrong_usage, "--plan, --draw and --join work in one process, not under mpirun");
  if (is_of_plan(given.plan)) return run_plan(given.plan, given.film, given.output, given.given, session);
  if (!given.shots.list.empty()) {
    RotoscopeArguments listing = given;
    listing.output = given.shots.list;
    const FilmFiles film = films_from(listing);
    return run_list(given.shots, film, reading_options(listing, film, session), session);
  }
  RotoscopeArguments arguments = given;
  RotoscopeOptions& frames = arguments.options.frames;
  frames.style = style_from(arguments.style, session.seed);
  take_matching(arguments);
  take_flow(arguments);
  take_display(arguments);
  if (arguments.options.frames.display || writes_marks(arguments)) arguments.options.frames.depth_budget.reset();
  frames.deep = !frames.display && arguments.output_layout.anaglyph.empty() &&
                may_write_deep(arguments.output, arguments.options.writing);
  frames.depth = {.kind = arguments.depth.kind, .strength = arguments.depth.strength};
  if (arguments.output_layout.two_films && !writes_marks(arguments)) {
    arguments.options.right_film = film_of_eye(arguments.output, right_eye);
    arguments.output = film_of_eye(arguments.output, left_eye).string();
  }
  arguments.options.anaglyph = arguments.output_layout.anaglyph;
  const bool is_preview = !arguments.shots.preview.empty();
  if (is_preview && !arguments.given("--output")) arguments.output = "painted.mkv";  // holds every codec
  if (arguments.options.plan.empty() && !is_preview) tell_what_film_keeps(arguments.output, arguments.options.marks);
  RotoscopeFilmOptions options = arguments.options;
  take_truth(arguments, session, options);
  const FilmFiles film = films_from(arguments);
  options.reading = reading_options(arguments, film, session);
  options.version = WHEATSTONE_VERSION;
  options.made_by = fmt::format("wheatstone {}", WHEATSTONE_VERSION);
  take_device(session, options);
  StereoFilmReader source = open_source(arguments, film, session, options);
  const bool has_one_eye = !has_depth(arguments.depth) && source.layout() == StereoLayout::mono && film.right.empty();
  if (has_depth(arguments.depth)) take_depth(arguments, film, source, options);
  take_passes(arguments, film, session, options);
  if (has_one_eye) refuse_for_one_eye(arguments, film);
  take_mask(arguments.mask, film, source, session, options);
  take_shots(arguments, film, has_one_eye, session, options);
  if (session.verbose && film.right.empty())
    remark(session, fmt::format("layout: {} ({})", layout_name(source.layout()), source.layout_how()));
  options.made_by += fmt::format(" from {}", layout_name(source.layout()));
  options.writing = writing_options(arguments, film, source, options.reading);
  options.expected_frames = expected_frames(source.facts(), options.reading);
  options.made_from.push_back(film.film);
  if (!film.right.empty()) options.made_from.push_back(film.right);
  if ((options.on_twos || is_preview) && options.shots.empty()) options.shots = shots_found(film, options, session);
  if (is_preview) return run_preview(arguments.shots, film, arguments.output, options, session);
  const std::vector<std::string> left_out = side_streams_left_out(arguments.output, options.writing);
  if (!left_out.empty()) remark(session, fmt::format("wheatstone: {}", fmt::join(left_out, "; ")));
  take_ranks(film, options, session);
  const RotoscopedFilm result =
      make_or_say_how_to_continue([&] { return rotoscope_film(source, arguments.output, options, session.progress); });
  session.ranks.meet();
  return session.ranks.first() ? report_of(arguments, result, session) : Report();
}

}  // namespace

Command rotoscope_command() {
  return make_command(
      "rotoscope", "Paint a stereo or ordinary film, or a model that turns; strokes follow the motion", rotoscope_rows,
      run_rotoscope,
      R"(Strokes are planned in the view between the eyes and follow the motion of the film. Audio and subtitles are
copied. --resume continues a stopped run and gives the same film.

Examples:
  wheatstone rotoscope film.mp4 -o painted.mp4
  wheatstone rotoscope film.mp4 --from 0:10 --to 0:12 --style expressionist -o try.mp4
  wheatstone rotoscope film.mp4 --display looking-glass-portrait -o painted
  wheatstone rotoscope walk.mp4 --depth depth.mp4 -o painted.mp4
  wheatstone synth film -o film && wheatstone rotoscope film -o painted.mp4
  wheatstone rotoscope film.mp4 --mask matte.mp4 --outside mosaic -o painted.mp4
  wheatstone rotoscope model.glb --frames 8 --orbit 30 --picture-size 640x360 -o turntable.mp4
  wheatstone rotoscope film.mp4 --plan film.plan -o painted.mp4
  wheatstone rotoscope --draw film.plan --frame-range 1/2 && wheatstone rotoscope --draw film.plan --frame-range 2/2
  wheatstone rotoscope --join film.plan
  wheatstone rotoscope film.mp4 --list-shots shots.toml && wheatstone rotoscope film.mp4 --shots shots.toml)");
}

}  // namespace wheatstone::cli
