#include "wheatstone/calibration/rectify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "wheatstone/calibration/rectify_internal.h"
#include "wheatstone/calibration/rectifying_map_internal.h"
#include "wheatstone/calibration/rectifying_turn_internal.h"
#include "wheatstone/calibration/warp_picture_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/percentile.h"
#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {
namespace {

constexpr int least_features = 40;

cv::Size size_of(const StereoPair& pair) { return {pair.left.width(), pair.left.height()}; }

/// Every fifth match is kept aside to measure with.
struct SplitMatches {
  std::vector<FeatureMatch> deciding, measuring;
};

SplitMatches split(std::span<const FeatureMatch> matches) {
  SplitMatches result;
  for (std::size_t i = 0; i < matches.size(); ++i)
    (i % 5 == 2 ? result.measuring : result.deciding).push_back(matches[i]);
  return result;
}

std::vector<FeatureMatch> fitting(std::span<const FeatureMatch> matches, const RectifyingTurn& turn,
                                  double tolerance_px) {
  std::vector<FeatureMatch> result;
  for (const FeatureMatch& match : matches)
    if (miss_of(turn, match) <= tolerance_px) result.push_back(match);
  return result;
}

void check_features(const FeatureMatches& features) {
  const auto& [matches, left, right] = features;
  if (std::min(left, right) < least_features)
    throw Error(ErrorKind::bad_input,
                fmt::format("the {} picture has only {} distinct points, expected at least {}: it has too little "
                            "texture or is too blurred",
                            left < right ? "left" : "right", std::min(left, right), least_features));
  if (matches.size() < least_inliers)
    throw Error(ErrorKind::bad_input, fmt::format("of {} and {} distinct points only {} match, expected at least {}: "
                                                  "the two pictures do not show the same scene",
                                                  left, right, matches.size(), least_inliers));
}

void check_geometry(const EpipolarGeometry& geometry, std::size_t matches, const FeatureMatches& features,
                    bool must_decide_cameras) {
  const std::size_t inliers = geometry.inliers.size();
  if (!shows_one_scene(geometry, matches, features))
    throw Error(ErrorKind::bad_input, fmt::format("only {} of {} matched points (of {} and {} distinct points) fit one "
                                                  "epipolar geometry: the two pictures do not show the same scene",
                                                  inliers, matches, features.left_features, features.right_features));
  if (!must_decide_cameras) return;
  const int least_off_plane = std::max(12, static_cast<int>(0.02 * static_cast<double>(inliers)));
  if (geometry.off_plane < least_off_plane)
    throw Error(ErrorKind::bad_input,
                "the camera positions cannot be determined, because the scene is flat or too far away, or both "
                "pictures were taken from the same position: expected a pair with depth, or a calibration");
}

/// Points around the outline of a picture, where they are taken to; refuses what turns a picture beyond recognition.
std::vector<PicturePoint> rectified_outline(const RectifyingMap& map) {
  const double width = map.width, height = map.height;
  const std::vector<PicturePoint> outline{{0, 0},          {width / 2, 0},      {width, 0},  {width, height / 2},
                                          {width, height}, {width / 2, height}, {0, height}, {0, height / 2}};
  const cv::Matx33d homography(map.homography.data());
  std::vector<PicturePoint> places;
  std::vector<cv::Point2f> polygon;
  bool sane = true;
  for (const PicturePoint& point : outline) {
    const PicturePoint straight = straightened_place(map, point);
    sane = sane && homography(2, 0) * straight.x + homography(2, 1) * straight.y + homography(2, 2) > 0.2;
    places.push_back(rectified_place(map, point));
    polygon.emplace_back(static_cast<float>(places.back().x), static_cast<float>(places.back().y));
  }
  const double growth = cv::contourArea(polygon) / (width * height);
  if (!sane || !(growth > 0.4 && growth < 2.5))
    throw Error(ErrorKind::bad_input,
                "the cameras' directions differ too much, or the camera moved forwards: expected two cameras side by "
                "side that look in the same direction");
  return places;
}

double row_miss(const RectifyingTurn& turn, const FeatureMatch& match) {
  return std::abs(rectified_place(turn.left, match.left).y - rectified_place(turn.right, match.right).y);
}

/// Whether `better` brings matches that decided neither clearly closer to the same rows than `plain` does. Matches that
/// fit neither are wrong ones.
bool helps(const RectifyingTurn& better, const RectifyingTurn& plain, std::span<const FeatureMatch> held_out,
           double tolerance_px) {
  constexpr double clear_gain = 0.9;
  const double most_px = 8 * tolerance_px;
  double with = 0, without = 0;
  for (const FeatureMatch& match : held_out) {
    const double after = row_miss(better, match), before = row_miss(plain, match);
    if (std::min(after, before) > most_px) continue;
    with += std::min(after, most_px);
    without += std::min(before, most_px);
  }
  return with < clear_gain * without;
}

/// Settles what is left of the rows, with a smooth field where that helps.
RectifyingTurn settled(RectifyingTurn turn, const SplitMatches& matches, double tolerance_px) {
  settle_rows(turn, fitting(matches.deciding, turn, 1.5 * tolerance_px));
  RectifyingTurn smooth = turn;
  settle_rows_smoothly(smooth, fitting(matches.deciding, turn, 4 * tolerance_px));
  return helps(smooth, turn, matches.measuring, tolerance_px) ? smooth : turn;
}

/// The turn that explains the matches, with a distortion of the lenses where it is not enough and that helps: a
/// distortion that explains next to nothing would be bought with a needless turn.
RectifyingTurn find_turn(const EpipolarGeometry& geometry, const SplitMatches& matches, cv::Size size,
                         double tolerance_px) {
  const auto found = [&](LensModel lens, std::span<const FeatureMatch> from, double reach_px) {
    const RectifyingTurn first = find_rectifying_turn(from, size, lens);
    const std::vector<FeatureMatch> near = fitting(matches.deciding, first, reach_px);
    return near.size() < least_inliers ? first : find_rectifying_turn(near, size, lens);
  };
  const RectifyingTurn plain = found(LensModel::straight, geometry.inliers, 1.5 * tolerance_px);
  const RectifyingTurn plain_settled = settled(plain, matches, tolerance_px);
  const VerticalDisparity left_over =
      vertical_disparity(rectified_matches(plain, fitting(matches.measuring, plain, 8 * tolerance_px)));
  if (left_over.percentile_95_px <= 0.5 * tolerance_px) return plain_settled;
  // What straight lenses leave far off may be what a bent one explains.
  const RectifyingTurn radial =
      found(LensModel::radial, fitting(matches.deciding, plain, 24 * tolerance_px), 3 * tolerance_px);
  const RectifyingTurn radial_settled = settled(radial, matches, tolerance_px);
  return helps(radial_settled, plain_settled, matches.measuring, tolerance_px) ? radial_settled : plain_settled;
}

struct Estimate {
  RectifyingTurn turn;
  std::vector<FeatureMatch> deciding, measuring;
};

Estimate estimate(const StereoPair& pair, const RectifyOptions& options, const Progress& progress) {
  const cv::Size size = size_of(pair);
  const double tolerance = epipolar_tolerance_px(std::max(size.width, size.height));
  report(progress, "matching features", 0);
  const FeatureMatches features = match_features(pair.left, pair.right);
  check_features(features);
  report(progress, "estimating the cameras", 0.5);
  const SplitMatches matches = split(features.matches);
  EpipolarGeometry geometry = find_epipolar_geometry(matches.deciding, tolerance);
  // A lens that bends straight lines leaves few matches close to the lines of straight ones.
  constexpr double poor_lens = 4;
  if (!shows_one_scene(geometry, matches.deciding.size(), features))
    geometry = find_epipolar_geometry(matches.deciding, poor_lens * tolerance);
  check_geometry(geometry, matches.deciding.size(), features, options.cameras_must_be_decided);

  Estimate found;
  found.turn = find_turn(geometry, matches, size, tolerance);
  found.deciding = fitting(matches.deciding, found.turn, 1.5 * tolerance);
  if (found.deciding.size() < std::max<std::size_t>(least_inliers, geometry.inliers.size() / 2))
    throw Error(ErrorKind::bad_input,
                "no camera rotation brings matching points to the same rows: expected two cameras side by side that "
                "look in the same direction");
  // Wider than what decided, so that what fits badly is seen; without a limit wrong matches would be all that is seen.
  found.measuring = fitting(matches.measuring, found.turn, 4 * tolerance);
  return found;
}

/// What must be added to all disparities so that the farthest match's is not below 0, with some room for what is
/// farther still.
double shift_for(std::span<const FeatureMatch> matches, cv::Size size) {
  std::vector<double> disparities;
  for (const FeatureMatch& match : matches) disparities.push_back(match.left.x - match.right.x);
  const double room = std::max(2.0, 0.01 * size.width);
  const double least = percentile(std::move(disparities), 0.01);
  return least < 0 ? std::ceil(room - least) : 0;
}

/// Moves both turned pictures so that all that may be common to them begins at (0, 0); returns its size.
cv::Size fit_canvas(RectifyingTurn& turn) {
  const std::vector<PicturePoint> left = rectified_outline(turn.left), right = rectified_outline(turn.right);
  const auto common = [&](double PicturePoint::*axis) {
    const auto [left_low, left_high] = std::ranges::minmax(left, {}, axis);
    const auto [right_low, right_high] = std::ranges::minmax(right, {}, axis);
    return std::pair{std::floor(std::max(left_low.*axis, right_low.*axis)),
                     std::ceil(std::min(left_high.*axis, right_high.*axis))};
  };
  const auto [x_low, x_high] = common(&PicturePoint::x);
  const auto [y_low, y_high] = common(&PicturePoint::y);
  const cv::Matx33d move(1, 0, -x_low, 0, 1, -y_low, 0, 0, 1);
  follow_with(turn.left, move);
  follow_with(turn.right, move);
  return {std::max(static_cast<int>(x_high - x_low), 0), std::max(static_cast<int>(y_high - y_low), 0)};
}

/// The largest rectangle within `window` of the shape of `size`, around its middle.
cv::Rect2d of_shape(const cv::Rect& window, cv::Size size) {
  const double scale =
      std::min(static_cast<double>(window.width) / size.width, static_cast<double>(window.height) / size.height);
  const double width = scale * size.width, height = scale * size.height;
  return {window.x + (window.width - width) / 2, window.y + (window.height - height) / 2, width, height};
}

/// How far a photograph's upright sides lean in its rectified picture: columns a row.
double lean_of(const RectifyingMap& map) {
  const double width = map.width, height = map.height;
  double lean = 0;
  for (const double x : {0.0, width}) {
    const PicturePoint above = rectified_place(map, {x, 0}), below = rectified_place(map, {x, height});
    lean += (below.x - above.x) / (below.y - above.y) / 2;
  }
  return lean;
}

/// Where both cameras were rolled against the line that joins them, a turn of both cuts off four corners. Rows need the
/// turn, columns do not: the same shear of both pictures brings the photographs' sides upright again.
void keep_sides_upright(RectifyingTurn& turn) {
  constexpr double most = 0.035;  // two degrees, which are not seen as a distortion
  const double lean = std::clamp((lean_of(turn.left) + lean_of(turn.right)) / 2, -most, most);
  const cv::Matx33d shear(1, -lean, lean * turn.left.height / 2, 0, 1, 0, 0, 0, 1);
  follow_with(turn.left, shear);
  follow_with(turn.right, shear);
}

/// Crops both pictures to what both show.
Rectification cropped(RectifyingTurn turn, const RectifyOptions& options) {
  const cv::Size size(turn.left.width, turn.left.height);
  keep_sides_upright(turn);
  const cv::Rect window = covered_window(turn.left, turn.right, fit_canvas(turn));
  if (std::min(window.width, window.height) < least_rectified_side_px)
    throw Error(ErrorKind::bad_input, "the two rectified pictures have no common area");
  const cv::Rect2d kept = options.keep_size ? of_shape(window, size) : cv::Rect2d(window);
  const double scale = options.keep_size ? size.width / kept.width : 1;
  const cv::Matx33d move(scale, 0, -scale * kept.x, 0, scale, -scale * kept.y, 0, 0, 1);
  follow_with(turn.left, move);
  follow_with(turn.right, move);
  return {turn.left, turn.right, options.keep_size ? size.width : window.width,
          options.keep_size ? size.height : window.height};
}

}  // namespace

