#include "wheatstone/matching/eye_order.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/plain_sgbm_opencv.h"

namespace wheatstone {
namespace {

/// Disparities of a copy that hold both ways; `own` is the view whose pixels are asked.
struct CheckedView {
  cv::Mat colours;         ///< CIE L*a*b*, 32-bit float
  Image<float> disparity;  ///< own x − other x; NaN where the other view does not confirm it
  cv::Mat frame;           ///< as `frame_of` has it
};

/// Large pictures are asked in a smaller copy, and small ones in a larger copy, since a step in depth of fewer pixels
/// than `least_step_px` hides too few to see their colour.
double asked_scale(int width_px, int height_px) {
  constexpr double asked_px = 400, largest = 3;
  return std::min({asked_px / width_px, std::max(1.0, asked_px / height_px), largest});
}

cv::Mat asked_copy(const Image<Rgb8>& picture, double scale) {
  return shrunk(as_mat(picture), scale, scale > 1 ? cv::INTER_CUBIC : cv::INTER_AREA);
}

/// 255 on what has the colour of a corner of the picture and goes on from there, and a little around it. It may be a
/// frame, as the mount of a card beside the rounded corners of its prints: a frame hides what is farther and cuts off
/// what is nearer, in both eyes.
cv::Mat frame_of(const cv::Mat& colours) {
  constexpr int window_px = 5, reach_px = 7;
  constexpr double like_colour = 6;
  cv::Mat even, reached(colours.rows + 2, colours.cols + 2, CV_8U, cv::Scalar(0));
  cv::blur(colours, even, {window_px, window_px});
  const int fill = 4 | (255 << 8) | cv::FLOODFILL_FIXED_RANGE | cv::FLOODFILL_MASK_ONLY;
  for (const int y : {0, colours.rows - 1})
    for (const int x : {0, colours.cols - 1})
      cv::floodFill(even, reached, {x, y}, {}, nullptr, cv::Scalar::all(like_colour), cv::Scalar::all(like_colour),
                    fill);
  cv::Mat frame = reached(cv::Rect(1, 1, colours.cols, colours.rows)).clone();
  cv::dilate(frame, frame, cv::getStructuringElement(cv::MORPH_RECT, {reach_px, reach_px}));
  return frame;
}

Image<float> confirmed(const Image<float>& own, const Image<float>& other) {
  constexpr float tolerance_px = 1;
  Image<float> kept = own;
  for (int y = 0; y < own.height(); ++y) {
    for (int x = 0; x < own.width(); ++x) {
      const float d = own(x, y);
      const int there = std::isnan(d) ? -1 : static_cast<int>(std::lround(static_cast<float>(x) - d));
      if (!own.contains(there, y) || !(std::abs(other(there, y) + d) <= tolerance_px))
        kept(x, y) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return kept;
}

/// A view's disparities, own x − other x, of the pair in a mirror.
Image<float> mirrored(const Image<float>& disparity) {
  Image<float> other(disparity.width(), disparity.height());
  for (int y = 0; y < disparity.height(); ++y)
    std::transform(disparity.row(y).rbegin(), disparity.row(y).rend(), other.row(y).begin(), std::negate<>());
  return other;
}

/// Mean colour of a run of a row.
cv::Vec3f mean_colour(const cv::Mat& colours, int y, int begin, int end) {
  cv::Vec3f sum{};
  for (int x = begin; x < end; ++x) sum += colours.at<cv::Vec3f>(y, x);
  return sum / static_cast<float>(std::max(end - begin, 1));
}

struct Votes {
  int farther = 0, nearer = 0;
};

/// One unconfirmed run [begin, end) of a row. Going by the disparities alone, what only this eye sees has the width of
/// the step; where the disparity falls to the right it is the other eye that sees more.
void vote(const CheckedView& view, int y, int begin, int end, Votes& votes) {
  constexpr float least_step_px = 3, least_difference = 12;
  constexpr int most_asked_px = 5;
  const int width = end - begin;
  const float step = view.disparity(end, y) - view.disparity(begin - 1, y);
  if (step < least_step_px || static_cast<float>(width) < 0.6f * step || static_cast<float>(width) > 1.6f * step + 2)
    return;
  // The outermost pixels mix both surfaces.
  const int asked = std::clamp(width / 2, 1, most_asked_px);
  if (begin - 1 - asked < 0 || end + 1 + asked > view.disparity.width()) return;
  const auto touches_frame = [&](int from, int to) {
    return cv::countNonZero(view.frame(cv::Range(y, y + 1), cv::Range(from, to))) > 0;
  };
  if (touches_frame(begin - 1 - asked, begin - 1) || touches_frame(end + 1, end + 1 + asked)) return;
  const cv::Vec3f left = mean_colour(view.colours, y, begin - 1 - asked, begin - 1);
  const cv::Vec3f right = mean_colour(view.colours, y, end + 1, end + 1 + asked);
  const cv::Vec3f band = mean_colour(view.colours, y, begin + width / 4, end - width / 4);
  const double to_left = cv::norm(band - left), to_right = cv::norm(band - right);
  if (cv::norm(left - right) < least_difference || std::abs(to_left - to_right) < least_difference / 2) return;
  // The lower disparity, the farther surface, is on the left.
  ++(to_left < to_right ? votes.farther : votes.nearer);
}

void vote(const CheckedView& view, Votes& votes) {
  for (int y = 0; y < view.disparity.height(); ++y) {
    int last_known = -1;
    for (int x = 0; x < view.disparity.width(); ++x) {
      if (std::isnan(view.disparity(x, y))) continue;
      if (last_known >= 0 && x - last_known > 2) vote(view, y, last_known + 1, x, votes);
      last_known = x;
    }
  }
}

}  // namespace

EyeOrderEvidence eye_order_evidence(const StereoPair& pair, const std::optional<DisparityRange>& within) {
  const double scale = asked_scale(pair.left.width(), pair.left.height());
  cv::Mat left, right;
  tbb::parallel_invoke([&] { left = asked_copy(pair.left, scale); }, [&] { right = asked_copy(pair.right, scale); });
  constexpr int least_side_px = 32;
  if (left.cols < least_side_px || left.rows < least_side_px) return {};
  DisparityRange range{-left.cols / 4, left.cols / 4};
  if (within)
    range = {std::max(static_cast<int>(std::floor(within->least * scale)), range.least),
             std::min(static_cast<int>(std::ceil(within->largest * scale)), range.largest)};
  if (range.least >= range.largest) return {};

  Votes votes;
  Image<float> forth, back;
  tbb::parallel_invoke([&] { forth = match_plain_sgbm(left, right, range); },
                       [&] {
                         back = match_plain_sgbm(right, left, {-range.largest, -range.least});
                       });
  const cv::Mat left_colours = cielab_of(left);
  vote({left_colours, confirmed(forth, back), frame_of(left_colours)}, votes);
  // The right view in a mirror is a left view.
  cv::flip(right, right, 1);
  const cv::Mat right_colours = cielab_of(right);
  vote({right_colours, confirmed(mirrored(back), mirrored(forth)), frame_of(right_colours)}, votes);

  EyeOrderEvidence evidence;
  evidence.bands = votes.farther + votes.nearer;
  if (evidence.bands > 0) evidence.for_order = static_cast<double>(votes.farther - votes.nearer) / evidence.bands;
  return evidence;
}

EyeOrder eye_order(const StereoPair& pair, const std::optional<DisparityRange>& within) {
  constexpr int least_bands = 60;
  constexpr double clearly = 0.3;
  const EyeOrderEvidence evidence = eye_order_evidence(pair, within);
  if (evidence.bands < least_bands || std::abs(evidence.for_order) < clearly) return EyeOrder::undecided;
  return evidence.for_order > 0 ? EyeOrder::as_given : EyeOrder::swapped;
}

}  // namespace wheatstone
