// How painted films hold where thin things move fast: the synthetic film of beams with motion blur, with either flow,
// against the film itself and against painting it frame by frame. Motion is the film's exact flow.

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "wheatstone/app/rotoscope.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::bench {
namespace {

std::vector<SyntheticFilmFrame> make_film(int frames) {
  SyntheticFilmOptions options;
  options.still.width = 640;
  options.still.height = 360;
  options.frames = frames;
  options.scene = FilmScene::beams;
  std::vector<SyntheticFilmFrame> film;
  for (int i = 0; i < frames; ++i) film.push_back(make_synthetic_film_frame(options, i));
  return film;
}

FramePair pair_to(const std::vector<SyntheticFilmFrame>& film, std::size_t frame) {
  return relate_frames(FlowPair{film[frame - 1].to_next, film[frame].to_previous});
}

double error_of_film(const std::vector<SyntheticFilmFrame>& film) {
  TemporalError error;
  for (std::size_t i = 1; i < film.size(); ++i)
    error.add(film[i - 1].pictures.left, film[i].pictures.left, pair_to(film, i));
  return error.mean();
}

struct PaintedFilm {
  double temporal_error = 0;
  std::vector<double> wrong;  ///< pixels of both eyes, a frame each
};

PaintedFilm paint_film(const std::vector<SyntheticFilmFrame>& film, const RotoscopeOptions& options) {
  PaintedFilm painted;
  RotoscopeState state;
  TemporalError error;
  Image<Rgb8> before;
  for (std::size_t i = 0; i < film.size(); ++i) {
    auto pictures = std::get<StereoPair>(rotoscope_frame(film[i].pictures, options, state).pictures);
    const double pixels = 2.0 * pictures.left.width() * pictures.left.height();
    painted.wrong.push_back(std::round(pixels * measure_wrong_spots(pictures, film[i].pictures).share));
    if (i > 0) error.add(before, pictures.left, pair_to(film, i));
    before = std::move(pictures.left);
  }
  painted.temporal_error = error.mean();
  return painted;
}

const char* verdict(bool holds) { return holds ? "holds" : "does not hold"; }

/// The most that the temporal error is to be of the film's own, 0: anything, and of that frame by frame.
struct Limits {
  double of_film, of_anew;
};

void print(std::string_view name, const PaintedFilm& painted, const PaintedFilm& anew, double film_error,
           const Limits& limits) {
  const double of_film = painted.temporal_error / film_error, of_anew = painted.temporal_error / anew.temporal_error;
  constexpr double most_wrong = 1.2;
  int over = 0;
  double wrong = 0, wrong_anew = 0;
  for (std::size_t i = 0; i < painted.wrong.size(); ++i) {
    over += painted.wrong[i] > most_wrong * anew.wrong[i] ? 1 : 0;
    wrong += painted.wrong[i];
    wrong_anew += anew.wrong[i];
  }
  const auto frames = static_cast<double>(painted.wrong.size());
  fmt::print("{:10} temporal error {:.5f}: {:.2f} x the film's own", name, painted.temporal_error, of_film);
  if (limits.of_film > 0) fmt::print(", <= {} {}", limits.of_film, verdict(of_film <= limits.of_film));
  fmt::print("; {:.2f} x frame by frame, <= {} {}\n", of_anew, limits.of_anew, verdict(of_anew <= limits.of_anew));
  fmt::print(
      "{:10} wrong pixels a frame {:.1f}, frame by frame {:.1f}; more than {} times as many in {} frames, 0 {}\n", "",
      wrong / frames, wrong_anew / frames, most_wrong, over, verdict(over == 0));
  std::fflush(stdout);
}

void print_all(int frames) {
  fmt::print("Painted films of fast beams, {} frames of 640x360 an eye\n", frames);
  const std::vector<SyntheticFilmFrame> film = make_film(frames);
  const double film_error = error_of_film(film);
  RotoscopeOptions options;
  options.anew = true;
  const PaintedFilm anew = paint_film(film, options);
  options.anew = false;
  print("dis", paint_film(film, options), anew, film_error, {2, 0.5});
  options.flow = FlowMethod::farneback;
  print("farneback", paint_film(film, options), anew, film_error, {0, 1});
}

}  // namespace
}  // namespace wheatstone::bench

/// The number of frames may be given.
int main(int argc, char** argv) { wheatstone::bench::print_all(argc > 1 ? std::atoi(argv[1]) : 24); }
