// What is written: the same bytes on every run, and nothing at all where it does not fit.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "cli/run_program.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::writing_test {

namespace fs = std::filesystem;

/// Writes beyond this size fail in this process, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

/// Two views of a wall of noise, which nothing makes small, and particles.
void write_inputs(const TemporaryFolder& folder) {
  constexpr int width = 64, height = 48, disparity_px = 4;
  std::mt19937 random(1);
  const auto level = [&] { return static_cast<std::uint8_t>(random()); };
  Image<Rgb8> left(width, height), right(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width + disparity_px; ++x) {
      const Rgb8 colour{level(), level(), level()};
      if (x < width) left(x, y) = colour;
      if (x >= disparity_px) right(x - disparity_px, y) = colour;
    }
  }
  write_image(folder / "left.png", left);
  write_image(folder / "right.png", right);
  std::ofstream cloud(folder / "cloud.csv");
  cloud << "x,y,z\n";
  for (int i = 0; i < 900; ++i) cloud << random() % 1000 << (i % 3 == 2 ? '\n' : ',');
}

/// A line for every kind of file that the program writes, films apart.
std::vector<std::vector<std::string>> writers() {
  std::vector<std::vector<std::string>> lines;
  for (const std::string file : {"v.gif", "v.webp", "v.mpo", "v.jps", "v.exr"})
    lines.push_back({"pack", "left.png", "right.png", "-o", file, "--to",
                     file == "v.gif" || file == "v.webp" ? "wiggle" : file.substr(2)});
  for (const std::string file : {"a.png", "a.jpg", "a.tif", "a.webp", "a.ppm", "a.bmp"})
    lines.push_back({"pack", "left.png", "right.png", "--to", "left-right", "-o", file});
  for (const std::string file : {"d.exr", "d.png", "d.pfm"})
    lines.push_back({"pack", "left.png", "right.png", "--to", "disparity", "-o", file});
  lines.push_back({"pack", "left.png", "right.png", "--to", "depth", "-o", "depth.exr"});
  lines.push_back({"render", "cloud.csv", "--size", "64x48", "-o", "views"});
  lines.push_back({"render", "cloud.csv", "--size", "64x48", "--save-slices", "s.exr", "-o", "sliced"});
  lines.push_back({"synth", "universe", "--particles", "2000", "-o", "u.hdf5"});
  lines.push_back({"synth", "still", "--size", "48x36", "-o", "still"});
  lines.push_back({"match", "left.png", "right.png", "-o", "matched"});
  lines.push_back({"study", "simulate", "path-searching-2", "--subjects", "2", "-o", "simulated"});
  return lines;
}

std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const std::string& name : files_in(folder))
    if (!fs::is_directory(folder / name)) contents[name] = bytes_of(folder / name);
  return contents;
}

TEST(Writing, GivesTheSameBytesAtAnyTime) {
  const TemporaryFolder now, later;
  for (const TemporaryFolder* folder : {&now, &later}) {
    // The dates that formats keep count seconds.
    if (folder == &later) std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    write_inputs(*folder);
    for (const std::vector<std::string>& line : writers()) {
      const ProgramResult result = run_program(line, {.folder = *folder / ""});
      EXPECT_EQ(result.exit_code, 0) << result.errors;
    }
  }
  const auto first = contents_of(now / ""), second = contents_of(later / "");
  EXPECT_GT(first.size(), writers().size());
  ASSERT_EQ(first.size(), second.size());
  for (const auto& [name, bytes] : first) EXPECT_TRUE(bytes == second.at(name)) << name;
}

TEST(Writing, MakesTheFoldersOfAnOutputAndLeavesNoneOfAFailedRun) {
  const TemporaryFolder folder;
  write_inputs(folder);
  const std::set<std::string> before = files_in(folder / "");
  for (std::vector<std::string> line : writers()) {
    if (line.front() == "study") continue;
    (std::ranges::find(line, "-o") + 1)->insert(0, "new/below/");
    line.emplace_back("--quiet");
    const FileSizeLimit limit(64);
    const ProgramResult result = run_program(line, {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 4) << line[0] << result.errors;
    EXPECT_EQ(files_in(folder / ""), before) << line[0];
  }
  const ProgramResult packed = run_program(
      {"pack", "left.png", "right.png", "--to", "left-right", "-o", "new/below/both.png"}, {.folder = folder / ""});
  EXPECT_EQ(packed.exit_code, 0) << packed.errors;
  EXPECT_TRUE(fs::exists(folder / "new/below/both.png"));
}

TEST(Writing, FollowsALinkThatLeadsNowhereYet) {
  const TemporaryFolder folder;
  write_inputs(folder);
  fs::create_symlink("target.png", folder / "link.png");
  const ProgramResult result =
      run_program({"pack", "left.png", "right.png", "--to", "left-right", "-o", "link.png"}, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
  EXPECT_TRUE(fs::is_regular_file(folder / "target.png"));
}

TEST(Writing, ToAFullDiskLeavesNothing) {
  const TemporaryFolder folder;
  write_inputs(folder);
  const std::set<std::string> before = files_in(folder / "");
  for (const std::vector<std::string>& line : writers()) {
    const FileSizeLimit limit(64);
    std::vector<std::string> quietly = line;
    quietly.emplace_back("--quiet");
    const ProgramResult result = run_program(quietly, {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 4) << line[0] << " " << line.back() << " " << result.errors;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
    EXPECT_EQ(files_in(folder / ""), before) << line.back();
  }
}

}  // namespace wheatstone::writing_test
