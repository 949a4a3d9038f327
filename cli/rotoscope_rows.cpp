#include <algorithm>
#include <array>
#include <filesystem>

#include "device_option.h"
#include "film_argument.h"
#include "rotoscope_arguments.h"
#include "stereo_arguments.h"
#include "wheatstone/app/rendered_film.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// Models are rendered.
Reason of_film(const RotoscopeArguments& a) {
  return when([&a] { return is_of_model(a); }, "on a model of triangles; it works on films");
}

/// Where the frames that are painted, and what is known of them, are given.
Reason with_given_frames(const RotoscopeArguments& a) {
  return [&a]() -> std::string {
    if (is_of_model(a)) return "on a model of triangles, whose flow and disparity are exact";
    return a.truth.empty() ? "" : "with --truth; the exact flow and disparity are read";
  };
}

Reason with_exact_motion(const RotoscopeArguments& a) {
  return [&a]() -> std::string {
    if (uses_passes(a)) return "on pictures with a renderer's depth and motion; --passes none ignores these";
    return with_given_frames(a)();
  };
}

Rows film_rows(RotoscopeArguments& a) {
  const Rows source{
      row("--layout", film_layout(a.layout),
          "Stereo layout of the film: sbs, sbs-half, tb, tb-half, mono, …; by default from its metadata, or else "
          "estimated from the pictures",
          {of_film(a)}),
      row("--output-layout", parsed(a.output_layout, find_eyes_in_film),
          "Stereo layout of the painted film, such as sbs-half for televisions, or anaglyph, or a kind of anaglyph, or "
          "two-files, a film for each eye; that of the source by default",
          {when([&a] { return !a.display.name.empty(); }, "with --display; it works where two eyes are painted")}),
      projection_row(a.options.writing,
                     {when([&a] { return !a.display.name.empty(); }, "with --display; its films lie on no sphere")}),
      row("--from", parsed(a.from_s, parse_time_s), "Start time: seconds or [HH:]MM:SS", {of_film(a)}),
      row("--to", parsed(a.to_s, parse_time_s), "End time: seconds or [HH:]MM:SS", {of_film(a)}),
      row("--rate", parsed(a.rate, parse_frame_rate),
          "Frames per second of numbered pictures or a model, for example 25 or 24000/1001; 24 by default"),
      row("--frame-step", number(a.frame_step, {1, 1'000'000}), "Paint every Nth frame only", {of_film(a)})};
  const Rows marks{row("--save-marks", text(a.options.marks), "Also write the marks of each frame: marks_%04d.wst",
                       {when([&a] { return !a.options.plan.empty(); }, "with --plan, which has the marks")})};
  const Rows damaged{row("--keep-going", flag(a.options.keep_going),
                         "Paint the frames of a damaged film that can be decoded, without an error at the end")};
  return under("Film", join({source, film_coding_rows(a.options.writing),
                             under({}, side_stream_rows(a.options.writing), {of_film(a)}), marks,
                             film_resume_rows(a.options.resume, a.options.frames_between_checkpoints), damaged}));
}

/// "on a model of triangles", "with --truth" or "with --depth", which stand in for what is estimated.
std::string known_depth(const RotoscopeArguments& a) {
  if (is_of_model(a)) return "on a model of triangles";
  if (!a.truth.empty()) return "with --truth";
  if (uses_passes(a)) return "on pictures with a renderer's depth";
  return has_depth(a.depth) ? "with " + option_of(a.depth) : "";
}

Reason with_depth(const RotoscopeArguments& a) {
  return [&a] {
    return has_depth(a.depth) ? fmt::format("with {}; it works where there are two eyes", option_of(a.depth)) : "";
  };
}

constexpr std::array<std::string_view, 2> uses_of_passes{"auto", "none"};

