#include "wheatstone/files/output_paths.h"

#include <gtest/gtest.h>

#include <array>

#include "temporary_folder.h"
#include "throws_error.h"

namespace wheatstone::output_paths_test {

namespace fs = std::filesystem;

TEST(InputGuard, RefusesAnInputUnderAnyOfItsNames) {
  const TemporaryFolder folder;
  put_bytes(folder / "left.png", "left");
  put_bytes(folder / "right.png", "right");
  fs::create_symlink("right.png", folder / "link.png");
  fs::create_hard_link(folder / "right.png", folder / "second.png");
  const std::array<fs::path, 3> inputs{"", folder / "left.png", folder / "right.png"};
  fs::create_directory_symlink(".", folder / "here");
  for (const char* name : {"right.png", "link.png", "second.png", "./left.png", "here/left.png"})
    expect_error(ErrorKind::wrong_usage, std::string(name) + ": is the same file as the input",
                 [&] { check_not_an_input(folder / name, inputs); });
}

TEST(InputGuard, AllowsWhatIsNoInput) {
  const TemporaryFolder folder;
  put_bytes(folder / "left.png", "same bytes");
  put_bytes(folder / "other.png", "same bytes");
  const std::array<fs::path, 3> inputs{"", folder / "left.png", folder / "missing.png"};
  for (const char* name : {"other.png", "missing.png", "new.png"})
    EXPECT_NO_THROW(check_not_an_input(folder / name, inputs));
  EXPECT_NO_THROW(check_not_an_input("", inputs));
}

TEST(InputGuard, RefusesOneFileForTwoOutputs) {
  const TemporaryFolder folder;
  fs::create_symlink("page.html", folder / "link.html");
  const auto outputs = [&](const char* other) {
    return std::array<NamedOutput, 3>{
        {{"--output", folder / "page.html"}, {"--log", ""}, {"--element", folder / other}}};
  };
  for (const char* same : {"page.html", "./page.html", "no/../page.html", "link.html"})
    expect_error(ErrorKind::wrong_usage, "is the same file as that of --output",
                 [&] { check_distinct_outputs(outputs(same)); });
  EXPECT_NO_THROW(check_distinct_outputs(outputs("element.js")));
}

}  // namespace wheatstone::output_paths_test
