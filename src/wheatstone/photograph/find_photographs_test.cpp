#include "wheatstone/photograph/find_photographs.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "scenes/exif_data.h"
#include "scenes/test_photographs.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/photograph/pairs_by_name_internal.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::find_photographs_test {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;
using Names = std::vector<std::string>;

/// "stem: left right depth" of each.
Names told(const std::vector<FoundPhotograph>& photographs) {
  Names names;
  for (const FoundPhotograph& one : photographs) {
    names.push_back(one.stem + ":");
    for (const fs::path& file : {one.left, one.right, one.depth})
      if (!file.empty()) names.back() += " " + file.generic_string();
  }
  return names;
}

PairsByName grouped(std::vector<fs::path> files) {
  std::ranges::sort(files);
  return pairs_by_name(files);
}

TEST(PairsByName, AreFoundInEveryFormOfNames) {
  const PairsByName found =
      grouped({"a_L.jpg", "a_R.jpg", "b-left.png", "b-right.png", "cleft.png", "cright.png", "d/left.png",
               "d/right.png", "e.l.tif", "e.r.tif", "f/L/x.png", "f/R/x.png", "Left/y/z.png", "Right/y/z.png"});
  EXPECT_THAT(told(found.photographs),
              UnorderedElementsAre("a: a_L.jpg a_R.jpg", "b: b-left.png b-right.png", "c: cleft.png cright.png",
                                   "d: d/left.png d/right.png", "e: e.l.tif e.r.tif", "f/x: f/L/x.png f/R/x.png",
                                   "y/z: Left/y/z.png Right/y/z.png"));
  EXPECT_THAT(found.left_out, IsEmpty());
  EXPECT_THAT(found.rest, IsEmpty());
}

TEST(PairsByName, OfDoubtfulPartnersAreLeftOut) {
  for (const std::vector<fs::path>& files :
       std::vector<std::vector<fs::path>>{{"a_L.png"},
                                          {"a_R.png", "b_L.png"},
                                          {"a_L.jpg", "a_L.png", "a_R.png"},
                                          {"a_L.png", "a_right.png"},
                                          {"a_L.png", "a-R.png"},
                                          {"disp_left.png", "disp_right.png"},
                                          {"left/a.png", "left/a.jpg", "right/a.png"},
                                          {"x/a_L.png", "y/a_R.png"}}) {
    const PairsByName found = grouped(files);
    EXPECT_THAT(found.photographs, IsEmpty()) << files.front();
    EXPECT_EQ(found.left_out.size(), files.size()) << files.front();
  }
}

TEST(PairsByName, LeaveNamesThatOnlyLookLikeThem) {
  const std::vector<fs::path> files{"a_R.mpo", "bright.jpg", "left/one.png", "tree_left_right.png", "pool.jpg"};
  const PairsByName found = grouped(files);
  EXPECT_THAT(found.rest, testing::UnorderedElementsAreArray(files));
}

TEST(PairsByName, GiveDepthMapsToTheirPictures) {
  const PairsByName found = grouped({"a.jpg", "a_depth.png", "b-depth.pfm", "b.png"});
  EXPECT_THAT(told(found.photographs), UnorderedElementsAre("a: a.jpg a_depth.png", "b: b.png b-depth.pfm"));
  EXPECT_EQ(grouped({"a_depth.png"}).left_out.size(), 1U);
  EXPECT_EQ(grouped({"a.jpg", "a.png", "a_depth.png"}).left_out.size(), 3U);
  EXPECT_EQ(grouped({"a.jpg", "a_depth.exr", "a_depth.png"}).left_out.size(), 3U);
  const PairsByName pair = grouped({"a_L.jpg", "a_R.jpg", "a_L_depth.png"});
  EXPECT_THAT(told(pair.photographs), ElementsAre("a: a_L.jpg a_R.jpg"));
  EXPECT_EQ(pair.left_out.size(), 1U);
}

TEST(FoundPhotographs, AreThoseThatFilesHold) {
  const TemporaryFolder folder;
  const StereoPair still = still_for_test(96, 72), other = still_for_test(80, 60);
  for (const char* below : {"below", ".hidden", "painted"}) fs::create_directory(folder / below);
  put_bytes(folder / "painted/painting.wst", "a painting");
  write_image(folder / "painted/left.png", still.left);
  write_image(folder / "painted/right.png", still.right);
  write_image(folder / ".hidden/a.png", still.left);
  const ImageView<const Rgb8> views[] = {still.left, still.right};
  write_mpo(folder / "a.mpo", views);
  write_image(folder / "a_L.png", still.left);
  write_image(folder / "a_R.png", still.right);
  write_image(folder / "b_L.png", still.left);
  write_image(folder / "b_R.png", other.right);
  write_image(folder / "below/c_sbs.png", joined(still.left, still.right, true));
  write_image(folder / "one.png", still.left);
  write_image(folder / "table_1.png", still.left);
  write_image(folder / "table_2.png", still.right);
  put_bytes(folder / "empty.jpg", "");
  put_bytes(folder / "notes.txt", "no picture");
  put_bytes(folder / "pairs.tsv", "table_1.png\ttable_2.png\r\n\n");

  const PhotographFolder found =
      find_photographs(folder / "", {.views = {}, .pairs = read_pair_table(folder / "pairs.tsv")});
  Names stems, left_out;
  for (const FoundPhotograph& one : found.photographs) stems.push_back(one.stem);
  EXPECT_THAT(stems, ElementsAre("a-mpo", "a-pair", "below/c_sbs", "table_1"));
  for (const LeftOutFile& one : found.left_out) {
    left_out.push_back(one.file.filename().string());
    EXPECT_EQ(one.error.has_value(), left_out.back() == "empty.jpg") << one.file;
  }
  EXPECT_THAT(left_out, ElementsAre("b_L.png", "b_R.png", "empty.jpg", "one.png", "painted"));
  EXPECT_THAT(found.left_out.front().reason, testing::HasSubstr("b_R.png has 80x60 pixels, this picture 96x72"));
}