Rows time_rows(RotoscopeArguments& a) {
  RotoscopeOptions& frames = a.options.frames;
  static constexpr std::array<Choice<FlowMethod>, 3> flows{
      {{"dis", FlowMethod::dis}, {"farneback", FlowMethod::farneback}, {"onnx", FlowMethod::onnx}}};
  static constexpr std::array<Choice<CentralMerge>, 2> merges{
      {{"visible", CentralMerge::visible}, {"average", CentralMerge::average}}};
  const Reason truth = with_exact_motion(a);
  const Reason anew =
      when([&a] { return a.options.frames.anew; }, "with --frame-by-frame; nothing is carried from frame to frame");
  const Reason other_marks = [&a]() -> std::string {
    if (!a.shots.file.empty()) return {};  // its shots may have strokes
    const Style style = style_from(a.style, 1);
    return is_of_strokes(style) ? "" : fmt::format("on a painting of {}; it works with strokes", name_of(style.marks));
  };
  const Reason of_marks = when([&a] { return writes_marks(a); }, "on marks (.wst); they have the depth of the film");
  const Reason masked = when([&a] { return !a.mask.file.empty(); }, keeps_depth_in_masks);
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
           {when([&a] { return !a.display.name.empty(); }, "with --display; --span sets how deep it looks"), of_marks,
            masked}),
       row("--zero-parallax", number(frames.zero_parallax_px, zero_parallax_range),
           "Disparity in pixels that lies on the screen plane; chosen from the depth by default", {of_marks, masked}),
       row("--on-twos", flag(a.options.on_twos),
           "Make a new painting for every second frame only, and show it twice, as in hand-drawn films",
           {with_given_frames(a)}),
       row("--frame-by-frame", flag(frames.anew), "Paint every frame separately, which flickers; for comparison"),
       row("--passes", name(a.passes, uses_of_passes),
           "Depth and motion that a renderer such as Blender notes in numbered OpenEXR of two views: auto uses them "
           "instead of estimates, none does not",
           {of_film(a), with_depth(a)}),
       row("--truth", text(a.truth),
           "Folder of 'synth film' whose exact flow and disparities are used instead of estimates",
           {with_depth(a), of_film(a)})});
}

}  // namespace

bool is_of_model(const RotoscopeArguments& arguments) { return wheatstone::is_model(arguments.film); }

bool uses_passes(const RotoscopeArguments& a) {
  if (a.passes != "auto" || !a.truth.empty() || !a.right.empty() || (a.layout && *a.layout != StereoLayout::left_right))
    return false;
  std::error_code ignored;
  return is_rendered_film(fs::is_directory(a.film, ignored) ? find_film(a.film).film : fs::path(a.film));
}

bool writes_marks(const RotoscopeArguments& arguments) { return fs::path(arguments.output).extension() == ".wst"; }

Rows rotoscope_rows(RotoscopeArguments& a) {
  a.matching.matcher = name_of(RotoscopeOptions().matching.matcher);  // films need a quick one
  a.model.size = {1280, 720};
  a.options.frames.depth_budget = comfortable_parallax_share;
  const Reason marks =
      when([&a] { return writes_marks(a); }, "on marks (.wst); 'paint --display' draws them for a display");
  const Reason undrawn = when([&a] { return writes_marks(a); }, "on marks (.wst); they are not drawn");
  const Reason on_display = when([&a] { return !a.display.name.empty(); }, "with --display; it works with eyes");
  const Reason known = [&a] {
    return known_depth(a).empty() ? "" : known_depth(a) + "; nothing is matched where the disparity is given";
  };
  const Row plan_row = row("--plan", of_type("DIR", text(a.options.plan)),
                           "Only plan the film, and write the marks of its frames to this folder, to be drawn in parts "
                           "by --draw",
                           {when([&a] { return writes_marks(a); }, "on marks (.wst); they are all that is written"),
                            when([&a] { return a.options.resume; }, "with --resume; a plan is made in one run")},
                           {}, {"--draw", "--join"});
  const Rows basic{row("FILM", required(text(a.film)),
                       "Film with one or two eyes; numbered pictures (frame_%04d.png); a folder of them; one film "
                       "per eye: LEFT,RIGHT; or a model of triangles (glTF, OBJ, PLY, STL), around which the camera "
                       "moves; with --draw and --join a plan"),
                   row("RIGHT", text(a.right), "Film of the right eye, if FILM is that of the left eye", {of_film(a)}),
                   row("-o,--output", output_name(a.output),
                       "Painted film (.mp4, .mov, .mkv, .webm), numbered pictures (frame_%04d.png, .exr), or marks "
                       "(frame_%04d.wst); the stem of the name with --display")};
  Rows style = style_rows(a.style);
  std::ranges::find(style, "--propagation", &Row::names)->unless.push_back([&a] {
    return is_of_strokes(style_from(a.style, 1))
               ? "on the strokes of a film; they are planned in the view between the eyes"
               : "";
  });
  const Rows all = join(
      {basic,
       film_rows(a),
       under({}, shots_rows(a.shots, {with_exact_motion(a)}, {undrawn}), {of_film(a)}),
       plan_rows(a.plan, plan_row),
       time_rows(a),
       under({}, film_depth_rows(a.depth), {of_film(a)}),
       mask_rows(a.mask, {undrawn, on_display}),
       film_display_rows(a.display, {marks}),
       {device_row(a.options.frames.device, "What draws the planned frames", {undrawn})},
       under("Models", join({model_rows(a.model), motion_rows(a.motion, "Number of frames of a film of a model", {})}),
             {when([&a] { return !is_of_model(a); }, "on a film; it works on models of triangles")}),
       style,
       under({}, match_rows(a.matching), {known})});
  return refused_on_list(refused_on_plans(all, a.plan), a.shots);
}

}  // namespace wheatstone::cli
