#include "wheatstone/motion/find_dissolve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

using Values = std::span<const float>;

// Between what dissolves of real films measure and pans, zooms, walks and changes of light (find_dissolve_test.cpp).
constexpr double least_difference = 15;       ///< between the two scenes: root mean square, in levels
constexpr double least_contrast = 8;          ///< of either scene, in levels, and …
constexpr double least_contrast_share = 0.3;  ///< … of the other scene's: less is a fade to black or white
constexpr double most_likeness = 0.95;        ///< correlation of the two scenes: more is one scene in another light
constexpr double most_unevenness = 0.12;      ///< by which a share may differ from one that grows evenly
constexpr double most_rest = 0.45;            ///< of a frame that is no mixture, as a share of the difference
/// Mean square of the slopes in the middle, of that at the ends: half in a mixture of two scenes, whose edges lie at
/// different places; all where one scene moves.
constexpr double most_detail = 0.68;

constexpr std::int64_t least_alone = 4;  ///< frames before and after a dissolve

double mean(Values values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

/// Root mean square of the differences from the mean.
double contrast(Values values) {
  const double middle = mean(values);
  double sum = 0;
  for (const float value : values) sum += (value - middle) * (value - middle);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double correlation(Values a, Values b) {
  const double of_a = mean(a), of_b = mean(b);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = a[i] - of_a, y = b[i] - of_b;
    ab += x * y, aa += x * x, bb += y * y;
  }
  return ab / std::sqrt(aa * bb + 1e-9);
}

/// A frame as a mixture of two: (1 - share) of the first, and of the second the share that leaves the least rest.
struct Mixture {
  double share = 0;
  double rest = 0;  ///< root mean square, of that of the difference of the two
};

/// `difference`: mean square of that.
Mixture mixture_of(Values frame, Values first, Values second, double difference) {
  double along = 0, squares = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double from_first = frame[i] - first[i];
    along += from_first * (second[i] - first[i]);
    squares += from_first * from_first;
  }
  const auto count = static_cast<double>(frame.size());
  const double share = along / count / difference;
  return {share, std::sqrt(std::max(squares / count / difference - share * share, 0.))};
}

double mean_square_difference(Values a, Values b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (b[i] - a[i]) * (b[i] - a[i]);
  return sum / static_cast<double>(a.size());
}

}  // namespace

/// Looks for dissolves in the frames of a scene, which count from 0 here.
class DissolvesOfScene {
 public:
  explicit DissolvesOfScene(std::span<const DissolveFinder::SmallFrame> frames) : frames_(frames) {}

  /// Longer ones first, none of which overlap.
  std::vector<FoundDissolve> find() const {
    std::vector<FoundDissolve> candidates;
    for (std::int64_t middle = 0; middle < count(); ++middle)
      if (const auto found = longest_around(middle)) candidates.push_back(*found);
    std::ranges::stable_sort(candidates, std::greater(), length);
    std::vector<FoundDissolve> dissolves;
    for (const FoundDissolve& candidate : candidates)
      if (std::ranges::none_of(dissolves, [&](const FoundDissolve& other) {
            return candidate.last_before <= other.first_after && other.last_before <= candidate.first_after;
          }))
        dissolves.push_back(candidate);
    for (FoundDissolve& dissolve : dissolves) dissolve = with_exact_ends(dissolve);
    // Another scene would have no frames of its own.
    std::erase_if(dissolves, [&](const FoundDissolve& dissolve) {
      return dissolve.last_before < least_alone - 1 || dissolve.first_after > count() - least_alone;
    });
    std::ranges::sort(dissolves, {}, &FoundDissolve::first_after);
    return dissolves;
  }

 private:
  static std::int64_t length(const FoundDissolve& dissolve) { return dissolve.first_after - dissolve.last_before; }
  std::int64_t count() const { return static_cast<std::int64_t>(frames_.size()); }
  Values at(std::int64_t frame) const { return frames_[static_cast<std::size_t>(frame)].colours; }

