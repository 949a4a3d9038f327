#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.h"
#include "depth_argument.h"
#include "device_option.h"
#include "display_argument.h"
#include "film_argument.h"
#include "match_options.h"
#include "number_arguments.h"
#include "option_use.h"
#include "output_option.h"
#include "print_facts.h"
#include "stereo_arguments.h"
#include "style_options.h"
#include "typed_options.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/error.h"
#include "wheatstone/files/input_guard.h"
#include "wheatstone/motion/flow_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/video/film_files.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct RotoscopeArguments {
  std::string film, right;
  std::string output = "painted.mp4";
  std::string layout, output_layout;
  std::string from, to;
  int frame_step = 1;
  bool no_audio = false, no_subtitles = false;
  std::string rate;
  std::string truth;
  DisplayArguments display;
  std::string depth_budget = "3%";
  std::string flow_values = "255";
  DepthArguments depth;
  RotoscopeFilmOptions options;
  MatchArguments matching;
  StyleArguments style;
};

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
  if (const auto asked = film_layout_option("--output-layout", arguments.output_layout)) {
    if (source.layout() == StereoLayout::mono && !two_films && *asked != StereoLayout::mono)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--output-layout: is '{}', but the film has one eye", arguments.output_layout));
    return *asked;
  }
  return layout_of_painted_film(source, two_films);
}

FilmWriterOptions writing_options(const RotoscopeArguments& arguments, const FilmFiles& film,
                                  const StereoFilmReader& source, const FilmReaderOptions& reading) {
  FilmWriterOptions writing = arguments.options.writing;
  const FilmFacts& facts = source.facts();
  writing.layout = layout_of_output(arguments, source, !film.right.empty());
  write_as_source(film.film, facts, reading, writing);
  if (arguments.options.frames.display) writing.pixel_aspect = {1, 1};
  writing.copy_audio = !arguments.no_audio;
  writing.copy_subtitles = !arguments.no_subtitles;
  return writing;
}

nlohmann::ordered_json to_json(const RotoscopeArguments& arguments, const RotoscopedFilm& film,
                               const Session& session) {
  const RotoscopeTotals& totals = film.totals;
  const auto painted = static_cast<double>(std::max<std::int64_t>(film.frames - film.resumed_frames, 1));
  nlohmann::ordered_json facts{{"output", arguments.output},
                               {"frames", film.frames},
                               {"resumed_frames", film.resumed_frames},
                               {"scenes", totals.scenes},
                               {"strokes_a_frame", film.frames > 0 ? totals.strokes / film.frames : 0},
                               {"worst_bare_share", totals.worst_bare_share},
                               {"popped_strokes", totals.popped_strokes}};
  if (totals.whole_strokes > 0)
    facts["survival"] = static_cast<double>(totals.survived_strokes) / static_cast<double>(totals.whole_strokes);
  facts["seconds_a_frame"] = film.seconds / painted;
  facts["core_seconds_a_frame"] = film.core_seconds / painted;
  facts["matching_seconds_a_frame"] = film.times.matching_s / painted;
  facts["central_view_seconds_a_frame"] = film.times.central_s / painted;
  facts["flow_seconds_a_frame"] = film.times.flow_s / painted;
  facts["planning_seconds_a_frame"] = film.painting_times.planning_s / painted;
  facts["drawing_seconds_a_frame"] = film.painting_times.rasterising_s / painted;
  if (const std::optional<FilmDisplay>& display = arguments.options.frames.display) {
    facts["views"] = display->views.views;
    facts["view_width"] = display->views.width;
    facts["view_height"] = display->views.height;
  } else {
    facts["moved_frames"] = totals.moved_frames;
    facts["presented_separation"] = totals.least_separation;
  }
  facts["ranks"] = session.ranks.count();
  facts["notes"] = film.notes;
  if (film.loss) facts["loss"] = *film.loss;
  return facts;
}

