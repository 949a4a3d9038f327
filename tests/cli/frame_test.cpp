// What holds of every command: help, shared options, usage errors, output that cannot be written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_program.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::frame_test {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// What the dynamic linker says of the libraries that a run loads.
std::string libraries_of(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  const TemporaryFolder told;
  ::setenv("LD_DEBUG", "files", 1);
  ::setenv("LD_DEBUG_OUTPUT", (told / "by").c_str(), 1);
  const ProgramResult result = run_program(arguments, {.folder = folder / ".", .own_process = true});
  ::unsetenv("LD_DEBUG");
  ::unsetenv("LD_DEBUG_OUTPUT");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  std::string libraries;
  for (const auto& file : std::filesystem::directory_iterator(told / ".")) libraries += bytes_of(file.path());
  return libraries;
}

TEST(CommandLine, LoadsTheManyLibrariesOfRareFormatsForTheseOnly) {
  const TemporaryFolder folder;
  put_bytes(folder / "particles.txt", "x y z\n1 2 3\n4 5 7\n8 1 2\n");
  const std::string rendering =
      libraries_of(folder, {"render", "particles.txt", "--size", "32x24", "--views", "1", "-o", "views"});
  EXPECT_THAT(rendering, HasSubstr("libhdf5"));
  EXPECT_THAT(rendering, Not(HasSubstr("libOpenImageIO")));
  EXPECT_THAT(rendering, Not(HasSubstr("libgdal")));
  EXPECT_THAT(libraries_of(folder, {"info", "views/view_000.png"}), Not(HasSubstr("libOpenImageIO")));
  write_image(folder / "a.tif", Image<Rgb8>(4, 4));
  EXPECT_THAT(libraries_of(folder, {"info", "a.tif"}), HasSubstr("libOpenImageIO"));
}

TEST(CommandLine, ListsItsCommands) { EXPECT_THAT(commands(), Contains("info")); }

TEST(CommandLine, EveryCommandsHelpHasAnExampleAndTheSharedOptions) {
  for (const std::string& command : commands()) {
    const ProgramResult result = run_program({command, "--help"});
    EXPECT_EQ(result.exit_code, 0) << command;
    EXPECT_EQ(result.errors, "") << command;
    EXPECT_THAT(result.output, HasSubstr("\n  wheatstone " + command)) << command;
    EXPECT_THAT(result.output, HasSubstr("--threads")) << command;
  }
}

TEST(CommandLine, ShowsItsHelpWithoutArguments) {
  const auto result = run_program({});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output, run_program({"--help"}).output);
}

TEST(CommandLine, TellsItsVersion) {
  EXPECT_THAT(run_program({"--version"}).output, testing::StartsWith("wheatstone "));
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  expect_refused(folder, {"--quiet"}, 2, "no command given; see 'wheatstone --help'");
  expect_refused(folder, {"pain"}, 2, "pain: no such command; did you mean 'paint'? see 'wheatstone --help'");
  expect_refused(folder, {"x"}, 2, "x: no such command; see 'wheatstone --help'");
  expect_refused(folder, {"engrave", "--json"}, 2, "engrave: no such command; see 'wheatstone --help'");
  for (const std::string& command : commands()) {
    expect_refused(folder, {command, "--no-such-option"}, 2, "see 'wheatstone " + command + " --help'");
  }
  expect_refused(folder, {"--threads", "many", "info", "a.png"}, 2, "--threads");
  expect_refused(folder, {"info", "a.png", "--threads", "-1"}, 2, "--threads");
  expect_refused(folder, {"info", "a.png", "--verbose", "--quiet"}, 2, "excludes");
  expect_refused(folder, {"--threads", "1", "info", "a.png", "--threads", "2"}, 2,
                 "--threads: is given 2 times, expected once");
  expect_refused(folder, {"match", "a.png", "b.png", "--output"}, 2, "--output: is given without a value");
  expect_refused(folder, {"synth"}, 2, "synth: its kind is missing, expected film, model, still, universe");
  expect_refused(folder, {"synth", "stil"}, 2, "synth stil: no such kind; did you mean 'still'?");
  expect_refused(folder, {"synth", "water"}, 2, "synth water: no such kind, expected film, model, still, universe");
  expect_refused(folder, {"--config", "none.toml", "info", "a.png"}, 3, "--config: none.toml: cannot be read");
}

TEST(CommandLine, TakesSharedOptionsBeforeAndBehindTheCommand) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image<Rgb8>(4, 3));
  const std::string file = folder / "a.png";
  const std::string before = run_program({"--json", "--threads", "1", "info", file}).output;
  const std::string behind = run_program({"info", file, "--threads", "1", "--json"}).output;
  EXPECT_THAT(before, testing::StartsWith("{"));
  EXPECT_EQ(before, behind);
}

TEST(CommandLine, ReadsOptionsFromAFileAndRefusesUnknownOnes) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image<Rgb8>(4, 3));
  put_bytes(folder / "good.toml", "json = true\nthreads = 1\n");
  put_bytes(folder / "bad.toml", "jsn = true\n");
  put_bytes(folder / "bad_section.toml", "[info]\ncolour = true\n");
  const ProgramRun here = {.folder = folder / ""};
  EXPECT_THAT(run_program({"info", "a.png", "--config", "good.toml"}, here).output, testing::StartsWith("{"));
  expect_refused(folder, {"info", "a.png", "--config", "bad.toml"}, 2, "unknown option 'jsn'");
  expect_refused(folder, {"info", "a.png", "--config", "bad_section.toml"}, 2, "unknown option 'info.colour'");
  expect_refused(folder, {"info", "a.png", "--config", "missing.toml"}, 3, "missing.toml");
}

TEST(CommandLine, SaysThatItsOutputCannotBeWritten) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image<Rgb8>(4, 3));
  const std::vector<std::vector<std::string>> lines = {{"info", folder / "a.png"}, {"--help"}};
  for (const std::vector<std::string>& line : lines) {
    const ProgramResult result = run_program(line, {.standard_output = "/dev/full"});
    EXPECT_EQ(result.exit_code, 4) << line.front();
    EXPECT_EQ(result.errors, "wheatstone: standard output: cannot write\n");
  }
}

}  // namespace wheatstone::frame_test
