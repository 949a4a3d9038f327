#include <fmt/format.h>

#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "wheatstone/error.h"
#include "wheatstone/measures/painting_likeness.h"
#include "wheatstone/pictures/find_faces.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::cli {
namespace {

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

std::string text_of_faces(const std::optional<std::vector<double>>& faces) {
  if (!faces) return "not looked for: the package opencv-data is not installed";
  if (faces->empty()) return "none found";
  return fmt::format("{:.3f}, mean of {}", mean_of(*faces), faces->size());
}

Report report_of(const MeasuredPainting& measured) {
  const PaintingLikeness& likeness = measured.likeness;
  const auto line = [](std::string_view name, std::string_view value) { return fmt::format("{:<38}{}", name, value); };
  Json faces;
  if (measured.faces) {
    faces = {{"count", measured.faces->size()}, {"gms", nullptr}, {"each", *measured.faces}};
    if (!measured.faces->empty()) faces["gms"] = mean_of(*measured.faces);
  }
  const std::string in_faces = line("  in faces", text_of_faces(measured.faces));
  return {{{"gms", likeness.gms, line("gradient similarity (1: equal)", fmt::format("{:.3f}", likeness.gms))},
           {"gms_detail", likeness.gms_detail,
            line("  in the most detailed tenth", fmt::format("{:.3f}", likeness.gms_detail)) + "\n" + in_faces},
           {"lab", likeness.lab, line("colour distance, CIE L*a*b*", fmt::format("{:.2f}", likeness.lab))},
           {"grain", likeness.grain, line("grain, in L*", fmt::format("{:.2f}", likeness.grain))},
           {"streaks", likeness.streaks, line("streaks (0..1)", fmt::format("{:.2f}", likeness.streaks))},
           {"faces", faces}}};
}

Report run_measure_painting(const MeasurePaintingArguments& arguments, const Session& /*session*/) {
  const auto [photograph, painting] = read_two_images(arguments.photograph, arguments.painting);
  MeasuredPainting measured;
  try {
    measured.likeness = measure_likeness(photograph, painting);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", arguments.painting, error.what()));
  }
  if (const auto faces = find_faces(photograph)) measured.faces = measure_faces(photograph, painting, *faces);
  return report_of(measured);
}

Rows measure_painting_rows(MeasurePaintingArguments& a) {
  return {row("PHOTO", required(text(a.photograph)), "The photograph"),
          row("PAINTING", required(text(a.painting)),
              "The painting, of the same shape; a larger one is reduced to the photograph's size")};
}

}  // namespace

Command measure_painting_command() {
  return make_command(
      "painting", "Measure how much of a photograph its painting keeps", measure_painting_rows, run_measure_painting,
      R"(A photograph that is blurred a little is like itself: judge likeness together with grain and streaks, which
paint leaves.

Example:
  wheatstone paint still/left.png still/right.png -o painted
  wheatstone paint painted/painting.wst --scale 3 -o large
  wheatstone measure painting still/left.png large/left.png)");
}

}  // namespace wheatstone::cli