void check_rectifiable(const StereoPair& pair) {
  check_fits(pair);
  if (pair.left.width() < least_rectified_side_px || pair.left.height() < least_rectified_side_px)
    throw Error(ErrorKind::bad_input,
                fmt::format("the pictures are {}x{} pixels, expected at least {}x{}", pair.left.width(),
                            pair.left.height(), least_rectified_side_px, least_rectified_side_px));
  constexpr int most_side_px = 32766;  // OpenCV counts the pixels of a side in 16 bits
  if (std::max(pair.left.width(), pair.left.height()) > most_side_px)
    throw Error(ErrorKind::bad_input, fmt::format("the pictures are {}x{} pixels, expected at most {} on each side",
                                                  pair.left.width(), pair.left.height(), most_side_px));
}

bool shows_one_scene(const EpipolarGeometry& geometry, std::size_t matches, const FeatureMatches& features) {
  constexpr double least_share_of_matches = 0.5, least_share_of_features = 0.02;
  const auto inliers = static_cast<double>(geometry.inliers.size());
  const double asked_share = static_cast<double>(matches) / static_cast<double>(features.matches.size());
  return geometry.inliers.size() >= least_inliers && inliers >= least_share_of_matches * static_cast<double>(matches) &&
         inliers >= least_share_of_features * asked_share * std::min(features.left_features, features.right_features);
}