void print_summary(const RotoscopeArguments& arguments, const RotoscopedFilm& film, const Session& session) {
  const RotoscopeTotals& totals = film.totals;
  const auto painted = static_cast<double>(std::max<std::int64_t>(film.frames - film.resumed_frames, 1));
  fmt::print(session.output, "painted          {} frames in {} scene{}", film.frames, totals.scenes,
             totals.scenes == 1 ? "" : "s");
  if (film.resumed_frames > 0) fmt::print(session.output, ", the first {} by an earlier run", film.resumed_frames);
  fmt::print(session.output, "\ntime             {:.2f} s a frame, {:.2f} core-seconds\n", film.seconds / painted,
             film.core_seconds / painted);
  if (totals.whole_strokes > 0)
    fmt::print(session.output, "carried          {:.1f} % of the strokes from frame to frame, {} popped\n",
               100 * static_cast<double>(totals.survived_strokes) / static_cast<double>(totals.whole_strokes),
               totals.popped_strokes);
  fmt::print(session.output, "unpainted        at most {:.3f} % of {}\n", 100 * totals.worst_bare_share,
             arguments.options.frames.display ? "a view" : "an eye");
  if (totals.moved_frames > 0)
    fmt::print(session.output,
               "depth            reduced in {} frames, to {:.0f} % or more, to stay comfortable ({:.3g} % of width); "
               "--depth-budget full keeps it\n",
               totals.moved_frames, 100 * totals.least_separation,
               100 * arguments.options.frames.depth_budget.value_or(1));
  if (film.loss) fmt::print(session.output, "source           {}\n", *film.loss);
  for (const std::string& note : film.notes) fmt::print(session.output, "note             {}\n", note);
  fmt::print(session.output, "written to       {}\n", arguments.output);
}

/// Refuses options that change nothing in this run, as far as that is known before the film is opened.
void refuse_options_without_effect(const CLI::App& command, const RotoscopeArguments& arguments) {
  const bool known = !arguments.truth.empty(), deep = has_depth(arguments.depth);
  const std::string with_depth = arguments.depth.model.empty() ? "with --depth" : "with --depth-model";
  refuse_match_options_without_effect(command, arguments.matching, known ? "with --truth" : deep ? with_depth : "");
  const Style& style = arguments.options.frames.style;
  const auto refuse = [&](const std::vector<std::string>& options, std::string_view situation, std::string_view where) {
    refuse_options(command, options, situation, where);
  };
  if (is_of_strokes(style))
    refuse({"--propagation"}, "on the strokes of a film", "they are planned in the view between the eyes");
  if (!is_of_strokes(style))
    refuse({"--fade-in", "--fade-out"}, fmt::format("on a painting of {}", name_of(style.marks)),
           "it works with strokes");
  const RotoscopeOptions& frames = arguments.options.frames;
  if (frames.anew)
    refuse({"--flow", "--flow-model", "--flow-values", "--fade-in", "--fade-out"}, "with --frame-by-frame",
           "nothing is carried from frame to frame");
  if (deep) refuse({"--truth", "--rectify"}, with_depth, "it works where there are two eyes");
  if (!arguments.depth.model.empty()) refuse({"--depth-is"}, with_depth, "a network gives inverse depth");
  if (!deep) refuse({"--depth-is", "--strength"}, "without --depth", "");
  if (known)
    refuse({"--flow", "--flow-model", "--flow-values", "--rectify"}, "with --truth",
           "the exact flow and disparity are read");
}

/// Depth makes a pair of a film of one eye.
void take_depth(const RotoscopeArguments& arguments, const FilmFiles& film, const StereoFilmReader& source,
                RotoscopeFilmOptions& options) {
  const std::string option = arguments.depth.model.empty() ? "--depth" : "--depth-model";
  const FilmFacts& facts = source.facts();
  const bool says_two = !facts.layout_how.empty() && facts.layout != StereoLayout::mono && arguments.layout.empty();
  if (source.layout() != StereoLayout::mono || !film.right.empty() || says_two)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: belongs to a film of one eye, but {} has two", option, film.film.string()));
  const DepthArguments& depth = arguments.depth;
  const FilmDepth depth_of = depth.model.empty()
                                 ? depth_of_film(depth.file, {film.film, source.facts(), options.reading}, depth.kind)
                                 : depth_of_network(depth.model);
  options.known = [depth_of](std::int64_t frame, const Image<Rgb8>& left) {
    return KnownFrame{{}, {}, depth_of(frame, left)};
  };
  options.made_from.emplace_back(depth.model.empty() ? depth.file : depth.model);
}

/// The depth of what two eyes look at. Of marks, and of a display with more views, it is that of the film.
void take_depth_budget(const CLI::App& command, RotoscopeArguments& arguments) {
  const std::vector<std::string> option{"--depth-budget"};
  if (arguments.options.frames.display)
    return refuse_options(command, option, "with --display", "--span sets how deep it looks");
  if (fs::path(arguments.output).extension() == ".wst")
    return refuse_options(command, option, "on marks (.wst)", "they have the depth of the film");
  if (arguments.depth_budget != "full")
    arguments.options.frames.depth_budget = parse_share("--depth-budget", arguments.depth_budget, {0.1, 100});
}

