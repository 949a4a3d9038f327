// How a run ends that cannot go on: interrupted, or without room for its results. Nothing half-written is left.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "cli/failure.h"
#include "cli/run_program.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::ending_test {

// Long enough that no machine is done before the signal comes.
const std::vector<std::string> long_run = {"synth", "still",  "-o",      "results", "--views",
                                           "1000",  "--size", "640x480", "--quiet"};

/// Waits until a program has begun to watch for a signal: until then it would just end.
void wait_until_caught(int process, int signal) {
  for (int tries = 0; tries < 600; ++tries) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:") && (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

/// So many random places, as numpy keeps them.
void write_particles(const std::filesystem::path& path, std::size_t count) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(count) + ", 3), }";
  constexpr std::size_t preamble = 10, aligned = 128;
  header.append(aligned - preamble - header.size() - 1, ' ').push_back('\n');
  std::mt19937 random(1);
  std::vector<float> places(3 * count);
  for (float& place : places) place = static_cast<float>(random() >> 8);
  std::ofstream file(path, std::ios::binary);
  file.write("\x93NUMPY\x01\x00", 8).put(static_cast<char>(header.size())).put(0);
  file << header;
  file.write(reinterpret_cast<const char*>(places.data()), static_cast<std::streamsize>(places.size() * sizeof(float)));
}

TEST(Ending, OfAnInterruptedRunIsExitCodeFive) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const ProgramResult result = run_program(long_run, {.folder = folder / "", .while_running = [signal](int process) {
                                                          wait_until_caught(process, signal);
                                                          std::this_thread::sleep_for(std::chrono::milliseconds(100));
                                                          ::kill(process, signal);
                                                        }});
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_EQ(result.errors, "wheatstone: interrupted; nothing half-written is left\n");
    EXPECT_TRUE(folder.is_empty());
  }
}

using Lines = std::vector<std::vector<std::string>>;

/// Runs lines that take many seconds, each in another of the long stages that no progress is told of, and stops them.
void expect_ends_within_a_second(const Lines& lines) {
  const TemporaryFolder folder;
  // Noise, coarse enough to be a picture at any reduced size.
  std::mt19937 random(1);
  constexpr int block_px = 50;
  Image<Rgb8> blocks(80, 60), noise(4000, 3000);
  for (Rgb8& block : blocks.pixels()) block.r = static_cast<std::uint8_t>(random() % 200);
  for (int y = 0; y < noise.height(); ++y)
    for (int x = 0; x < noise.width(); ++x)
      noise(x, y) = {static_cast<std::uint8_t>(blocks(x / block_px, y / block_px).r + random() % 50), 0, 0};
  for (const char* name : {"left.bmp", "right.bmp"}) write_image(folder / name, noise);
  std::filesystem::create_symlink("left.bmp", folder / "frame_0001.bmp");
  write_particles(folder / "cloud.npy", 3'000'000);
  const std::set<std::string> before = files_in(folder / "");
  for (const std::vector<std::string>& line : lines) {
    std::chrono::steady_clock::time_point sent;
    const ProgramResult result = run_program(line, {.folder = folder / "", .while_running = [&sent](int process) {
                                                      wait_until_caught(process, SIGINT);
                                                      std::this_thread::sleep_for(std::chrono::milliseconds(300));
                                                      sent = std::chrono::steady_clock::now();
                                                      ::kill(process, SIGINT);
                                                    }});
    const std::chrono::duration<double> reaction = std::chrono::steady_clock::now() - sent;
    EXPECT_EQ(result.exit_code, 5) << line[0] << result.errors;
    EXPECT_THAT(result.errors, testing::EndsWith("wheatstone: interrupted; nothing half-written is left\n")) << line[0];
    EXPECT_LT(reaction.count(), 1) << line[0];
    EXPECT_EQ(files_in(folder / ""), before) << line[0];
  }
}

TEST(Ending, OfALongStageTakesLessThanASecondAndLeavesNothing) {
  expect_ends_within_a_second(
      {{"synth", "still", "-o", "results", "--size", "4000x3000", "--samples", "8"},
       {"paint", "left.bmp", "right.bmp", "-o", "results"},
       {"rotoscope", "frame_%04d.bmp", "-o", "results.mp4", "--style", "mosaic", "--layout", "mono"},
       {"pack", "left.bmp", "right.bmp", "--to", "wiggle", "-o", "results.webp"},
       {"render", "cloud.npy", "--views", "500", "--size", "1920x1080", "--save-slices", "s.exr", "-o", "results"}});
}

