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
#include "depth_argument.h"
#include "device_option.h"
#include "display_argument.h"
#include "film_argument.h"
#include "film_plan_run.h"
#include "film_shots_run.h"
#include "match_options.h"
#include "stereo_arguments.h"
#include "style_options.h"
#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/app/rotoscope_film.h"
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

struct RotoscopeArguments {
  Given given;
  std::string film, right;
  std::string output = "painted.mp4";
  std::optional<StereoLayout> layout;
  EyesInFilm output_layout;
  std::optional<double> from_s, to_s;
  int frame_step = 1;
  std::optional<Rational> rate;
  std::string truth;
  DisplayArguments display;
  std::string flow_values = "255";
  DepthArguments depth;
  PlanArguments plan;
  ShotsArguments shots;
  RotoscopeFilmOptions options;
  MatchArguments matching;
  StyleArguments style;
};

bool writes_marks(const RotoscopeArguments& arguments) { return fs::path(arguments.output).extension() == ".wst"; }

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
  options.known = [depth_of](std::int64_t frame, const Image<Rgb8>& left) {
    return KnownFrame{{}, {}, depth_of(frame, left)};
  };
  options.made_from.emplace_back(depth.model.empty() ? depth.file : depth.model);
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
  options.known = [folder = arguments.truth](std::int64_t frame, const Image<Rgb8>& /*left*/) {
    return read_known_frame(folder, frame);
  };
  for (const char* file :
       {"left_disparity_%04d.pfm", "right_disparity_%04d.pfm", "flow_forward_%04d.flo", "flow_backward_%04d.flo"})
    options.made_from.push_back(fs::path(arguments.truth) / file);
}

/// Frames of one film are drawn by one device: --resume compares it.
void take_device(const Session& session, RotoscopeFilmOptions& options) {
  if (options.frames.device != Device::processor && !session.ranks.alone())
    throw Error(ErrorKind::wrong_usage, "--device: works in one process, expected --device cpu under mpirun");
  options.made_by += fmt::format(", drawn by {}", settle_device(options.frames.device, session));
}

FilmFiles films_from(const RotoscopeArguments& arguments) {
  check_distinct_outputs(
      std::array<NamedOutput, 2>{{{"--output", arguments.output}, {"--save-marks", arguments.options.marks}}});
  std::optional<StereoLayout> layout = arguments.layout;
  if (has_depth(arguments.depth) && !layout) layout = StereoLayout::mono;
  FilmFiles film = find_film(arguments.film, layout);
  if (!arguments.right.empty()) film = {arguments.film, arguments.right, {}};
  const fs::path depth = arguments.depth.file, model = arguments.depth.model;
  const fs::path shots = arguments.shots.file;
  for (const fs::path& output : {fs::path(arguments.output), arguments.options.right_film})
    if (!output.empty())
      check_not_an_input(output,
                         std::array{film.film, film.right, depth, model, arguments.options.frames.flow_model, shots});
  return film;
}