/// A network for the optical flow, and nothing of it without one.
void take_flow(RotoscopeArguments& arguments) {
  RotoscopeOptions& frames = arguments.options.frames;
  const bool by_network = frames.flow == FlowMethod::onnx;
  if (by_network && frames.flow_model.empty())
    throw Error(ErrorKind::wrong_usage, "--flow: onnx needs a network, expected --flow-model FILE.onnx");
  if (!by_network && !frames.flow_model.empty())
    throw Error(ErrorKind::wrong_usage, "--flow-model: has no effect with this --flow; it works with onnx");
  frames.flow_model_values = *network_values_by_name(arguments.flow_values);
}

/// What a display asks for, where the user does not say otherwise.
void take_display(const CLI::App& command, RotoscopeArguments& arguments) {
  arguments.options.frames.display = film_display_from(arguments.display);
  if (!arguments.options.frames.display) return;
  refuse_options(command, {"--output-layout"}, "with --display", "it works where two eyes are painted");
  if (!was_given(command, "--output")) arguments.output = "painted";
  arguments.output = name_of_display_film(arguments.output, arguments.display);
  if (fs::path(arguments.output).extension() == ".wst")
    refuse_options(command, {"--display"}, "on marks (.wst)", "'paint --display' draws them for a display");
  choose_coding(command, *arguments.options.frames.display, arguments.options.writing);
}

/// The exact geometry and flow of a film of 'synth film'.
void take_truth(const RotoscopeArguments& arguments, const Session& session, RotoscopeFilmOptions& options) {
  if (arguments.truth.empty()) return;
  if (!session.ranks.alone()) throw Error(ErrorKind::wrong_usage, "--truth works in one process, not under mpirun");
  if (!arguments.from.empty() || arguments.frame_step != 1)
    throw Error(ErrorKind::wrong_usage, "--truth counts all frames from the first: leave out --from and --frame-step");
  options.known = [folder = arguments.truth](std::int64_t frame, const Image<Rgb8>& /*left*/) {
    return read_known_frame(folder, frame);
  };
  for (const char* file :
       {"left_disparity_%04d.pfm", "right_disparity_%04d.pfm", "flow_forward_%04d.flo", "flow_backward_%04d.flo"})
    options.made_from.push_back(fs::path(arguments.truth) / file);
}

/// Frames of one film are drawn by one device: --resume compares it.
void take_device(const CLI::App& command, const Session& session, const std::string& output,
                 RotoscopeFilmOptions& options) {
  if (fs::path(output).extension() == ".wst")
    refuse_options(command, {"--device"}, "on marks (.wst)", "they are not drawn");
  if (options.frames.device != Device::processor && !session.ranks.alone())
    throw Error(ErrorKind::wrong_usage, "--device: works in one process, expected --device cpu under mpirun");
  options.made_by += fmt::format(", drawn by {}", settle_device(options.frames.device, session));
}

FilmFiles films_from(const RotoscopeArguments& arguments) {
  check_distinct_outputs(
      std::array<NamedOutput, 2>{{{"--output", arguments.output}, {"--save-marks", arguments.options.marks}}});
  std::optional<StereoLayout> layout = film_layout_option("--layout", arguments.layout);
  if (has_depth(arguments.depth) && !layout) layout = StereoLayout::mono;
  FilmFiles film = find_film(arguments.film, layout);
  if (!arguments.right.empty()) film = {arguments.film, arguments.right, {}};
  const fs::path depth = arguments.depth.file, model = arguments.depth.model;
  check_not_an_input(arguments.output,
                     std::array{film.film, film.right, depth, model, arguments.options.frames.flow_model});
  return film;
}

FilmReaderOptions reading_options(const RotoscopeArguments& arguments, const FilmFiles& film, const Session& session) {
  FilmReaderOptions reading{.from_s = parse_time_s("--from", arguments.from),
                            .to_s = parse_time_s("--to", arguments.to),
                            .every = arguments.frame_step,
                            .threads = session.threads};
  if (arguments.rate.empty()) return reading;
  if (!frame_pattern(film.film))
    throw Error(ErrorKind::wrong_usage, "--rate: a film says its own, expected numbered pictures");
  reading.sequence_rate = parse_frame_rate("--rate", arguments.rate);
  return reading;
}

/// A film of one eye has no depth.
void refuse_for_one_eye(const CLI::App& command, const FilmFiles& film, const RotoscopeFilmOptions& options) {
  if (options.frames.display)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has one eye, expected two, or --depth, for a display of more views (--layout says how "
                            "they lie)",
                            film.film.string()));
  refuse_group(command, match_options_group, {}, "on a film of one eye", {});
  refuse_options(command, {"--central", "--rectify", "--depth-budget"}, "on a film of one eye", {});
}

