// What a frame of a painted film costs: against what OpenCV itself takes for that frame's matching and flow, both ways,
// on the same threads in the same run; and beside the core-seconds of Bukenberger et al. (2015), sec. 5.4. Core-seconds
// decide: other programs at work disturb them less than time.

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <string>
#include <vector>

#include "wheatstone/app/rotoscope.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::bench {
namespace {

constexpr int frames = 6;  ///< the first is not counted

std::vector<StereoPair> make_film() {
  SyntheticFilmOptions options;
  options.still = {.width = 1920, .height = 1080, .samples_a_side = 1};
  options.frames = 2 * frames;
  options.cut = 0;
  std::vector<StereoPair> film;
  for (int i = 0; i < frames; ++i) film.push_back(make_synthetic_film_frame(options, i).pictures);
  return film;
}

template <class Work>
double seconds(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void match_both_ways(const StereoPair& eyes) {
  constexpr int block = 3, disparities = 128;
  const auto one_way = [](const cv::Mat& a, const cv::Mat& b) {
    const auto matcher = cv::StereoSGBM::create(0, disparities, block, 8 * 3 * block * block, 32 * 3 * block * block, 1,
                                                63, 10, 100, 2, cv::StereoSGBM::MODE_SGBM_3WAY);
    cv::Mat disparity;
    matcher->compute(a, b, disparity);
  };
  cv::Mat left, right;
  cv::flip(as_mat(eyes.left), left, 1);
  cv::flip(as_mat(eyes.right), right, 1);
  one_way(as_mat(eyes.left), as_mat(eyes.right));
  one_way(right, left);
}

/// With the parameters of OpenCV's own sample, both ways at once.
void flow_both_ways(const StereoPair& before, const StereoPair& now) {
  cv::Mat a, b;
  cv::cvtColor(as_mat(before.left), a, cv::COLOR_RGB2GRAY);
  cv::cvtColor(as_mat(now.left), b, cv::COLOR_RGB2GRAY);
  const auto one_way = [](const cv::Mat& from, const cv::Mat& to) {
    constexpr double finer = 0.5, deviation = 1.2;
    constexpr int levels = 3, window = 15, iterations = 3, polynomial = 5;
    cv::Mat flow;
    cv::calcOpticalFlowFarneback(from, to, flow, finer, levels, window, iterations, polynomial, deviation, 0);
  };
  tbb::parallel_invoke([&] { one_way(a, b); }, [&] { one_way(b, a); });
}

/// What a film is painted with, and the most that it is to take of OpenCV's time.
struct Contender {
  std::string name;
  FlowMethod flow;
  MatchQuality quality;
  double limit;
};

struct Seconds {
  double elapsed = 0, of_cores = 0;
  template <class Work>
  void add(Work work) {
    const std::clock_t before = std::clock();
    elapsed += seconds(work);
    of_cores += static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  }
};

void measure(const std::vector<StereoPair>& film, const Contender& contender) {
  RotoscopeOptions options;
  options.flow = contender.flow;
  options.matching.size = match_options_for(contender.quality).size;
  options.at_half_size = contender.quality == MatchQuality::fast;
  RotoscopeState state;
  rotoscope_frame(film.front(), options, state);
  Seconds ours, opencv;
  RotoscopeTimes times;
  PaintingTimes painting;
  for (int i = 1; i < frames; ++i) {
    ours.add([&] {
      const RotoscopedFrame frame = rotoscope_frame(film[i], options, state);
      times.matching_s += frame.times.matching_s;
      times.central_s += frame.times.central_s;
      times.flow_s += frame.times.flow_s;
      painting.planning_s += frame.painting_times.planning_s;
      painting.rasterising_s += frame.painting_times.rasterising_s;
    });
    opencv.add([&] {
      match_both_ways(film[i]);
      flow_both_ways(film[i - 1], film[i]);
    });
  }
  constexpr double counted = frames - 1;
  const double ratio = ours.elapsed / opencv.elapsed, ratio_of_cores = ours.of_cores / opencv.of_cores;
  fmt::print(
      "{:12} {:.2f} s a frame (matching {:.2f}, central view {:.2f}, flow {:.2f}, planning {:.2f}, drawing {:.2f});\n"
      "             OpenCV's matching and flow, both ways, {:.2f} s: {:.2f} x\n"
      "             {:.2f} core-seconds a frame, OpenCV's {:.2f}: {:.2f} x, <= {:.2f} {}; the paper 960 to 1440\n",
      contender.name, ours.elapsed / counted, times.matching_s / counted, times.central_s / counted,
      times.flow_s / counted, painting.planning_s / counted, painting.rasterising_s / counted, opencv.elapsed / counted,
      ratio, ours.of_cores / counted, opencv.of_cores / counted, ratio_of_cores, contender.limit,
      ratio_of_cores <= contender.limit ? "holds" : "does not hold");
}

}  // namespace
}  // namespace wheatstone::bench

/// The names of those to be measured may be given.
int main(int argc, char** argv) {
  using namespace wheatstone;
  const std::vector<bench::Contender> contenders{{"farneback", FlowMethod::farneback, MatchQuality::good, 2},
                                                 {"dis", FlowMethod::dis, MatchQuality::good, 0.65},
                                                 {"fast", FlowMethod::dis, MatchQuality::fast, 0.4}};
  const std::vector<std::string> names(argv + 1, argv + argc);
  fmt::print("Painted films, 1920x1080 an eye, strokes, after the first frame\n");
  const auto film = bench::make_film();
  for (const bench::Contender& contender : contenders)
    if (names.empty() || std::ranges::find(names, contender.name) != names.end()) bench::measure(film, contender);
}
