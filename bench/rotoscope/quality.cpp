// How steady painted films are, on a synthetic film with exact disparity and flow: strokes carried along the true and
// the estimated motion, the same frame by frame, and the film itself, by the same formulas.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/rotoscope.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::bench {
namespace {

constexpr int stereo_every = 8;

std::vector<SyntheticFilmFrame> make_film(int frames) {
  SyntheticFilmOptions options;
  options.still = {.width = 960, .height = 540, .samples_a_side = 2};
  options.frames = frames;
  std::vector<SyntheticFilmFrame> film;
  for (int i = 0; i < frames; ++i) film.push_back(make_synthetic_film_frame(options, i));
  return film;
}

FlowPair left_flow(std::span<const SyntheticFilmFrame> film, std::size_t to) {
  return {film[to - 1].to_next, film[to].to_previous};
}

struct Result {
  double temporal_error = 0;
  double left_right = 0;  ///< mean difference of the eyes, 0..255
  double bad_2 = 0;
  RotoscopeTotals totals;
};

void add_stereo(const StereoPair& pictures, const SyntheticFilmFrame& frame, Result& result, int& count) {
  const PairMeasures measures = measure_pair(pictures, frame.geometry.left_disparity);
  result.left_right += measures.difference.mean_absolute;
  result.bad_2 += measures.survival.bad_2;
  ++count;
}

Result measure_source(std::span<const SyntheticFilmFrame> film) {
  Result result;
  TemporalError error;
  int stereo = 0;
  for (std::size_t i = 0; i < film.size(); ++i) {
    if (i > 0) error.add(film[i - 1].pictures.left, film[i].pictures.left, relate_frames(left_flow(film, i)));
    if (i % stereo_every == 0) add_stereo(film[i].pictures, film[i], result, stereo);
  }
  result.temporal_error = error.mean();
  result.left_right /= stereo;
  result.bad_2 /= stereo;
  return result;
}

Result paint_film(std::span<const SyntheticFilmFrame> film, const RotoscopeOptions& options, bool truth) {
  Result result;
  RotoscopeState state;
  TemporalError error;
  int stereo = 0;
  Image<Rgb8> before;
  for (std::size_t i = 0; i < film.size(); ++i) {
    std::optional<KnownFrame> known;
    if (truth) known = KnownFrame{film[i].geometry, {}};
    if (truth && i > 0) known->flow = left_flow(film, i);
    RotoscopedFrame frame = rotoscope_frame(film[i].pictures, options, state, known ? &*known : nullptr);
    if (i > 0) error.add(before, std::get<StereoPair>(frame.pictures).left, relate_frames(left_flow(film, i)));
    if (i % stereo_every == 0) add_stereo(std::get<StereoPair>(frame.pictures), film[i], result, stereo);
    before = std::move(std::get<StereoPair>(frame.pictures).left);
  }
  result.temporal_error = error.mean();
  result.left_right /= stereo;
  result.bad_2 /= stereo;
  result.totals = state.totals;
  return result;
}

double survival(const RotoscopeTotals& totals) {
  return totals.whole_strokes > 0
             ? static_cast<double>(totals.survived_strokes) / static_cast<double>(totals.whole_strokes)
             : 0;
}

void print_row(std::string_view name, const Result& result) {
  fmt::print("  {:34} {:.5f}   {:6.2f}  {:.3f}", name, result.temporal_error, result.left_right, result.bad_2);
  if (result.totals.whole_strokes > 0)
    fmt::print("   {:5.1f} %  {:5}  {:.4f} %", 100 * survival(result.totals), result.totals.popped_strokes,
               100 * result.totals.worst_bare_share);
  fmt::print("\n");
  std::fflush(stdout);
}

const char* verdict(bool holds) { return holds ? "holds" : "does not hold"; }

void print_style(std::span<const SyntheticFilmFrame> film, std::string_view style, bool truth, double most_ratio,
                 double least_survival) {
  RotoscopeOptions options;
  options.style = style_by_name(style);
  const Result carried = paint_film(film, options, truth);
  options.anew = true;
  const Result anew = paint_film(film, options, truth);
  const char* motion = truth ? "true motion" : "estimated motion";
  print_row(fmt::format("{}, {}", style, motion), carried);
  print_row("  the same frame by frame", {anew.temporal_error, anew.left_right, anew.bad_2, {}});
  const double ratio = carried.temporal_error / anew.temporal_error;
  fmt::print("    temporal error {:.2f} x frame by frame, <= {:.1f} {}", ratio, most_ratio,
             verdict(ratio <= most_ratio));
  if (least_survival > 0)
    fmt::print("; survival >= {:.0f} % {}; bare 0 {}; popped 0 {}", 100 * least_survival,
               verdict(survival(carried.totals) >= least_survival), verdict(carried.totals.worst_bare_share == 0),
               verdict(carried.totals.popped_strokes == 0));
  fmt::print("\n");
}

void print_all(int frames) {
  const std::vector<SyntheticFilmFrame> film = make_film(frames);
  fmt::print(
      "Painted films, {} frames of 960x540 an eye, with a cut\n  {:34} E_warp    L - R   bad-2   carried  popped  "
      "bare\n",
      frames, "");
  print_row("film", measure_source(film));
  print_style(film, "impressionist", true, 0.4, 0.95);
  print_style(film, "impressionist", false, 0.6, 0.90);
  // These take longer: only the beginning.
  constexpr std::size_t most_frames = 10;
  const std::span<const SyntheticFilmFrame> beginning = std::span(film).first(std::min(film.size(), most_frames));
  for (const char* style : {"dual", "posterise", "mosaic", "diffusion"}) print_style(beginning, style, false, 1, 0);
}

}  // namespace
}  // namespace wheatstone::bench

/// The number of frames may be given.
int main(int argc, char** argv) { wheatstone::bench::print_all(argc > 1 ? std::atoi(argv[1]) : 40); }