void run_rotoscope(RotoscopeArguments arguments, const CLI::App& command, const Session& session) {
  arguments.options.frames.style = style_from(arguments.style, session.seed);
  arguments.options.frames.matching = match_options_from(arguments.matching);
  // Whoever chooses a method of matching has each frame matched by it.
  arguments.options.frames.match_near_last =
      arguments.matching.quality != "best" &&
      std::ranges::none_of(std::array{"--matcher", "--block", "--no-left-right-check", "--refine"},
                           [&](const char* option) { return was_given(command, option); });
  arguments.options.frames.at_half_size = arguments.matching.quality == "fast";
  take_flow(arguments);
  take_display(command, arguments);
  take_depth_budget(command, arguments);
  arguments.options.frames.depth = {.kind = arguments.depth.kind, .strength = parse_strength(arguments.depth.strength)};
  refuse_options_without_effect(command, arguments);
  tell_what_film_keeps(arguments.output, arguments.options.marks);
  RotoscopeFilmOptions options = arguments.options;
  take_truth(arguments, session, options);
  const FilmFiles film = films_from(arguments);
  options.reading = reading_options(arguments, film, session);
  options.made_by = fmt::format("wheatstone {}", WHEATSTONE_VERSION);
  take_device(command, session, arguments.output, options);
  StereoFilmReader source = open_film(film, options.reading);
  if (has_depth(arguments.depth)) {
    take_depth(arguments, film, source, options);
  } else if (source.layout() == StereoLayout::mono && film.right.empty()) {
    refuse_for_one_eye(command, film, options);
  }
  if (session.verbose && film.right.empty())
    fmt::print(session.errors, "layout: {} ({})\n", layout_name(source.layout()), source.layout_how());
  options.made_by += fmt::format(" from {}", layout_name(source.layout()));
  options.writing = writing_options(arguments, film, source, options.reading);
  options.expected_frames = expected_frames(source.facts(), options.reading);
  options.made_from.push_back(film.film);
  if (!film.right.empty()) options.made_from.push_back(film.right);
  const std::vector<std::string> left_out = side_streams_left_out(arguments.output, options.writing);
  if (!left_out.empty() && !session.quiet) fmt::print(session.errors, "wheatstone: {}\n", fmt::join(left_out, "; "));
  if (!session.ranks.alone()) {
    options.ranks = session.ranks;
    StereoFilmReader looked_at = open_film(film, options.reading);
    options.scenes = find_scenes(looked_at, session.ranks, session.progress);
  }
  const RotoscopedFilm result =
      make_or_say_how_to_continue([&] { return rotoscope_film(source, arguments.output, options, session.progress); });
  session.ranks.meet();
  if (!session.ranks.first()) return;
  if (session.json) {
    print_facts(to_json(arguments, result, session), session);
  } else {
    print_summary(arguments, result, session);
  }
}

void add_film_options(CLI::App& command, RotoscopeArguments& arguments) {
  constexpr auto group = "Film";
  command
      .add_option("--layout", arguments.layout,
                  "Stereo layout of the film: sbs, sbs-half, tb, tb-half, mono, …; by default from its metadata, or "
                  "else estimated from the pictures")
      ->group(group);
  command
      .add_option("--output-layout", arguments.output_layout,
                  "Stereo layout of the painted film; that of the source by default")
      ->group(group);
  command.add_option("--from", arguments.from, "Start time: seconds or [HH:]MM:SS")->group(group);
  command.add_option("--to", arguments.to, "End time: seconds or [HH:]MM:SS")->group(group);
  command
      .add_option("--rate", arguments.rate,
                  "Frames per second of numbered pictures, for example 25 or 24000/1001; 24 by default")
      ->group(group);
  add_number(command, "--frame-step", arguments.frame_step, {1, 1'000'000}, "Paint every Nth frame only")->group(group);
  add_film_coding_options(command, arguments.options.writing, group);
  command.add_flag("--no-audio", arguments.no_audio, "Do not copy the film's sound")->group(group);
  command.add_flag("--no-subtitles", arguments.no_subtitles, "Do not copy the film's subtitles")->group(group);
  command.add_option("--save-marks", arguments.options.marks, "Also write the marks of each frame: marks_%04d.wst")
      ->group(group);
  add_film_resume_options(command, arguments.options.resume, arguments.options.frames_between_checkpoints, group);
  command
      .add_flag("--keep-going", arguments.options.keep_going,
                "Paint the frames of a damaged film that can be decoded, without an error at the end")
      ->group(group);
}

