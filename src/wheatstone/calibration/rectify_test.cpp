#include "wheatstone/calibration/rectify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "scenes/still_life.h"
#include "shared_data.h"
#include "throws_error.h"
#include "wheatstone/calibration/rectifying_map_internal.h"
#include "wheatstone/calibration/warp_picture_internal.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/match_features.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/random.h"

namespace wheatstone::rectify_test {

/// How a picture was spoiled: turned and scaled around its middle, then moved, in our pixels.
struct Misalignment {
  double degrees = 0, scale = 1, right_px = 0, down_px = 0;

  cv::Matx33d matrix(cv::Size size) const {
    const double angle = degrees * std::numbers::pi / 180;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    const double x = size.width / 2.0, y = size.height / 2.0;
    return {c, -s, x + right_px - c * x + s * y, s, c, y + down_px - s * x - c * y, 0, 0, 1};
  }
};

constexpr Misalignment turned_right{1.7, 1.03, 0, 9};
constexpr Misalignment turned_left{-0.8, 1, 0, -3};

Image<Rgb8> misaligned(const Image<Rgb8>& picture, const Misalignment& how) {
  const cv::Matx33d half(1, 0, 0.5, 0, 1, 0.5, 0, 0, 1), back(1, 0, -0.5, 0, 1, -0.5, 0, 0, 1);
  const cv::Matx33d in_opencv = back * how.matrix({picture.width(), picture.height()}) * half;
  Image<Rgb8> result(picture.width(), picture.height());
  cv::Mat target = as_mat(result);
  cv::warpPerspective(as_mat(picture), target, in_opencv, target.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return result;
}

StereoPair misaligned(const StereoPair& pair) {
  return {misaligned(pair.left, turned_left), misaligned(pair.right, turned_right)};
}

/// True counterparts in the misaligned photographs, from what is known of the pair before.
std::vector<FeatureMatch> true_matches(const Image<float>& disparity) {
  const cv::Size size(disparity.width(), disparity.height());
  const cv::Matx33d left = turned_left.matrix(size), right = turned_right.matrix(size);
  const Image<std::uint8_t> visible = visible_in_both(disparity);
  std::vector<FeatureMatch> matches;
  for (int y = 0; y < size.height; y += 3) {
    for (int x = 0; x < size.width; x += 3) {
      if (visible(x, y) == 0) continue;
      matches.push_back({carried(left, {x + 0.5, y + 0.5}),
                         carried(right, {x + 0.5 - static_cast<double>(disparity(x, y)), y + 0.5})});
    }
  }
  return matches;
}

/// Where a rectification takes them.
std::vector<FeatureMatch> rectified(const std::vector<FeatureMatch>& matches, const RectifiedPair& pair) {
  const auto& [left, right, width, height] = pair.rectification.value();
  std::vector<FeatureMatch> result;
  for (const FeatureMatch& match : matches)
    result.push_back({rectified_place(left, match.left), rectified_place(right, match.right)});
  return result;
}

VerticalDisparity vertical(const std::vector<FeatureMatch>& matches) {
  std::vector<double> off;
  for (const FeatureMatch& match : matches) off.push_back(std::abs(match.left.y - match.right.y));
  std::ranges::sort(off);
  if (off.empty()) return {INFINITY, INFINITY};
  return {off[off.size() / 2], off[off.size() * 95 / 100]};
}

/// Share of the true matches that dense matching of the rectified pictures finds to 2 pixels.
double found_by_matching(const RectifiedPair& pair, const std::vector<FeatureMatch>& truth) {
  const Image<float> disparity = match(pair.pictures).geometry.left_disparity;
  double asked = 0, found = 0;
  for (const FeatureMatch& match : rectified(truth, pair)) {
    const int x = static_cast<int>(std::floor(match.left.x)), y = static_cast<int>(std::floor(match.left.y));
    const int there = static_cast<int>(std::floor(match.right.x));
    if (!disparity.contains(x, y) || !disparity.contains(there, y)) continue;
    ++asked;
    found += std::abs(static_cast<double>(disparity(x, y)) - (match.left.x - match.right.x)) <= 2 ? 1 : 0;
  }
  return found / asked;
}

void expect_rows_agree(const StereoPair& photographs, const Image<float>& disparity) {
  const StereoPair spoiled = misaligned(photographs);
  const std::vector<FeatureMatch> truth = true_matches(disparity);
  const VerticalDisparity before = vertical(truth);
  EXPECT_GT(before.median_px, 5);

  const RectifiedPair pair = rectify(spoiled);
  const VerticalDisparity after = vertical(rectified(truth, pair));
  testing::Test::RecordProperty("median_px", std::to_string(after.median_px));
  testing::Test::RecordProperty("percentile_95_px", std::to_string(after.percentile_95_px));
  EXPECT_LE(after.median_px, 0.5);
  EXPECT_LE(after.percentile_95_px, 1.5);

  // What it says of itself is near the truth.
  EXPECT_GE(pair.measured_matches, 20);
  EXPECT_NEAR(pair.before.median_px, before.median_px, 0.4 * before.median_px);
  EXPECT_NEAR(pair.after.median_px, after.median_px, 0.4);

  // Little is lost, and what is left can be matched as well as before, which the spoiled pair cannot.
  EXPECT_GT(pair.pictures.left.width(), photographs.left.width() * 3 / 4);
  EXPECT_GT(pair.pictures.left.height(), photographs.left.height() * 3 / 4);
  EXPECT_TRUE(same_size(pair.pictures.left, pair.pictures.right));
  EXPECT_GT(found_by_matching(pair, truth), 0.87);
  RectifiedPair untouched{spoiled};
  const int width = photographs.left.width(), height = photographs.left.height();
  const RectifyingMap as_it_is{.width = width, .height = height};
  untouched.rectification = Rectification{as_it_is, as_it_is, width, height};
  EXPECT_LT(found_by_matching(untouched, truth), 0.6);
}

const SyntheticStill& still() { return still_life(640, 480); }

std::filesystem::path shared(const std::string& name) { return shared_data() / "stereo" / name; }

TEST(Rectify, BringsTheStillLifeToTheSameRows) { expect_rows_agree(still().pictures, still().geometry.left_disparity); }

TEST(Rectify, BringsTeddyToTheSameRows) {
  if (!std::filesystem::exists(shared("teddy"))) GTEST_SKIP() << "no " << shared("teddy").string();
  expect_rows_agree({read_image(shared("teddy") / "left.png"), read_image(shared("teddy") / "right.png")},
                    read_disparity(shared("teddy") / "disp_left.png", 4.f));
}

TEST(RectifyLong, BringsAloeToTheSameRows) {
  if (!std::filesystem::exists(shared("aloe"))) GTEST_SKIP() << "no " << shared("aloe").string();
  const StereoPair spoiled =
      misaligned({read_image(shared("aloe") / "left.jpg"), read_image(shared("aloe") / "right.jpg")});
  const auto matched_anew = [](const StereoPair& pair) {
    return vertical(find_epipolar_geometry(match_features(pair.left, pair.right).matches, 4).inliers);
  };
  EXPECT_GT(matched_anew(spoiled).median_px, 5);
  const RectifiedPair pair = rectify(spoiled);
  const VerticalDisparity after = matched_anew(pair.pictures);
  RecordProperty("median_px", std::to_string(after.median_px));
  RecordProperty("percentile_95_px", std::to_string(after.percentile_95_px));
  EXPECT_LE(after.median_px, 0.5);
  EXPECT_LE(after.percentile_95_px, 1.5);
  EXPECT_GT(match(pair.pictures).left_found_share, 0.7);
}

TEST(Rectify, LeavesARectifiedPairAboutAsItIs) {
  const RectifiedPair pair = rectify(still().pictures);
  EXPECT_LT(pair.after.median_px, 0.5);
  EXPECT_GT(pair.pictures.left.width(), 600);
  EXPECT_GT(pair.pictures.left.height(), 450);
  EXPECT_EQ(pair.shift_px, 0);
}

TEST(Rectify, ShiftsWhatWouldHaveNegativeDisparities) {
  const SyntheticStill& converged = still_life(640, 480, 1, true);
  const RectifiedPair pair = rectify(converged.pictures);
  EXPECT_GT(pair.shift_px, 0);
  for (const FeatureMatch& match :
       find_epipolar_geometry(match_features(pair.pictures.left, pair.pictures.right).matches, 1).inliers)
    EXPECT_GT(match.left.x - match.right.x, -1);
}

double mean_difference(const StereoPair& pair) {
  const MatchedPair matched = match(pair);
  return measure_left_right_difference(pair, matched.geometry.left_disparity).mean_absolute;
}

TEST(Rectify, KeepsSidesUprightWhereBothCamerasAreRolledAlike) {
  const StereoPair& pair = still().pictures;
  // How far the photograph's left side leans in the rectified picture: columns a row.
  const auto lean = [](const RectifyingMap& map) {
    const PicturePoint above = rectified_place(map, {0, 0}), below = rectified_place(map, {0, 1. * map.height});
    return (below.x - above.x) / (below.y - above.y);
  };
  const auto rolled = [&](double degrees) {
    return rectify(StereoPair{misaligned(pair.left, {degrees}), misaligned(pair.right, {degrees})});
  };
  // A turn by so much would leave 0.93 of the area.
  const RectifiedPair little = rolled(1.6);
  EXPECT_LT(little.after.percentile_95_px, 1.5);
  EXPECT_NEAR(lean(little.rectification->left), 0, 0.006);
  EXPECT_GT(kept_area(*little.rectification), 0.95);
  // More than two degrees would be seen as a distortion: the rest is turned.
  const RectifiedPair much = rolled(12);
  EXPECT_LT(much.after.percentile_95_px, 1.5);
  EXPECT_GT(std::abs(lean(much.rectification->left)), 0.02);
}

TEST(Rectify, GivesBothEyesTheSameExposureAndColour) {
  StereoPair pair = still().pictures;
  const double as_photographed = mean_difference(pair);
  apply_colour_transfer({{0.78, 0.85, 0.70}, {1.15, 1.1, 1.2}}, pair.right);
  const RectifiedPair left_alone = rectify(pair, {.match_colour = false});
  const RectifiedPair matched = rectify(pair);
  EXPECT_FALSE(left_alone.colour);
  ASSERT_TRUE(matched.colour);
  EXPECT_GT(mean_difference(left_alone.pictures), as_photographed + 12);
  EXPECT_LT(mean_difference(matched.pictures), as_photographed + 3);
}

TEST(Rectify, RefusesWhatIsNoPairOfOneScene) {
  StereoPair other = still().pictures;
  cv::Mat mirrored = as_mat(other.right);
  cv::flip(mirrored, mirrored, 1);
  expect_error(ErrorKind::bad_input, "do not show the same scene", [&] { rectify(other); });
  const StereoPair blank{Image<Rgb8>(320, 240, {99, 99, 99}), Image<Rgb8>(320, 240, {99, 99, 99})};
  expect_error(ErrorKind::bad_input, "distinct points", [&] { rectify(blank); });
  expect_error(ErrorKind::bad_input, "320x240", [&] { rectify({still().pictures.left, blank.right}); });
  if (!std::filesystem::exists(shared("teddy"))) GTEST_SKIP() << "no " << shared("teddy").string();
  const StereoPair teddy{read_image(shared("teddy") / "left.png"), read_image(shared("teddy") / "right.png")};
  const StereoPair& small = still_life(450, 375).pictures;
  expect_error(ErrorKind::bad_input, "do not show the same scene", [&] { rectify({teddy.left, small.right}); });
}

TEST(Rectify, RefusesWhatDoesNotDecideTheCameras) {
  const auto refuses = [](const StereoPair& pair) {
    expect_error(ErrorKind::bad_input, "taken from the same position", [&] { rectify(pair); });
  };
  refuses({still().pictures.left, still().pictures.left});
  refuses({still().pictures.left, misaligned(still().pictures.left, {2, 1.01, 20, 8})});
}

TEST(RectifyLong, FollowsACalibration) {
  if (!std::filesystem::exists(shared("calibration"))) GTEST_SKIP() << "no " << shared("calibration").string();
  constexpr Checkerboard board{11, 7, 30};
  std::vector<PictureFiles> files;
  for (int i = 2; i <= 9; ++i) {
    const std::string rest = "_0" + std::to_string(i) + ".png";
    files.push_back({shared("calibration") / ("left" + rest), shared("calibration") / ("right" + rest)});
  }
  const StereoCalibration rig = calibrate(find_checkerboards(files, board), board).calibration;
  // A pair that the calibration has not seen: the board's corners are found anew in the rectified pictures.
  const StereoPair photographs{read_image(shared("calibration") / "left_01.png"),
                               read_image(shared("calibration") / "right_01.png")};
  const auto rows_differ = [&](const StereoPair& pair) {
    const BoardSighting seen = find_checkerboards(pair.left, pair.right, board);
    std::vector<FeatureMatch> corners;
    for (std::size_t i = 0; i < std::min(seen.left.size(), seen.right.size()); ++i)
      corners.push_back({seen.left[i], seen.right[i]});
    return vertical(corners);
  };
  EXPECT_GT(rows_differ(photographs).median_px, 2);
  const RectifiedPair pair = rectify(photographs, rig);
  EXPECT_LE(rows_differ(pair.pictures).median_px, 0.3);
  EXPECT_GT(pair.pictures.left.width(), photographs.left.width() / 2);
  EXPECT_FALSE(pair.rectification);
  expect_error(ErrorKind::bad_input, "expected the calibration's 1024x576", [&] { rectify(still().pictures, rig); });
}

TEST(CommonWindow, IsTheLargestRectangle) {
  cv::Mat mask(60, 80, CV_8UC1, cv::Scalar(0));
  EXPECT_TRUE(largest_rectangle_within(mask).empty());
  mask(cv::Rect(10, 5, 50, 40)).setTo(255);
  mask(cv::Rect(5, 20, 70, 10)).setTo(255);
  EXPECT_EQ(largest_rectangle_within(mask), cv::Rect(10, 5, 50, 40));
  mask.at<std::uint8_t>(24, 30) = 0;
  EXPECT_EQ(largest_rectangle_within(mask), cv::Rect(31, 5, 29, 40));
  mask.setTo(255);
  EXPECT_EQ(largest_rectangle_within(mask), cv::Rect(0, 0, 80, 60));
}

TEST(KeptArea, IsWhatTheFrameShowsOfThePhotograph) {
  Rectification all{{.width = 400, .height = 300}, {.width = 400, .height = 300}, 400, 300};
  EXPECT_NEAR(kept_area(all), 1, 1e-6);
  all.width = 200;  // half of it, without a turn
  EXPECT_NEAR(kept_area(all), 0.5, 1e-6);
  all.right.homography[0] = 2;  // the right eye's is drawn twice as wide: half of that is seen
  EXPECT_NEAR(kept_area(all), 0.25, 1e-6);
}

}  // namespace wheatstone::rectify_test
