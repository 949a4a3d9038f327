// Every example of the README, the documentation and --help is run, in a folder that holds the inputs that it names.

#include "cli/examples.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "cli/example_inputs.h"
#include "cli/run_program.h"

namespace wheatstone::examples_test {

namespace fs = std::filesystem;
using testing::IsEmpty;
using testing::SizeIs;
using Words = std::vector<std::string>;

/// What examples begin with that this test does not run, and why.
const std::map<std::string, std::string> not_run{
    {"make", "installs packages and builds; the continuous integration calls it"},
    {".ci/run", "builds and runs all tests, this one too"},
    {"cmake", "builds and installs; tests/install does so"},
    {"ctest", "runs all tests, this one too"},
    {"flatc", "is the FlatBuffers compiler; the build runs it on the same schema"},
    {"build/release/bin/wheatstone_stereo_test", "is a test program of its own"},
};

/// Whether the window, which needs Qt, was built.
constexpr bool has_window = WHEATSTONE_HAS_WINDOW;

/// Options in the documentation that are not the program's, and whose they are.
const std::map<std::string, std::string> options_of_others{
    {"--install", "cmake"},        {"--gtest_filter", "Google Test"}, {"--map-by", "mpirun"},     {"--array", "sbatch"},
    {"--cpus-per-task", "sbatch"}, {"--parsable", "sbatch"},          {"--dependency", "sbatch"}, {"--wrap", "sbatch"}};

/// Makes an example's work small. A command that begins with these words, and has a word that ends with `if_any` where
/// that is given, gets this option; one that it has already gets the value.
struct Reduction {
  Words command;
  std::string if_any;
  std::string option, value;
};
const std::vector<Reduction> reductions{
    {{"synth", "still"}, "", "--size", "144x108"},
    {{"synth", "still"}, "", "--samples", "1"},
    {{"synth", "film"}, "", "--size", "96x64"},
    {{"synth", "film"}, "", "--frames", "3"},
    {{"synth", "film"}, "", "--samples", "1"},
    {{"synth", "film"}, "--cut", "--cut", "2"},
    {{"synth", "universe"}, "", "--particles", "2000"},
    {{"study", "stimuli"}, "", "--size", "160x120"},
    {{"paint"}, "--display", "--size", "36x48"},
    {{"pack"}, "--slice-from", "--frames", "3"},
    {{"rotoscope"}, "--display", "--size", "36x48"},
    {{"render"}, ".hdf5", "--size", "48x36"},
    {{"render"}, ".glb", "--size", "48x36"},
    {{"render"}, ".obj", "--size", "48x36"},
    {{"synth", "model"}, "", "--triangles", "400"},
    {{"paint"}, ".glb", "--picture-size", "96x72"},
    {{"view"}, "", "--script", "tour.txt"},
    {{"view"}, "--camera", "--script", "stop.txt"},
};

bool begins_with(const Words& words, const Words& beginning) {
  return words.size() >= beginning.size() && std::equal(beginning.begin(), beginning.end(), words.begin());
}

Words reduced(Words words) {
  for (const Reduction& reduction : reductions) {
    const auto has_ending = [&](const std::string& word) { return word.ends_with(reduction.if_any); };
    if (!begins_with(words, reduction.command) || std::ranges::none_of(words, has_ending)) continue;
    const auto given = std::ranges::find(words, reduction.option);
    if (given != words.end()) {
      *(given + 1) = reduction.value;
    } else {
      words.push_back(reduction.option);
      words.push_back(reduction.value);
    }
  }
  return words;
}

/// Copies into `folder` the inputs that a command names and that no line before it wrote.
void bring_inputs(const Words& words, const TemporaryFolder& folder) {
  const bool has_kind = words.front() == "synth" || words.front() == "measure" || words.front() == "study";
  for (std::size_t i = has_kind ? 2 : 1; i < words.size(); ++i) {
    if (words[i - 1] == "-o" || words[i - 1] == "--output") continue;
    const std::string name = fs::path(words[i]).begin()->string();
    if (fs::exists(folder / name)) continue;
    const fs::path input = example_input(name);
    if (!input.empty()) fs::copy(input, folder / name, fs::copy_options::recursive);
  }
}

/// A session with a subject; viewer/window/study_test.sh has one.
bool needs_a_person(const Words& arguments) { return begins_with(arguments, {"study", "run"}); }

/// Runs a block's lines one after the other; says which fail, and how.
std::vector<std::string> failures_of(const ExampleBlock& block) {
  std::vector<std::string> failures;
  const TemporaryFolder folder;
  for (const std::string& line : block.lines) {
    if (not_run.contains(line.substr(0, line.find(' ')))) continue;
    for (const ExampleCommand& command : commands_of_line(line)) {
      // What mpirun starts several times runs once here; tests/mpi compares the two.
      const bool by_mpirun = command.words.front() == "mpirun";
      const auto program = command.words.begin() + (by_mpirun ? 3 : 0);
      if (command.words.end() - program < 2 || *program != "wheatstone") {
        failures.push_back(fmt::format("{}: '{}' is not a command that can be run", block.where, line));
        continue;
      }
      const Words arguments(program + 1, command.words.end());
      if (arguments.front() == "view" && !has_window) continue;
      if (needs_a_person(arguments)) continue;
      const Words small = reduced(arguments);
      bring_inputs(small, folder);
      const ProgramResult result = run_program(small, {.folder = folder / ""});
      if (result.exit_code != 0)
        failures.push_back(
            fmt::format("{}: '{}' ends with {}: {}", block.where, line, result.exit_code, result.errors));
      if (!command.output_file.empty()) put_bytes(folder / command.output_file, result.output);
    }
  }
  return failures;
}

std::vector<std::string> failures_of(const std::vector<ExampleBlock>& blocks) {
  std::vector<std::string> failures;
  for (const ExampleBlock& block : blocks) {
    const std::vector<std::string> more = failures_of(block);
    failures.insert(failures.end(), more.begin(), more.end());
  }
  return failures;
}

std::vector<fs::path> pages() {
  const fs::path project = WHEATSTONE_PROJECT;
  std::vector<fs::path> found{project / "README.md"};
  for (const fs::directory_entry& entry : fs::directory_iterator(project / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

/// The names in a list of the help, below a line as "Kinds:".
Words names_below(const std::string& heading, const std::string& help) {
  std::istringstream text(help);
  Words names;
  std::string line;
  while (std::getline(text, line) && line != heading) continue;
  while (std::getline(text, line) && line.starts_with("  "))
    if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

/// The help of every command and of every kind of it, by its name.
std::map<std::string, std::string> all_help() {
  std::map<std::string, std::string> all;
  for (const std::string& command : commands()) {
    const std::string help = all[command] = run_program({command, "--help"}).output;
    for (const std::string& kind : names_below("Kinds:", help))
      all[command + " " + kind] = run_program({command, kind, "--help"}).output;
  }
  return all;
}

class ExamplesOfPage : public testing::TestWithParam<fs::path> {};

TEST_P(ExamplesOfPage, CanBeRun) {
  const std::vector<ExampleBlock> blocks = examples_of_page(GetParam());
  EXPECT_THAT(blocks, testing::Not(IsEmpty())) << "a page begins with an example";
  EXPECT_THAT(failures_of(blocks), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Documentation, ExamplesOfPage, testing::ValuesIn(pages()), [](const auto& page) {
  std::string name = page.param.stem().string();
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(Examples, OfHelpCanBeRun) {
  for (const auto& [command, help] : all_help()) {
    const std::vector<ExampleBlock> blocks = examples_of_help(command, help);
    EXPECT_THAT(blocks, SizeIs(1)) << command << " --help has no example";
    EXPECT_THAT(failures_of(blocks), IsEmpty());
  }
}

TEST(Examples, ThatCannotBeRunAreFailures) {
  EXPECT_THAT(failures_of(ExampleBlock{"page:1", {"wheatstone info left.png  # a comment"}}), IsEmpty());
  EXPECT_THAT(failures_of(ExampleBlock{"page:1", {"wheatstone info no_such_input.png"}}), SizeIs(1));
  EXPECT_THAT(failures_of(ExampleBlock{"page:1", {"wheatstone paint left.png right.png --no-such-option"}}), SizeIs(1));
  EXPECT_THAT(failures_of(ExampleBlock{"page:1", {"--disparity map.pfm"}}), SizeIs(1));
  EXPECT_THAT(failures_of(ExampleBlock{"page:1", {"wheatstone info left.png && convert left.png right.png"}}),
              SizeIs(1));
}

TEST(Examples, AreFoundInIndentedAndPlainFencedBlocks) {
  const TemporaryFolder folder;
  put_bytes(folder / "page.md",
            "Text\n    continues\n\n    one\n    two # why\n\n- item\n  rest\n\n      three\n\n"
            "```cpp\nint x;\n```\n\n```\nfour \\\n  more\n```\n");
  const std::vector<ExampleBlock> blocks = examples_of_page(folder / "page.md");
  ASSERT_THAT(blocks, SizeIs(3));
  EXPECT_EQ(blocks[0].where, "page.md:4");
  EXPECT_EQ(blocks[0].lines, (Words{"one", "two # why"}));
  EXPECT_EQ(blocks[1].lines, Words{"three"});
  EXPECT_EQ(blocks[2].lines, Words{"four  more"});
}

TEST(Examples, AllThatAreNotRunStandOnAPage) {
  for (const auto& left_out : not_run) {
    const std::string_view beginning = left_out.first;
    const auto begins = [&](const std::string& line) { return line.substr(0, line.find(' ')) == beginning; };
    const auto has = [&](const fs::path& page) {
      return std::ranges::any_of(examples_of_page(page),
                                 [&](const ExampleBlock& block) { return std::ranges::any_of(block.lines, begins); });
    };
    EXPECT_TRUE(std::ranges::any_of(pages(), has)) << beginning << " need not be excepted any more";
  }
}

TEST(Documentation, NamesOnlyOptionsThatExist) {
  std::set<std::string> known = options_named_in(run_program({"--help"}).output);
  for (const auto& [command, help] : all_help()) known.merge(options_named_in(help));
  for (const auto& [option, owner] : options_of_others) known.insert(option);
  for (const fs::path& page : pages()) {
    std::istringstream text(bytes_of(page));
    for (std::string line; std::getline(text, line);) {
      const std::size_t begin = line.find_first_not_of(' ');
      if (begin != std::string::npos && not_run.contains(line.substr(begin, line.find(' ', begin) - begin))) continue;
      for (const std::string& option : options_named_in(line))
        EXPECT_TRUE(known.contains(option)) << page.filename() << " names " << option << ": " << line;
    }
  }
}

}  // namespace wheatstone::examples_test