void add_time_options(CLI::App& command, RotoscopeArguments& arguments) {
  constexpr auto group = "Time and depth";
  RotoscopeOptions& frames = arguments.options.frames;
  add_rectify_option(command, frames.rectify)->group(group);
  static constexpr std::array flows{std::pair{std::string_view("dis"), FlowMethod::dis},
                                    std::pair{std::string_view("farneback"), FlowMethod::farneback},
                                    std::pair{std::string_view("onnx"), FlowMethod::onnx}};
  CLI::Option* flow =
      add_choice<FlowMethod>(command, "--flow", frames.flow, flows,
                             "Optical flow method: dis (dense inverse search), farneback (polynomial expansion), which "
                             "is slower, or onnx, a network (--flow-model)")
          ->group(group);
  CLI::Option* model = command
                           .add_option("--flow-model", frames.flow_model,
                                       "Network (.onnx) for --flow onnx: takes two frames, 1x3xHxW each or stacked "
                                       "1x6xHxW; returns a flow, 1x2xHxW")
                           ->needs(flow)
                           ->group(group);
  add_name(command, "--flow-values", arguments.flow_values, network_values_names(),
           "Value range of that network's inputs: 0..255, 0..1, or ImageNet's normalisation")
      ->needs(model)
      ->group(group);
  static constexpr std::array merges{std::pair{std::string_view("visible"), CentralMerge::visible},
                                     std::pair{std::string_view("average"), CentralMerge::average}};
  add_choice<CentralMerge>(
      command, "--central", frames.central, merges,
      "How the eyes are merged to the central view: visible takes the colour from the eyes that see a point; average "
      "takes the average of both, which causes ghosting")
      ->group(group);
  add_number(command, "--fade-in", frames.carrying.fade_in_frames, {1, 1000},
             "Number of frames over which new strokes fade in")
      ->group(group);
  add_number(command, "--fade-out", frames.carrying.fade_out_frames, {1, 1000},
             "Number of frames over which strokes that no longer fit fade out")
      ->group(group);
  command
      .add_option(
          "--depth-budget", arguments.depth_budget,
          "Depth of the painted film from the farthest point to the nearest, at most, in % of the width; 'full' "
          "for that of the source. The film is drawn for eyes that are nearer together")
      ->type_name("SHARE")
      ->capture_default_str()
      ->group(group);
  command.add_flag("--frame-by-frame", frames.anew, "Paint every frame separately, which flickers; for comparison")
      ->group(group);
  command
      .add_option("--truth", arguments.truth,
                  "Folder of 'synth film' whose exact flow and disparities are used instead of estimates")
      ->group(group);
}

}  // namespace

void add_rotoscope_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<RotoscopeArguments>();
  CLI::App& command =
      *program.add_subcommand("rotoscope", "Paint a stereo or ordinary film; strokes follow the motion of the film");
  command
      .add_option("FILM", arguments->film,
                  "Film with one or two eyes; numbered pictures (frame_%04d.png); a folder of them; or one film per "
                  "eye: LEFT,RIGHT")
      ->required();
  command.add_option("RIGHT", arguments->right, "Film of the right eye, if FILM is that of the left eye");
  add_output_option(
      command, arguments->output,
      "Painted film (.mp4, .mov, .mkv), numbered pictures (frame_%04d.png), or marks (frame_%04d.wst); the stem of "
      "the name with --display");
  add_film_options(command, *arguments);
  add_time_options(command, *arguments);
  add_film_depth_options(command, arguments->depth);
  add_film_display_options(command, arguments->display);
  add_device_option(command, arguments->options.frames.device, "What draws the planned frames");
  add_style_options(command, arguments->style);
  arguments->matching.matcher = name_of(RotoscopeOptions().matching.matcher);  // films need a quick one
  add_match_options(command, arguments->matching);
  command.footer(
      "Strokes are planned in the view between the eyes and follow the motion of the film. Audio and subtitles are\n"
      "copied. --resume continues a stopped run and gives the same film.\n\n"
      "Examples:\n  wheatstone rotoscope film.mp4 -o painted.mp4\n"
      "  wheatstone rotoscope film.mp4 --from 0:10 --to 0:12 --style expressionist -o try.mp4\n"
      "  wheatstone rotoscope film.mp4 --display looking-glass-portrait -o painted\n"
      "  wheatstone rotoscope walk.mp4 --depth depth.mp4 -o painted.mp4\n"
      "  wheatstone synth film -o film && wheatstone rotoscope film -o painted.mp4");
  command.callback([arguments, &command, &session] { run_rotoscope(*arguments, command, session); });
}

}  // namespace wheatstone::cli
