// What a folder holds, and how one goes through it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "command_table.h"
#include "folder_items.h"
#include "script.h"
#include "temporary_folder.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer::folder_test {

using testing::HasSubstr;

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still({.width = 96, .height = 64, .samples_a_side = 1});
  return made;
}

/// A folder of two stereo files, a pair, one picture with a depth map, a painting, and what is none of these.
class Folder : public testing::Test {
 protected:
  Folder() {
    const StereoPair& pair = still().pictures;
    for (const char* name : {"tree10.jps", "tree2.jps"}) write_jps(folder / name, pair.left, pair.right);
    write_image(folder / "Barn_L.png", pair.left);
    write_image(folder / "Barn_R.png", pair.right);
    write_image(folder / "well.png", pair.left);
    write_image(folder / "well_depth.png", pair.left);
    write_painting(folder / "yard.wst", plan_painting(pair, still().geometry, {}));
    write_whole_file(folder / "notes.txt", "no picture");
    write_image(folder / ".hidden.png", pair.left);
    viewer.set_viewport({96, 64});
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  void open(const std::string& name) {
    viewer.open_all({name.empty() ? folder / "" : folder / name});
    viewer.wait();
  }
  std::string name() const { return open_item(viewer.session())->front().filename().string(); }
  std::string place() const { return place_told(viewer.session()); }

  const TemporaryFolder folder;
  Viewer viewer;
};

TEST_F(Folder, HoldsItsPhotographsAndPaintingsAsPeopleSortThem) {
  const std::vector<Item> expected{{folder / "Barn_L.png", folder / "Barn_R.png"},
                                   {folder / "tree2.jps"},
                                   {folder / "tree10.jps"},
                                   {folder / "well.png"},
                                   {folder / "yard.wst"}};
  EXPECT_EQ(items_in(folder / ""), expected);
  EXPECT_EQ(place_among(expected, {folder / "Barn_R.png"}), 0u);
  EXPECT_FALSE(place_among(expected, {folder / "notes.txt"}));
}

TEST(NamesOfFiles, AreSortedByTheNumbersInThem) {
  const std::vector<std::string> sorted{"a1.png", "A2.png", "a002b.png", "a10.png", "a010.png1", "b.png", "b1.png"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_FALSE(comes_before(sorted[i], sorted[i]));
    for (std::size_t j = i + 1; j < sorted.size(); ++j) {
      EXPECT_TRUE(comes_before(sorted[i], sorted[j])) << sorted[i] << ' ' << sorted[j];
      EXPECT_FALSE(comes_before(sorted[j], sorted[i])) << sorted[i] << ' ' << sorted[j];
    }
  }
}

TEST_F(Folder, IsWalkedFromTheFileThatIsOpen) {
  open("tree2.jps");
  EXPECT_EQ(place(), "2 of 5");
  run("next-file");
  EXPECT_EQ(name(), "tree10.jps");
  EXPECT_EQ(viewer.session().opened.kind, "photograph");
  run("next-file");
  run("next-file");
  EXPECT_EQ(name(), "yard.wst");
  EXPECT_EQ(viewer.session().opened.kind, "painting");
  run("next-file");
  EXPECT_EQ(name(), "Barn_L.png");
  EXPECT_EQ(viewer.session().opened.kind, "photograph") << "with its right eye";
  EXPECT_EQ(place(), "1 of 5");
  run("previous-file");
  EXPECT_EQ(place(), "5 of 5");
  EXPECT_EQ(viewer.session().items.size(), 1u) << "what was walked past was not asked for";
  EXPECT_THAT(state_json(viewer), HasSubstr("\"place\":\"5 of 5\""));
}

TEST_F(Folder, IsWalkedQuicklyPastFilesThatCannotBeOpened) {
  write_whole_file(folder / "tree3.jps", "damaged");
  open("tree2.jps");
  run("next-file");
  EXPECT_TRUE(viewer.session().message_is_error);
  EXPECT_EQ(place(), "3 of 6");
  for (int i = 0; i < 7; ++i) run_line(viewer, "next-file");  // faster than they are opened
  viewer.wait();
  EXPECT_EQ(name(), "tree10.jps");
  EXPECT_FALSE(viewer.session().message_is_error);
}

TEST_F(Folder, ChangesWhileItIsWalked) {
  open("tree2.jps");
  viewer.collect();  // begins to read ahead
  write_image(folder / "tree10.jps.png", still().pictures.left);
  std::filesystem::remove(folder / "tree10.jps");
  write_painting(folder / "tree3.wst", plan_painting(still().pictures, still().geometry, {}));
  open("tree2.jps");
  EXPECT_EQ(place(), "2 of 6");
  run("next-file");
  EXPECT_EQ(name(), "tree3.wst");
}

TEST_F(Folder, ShowsWhatWasReadAheadOnlyWhereItIsStillTheSame) {
  open("tree2.jps");
  const auto read_ahead = [this] {
    for (int i = 0; i < 200; ++i) {
      viewer.collect();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  };
  read_ahead();
  write_jps(folder / "tree10.jps", still().pictures.left, still().pictures.left);
  std::filesystem::last_write_time(folder / "tree10.jps",
                                   std::filesystem::file_time_type::clock::now() + std::chrono::hours(1));
  run("next-file");
  run("compare photograph");
  const Image<Rgb8> changed = viewer.frame()->picture;
  Viewer other;
  other.set_viewport({96, 64});
  other.open_all({folder / "tree10.jps"});
  other.wait();
  run_line(other, "compare photograph");
  other.wait();
  EXPECT_EQ(changed, other.frame()->picture);
  read_ahead();
  run("next-file");
  EXPECT_EQ(name(), "well.png");
  EXPECT_EQ(viewer.session().opened.kind, "picture");
}

TEST_F(Folder, IsOpenedAtItsFirstPhotograph) {
  open("");
  EXPECT_EQ(name(), "Barn_L.png");
  EXPECT_EQ(place(), "1 of 5");
  const TemporaryFolder empty;
  viewer.open_all({empty / ""});
  viewer.wait();
  EXPECT_THAT(viewer.session().message, HasSubstr("holds no photographs, no paintings and no numbered frames"));
}

TEST(FolderOfFrames, IsAFilm) {
  const TemporaryFolder folder;
  for (const char* name : {"left_001.png", "left_002.png"}) write_image(folder / name, still().pictures.left);
  for (const char* name : {"right_001.png", "right_002.png"}) write_image(folder / name, still().pictures.right);
  EXPECT_TRUE(holds_film(folder / ""));
  Viewer viewer;
  viewer.set_viewport({96, 64});
  viewer.open_all({folder / ""});
  viewer.wait();
  EXPECT_EQ(viewer.session().opened.kind, "film");
  const TemporaryFolder one;
  write_image(one / "frame_001.png", still().pictures.left);
  EXPECT_FALSE(holds_film(one / ""));
}

TEST_F(Folder, IsShownByASlideshow) {
  open("tree2.jps");
  run_line(viewer, "slideshow 0.1");
  const auto begin = std::chrono::steady_clock::now();
  while (place() != "4 of 5" && std::chrono::steady_clock::now() - begin < std::chrono::seconds(20)) {
    viewer.collect();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(place(), "4 of 5");
  EXPECT_GT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(200));
  run("leave");
  EXPECT_EQ(viewer.session().slideshow_s, 0);
}

TEST_F(Folder, IsNotWalkedWhereFilesWereGivenTogether) {
  viewer.open_all({folder / "yard.wst", folder / "tree2.jps", folder / "well.png"});
  viewer.wait();
  EXPECT_EQ(place(), "1 of 3");
  run("next-file");
  EXPECT_EQ(name(), "tree2.jps");
  run_command(viewer, find_command("open"), {folder / "tree2.jps"});
  viewer.wait();
  EXPECT_EQ(place(), "2 of 5");
}

}  // namespace wheatstone::viewer::folder_test