FilmReaderOptions reading_options(const RotoscopeArguments& arguments, const FilmFiles& film, const Session& session) {
  FilmReaderOptions reading{
      .from_s = arguments.from_s, .to_s = arguments.to_s, .every = arguments.frame_step, .threads = session.threads};
  if (!arguments.rate) return reading;
  if (!frame_pattern(film.film))
    throw Error(ErrorKind::wrong_usage, "--rate: a film says its own, expected numbered pictures");
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
  frames.matching = match_options_from(arguments.matching);
  // Whoever chooses a method of matching has each frame matched by it.
  frames.match_near_last = arguments.matching.quality != "best" &&
                           std::ranges::none_of(std::array{"--matcher", "--block", "--no-left-right-check", "--refine"},
                                                [&](const char* option) { return arguments.given(option); });
  frames.at_half_size = arguments.matching.quality == "fast";
  take_flow(arguments);
  take_display(arguments);
  if (arguments.options.frames.display || writes_marks(arguments)) arguments.options.frames.depth_budget.reset();
  frames.depth = {.kind = arguments.depth.kind, .strength = arguments.depth.strength};
  if (arguments.output_layout.two_films && !writes_marks(arguments)) {
    arguments.options.right_film = film_of_eye(arguments.output, right_eye);
    arguments.output = film_of_eye(arguments.output, left_eye).string();
  }
  arguments.options.anaglyph = arguments.output_layout.anaglyph;
  if (arguments.options.plan.empty()) tell_what_film_keeps(arguments.output, arguments.options.marks);
  RotoscopeFilmOptions options = arguments.options;
  take_truth(arguments, session, options);
  const FilmFiles film = films_from(arguments);
  options.reading = reading_options(arguments, film, session);
  options.version = WHEATSTONE_VERSION;
  options.made_by = fmt::format("wheatstone {}", WHEATSTONE_VERSION);
  take_device(session, options);
  StereoFilmReader source = open_film(film, options.reading);
  const bool has_one_eye = !has_depth(arguments.depth) && source.layout() == StereoLayout::mono && film.right.empty();
  if (has_depth(arguments.depth)) take_depth(arguments, film, source, options);
  if (has_one_eye) refuse_for_one_eye(arguments, film);
  if (!arguments.shots.file.empty())
    options.shots = shots_from(arguments.shots, film, options, {writes_marks(arguments), has_one_eye}, session);
  if (session.verbose && film.right.empty())
    remark(session, fmt::format("layout: {} ({})", layout_name(source.layout()), source.layout_how()));
  options.made_by += fmt::format(" from {}", layout_name(source.layout()));
  options.writing = writing_options(arguments, film, source, options.reading);
  options.expected_frames = expected_frames(source.facts(), options.reading);
  options.made_from.push_back(film.film);
  if (!film.right.empty()) options.made_from.push_back(film.right);
  const std::vector<std::string> left_out = side_streams_left_out(arguments.output, options.writing);
  if (!left_out.empty()) remark(session, fmt::format("wheatstone: {}", fmt::join(left_out, "; ")));
  if (options.on_twos && options.shots.empty()) options.shots = shots_found(film, options, session);
  take_ranks(film, options, session);
  const RotoscopedFilm result =
      make_or_say_how_to_continue([&] { return rotoscope_film(source, arguments.output, options, session.progress); });
  session.ranks.meet();
  return session.ranks.first() ? report_of(arguments, result, session) : Report();
}

Rows film_rows(RotoscopeArguments& a) {
  const Rows source{
      row("--layout", film_layout(a.layout),
          "Stereo layout of the film: sbs, sbs-half, tb, tb-half, mono, …; by default from its metadata, or else "
          "estimated from the pictures"),
      row("--output-layout", parsed(a.output_layout, find_eyes_in_film),
          "Stereo layout of the painted film, such as sbs-half for televisions, or anaglyph, or a kind of anaglyph, or "
          "two-files, a film for each eye; that of the source by default",
          {when([&a] { return !a.display.name.empty(); }, "with --display; it works where two eyes are painted")}),
      projection_row(a.options.writing,
                     {when([&a] { return !a.display.name.empty(); }, "with --display; its films lie on no sphere")}),
      row("--from", parsed(a.from_s, parse_time_s), "Start time: seconds or [HH:]MM:SS"),
      row("--to", parsed(a.to_s, parse_time_s), "End time: seconds or [HH:]MM:SS"),
      row("--rate", parsed(a.rate, parse_frame_rate),
          "Frames per second of numbered pictures, for example 25 or 24000/1001; 24 by default"),
      row("--frame-step", number(a.frame_step, {1, 1'000'000}), "Paint every Nth frame only")};
  const Rows marks{row("--save-marks", text(a.options.marks), "Also write the marks of each frame: marks_%04d.wst",
                       {when([&a] { return !a.options.plan.empty(); }, "with --plan, which has the marks")})};
  const Rows damaged{row("--keep-going", flag(a.options.keep_going),
                         "Paint the frames of a damaged film that can be decoded, without an error at the end")};
  return under("Film", join({source, film_coding_rows(a.options.writing), side_stream_rows(a.options.writing), marks,
                             film_resume_rows(a.options.resume, a.options.frames_between_checkpoints), damaged}));
}