TEST(EndingLong, OfOtherLongStagesTakesLessThanASecondAndLeavesNothing) {
  const std::string left = "left.bmp", right = "right.bmp";
  expect_ends_within_a_second(
      {{"synth", "universe", "-o", "results.hdf5", "--particles", "100000000"},
       {"match", left, right, "-o", "results", "--range", "0:600"},
       {"rectify", left, right, "-o", "results"},
       {"calibrate", "--left", left, left, left, "--right", right, right, right, "-o", "results.yml"},
       {"measure", "stereo", left, right, "--photographs", left, right}});
}

// Sanitizers need more addresses than the limit leaves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Ending, WithoutMemoryIsExitCodeFour) {
  const TemporaryFolder folder;
  constexpr std::size_t mib = std::size_t{1} << 20;
  std::mt19937 random(1);
  Image<Rgb8> noise(800, 600);
  for (Rgb8& pixel : noise.pixels()) pixel.g = static_cast<std::uint8_t>(random());
  for (const char* name : {"left.jpg", "right.jpg"}) write_image(folder / name, noise);
  const std::set<std::string> before = files_in(folder / "");
  std::size_t least = 150 * mib;
  const auto starts = [&] { return run_program({"--version"}, {.most_addresses = least}).exit_code != 127; };
  for (const std::size_t step : {32, 8, 1}) {  // ends where it starts, and does not with a step less
    while (!starts()) least += step * mib;
    if (step > 1) least -= step * mib;
  }
  for (const std::vector<std::string>& line : Lines{{"--version"},
                                                    {"match", "left.jpg", "right.jpg", "-o", "results", "--quiet"},
                                                    {"paint", "left.jpg", "right.jpg", "-o", "results", "--quiet"}}) {
    for (const std::size_t more : {0, 1, 2, 8, 32, 64, 100, 150, 200, 250, 300, 400}) {
      const ProgramResult result = run_program(line, {.folder = folder / "", .most_addresses = least + more * mib});
      if (result.exit_code == 0) {
        std::filesystem::remove_all(folder / "results");
        break;  // so it is with more
      }
      EXPECT_EQ(result.exit_code, 4) << line[0] << " " << more;
      EXPECT_EQ(result.errors, "wheatstone: not enough memory\n") << line[0] << " " << more;
      EXPECT_EQ(files_in(folder / ""), before) << line[0] << " " << more;
    }
  }
}
#endif

TEST(Ending, OfAnExceptionIsOneExitCodeAndOneLine) {
  const std::string lack = "not enough memory";
  const struct {
    std::exception_ptr thrown;
    int exit_code;
    std::string message;
  } cases[] = {
      {nullptr, 4, lack},
      {std::make_exception_ptr(std::bad_alloc()), 4, lack},
      {std::make_exception_ptr(std::bad_array_new_length()), 4, lack},
      {std::make_exception_ptr(std::system_error(EAGAIN, std::generic_category())), 4, lack},
      {std::make_exception_ptr(std::system_error(ENOMEM, std::system_category())), 4, lack},
      {std::make_exception_ptr(std::runtime_error("pthread_create has failed: too many")), 4, lack},
      {std::make_exception_ptr(cv::Exception(cv::Error::StsNoMem, "Failed to allocate", "alloc", "a.cpp", 1)), 4, lack},
      {std::make_exception_ptr(cv::Exception(cv::Error::StsAssert, "a < b", "f", "a.cpp", 1)), 1,
       "internal error in OpenCV: a < b (f)"},
      {std::make_exception_ptr(std::filesystem::filesystem_error("no", std::make_error_code(std::errc::io_error))), 4,
       "filesystem error: no: Input/output error"},
      {std::make_exception_ptr(Error(ErrorKind::wrong_usage, "--x: is 1")), 2, "--x: is 1"},
      {std::make_exception_ptr(Error(ErrorKind::interrupted, "interrupted")), 5, "interrupted"},
      {std::make_exception_ptr(std::logic_error("odd")), 1, "internal error: odd"},
      {std::make_exception_ptr(7), 1, "internal error"}};
  for (const auto& expected : cases) {
    const auto [exit_code, message] = cli::failure_of(expected.thrown);
    EXPECT_EQ(message, expected.message);
    EXPECT_EQ(exit_code, expected.exit_code) << message;
  }
}

TEST(Ending, OnAFullDiskIsExitCodeFour) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"synth", "still", "-o", "results", "--size", "320x240", "--quiet"},
                                           {.folder = folder / "", .largest_file = 20000});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.errors, testing::StartsWith("wheatstone: "));
  EXPECT_THAT(result.errors, testing::HasSubstr("File too large"));
  EXPECT_TRUE(folder.is_empty());
}

}  // namespace wheatstone::ending_test
