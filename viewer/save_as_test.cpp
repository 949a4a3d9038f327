// What is seen, saved in the formats of `wheatstone pack`.

#include "save_as.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "cli/run.h"
#include "command_line.h"
#include "command_table.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "viewer.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer::save_as_test {

using testing::HasSubstr;

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still({.width = 240, .height = 160, .samples_a_side = 1});
  return made;
}

class WhatIsSeen : public testing::Test {
 protected:
  WhatIsSeen() {
    write_painting(folder / "still.wst", plan_painting(still().pictures, still().geometry, {}));
    write_image(folder / "left.png", still().pictures.left);
    viewer.set_viewport({320, 200});
    open("still.wst");
  }
  void open(const char* name) {
    run_command(viewer, find_command("open"), {folder / name});
    viewer.wait();
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  /// Saves, and fails where that fails.
  void save(const char* format, const std::string& name, const Words& framing = {}) {
    Words words{format, folder / name};
    words.insert(words.end(), framing.begin(), framing.end());
    run_command(viewer, find_command("save-as"), words);
    viewer.wait();
    EXPECT_FALSE(viewer.take_failed_save()) << format << ": " << viewer.session().message;
  }
  void pack(std::vector<std::string> words, const std::string& name) {
    words.insert(words.begin(), {"pack", folder / "still.wst", "--quiet", "-o", folder / name});
    std::ostringstream output, errors;
    EXPECT_EQ(cli::run_command_line(words, output, errors), 0) << errors.str();
  }

  const TemporaryFolder folder;
  Viewer viewer;
};

TEST_F(WhatIsSeen, IsSavedAsPackWritesIt) {
  run("separation 1");
  run("zero-parallax 9");
  run("slice-depth 40%");
  for (const char* format : {"red-cyan", "left-right-half", "top-bottom", "even-odd-rows"}) {
    save(format, "seen.png");
    pack({"--to", format, "--zero-parallax", "9", "--slice-depth", "40%"}, "packed.png");
    EXPECT_EQ(read_image(folder / "seen.png"), read_image(folder / "packed.png")) << format;
  }
  for (const char* line : {"slice-keep front", "swap", "slice-depth -20px", "finest-layer 1"}) {
    run(line);
    run("mode left-right");
    save("left-right", "seen.png");
    Words words = words_of(command_line_of(viewer.session()));
    words.erase(words.begin());
    words.back() = folder / words.back();
    std::ostringstream output, errors;
    ASSERT_EQ(cli::run_command_line(words, output, errors), 0) << line << errors.str();
    EXPECT_EQ(read_image(folder / "seen.png"), read_image(words.back())) << line;
  }
  run("swap");
  run("finest-layer 1000");
  run("slice-keep back");
  run("slice-depth 40%");
  for (const char* ending : {"mpo", "jps", "exr"}) {
    save(ending, fmt::format("seen.{}", ending));
    pack({"--zero-parallax", "9", "--slice-depth", "40%"}, fmt::format("packed.{}", ending));
    EXPECT_EQ(read_whole_file(folder / fmt::format("seen.{}", ending), 1 << 26),
              read_whole_file(folder / fmt::format("packed.{}", ending), 1 << 26));
  }
}

TEST_F(WhatIsSeen, IsCroppedAndFramedAsPackDoesIt) {
  run("separation 1");
  run("zero-parallax 0");
  save("left-right", "seen.png", {"crop=4:3", "border=3%,black", "caption=Apples and {title}", "floating-window=5,7"});
  pack({"--to", "left-right", "--crop", "4:3", "--border", "3%,black", "--caption", "Apples and {title}",
        "--floating-window", "5,7"},
       "packed.png");
  EXPECT_EQ(read_image(folder / "seen.png"), read_image(folder / "packed.png"));
  save("card", "seen.pdf", {"caption=Apples"});
  EXPECT_TRUE(std::filesystem::exists(folder / "seen.pdf"));
}

TEST_F(WhatIsSeen, FollowsTheWindowsState) {
  run("separation 1");
  run("zero-parallax 0");
  save("left-right", "whole.png");
  run("swap");
  save("left-right", "swapped.png");
  save("right-left", "again.png");
  EXPECT_EQ(read_image(folder / "whole.png"), read_image(folder / "again.png"));
  EXPECT_NE(read_image(folder / "whole.png"), read_image(folder / "swapped.png"));
  run("swap");
  run("zero-parallax 9");
  save("left-right", "moved.png");
  EXPECT_EQ(read_image(folder / "moved.png").width(), 2 * (240 - 9));
  run("separation 0");
  run("zero-parallax 0");
  save("views", "pair");
  EXPECT_EQ(read_image(folder / "pair/view_000.png"), read_image(folder / "pair/view_001.png"));
}

TEST_F(WhatIsSeen, HasEveryFormatThatIsListed) {
  run("display looking-glass-portrait");
  run("screen step-9");
  for (const SaveFormat& format : save_formats()) {
    const std::string name = proposed_name_as(viewer.session(), format.name);
    save(std::string(format.name).c_str(), name);
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  EXPECT_EQ(quilt_of_name(proposed_name_as(viewer.session(), "quilt"))->layout.columns, 8);
  EXPECT_EQ(read_views(folder / "still.mpo").views.size(), 2u);
}

TEST_F(WhatIsSeen, IsNotWrittenOverItsFileAndNotWhereItHasOneView) {
  const std::string before = read_whole_file(folder / "still.wst", 1 << 26);
  const auto refused = [this](const char* format, const std::string& name, const char* option = "border=2%") {
    run_command(viewer, find_command("save-as"), {format, folder / name, option});
    viewer.wait();
    const std::optional<Error> failed = viewer.take_failed_save();
    return failed ? std::string(failed->what()) : std::string();
  };
  EXPECT_THAT(refused("mpo", "still.wst"), HasSubstr("still.wst"));
  EXPECT_EQ(read_whole_file(folder / "still.wst", 1 << 26), before);
  EXPECT_THAT(refused("smellovision", "a.png"), HasSubstr("smellovision"));
  EXPECT_THAT(refused("red-cyan", "a.gif"), HasSubstr("expected a name that ends in"));
  EXPECT_THAT(refused("jps", "a.jps", "border=thick"), HasSubstr("border"));
  EXPECT_THAT(refused("jps", "a.jps", "crop=9000x9000"), HasSubstr("crop"));
  EXPECT_THAT(refused("jps", "a.jps", "colour=red"), HasSubstr("colour"));
  EXPECT_THAT(refused("jps", "a.jps", "large"), HasSubstr("'large' is no option"));
  run("display desk-stereo");
  EXPECT_THAT(refused("quilt", "a.png"), HasSubstr("desk-stereo takes no quilts"));
  open("left.png");
  EXPECT_THAT(refused("jps", "a.jps"), HasSubstr("one view only"));
  EXPECT_EQ(proposed_name_as(viewer.session(), "picture"), "left_left.png");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.jps"));
}

}  // namespace wheatstone::viewer::save_as_test
