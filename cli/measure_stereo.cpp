#include <fmt/format.h>
#include <fmt/ostream.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "command.h"
#include "disparity_argument.h"
#include "match_options.h"
#include "measure_kinds.h"
#include "print_facts.h"
#include "stereo_arguments.h"
#include "wheatstone/app/report.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/strokes/stroke_measures.h"

namespace wheatstone::cli {
namespace {

using Json = nlohmann::ordered_json;

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
struct Row {
  const char* name;
  const char* format;
  double (*value)(const PairMeasures&);
};
constexpr Row rows[] = {
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

void print_table(const MeasuredPair& measured, const Session& session) {
  fmt::print(session.output, "{:<30}{:>12}{:>14}\n", "", "stylised", measured.photographs ? "photographs" : "");
  for (const Row& row : rows) {
    const auto text = [&](const PairMeasures& m) { return fmt::format(fmt::runtime(row.format), row.value(m)); };
    fmt::print(session.output, "{:<30}{:>12}{:>14}\n", row.name, text(measured.stylised),
               measured.photographs ? text(*measured.photographs) : "");
  }
  if (measured.photographs) {
    const auto kept = [](double stylised, double photograph) {
      return fmt::format("{:.1f} %", 100 * ratio(stylised, photograph));
    };
    fmt::print(session.output, "{:<30}{:>12}\n", "  left of its photograph",
               kept(measured.stylised.left_gradient_energy, measured.photographs->left_gradient_energy));
    fmt::print(session.output, "{:<30}{:>12}\n", "  right of its photograph",
               kept(measured.stylised.right_gradient_energy, measured.photographs->right_gradient_energy));
  }
  const auto line = [&session](const char* name, const std::string& value) {
    fmt::print(session.output, "{:<30}{:>12}\n", name, value);
  };
  if (measured.wrong_spots) {
    line("wrong spots per 100 000 px", fmt::format("{:.1f}", measured.wrong_spots->spots_per_100000_px));
    line("  share of the pixels", fmt::format("{:.3f} %", 100 * measured.wrong_spots->share));
  }
  if (!measured.painting) return;
  const PaintingGuards& guards = *measured.painting;
  line("strokes", fmt::format("{}", guards.strokes.strokes));
  line("  in both eyes, of visible", fmt::format("{:.1f} %", 100 * guards.strokes.paired_share));
  line("  of another shape", fmt::format("{:.1f} %", 100 * guards.strokes.shape_differs_share));
  line("unpainted, left eye", fmt::format("{:.2f} %", 100 * guards.left_bare_share));
  line("unpainted, right eye", fmt::format("{:.2f} %", 100 * guards.right_bare_share));
}

void run_measure_stereo(const MeasureStereoArguments& arguments, const CLI::App& command, const Session& session) {
  if (arguments.disparity.empty() && !arguments.right_disparity.empty())
    throw Error(ErrorKind::wrong_usage, "--right-disparity needs --disparity, the left eye's");
  if (arguments.disparity.empty() && arguments.photographs.empty())
    throw Error(ErrorKind::wrong_usage, "measure stereo needs --disparity, or --photographs to match");
  refuse_match_options_without_effect(command, arguments.matching,
                                      arguments.disparity.empty() ? "" : "with --disparity");
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
  if (session.json) {
    print_facts(to_json(measured), session);
  } else {
    print_table(measured, session);
  }
}

}  // namespace

void add_measure_stereo(CLI::App& measure, const Session& session) {
  auto arguments = std::make_shared<MeasureStereoArguments>();
  CLI::App& command = *measure.add_subcommand("stereo", "Measure the consistency of a stereo pair");
  command.fallthrough();
  command.add_option("LEFT", arguments->left, "Left picture, stylised")->required();
  command.add_option("RIGHT", arguments->right, "Right picture, of the same size")->required();
  command
      .add_option("--photographs", arguments->photographs,
                  "Pair of photographs that they were made from, measured for comparison")
      ->expected(2);
  command.add_option(
      "--disparity", arguments->disparity,
      "True disparity of the left view: PNG, PFM or EXR as FILE[:SCALE], value / SCALE = pixels; by default the\n"
      "photographs are matched");
  command.add_option("--right-disparity", arguments->right_disparity,
                     "True disparity of the right view, in the same form");
  command.add_option("--painting", arguments->painting, "The painting.wst that the pictures were drawn from");
  add_match_options(command, arguments->matching);
  command.footer(
      "Depth is matched again in the stylised pair and compared with the true one: what is lost there is lost to the\n"
      "eyes. Blurring wins on differences and loses gradient energy.\n\n"
      "Example:\n  wheatstone measure stereo painted/left.png painted/right.png --photographs still/left.png "
      "still/right.png \\\n    --disparity still/left_disparity.pfm");
  command.callback([arguments, &command, &session] { run_measure_stereo(*arguments, command, session); });
}

}  // namespace wheatstone::cli