  std::optional<FoundDissolve> longest_around(std::int64_t middle) const {
    for (const std::int64_t half : {48, 40, 32, 26, 20, 16, 13, 10, 8, 6, 5, 4}) {
      const FoundDissolve candidate{middle - half, middle + half};
      if (candidate.last_before >= 0 && candidate.first_after < count() && is_dissolve(candidate)) return candidate;
    }
    return {};
  }

  bool is_dissolve(const FoundDissolve& candidate) const {
    const std::int64_t a = candidate.last_before, b = candidate.first_after;
    const Values first = at(a), second = at(b);
    const double difference = mean_square_difference(first, second);
    if (difference < least_difference * least_difference) return false;
    const auto detail = [&](std::int64_t frame) { return frames_[static_cast<std::size_t>(frame)].detail; };
    if (detail((a + b) / 2) > most_detail * (detail(a) + detail(b)) / 2) return false;
    const auto is_even_mixture = [&](std::int64_t frame) {
      const Mixture mixture = mixture_of(at(frame), first, second, difference);
      const double even = static_cast<double>(frame - a) / static_cast<double>(b - a);
      return mixture.rest < most_rest && std::abs(mixture.share - even) < most_unevenness;
    };
    if (!is_even_mixture((a + b) / 2) || correlation(first, second) > most_likeness) return false;
    const auto [less, more] = std::minmax({contrast(first), contrast(second)});
    if (less < std::max(least_contrast, least_contrast_share * more)) return false;
    for (std::int64_t frame = a + 1; frame < b; ++frame)
      if (!is_even_mixture(frame)) return false;
    return true;
  }

  /// A window around a dissolve is one, too, if it is little longer: shares are those of a ramp, whose ends are fitted.
  FoundDissolve with_exact_ends(const FoundDissolve& dissolve) const {
    const std::int64_t around = std::max<std::int64_t>(length(dissolve) / 4, 3);
    const std::int64_t from = std::max<std::int64_t>(dissolve.last_before - around, 0),
                       to = std::min(dissolve.first_after + around, count() - 1);
    const double difference = mean_square_difference(at(from), at(to));
    std::vector<double> shares;
    for (std::int64_t frame = from; frame <= to; ++frame)
      shares.push_back(mixture_of(at(frame), at(from), at(to), difference).share);
    FoundDissolve best = dissolve;
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t begin = from; begin <= dissolve.last_before + around; ++begin)
      for (std::int64_t end = std::max(begin + 4, dissolve.first_after - around); end <= to; ++end) {
        double squares = 0;
        for (std::int64_t frame = from; frame <= to; ++frame) {
          const double ramp = std::clamp(static_cast<double>(frame - begin) / static_cast<double>(end - begin), 0., 1.);
          const double off = shares[static_cast<std::size_t>(frame - from)] - ramp;
          squares += off * off;
        }
        if (squares >= least) continue;
        least = squares;
        best = {begin, end};
      }
    return best;
  }

  std::span<const DissolveFinder::SmallFrame> frames_;
};

void DissolveFinder::add(ImageView<const Rgb8> frame) {
  const cv::Mat whole = as_mat(frame);
  SmallFrame& kept = frames_.emplace_back();
  cv::Mat small, grey, to_right, down;
  cv::resize(whole, small, {columns, rows}, 0, 0, cv::INTER_AREA);
  cv::Mat colours(rows, columns, CV_32FC3, kept.colours.data());
  small.convertTo(colours, CV_32F);
  cv::resize(whole, small, {5 * columns, 5 * rows}, 0, 0, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_RGB2GRAY);
  grey.convertTo(grey, CV_32F);
  cv::subtract(grey.colRange(1, grey.cols), grey.colRange(0, grey.cols - 1), to_right);
  cv::subtract(grey.rowRange(1, grey.rows), grey.rowRange(0, grey.rows - 1), down);
  kept.detail = static_cast<float>(to_right.dot(to_right) + down.dot(down));
}

std::vector<FoundDissolve> DissolveFinder::end_scene() {
  std::vector<FoundDissolve> found = DissolvesOfScene(frames_).find();
  for (FoundDissolve& dissolve : found) {
    dissolve.last_before += first_;
    dissolve.first_after += first_;
  }
  first_ += static_cast<std::int64_t>(frames_.size());
  frames_.clear();
  return found;
}

}  // namespace wheatstone