/// "with --truth" or "with --depth", which stand in for what is estimated.
std::string known_depth(const RotoscopeArguments& a) {
  if (!a.truth.empty()) return "with --truth";
  return has_depth(a.depth) ? "with " + option_of(a.depth) : "";
}

Reason with_depth(const RotoscopeArguments& a) {
  return [&a] {
    return has_depth(a.depth) ? fmt::format("with {}; it works where there are two eyes", option_of(a.depth)) : "";
  };
}

Rows time_rows(RotoscopeArguments& a) {
  RotoscopeOptions& frames = a.options.frames;
  static constexpr std::array<Choice<FlowMethod>, 3> flows{
      {{"dis", FlowMethod::dis}, {"farneback", FlowMethod::farneback}, {"onnx", FlowMethod::onnx}}};
  static constexpr std::array<Choice<CentralMerge>, 2> merges{
      {{"visible", CentralMerge::visible}, {"average", CentralMerge::average}}};
  const Reason truth = when([&a] { return !a.truth.empty(); }, "with --truth; the exact flow and disparity are read");
  const Reason anew =
      when([&a] { return a.options.frames.anew; }, "with --frame-by-frame; nothing is carried from frame to frame");
  const Reason other_marks = [&a]() -> std::string {
    if (!a.shots.file.empty()) return {};  // its shots may have strokes
    const Style style = style_from(a.style, 1);
    return is_of_strokes(style) ? "" : fmt::format("on a painting of {}; it works with strokes", name_of(style.marks));
  };
  return under(
      "Time and depth",
      {rectify_row(frames.rectify, {with_depth(a), truth}),
       row("--flow", choice(frames.flow, flows),
           "Optical flow method: dis (dense inverse search), farneback (polynomial expansion), which is slower, or "
           "onnx, a network (--flow-model)",
           {anew, truth}),
       row("--flow-model", text(frames.flow_model),
           "Network (.onnx) for --flow onnx: takes two frames, 1x3xHxW each or stacked 1x6xHxW; returns a flow, "
           "1x2xHxW",
           {anew, truth,
            when([&a] { return a.options.frames.flow != FlowMethod::onnx; }, "with this --flow; it works with onnx")},
           "--flow"),
       row("--flow-values", name(a.flow_values, network_values_names()),
           "Value range of that network's inputs: 0..255, 0..1, or ImageNet's normalisation", {anew, truth},
           "--flow-model"),
       row("--central", choice(frames.central, merges),
           "How the eyes are merged to the central view: visible takes the colour from the eyes that see a point; "
           "average takes the average of both, which causes ghosting"),
       row("--fade-in", number(frames.carrying.fade_in_frames, {1, 1000}),
           "Number of frames over which new strokes fade in", {other_marks, anew}),
       row("--fade-out", number(frames.carrying.fade_out_frames, {1, 1000}),
           "Number of frames over which strokes that no longer fit fade out", {other_marks, anew}),
       row("--depth-budget", depth_budget(frames.depth_budget),
           "Depth of the painted film from the farthest point to the nearest, at most, in % of the width; 'full' for "
           "that of the source. The film is drawn for eyes that are nearer together",
           {when([&a] { return !a.display.name.empty(); }, "with --display; --span sets how deep it looks"),
            when([&a] { return writes_marks(a); }, "on marks (.wst); they have the depth of the film")}),
       row("--zero-parallax", number(frames.zero_parallax_px, zero_parallax_range),
           "Disparity in pixels that lies on the screen plane; chosen from the depth by default",
           {when([&a] { return writes_marks(a); }, "on marks (.wst); they have the depth of the film")}),
       row("--on-twos", flag(a.options.on_twos),
           "Make a new painting for every second frame only, and show it twice, as in hand-drawn films", {truth}),
       row("--frame-by-frame", flag(frames.anew), "Paint every frame separately, which flickers; for comparison"),
       row("--truth", text(a.truth),
           "Folder of 'synth film' whose exact flow and disparities are used instead of estimates", {with_depth(a)})});
}