void match_colours(RectifiedPair& pair, std::span<const FeatureMatch> matches) {
  pair.colour = find_colour_transfer(pair.pictures.left, pair.pictures.right, matches);
  if (pair.colour) apply_colour_transfer(*pair.colour, pair.pictures.right);
}

StereoPair rectified(const StereoPair& photographs, const Rectification& how) {
  const cv::Size size(how.width, how.height);
  return {warped(photographs.left, how.left, size), warped(photographs.right, how.right, size)};
}

Image<Rgb16> rectified_left(ImageView<const Rgb16> photograph, const Rectification& how) {
  return warped(photograph, how.left, cv::Size(how.width, how.height));
}

RectifiedPair rectify(const StereoPair& photographs, const RectifyOptions& options, const Progress& progress) {
  check_rectifiable(photographs);
  Estimate found = estimate(photographs, options, progress);
  report(progress, "rectifying", 0.8);
  RectifiedPair result;
  result.shift_px = shift_for(rectified_matches(found.turn, found.deciding), size_of(photographs));
  follow_with(found.turn.right, cv::Matx33d(1, 0, -result.shift_px, 0, 1, 0, 0, 0, 1));
  const Rectification how = cropped(found.turn, options);
  result.pictures = rectified(photographs, how);
  result.rectification = how;
  const auto after = [&](std::span<const FeatureMatch> matches) {
    return rectified_matches({how.left, how.right, {}}, matches);
  };
  result.measured_matches = static_cast<int>(found.measuring.size());
  result.before = vertical_disparity(found.measuring);
  result.after = vertical_disparity(after(found.measuring));
  if (options.match_colour) match_colours(result, after(found.deciding));
  report(progress, "rectifying", 1);
  return result;
}

