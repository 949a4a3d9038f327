// How a run ends that cannot go on: interrupted, or without room for its results. Nothing half-written is left.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <time.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "cli/run_program.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

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

TEST(Ending, OfAnInterruptedRunIsExitCodeFive) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const ProgramResult result = run_program(long_run, {.folder = folder / "", .while_running = [signal](int process) {
                                                          wait_until_caught(process, signal);
                                                          std::this_thread::sleep_for(std::chrono::seconds(1));
                                                          ::kill(process, signal);
                                                        }});
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_EQ(result.errors, "wheatstone: interrupted; nothing half-written is left\n");
    EXPECT_TRUE(folder.is_empty());
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

}  // namespace
}  // namespace wheatstone