Rows rotoscope_rows(RotoscopeArguments& a) {
  a.matching.matcher = name_of(RotoscopeOptions().matching.matcher);  // films need a quick one
  a.options.frames.depth_budget = comfortable_parallax_share;
  const Reason marks =
      when([&a] { return writes_marks(a); }, "on marks (.wst); 'paint --display' draws them for a display");
  const Reason undrawn = when([&a] { return writes_marks(a); }, "on marks (.wst); they are not drawn");
  const Reason known = [&a] {
    return known_depth(a).empty() ? "" : known_depth(a) + "; nothing is matched where the disparity is given";
  };
  const Reason with_truth =
      when([&a] { return !a.truth.empty(); }, "with --truth; the exact flow says where scenes begin");
  const Row plan_row = row("--plan", of_type("DIR", text(a.options.plan)),
                           "Only plan the film, and write the marks of its frames to this folder, to be drawn in parts "
                           "by --draw",
                           {when([&a] { return writes_marks(a); }, "on marks (.wst); they are all that is written"),
                            when([&a] { return a.options.resume; }, "with --resume; a plan is made in one run")},
                           {}, {"--draw", "--join"});
  const Rows basic{row("FILM", required(text(a.film)),
                       "Film with one or two eyes; numbered pictures (frame_%04d.png); a folder of them; or one film "
                       "per eye: LEFT,RIGHT; with --draw and --join a plan"),
                   row("RIGHT", text(a.right), "Film of the right eye, if FILM is that of the left eye"),
                   row("-o,--output", output_name(a.output),
                       "Painted film (.mp4, .mov, .mkv, .webm), numbered pictures (frame_%04d.png, .exr), or marks "
                       "(frame_%04d.wst); the stem of the name with --display")};
  Rows style = style_rows(a.style);
  std::ranges::find(style, "--propagation", &Row::names)->unless.push_back([&a] {
    return is_of_strokes(style_from(a.style, 1))
               ? "on the strokes of a film; they are planned in the view between the eyes"
               : "";
  });
  const Rows all = join({basic,
                         film_rows(a),
                         shots_rows(a.shots, {with_truth}),
                         plan_rows(a.plan, plan_row),
                         time_rows(a),
                         film_depth_rows(a.depth),
                         film_display_rows(a.display, {marks}),
                         {device_row(a.options.frames.device, "What draws the planned frames", {undrawn})},
                         style,
                         under({}, match_rows(a.matching), {known})});
  return refused_on_list(refused_on_plans(all, a.plan), a.shots);
}

}  // namespace

Command rotoscope_command() {
  return make_command(
      "rotoscope", "Paint a stereo or ordinary film; strokes follow the motion of the film", rotoscope_rows,
      run_rotoscope,
      R"(Strokes are planned in the view between the eyes and follow the motion of the film. Audio and subtitles are
copied. --resume continues a stopped run and gives the same film.

Examples:
  wheatstone rotoscope film.mp4 -o painted.mp4
  wheatstone rotoscope film.mp4 --from 0:10 --to 0:12 --style expressionist -o try.mp4
  wheatstone rotoscope film.mp4 --display looking-glass-portrait -o painted
  wheatstone rotoscope walk.mp4 --depth depth.mp4 -o painted.mp4
  wheatstone synth film -o film && wheatstone rotoscope film -o painted.mp4
  wheatstone rotoscope film.mp4 --plan film.plan -o painted.mp4
  wheatstone rotoscope --draw film.plan --frame-range 1/2 && wheatstone rotoscope --draw film.plan --frame-range 2/2
  wheatstone rotoscope --join film.plan
  wheatstone rotoscope film.mp4 --list-shots shots.toml && wheatstone rotoscope film.mp4 --shots shots.toml)");
}

}  // namespace wheatstone::cli
