#include <fmt/format.h>

#include <optional>
#include <vector>

#include "commands.h"
#include "match_options.h"
#include "stereo_arguments.h"
#include "wheatstone/app/report.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/strokes/stroke_measures.h"

namespace wheatstone::cli {
namespace {

struct MeasureStereoArguments {
  std::string left, right;
  std::vector<std::string> photographs;
  std::string disparity, right_disparity;
  std::string painting;
  MatchArguments matching;
};

/// What is known of where the points lie: the left view's disparity to judge by, unknown where it is NaN, and the same
/// completed for both views.
struct Truth {
  Image<float> left_disparity;
  StereoGeometry geometry;
};

/// How much the strokes cover, and how well those of the two eyes belong together.
struct PaintingGuards {
  StrokeMeasures strokes;
  double left_bare_share = 0;
  double right_bare_share = 0;
};

struct MeasuredPair {
  PairMeasures stylised;
  std::optional<PairMeasures> photographs;
  std::optional<WrongSpots> wrong_spots;  ///< against the photographs
  std::optional<PaintingGuards> painting;
};

Image<float> read_disparity_of(const std::string& argument, const StereoPair& pair, const std::string& picture) {
  Image<float> disparity = read_disparity_argument(argument);
  if (same_size(disparity, pair.left)) return disparity;
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", argument, disparity.width(), disparity.height(),
                          pair.left.width(), pair.left.height(), picture));
}

Truth find_truth(const MeasureStereoArguments& arguments, const StereoPair& stylised,
                 const std::optional<StereoPair>& photographs, const Session& session) {
  Truth truth;
  if (arguments.disparity.empty()) {
    truth.geometry = match(*photographs, match_options_from(arguments.matching), session.progress).geometry;
    truth.left_disparity = truth.geometry.left_disparity;
    return truth;
  }
  truth.left_disparity = read_disparity_of(arguments.disparity, stylised, arguments.left);
  if (arguments.right_disparity.empty()) {
    truth.geometry = geometry_from_left(truth.left_disparity);
  } else {
    truth.geometry = geometry_from_both(truth.left_disparity,
                                        read_disparity_of(arguments.right_disparity, stylised, arguments.right));
  }
  return truth;
}

PaintingGuards measure_guards(const MeasureStereoArguments& arguments, const StereoPair& stylised,
                              const StereoGeometry& geometry) {
  const Painting painting = read_painting(arguments.painting);
  const int width = width_of(painting), height = height_of(painting);
  if (!same_size(geometry.left_disparity, stylised.left) || width != stylised.left.width() ||
      height != stylised.left.height())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: paints {}x{} pixels, expected {}x{} as {}", arguments.painting, width, height,
                            stylised.left.width(), stylised.left.height(), arguments.left));
  const std::vector<double> bare_shares = present(painting, for_two_eyes()).bare_shares;
  return {measure_strokes(layers_of(painting), geometry), bare_shares.front(), bare_shares.back()};
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : 0; }

Json to_json(const MeasuredPair& measured) {
  Json facts{{"stylised", Json::parse(pair_measures_json(measured.stylised))}};
  const PairMeasures& stylised = measured.stylised;
  if (measured.photographs) {
    facts["photographs"] = Json::parse(pair_measures_json(*measured.photographs));
    facts["left_gradient_energy_of_photograph"] =
        ratio(stylised.left_gradient_energy, measured.photographs->left_gradient_energy);
    facts["right_gradient_energy_of_photograph"] =
        ratio(stylised.right_gradient_energy, measured.photographs->right_gradient_energy);
  }
  if (measured.wrong_spots) facts["wrong_spots"] = Json::parse(wrong_spots_json(*measured.wrong_spots));
  facts["right_gradient_energy_of_left"] = ratio(stylised.right_gradient_energy, stylised.left_gradient_energy);
  if (measured.painting) {
    const PaintingGuards& guards = *measured.painting;
    facts["strokes"] = {
        {"strokes", guards.strokes.strokes},           {"visible_to_both", guards.strokes.visible_to_both},
        {"paired_share", guards.strokes.paired_share}, {"shape_differs_share", guards.strokes.shape_differs_share},
        {"left_bare_share", guards.left_bare_share},   {"right_bare_share", guards.right_bare_share}};
  }
  return facts;
}

/// One line of the table: the stylised pair's value, and the photographs' beside it.
struct Line {
  const char* name;
  const char* format;
  double (*value)(const PairMeasures&);
};
constexpr Line table[] = {
    {"left - right, mean (0..255)", "{:.2f}", [](const PairMeasures& m) { return m.difference.mean_absolute; }},
    {"left - right, RMSE (0..1)", "{:.4f}", [](const PairMeasures& m) { return m.difference.rmse; }},
    {"compared, visible to both", "{:.1f} %", [](const PairMeasures& m) { return 100 * m.difference.compared_share; }},
    {"depth found again", "{:.1f} %", [](const PairMeasures& m) { return 100 * m.survival.density; }},
    {"  its mean error (px)", "{:.2f}", [](const PairMeasures& m) { return m.survival.end_point_error; }},
    {"  lost or off by over 1 px", "{:.1f} %", [](const PairMeasures& m) { return 100 * m.survival.bad_1; }},
    {"  lost or off by over 2 px", "{:.1f} %", [](const PairMeasures& m) { return 100 * m.survival.bad_2; }},
    {"gradient energy, left", "{:.1f}", [](const PairMeasures& m) { return m.left_gradient_energy; }},
    {"gradient energy, right", "{:.1f}", [](const PairMeasures& m) { return m.right_gradient_energy; }},
    {"  right of left", "{:.1f} %",
     [](const PairMeasures& m) { return 100 * ratio(m.right_gradient_energy, m.left_gradient_energy); }},
};

