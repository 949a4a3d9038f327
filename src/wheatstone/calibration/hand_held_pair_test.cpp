// A pair as hand-held cameras take it, from the photographs to the place of every pixel's partner.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "shared_data.h"
#include "temporary_folder.h"
#include "wheatstone/calibration/prepare_pair.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/match_confidence.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/phone_camera.h"

namespace wheatstone::hand_held_pair_test {

Image<Rgb8> through_jpeg(const Image<Rgb8>& picture, const std::filesystem::path& path) {
  write_whole_file(path, encode_jpeg(picture, 85));
  return read_image(path);
}

/// Share of the left photograph's pixels whose partner is found more than 0.25 % of the width from where it is, of
/// those that are in the rectified picture and have a partner.
double share_off(const PhonePair& truth, const PreparedPair& prepared, const Image<float>& disparity) {
  const auto& [left, right, width, height] = prepared.rectification.value();
  int asked = 0, off = 0;
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x) {
      const PicturePoint here = photograph_place(left, {x + 0.5, y + 0.5});
      const int from_x = static_cast<int>(std::floor(here.x)), from_y = static_cast<int>(std::floor(here.y));
      if (!truth.left_to_right.x.contains(from_x, from_y)) continue;
      const auto flow_x = static_cast<double>(truth.left_to_right.x(from_x, from_y));
      const auto flow_y = static_cast<double>(truth.left_to_right.y(from_x, from_y));
      if (std::isnan(flow_x)) continue;
      const PicturePoint found = photograph_place(right, {x + 0.5 - static_cast<double>(disparity(x, y)), y + 0.5});
      ++asked;
      if (std::hypot(found.x - here.x - flow_x, found.y - here.y - flow_y) > 0.0025 * left.width) ++off;
    }
  EXPECT_GT(asked, disparity.width() * disparity.height() * 3 / 4);
  return static_cast<double>(off) / asked;
}

/// What a pair from a camera is expected to give without any options.
void expect_found_without_streaks(const StereoPair& pictures, const MatchedPair& matched) {
  const MatchConfidence confidence = measure_match(pictures, matched);
  testing::Test::RecordProperty("confidence",
                                fmt::format("found {:.3f} streaks {:.4f} colour {:.1f}", confidence.found_share,
                                            confidence.streak_share, confidence.colour_difference));
  EXPECT_GE(confidence.found_share, 0.85);
  EXPECT_LE(confidence.streak_share, 0.015);
  EXPECT_LE(confidence.colour_difference, 4);
  EXPECT_EQ(match_warning(confidence), "");
}

TEST(HandHeldPair, HasItsPartnersFound) {
  const TemporaryFolder folder;
  const PhonePair truth = make_phone_pair({.width = 800, .height = 600, .seed = 2, .samples_a_side = 1});
  const StereoPair photographs{through_jpeg(truth.pictures.left, folder / "left.jpg"),
                               through_jpeg(truth.pictures.right, folder / "right.jpg")};
  const PreparedPair prepared = prepare_pair(photographs);
  ASSERT_TRUE(prepared.rectification);
  EXPECT_GT(prepared.photographed_rows.value().median_px, 20);
  EXPECT_LT(prepared.rows.value().median_px, 0.4);
  const MatchedPair matched = match(prepared.pictures);
  expect_found_without_streaks(prepared.pictures, matched);
  const double rectified = share_off(truth, prepared, matched.geometry.left_disparity);
  RecordProperty("share_off", std::to_string(rectified));
  EXPECT_LE(rectified, 0.08);
}

TEST(HandHeldPairLong, OfOrdinaryStereoCamerasIsFoundWithoutStreaks) {
  for (const char* name : {"lens_adapter.mpo", "stereo_camera_sbs.jpg"}) {
    SCOPED_TRACE(name);
    const std::filesystem::path file = shared_data() / "photographs" / name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file.string();
    ViewsFile read = read_views(file);
    const PreparedPair prepared = prepare_pair({std::move(read.views[0]), std::move(read.views[1])});
    EXPECT_TRUE(prepared.rectification);
    expect_found_without_streaks(prepared.pictures, match(prepared.pictures));
  }
}

}  // namespace wheatstone::hand_held_pair_test
