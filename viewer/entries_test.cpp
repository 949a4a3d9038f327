// What menus, panels and the start page rest on: how commands are shown, and what a file is opened in.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command_table.h"
#include "folder_items.h"
#include "output_mode.h"
#include "style_previews.h"
#include "temporary_folder.h"
#include "viewer.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer::entries_test {

using testing::HasSubstr;

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still({.width = 240, .height = 160, .samples_a_side = 1});
  return made;
}

/// A viewer beside a painting, a photograph's two pictures, and particles.
class OpenedFiles : public testing::Test {
 protected:
  OpenedFiles() {
    write_painting(folder / "still.wst", plan_painting(still().pictures, still().geometry, {}));
    write_image(folder / "left.png", still().pictures.left);
    write_image(folder / "right.png", still().pictures.right);
    write_whole_file(folder / "particles.txt", "x y z\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n");
    viewer.set_viewport({240, 160});
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  void open(const char* file) {
    run_command(viewer, find_command("open"), {folder / file});
    viewer.wait();
  }
  const Session& session() const { return viewer.session(); }

  const TemporaryFolder folder;
  Viewer viewer;
};

TEST_F(OpenedFiles, AreNeverShownAsAnaglyphsUnasked) {
  open("still.wst");
  EXPECT_EQ(session().state.mode, "left");
  run("look-with red-cyan");
  EXPECT_EQ(session().state.mode, "red-cyan");
  open("particles.txt");
  EXPECT_EQ(session().state.mode, "red-cyan") << "who has said that he wears glasses is believed";
}

TEST_F(OpenedFiles, OfOneViewAreShownPlainlyAndNotInTheLastFilesMode) {
  run("look-with red-cyan");
  open("still.wst");
  open("left.png");
  EXPECT_EQ(session().state.mode, "left");
  EXPECT_THAT(session().message, HasSubstr("one view"));
  const Image<Rgb8> plain = viewer.frame()->picture;
  EXPECT_EQ(plain, still().pictures.left);
  run("mode red-cyan");
  EXPECT_EQ(viewer.frame()->picture, plain) << "an anaglyph of one view would be tinted";
  open("still.wst");
  EXPECT_EQ(session().state.mode, "red-cyan");
  EXPECT_EQ(session().message, "") << "it was said of another file";
}

TEST_F(OpenedFiles, OfParticlesDoNotTakeTheModeOfPhotographs) {
  open("still.wst");
  run("mode left-right-half");
  open("particles.txt");
  EXPECT_EQ(session().state.mode, "left");
  open("still.wst");
  EXPECT_EQ(session().state.mode, "left-right-half");
}

TEST_F(OpenedFiles, OfOneViewFindTheOther) {
  open("left.png");
  run("find-other-view");
  EXPECT_EQ(session().opened.kind, "photograph");
  EXPECT_EQ(*open_item(session()), (Item{folder / "left.png", folder / "right.png"}));
  std::filesystem::remove(folder / "right.png");
  open("left.png");
  run("find-other-view");
  EXPECT_THAT(session().message, HasSubstr("no picture beside left.png"));
}

TEST_F(OpenedFiles, HaveThumbnails) {
  for (const char* file : {"still.wst", "left.png"}) {
    const Image<Rgb8> small = thumbnail_of({folder / file}, {60, 60});
    EXPECT_EQ(small.width(), 60) << file;
    EXPECT_EQ(small.height(), 40) << file;
  }
  EXPECT_TRUE(thumbnail_of({folder / "particles.txt"}, {60, 60}).empty());
  EXPECT_TRUE(thumbnail_of({folder / "missing.png"}, {60, 60}).empty());
}

TEST_F(OpenedFiles, AreUnsavedOnlyWhereSomethingWasSetByHand) {
  open("still.wst");
  for (const char* line : {"mode left-right", "pan 3 4", "style mosaic", "slice", "full-screen"}) run(line);
  EXPECT_FALSE(session().has_unsaved_work);
  run("set tile 20");
  EXPECT_TRUE(session().has_unsaved_work);
  run_command(viewer, find_command("save-style"), {folder / "mine.toml"});
  EXPECT_FALSE(session().has_unsaved_work);
  run("depth-mapping comfortable");
  EXPECT_TRUE(session().has_unsaved_work);
  run_command(viewer, find_command("save-painting"), {folder / "mine.wst"});
  viewer.wait();
  EXPECT_FALSE(session().has_unsaved_work);
}

TEST_F(OpenedFiles, StayOpenWhenEscLeavesWhatCoversThem) {
  open("still.wst");
  run("full-screen");
  run("help");
  run("leave");
  EXPECT_FALSE(session().help);
  EXPECT_TRUE(session().full_screen);
  run("leave");
  EXPECT_FALSE(session().full_screen);
  run("leave");
  EXPECT_FALSE(session().ends);
}

TEST_F(OpenedFiles, GreyTheCommandsThatDoNothingToThem) {
  const auto applies_now = [this](const char* name) { return applies(viewer, find_command(name)); };
  EXPECT_TRUE(applies_now("open"));
  for (const char* name : {"mode", "slice", "orbit", "play-or-pause", "save-picture"})
    EXPECT_FALSE(applies_now(name)) << name;
  open("still.wst");
  for (const char* name : {"mode", "slice", "save-picture"}) EXPECT_TRUE(applies_now(name)) << name;
  for (const char* name : {"orbit", "play-or-pause", "find-other-view"}) EXPECT_FALSE(applies_now(name)) << name;
  open("particles.txt");
  EXPECT_TRUE(applies_now("orbit"));
  EXPECT_FALSE(applies_now("slice"));
}

/// What stands may be set again, and changes nothing: sliders and ticks show what is.
TEST_F(OpenedFiles, TakeBackWhatEntriesSayOfThem) {
  for (const char* file : {"still.wst", "particles.txt"}) {
    open(file);
    for (const Command& command : command_table()) {
      const Entry& entry = command.entry;
      if (entry.now == nullptr || command.arguments.empty() || !applies(viewer, command)) continue;
      const std::string now = entry.now(viewer);
      if (now == "auto" || command.name == "mode") continue;
      const ViewState before = session().state;
      run(fmt::format("{} {}", command.name, now));
      EXPECT_EQ(entry.now(viewer), now) << command.name;
      EXPECT_EQ(session().state.adjustment, before.adjustment) << command.name;
      EXPECT_EQ(session().state.slicing, before.slicing) << command.name;
    }
  }
}

TEST_F(OpenedFiles, TakeEveryChoiceThatAMenuHas) {
  open("still.wst");
  for (const Command& command : command_table()) {
    // A tracker's port and Bridge are not there.
    if (command.name == "head-tracker" || command.name == "screen" || !applies(viewer, command)) continue;
    for (const Choice& choice : choices_of(viewer, command)) {
      EXPECT_FALSE(choice.text.empty());
      const bool needs_lenses = choice.words == "lenticular";
      if (needs_lenses) continue;
      EXPECT_NO_THROW(run_line(viewer, fmt::format("{} {}", command.name, choice.words)));
    }
  }
  viewer.wait();
}

TEST(StyleParameters, HaveATitleEachThatNoOtherHas) {
  std::vector<std::string_view> titles;
  for (const StyleParameter& parameter : style_parameters()) {
    EXPECT_FALSE(parameter.title.empty()) << parameter.name;
    EXPECT_THAT(titles, testing::Not(testing::Contains(parameter.title)));
    titles.push_back(parameter.title);
  }
}

TEST(StylePreview, IsThePhotographInThatStyle) {
  const Photograph photograph{.pictures = still().pictures, .geometry = still().geometry};
  const Image<Rgb8> oil = preview_of(photograph, style_by_name("oil"), 120);
  EXPECT_EQ(oil.width(), 120);
  EXPECT_EQ(oil.height(), 80);
  EXPECT_EQ(oil, preview_of(photograph, style_by_name("oil"), 120));
  EXPECT_NE(oil, preview_of(photograph, style_by_name("mosaic"), 120));
}

}  // namespace wheatstone::viewer::entries_test