namespace {

/// Of its photograph's area, what lies under the rectified picture: the area within the line that its frame comes from.
double kept_area(const RectifyingMap& map, int width, int height) {
  constexpr int steps = 24;  // on each side
  const PicturePoint corners[]{{0, 0}, {1. * width, 0}, {1. * width, 1. * height}, {0, 1. * height}, {0, 0}};
  double twice = 0;
  PicturePoint last = photograph_place(map, corners[0]);
  for (int side = 0; side < 4; ++side) {
    for (int step = 1; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      const PicturePoint next = photograph_place(map, {std::lerp(corners[side].x, corners[side + 1].x, share),
                                                       std::lerp(corners[side].y, corners[side + 1].y, share)});
      twice += last.x * next.y - next.x * last.y;
      last = next;
    }
  }
  return std::abs(twice) / 2 / (static_cast<double>(map.width) * map.height);
}

}  // namespace

double kept_area(const Rectification& rectification) {
  const auto [left, right, width, height] = rectification;
  return std::min({kept_area(left, width, height), kept_area(right, width, height), 1.});
}

double epipolar_tolerance_px(int longer_side_px) { return std::max(1.0, longer_side_px / 1000.0); }

VerticalDisparity vertical_disparity(std::span<const FeatureMatch> matches) {
  std::vector<double> differences;
  for (const FeatureMatch& match : matches) differences.push_back(std::abs(match.left.y - match.right.y));
  if (differences.empty()) return {};
  return {percentile(differences, 0.5), percentile(differences, 0.95)};
}

}  // namespace wheatstone
