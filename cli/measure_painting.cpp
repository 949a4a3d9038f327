#include <fmt/format.h>
#include <fmt/ostream.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "measure_kinds.h"
#include "print_facts.h"
#include "wheatstone/error.h"
#include "wheatstone/measures/painting_likeness.h"
#include "wheatstone/pictures/find_faces.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MeasurePaintingArguments {
  std::string photograph, painting;
};

struct MeasuredPainting {
  PaintingLikeness likeness;
  std::optional<std::vector<double>> faces;  ///< none: they cannot be looked for
};

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Json to_json(const MeasuredPainting& measured) {
  const PaintingLikeness& likeness = measured.likeness;
  Json facts{{"gms", likeness.gms},     {"gms_detail", likeness.gms_detail}, {"lab", likeness.lab},
             {"grain", likeness.grain}, {"streaks", likeness.streaks},       {"faces", nullptr}};
  if (measured.faces) {
    facts["faces"] = {{"count", measured.faces->size()}, {"gms", nullptr}, {"each", *measured.faces}};
    if (!measured.faces->empty()) facts["faces"]["gms"] = mean_of(*measured.faces);
  }
  return facts;
}

std::string text_of_faces(const std::optional<std::vector<double>>& faces) {
  if (!faces) return "not looked for: the package opencv-data is not installed";
  if (faces->empty()) return "none found";
  return fmt::format("{:.3f}, mean of {}", mean_of(*faces), faces->size());
}

void print_table(const MeasuredPainting& measured, const Session& session) {
  const auto line = [&session](const char* name, const std::string& value) {
    fmt::print(session.output, "{:<38}{}\n", name, value);
  };
  const PaintingLikeness& likeness = measured.likeness;
  line("gradient similarity (1: equal)", fmt::format("{:.3f}", likeness.gms));
  line("  in the most detailed tenth", fmt::format("{:.3f}", likeness.gms_detail));
  line("  in faces", text_of_faces(measured.faces));
  line("colour distance, CIE L*a*b*", fmt::format("{:.2f}", likeness.lab));
  line("grain, in L*", fmt::format("{:.2f}", likeness.grain));
  line("streaks (0..1)", fmt::format("{:.2f}", likeness.streaks));
}

void run_measure_painting(const MeasurePaintingArguments& arguments, const Session& session) {
  const Image<Rgb8> photograph = read_image(arguments.photograph), painting = read_image(arguments.painting);
  MeasuredPainting measured;
  try {
    measured.likeness = measure_likeness(photograph, painting);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", arguments.painting, error.what()));
  }
  if (const auto faces = find_faces(photograph)) measured.faces = measure_faces(photograph, painting, *faces);
  if (session.json) {
    print_facts(to_json(measured), session);
  } else {
    print_table(measured, session);
  }
}

}  // namespace

void add_measure_painting(CLI::App& measure, const Session& session) {
  auto arguments = std::make_shared<MeasurePaintingArguments>();
  CLI::App& command = *measure.add_subcommand("painting", "Measure how much of a photograph its painting keeps");
  command.fallthrough();
  command.add_option("PHOTO", arguments->photograph, "The photograph")->required();
  command
      .add_option("PAINTING", arguments->painting,
                  "The painting, of the same shape; a larger one is reduced to the photograph's size")
      ->required();
  command.footer(
      "A photograph that is blurred a little is like itself: judge likeness together with grain and streaks, which\n"
      "paint leaves.\n\n"
      "Example:\n"
      "  wheatstone paint still/left.png still/right.png -o painted\n"
      "  wheatstone paint painted/painting.wst --scale 3 -o large\n"
      "  wheatstone measure painting still/left.png large/left.png");
  command.callback([arguments, &session] { run_measure_painting(*arguments, session); });
}

}  // namespace wheatstone::cli