std::string text_of(const MeasuredPair& measured) {
  const std::optional<PairMeasures>& photographs = measured.photographs;
  std::string text = fmt::format("{:<30}{:>12}{:>14}", "", "stylised", photographs ? "photographs" : "");
  const auto line = [&text](const char* name, const std::string& value, const std::string& beside) {
    text += fmt::format("\n{:<30}{:>12}{:>14}", name, value, beside);
  };
  const auto add = [&text](const char* name, const char* format, double value) {
    text += fmt::format("\n{:<30}{:>12}", name, fmt::format(fmt::runtime(format), value));
  };
  for (const auto& [name, format, value] : table)
    line(name, fmt::format(fmt::runtime(format), value(measured.stylised)),
         photographs ? fmt::format(fmt::runtime(format), value(*photographs)) : "");
  if (photographs) {
    add("  left of its photograph", "{:.1f} %",
        100 * ratio(measured.stylised.left_gradient_energy, photographs->left_gradient_energy));
    add("  right of its photograph", "{:.1f} %",
        100 * ratio(measured.stylised.right_gradient_energy, photographs->right_gradient_energy));
  }
  if (measured.wrong_spots) {
    add("wrong spots per 100 000 px", "{:.1f}", measured.wrong_spots->spots_per_100000_px);
    add("  share of the pixels", "{:.3f} %", 100 * measured.wrong_spots->share);
  }
  if (!measured.painting) return text;
  const PaintingGuards& guards = *measured.painting;
  add("strokes", "{:.0f}", static_cast<double>(guards.strokes.strokes));
  add("  in both eyes, of visible", "{:.1f} %", 100 * guards.strokes.paired_share);
  add("  of another shape", "{:.1f} %", 100 * guards.strokes.shape_differs_share);
  add("unpainted, left eye", "{:.2f} %", 100 * guards.left_bare_share);
  add("unpainted, right eye", "{:.2f} %", 100 * guards.right_bare_share);
  return text;
}

Report run_measure_stereo(const MeasureStereoArguments& arguments, const Session& session) {
  if (arguments.disparity.empty() && arguments.photographs.empty())
    throw Error(ErrorKind::wrong_usage, "measure stereo needs --disparity, or --photographs to match");
  const StereoPair stylised = read_pair(arguments.left, arguments.right);
  std::optional<StereoPair> photographs;
  if (!arguments.photographs.empty()) {
    photographs = read_pair(arguments.photographs[0], arguments.photographs[1]);
    if (!same_size(photographs->left, stylised.left))
      throw Error(
          ErrorKind::bad_input,
          fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", arguments.photographs[0], photographs->left.width(),
                      photographs->left.height(), stylised.left.width(), stylised.left.height(), arguments.left));
  }
  const Truth truth = find_truth(arguments, stylised, photographs, session);

  MeasuredPair measured;
  measured.stylised = measure_pair(stylised, truth.left_disparity);
  if (photographs) {
    measured.photographs = measure_pair(*photographs, truth.left_disparity);
    measured.wrong_spots = measure_wrong_spots(stylised, *photographs);
  }
  if (!arguments.painting.empty()) measured.painting = measure_guards(arguments, stylised, truth.geometry);
  Report report{{only_text(text_of(measured))}};
  add_members(report, to_json(measured));
  return report;
}

Rows measure_stereo_rows(MeasureStereoArguments& a) {
  const Reason known =
      when([&a] { return !a.disparity.empty(); }, "with --disparity; nothing is matched where the disparity is given");
  Value pair = texts(a.photographs);
  pair.takes = Value::Takes::two;
  return join(
      {{row("LEFT", required(text(a.left)), "Left picture, stylised"),
        row("RIGHT", required(text(a.right)), "Right picture, of the same size"),
        row("--photographs", pair, "Pair of photographs from which the pictures were made, measured for comparison"),
        row("--disparity", text(a.disparity),
            "True disparity of the left view: PNG, PFM or EXR as FILE[:SCALE], value / SCALE = pixels; by default the\n"
            "photographs are matched"),
        row("--right-disparity", text(a.right_disparity), "True disparity of the right view, in the same form",
            {when([&a] { return a.disparity.empty(); }, "without --disparity, which is that of the left view")}),
        row("--painting", text(a.painting), "The painting.wst that the pictures were drawn from")},
       under({}, match_rows(a.matching), {known})});
}

}  // namespace

Command measure_stereo_command() {
  return make_command(
      "stereo", "Measure the consistency of a stereo pair", measure_stereo_rows, run_measure_stereo,
      R"(Depth is matched again in the stylised pair and compared with the true one: what is lost there is lost to the
eyes. Blurring wins on differences and loses gradient energy.

Example:
  wheatstone measure stereo painted/left.png painted/right.png --photographs still/left.png still/right.png \
    --disparity still/left_disparity.pfm)");
}

}  // namespace wheatstone::cli
