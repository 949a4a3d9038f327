// Places of paintings whose colour their photographs have nowhere near: every style, both eyes, on pictures with known
// disparity, with our own disparity and with the true one.
//
//     bench_wrong_spots [STEREO_DATA [FOLDER [STYLE]]]
//
// FOLDER gets each painting with the left eye above the right one, and its wrong pixels in red.

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "painting/subject.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::bench {
namespace {

/// A style, and what it is to keep below.
struct Limit {
  std::string_view style;
  double spots_per_100000_px;
};
constexpr Limit limits[] = {{"oil", 5}, {"impressionist", 5}, {"dual", 2}, {"posterise", 2}, {"diffusion", 1.5}};
constexpr double most_share = 0.002;

void mark_wrong(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph, int first_row, Image<Rgb8>& drawing) {
  const Image<std::uint8_t> wrong = wrong_pixels(painted, photograph);
  for (int y = 0; y < painted.height(); ++y)
    for (int x = 0; x < painted.width(); ++x)
      drawing(x, first_row + y) = wrong(x, y) != 0 ? Rgb8{255, 0, 0} : painted(x, y);
}

void measure(const Subject& subject, const Limit& limit, bool matched, const std::filesystem::path& folder) {
  PaintPhotographOptions options;
  options.style = style_by_name(limit.style);
  if (!matched) options.left_disparity = subject.left_disparity;
  const StereoPair painted = paint_photograph(subject.photographs, options).painted.pictures;
  const WrongSpots spots = measure_wrong_spots(painted, subject.photographs);
  const bool fails = spots.spots_per_100000_px > limit.spots_per_100000_px || spots.share > most_share;
  const WrongSpots seen = measure_wrong_spots(painted, subject.photographs, ColourDistance::oklab);
  fmt::print("  {:14} {:8} {:6.2f} (at most {:3.1f})   {:.3f} %      {:6.2f}   {:.3f} %{}\n", limit.style,
             matched ? "our own" : "true", spots.spots_per_100000_px, limit.spots_per_100000_px, 100 * spots.share,
             seen.spots_per_100000_px, 100 * seen.share, fails ? "   over" : "");
  if (folder.empty()) return;
  const int width = painted.left.width(), height = painted.left.height();
  Image<Rgb8> drawing(width, 2 * height);
  mark_wrong(painted.left, subject.photographs.left, 0, drawing);
  mark_wrong(painted.right, subject.photographs.right, height, drawing);
  write_image(folder / fmt::format("{}_{}_{}.png", subject.name, limit.style, matched ? "own" : "true"), drawing);
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argument_count, char** arguments) {
  namespace bench = wheatstone::bench;
  const std::filesystem::path shared = argument_count > 1 ? arguments[1] : "../shared/data/stereo";
  const std::filesystem::path folder = argument_count > 2 ? arguments[2] : "";
  const std::string_view only_style = argument_count > 3 ? arguments[3] : "";
  std::vector<bench::Subject> subjects;
  wheatstone::SyntheticStill still = wheatstone::make_synthetic_still();
  subjects.push_back({"still", std::move(still.pictures), std::move(still.geometry.left_disparity)});
  if (auto teddy = bench::read_subject(shared / "teddy", 4.f)) subjects.push_back(std::move(*teddy));
  if (auto motorcycle = bench::read_subject(shared / "motorcycle", {})) subjects.push_back(std::move(*motorcycle));
  for (const bench::Subject& subject : subjects) {
    fmt::print(
        "\n{}\n  style          disparity  wrong spots a 100 000 px   share (at most {:.1f} %)   "
        "in OKLab\n",
        subject.name, 100 * bench::most_share);
    for (const bench::Limit& limit : bench::limits) {
      if (!only_style.empty() && limit.style != only_style) continue;
      for (const bool matched : {true, false}) bench::measure(subject, limit, matched, folder);
    }
  }
  return 0;
}