TEST(FoundPhotographs, ArePairsByTheirTimeWhereTheyShowIt) {
  const TemporaryFolder folder;
  const StereoPair still = still_for_test(), other = still_for_test(480, 360, 3);
  const auto put = [&](const char* name, const Image<Rgb8>& picture, const char* taken) {
    write_image(folder / name, picture, {.title = {}, .taken = {}, .exif = exif_data("", taken)});
  };
  put("DSC1.jpg", still.right, "2020:05:01 10:00:00");  // the camera on the right is named first
  put("P7.jpg", still.left, "2020:05:01 10:00:01");
  put("DSC2.jpg", still.left, "2020:05:01 11:00:00");  // another scene
  put("P8.jpg", shared_pair("teddy").value_or(other).left, "2020:05:01 11:00:01");
  put("DSC3.jpg", still.left, "2020:05:01 12:00:00");  // twice the same picture
  put("P9.jpg", still.left, "2020:05:01 12:00:00");
  for (const char* name : {"b1.jpg", "b2.jpg", "b3.jpg"}) put(name, still.left, "2020:05:01 13:00:00");
  put("late.jpg", still.left, "2020:05:01 14:00:00");
  put("later.jpg", still.right, "2020:05:01 14:00:03");
  const PhotographFolder found = find_photographs(folder / "");
  ASSERT_EQ(found.photographs.size(), 1U);
  EXPECT_EQ(found.photographs[0].left.filename(), "P7.jpg");
  EXPECT_EQ(found.photographs[0].right.filename(), "DSC1.jpg");
  EXPECT_EQ(found.photographs[0].why, "pair with DSC1.jpg, by their time and what they show");
  EXPECT_EQ(found.left_out.size(), 9U);
  for (const LeftOutFile& file : found.left_out) EXPECT_FALSE(file.error) << file.file;
}

TEST(FoundPhotographs, MayDifferByAFewRows) {
  const TemporaryFolder folder;
  const StereoPair still = still_for_test(240, 180);
  write_image(folder / "a_L.png", still.left);
  Image<Rgb8> right(240, 177);
  for (int y = 0; y < 177; ++y) std::ranges::copy(still.right.row(y + 2), right.row(y).begin());
  write_image(folder / "a_R.png", right);
  const PhotographFolder found = find_photographs(folder / "");
  ASSERT_EQ(found.photographs.size(), 1U);
  EXPECT_THAT(found.photographs[0].why, testing::HasSubstr("240x180 and 240x177 pixels, framed to the common part"));
}

TEST(Folders, HoldPhotographsOrTheViewsOfOne) {
  const StereoPair still = still_for_test(96, 72);
  const auto holds = [&](const std::vector<std::pair<std::string, Image<Rgb8>>>& pictures) {
    const TemporaryFolder folder;
    for (const auto& [name, picture] : pictures) {
      fs::create_directories((folder / name).parent_path());
      write_image(folder / name, picture);
    }
    return holds_photographs(folder / "");
  };
  const Image<Rgb8> both = joined(still.left, still.right, true);
  EXPECT_FALSE(holds({{"left.png", still.left}, {"right.png", still.right}}));
  EXPECT_FALSE(holds({{"view_000.png", still.left}, {"view_001.png", still.right}}));
  EXPECT_FALSE(holds({{"1.png", still.left}, {"2.png", still.right}, {"3.png", still.right}}));
  EXPECT_TRUE(holds({{"a_L.png", still.left}, {"a_R.png", still.right}, {"b.png", still.right}}));
  EXPECT_TRUE(holds({{"one.png", both}, {"two.png", both}}));
  EXPECT_TRUE(holds({{"a_sbs.png", both}}));
  EXPECT_TRUE(holds({{"below/a.png", still.left}}));
  EXPECT_FALSE(holds({}));
}

TEST(FoundPhotographs, NeedAFolderWithPictures) {
  const TemporaryFolder folder;
  expect_error(ErrorKind::bad_input, "holds no picture", [&] { find_photographs(folder / ""); });
  put_bytes(folder / "notes.txt", "no picture");
  expect_error(ErrorKind::bad_input, "holds no picture", [&] { find_photographs(folder / ""); });
}

TEST(PairTable, RefusesBadLinesByTheirNumbers) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b", "c"}) put_bytes(folder / name, "x");
  for (const auto& [lines, part] :
       std::vector<std::pair<std::string, std::string>>{{"a\tb\nc", "pairs.tsv:2: expected LEFT, one tab and RIGHT"},
                                                        {"a\tb\tc", "pairs.tsv:1: expected"},
                                                        {"a\t", "pairs.tsv:1: expected"},
                                                        {"\na\tmissing", "pairs.tsv:2: "},
                                                        {"a\ta", "already stands in line 1"},
                                                        {"a\tb\nc\t./a", "pairs.tsv:2: "}}) {
    put_bytes(folder / "pairs.tsv", lines);
    expect_error(ErrorKind::bad_input, part, [&] { read_pair_table(folder / "pairs.tsv"); });
  }
}

}  // namespace wheatstone::find_photographs_test
