#include "wheatstone/photograph/write_views.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "psnr.h"
#include "scenes/test_photographs.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::write_views_test {

bool has_exiftool() { return std::system("exiftool -ver >/dev/null 2>&1") == 0; }

std::string told_by_exiftool(const std::string& arguments, const TemporaryFolder& folder) {
  const std::string output = folder / "told.txt";
  if (std::system(("exiftool " + arguments + " >" + output).c_str()) != 0) return "exiftool failed";
  return bytes_of(output);
}

TEST(WriteMpo, IsReadBackNearlyTheSame) {
  const TemporaryFolder folder;
  const StereoPair pair = still_for_test();
  const std::vector<ImageView<const Rgb8>> views{pair.left, pair.right, pair.left};
  write_mpo(folder / "a.mpo", views);
  const ViewsFile file = read_views(folder / "a.mpo");
  ASSERT_EQ(file.views.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(psnr_db(file.views[i], i == 1 ? pair.right : pair.left), 38);
  }
  EXPECT_LT(psnr_db(file.views[0], pair.right), 25) << "the measure must tell the eyes apart";
  // Programs that know nothing of MPO see the left view.
  EXPECT_EQ(read_image(folder / "a.mpo"), file.views[0]);
}

TEST(WriteMpo, IsSeenByOthersAsTwoViews) {
  if (!has_exiftool()) GTEST_SKIP() << "exiftool is not installed";
  const TemporaryFolder folder;
  const StereoPair pair = still_for_test();
  const std::vector<ImageView<const Rgb8>> views{pair.left, pair.right};
  write_mpo(folder / "a.mpo", views);
  const std::string file = folder / "a.mpo";
  EXPECT_EQ(told_by_exiftool("-s3 -MPFVersion -NumberOfImages -MPIndividualNum -MPImageType " + file, folder),
            "0100\n2\n1\nMulti-frame Disparity\n");
  EXPECT_EQ(told_by_exiftool("-s3 -warning -error " + file, folder), "");
  // The second picture, taken out by exiftool, is our right view.
  put_bytes(folder / "second.jpg", told_by_exiftool("-b -MPImage2 " + file, folder));
  EXPECT_EQ(read_image(folder / "second.jpg"), read_views(file).views[1]);
  EXPECT_EQ(told_by_exiftool("-s3 -MPIndividualNum " + (folder / "second.jpg").string(), folder), "2\n");
}

TEST(WriteJps, IsReadBackNearlyTheSameInEveryLayout) {
  const TemporaryFolder folder;
  const StereoPair pair = still_for_test();
  for (const LayoutTraits& traits : stereo_layouts()) {
    if (traits.arrangement != Arrangement::side_by_side && traits.arrangement != Arrangement::over_under) continue;
    SCOPED_TRACE(traits.name);
    const StereoLayout layout = traits.layout;
    write_jps(folder / "a.jps", pair.left, pair.right, layout);
    const ViewsFile file = read_views(folder / "a.jps");
    EXPECT_EQ(file.layout, layout);
    EXPECT_EQ(file.how_known, HowKnown::metadata);
    EXPECT_EQ(file.kind, "JPS");
    const double least_db = is_half_size(layout) ? 24 : 38;
    EXPECT_GE(psnr_db(file.views[0], pair.left), least_db);
    EXPECT_GE(psnr_db(file.views[1], pair.right), least_db);
    EXPECT_LT(psnr_db(file.views[1], pair.left), 22);
  }
}

TEST(WriteJps, IsSeenByOthersAsAJps) {
  if (!has_exiftool()) GTEST_SKIP() << "exiftool is not installed";
  const TemporaryFolder folder;
  const StereoPair pair = still_for_test(160, 120);
  write_jps(folder / "a.jps", pair.left, pair.right);
  EXPECT_EQ(told_by_exiftool("-s3 -JPSType -JPSLayout -JPSFlags " + (folder / "a.jps").string(), folder),
            "Stereo\nSide By Side\n(none)\n");
  write_jps(folder / "a.jps", pair.left, pair.right, StereoLayout::left_right_half);
  EXPECT_EQ(told_by_exiftool("-s3 -JPSFlags " + (folder / "a.jps").string(), folder), "Half width, Left field first\n");
}

TEST(WriteViews, RefusesWhatIsNoPair) {
  const TemporaryFolder folder;
  const Image<Rgb8> picture(20, 10), other(20, 12);
  const std::vector<ImageView<const Rgb8>> one{picture}, unlike{picture, other};
  expect_error(ErrorKind::wrong_usage, "1 views", [&] { write_mpo(folder / "a.mpo", one); });
  expect_error(ErrorKind::wrong_usage, "one size", [&] { write_mpo(folder / "a.mpo", unlike); });
  expect_error(ErrorKind::wrong_usage, "one size", [&] { write_jps(folder / "a.jps", picture, other); });
  expect_error(ErrorKind::cannot_read_write, "cannot write", [&] { write_jps("/dev/null/a.jps", picture, picture); });
  EXPECT_TRUE(folder.is_empty());
}

}  // namespace wheatstone::write_views_test
