// `--device auto` where the graphics processor is lost in the middle of a run: the processor finishes it. Each test
// runs in a process that starts anew, in which no driver has begun.

#include "lost_gpu.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "cli/run_program.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::lost_gpu_test {

/// What the program says where the graphics processor is lost, or where there is none to lose.
constexpr const char* finished = "the cpu finished the work; .*lost its state|takes the cpu; graphics processor";

void need(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "not so: %s\n", what);
  std::exit(9);
}

std::string run(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  const ProgramResult result = run_program(arguments, {.folder = folder / "."});
  need(result.exit_code == 0, result.errors.c_str());
  return result.errors;
}

[[noreturn]] void end_with(const std::string& errors) {
  std::fputs(errors.c_str(), stderr);
  std::exit(0);
}

/// What it says on standard error.
std::string render_and_lose() {
  const TemporaryFolder folder;
  run(folder, {"synth", "universe", "--particles", "110000", "-o", "gas.hdf5", "--quiet"});
  const auto rendered = [&](const std::string& device) {
    return run(folder, {"render", "gas.hdf5", "--views", "100", "--size", "24x16", "--method", "incremental",
                        "--device", device, "-o", device});
  };
  rendered("cpu");
  pass_for_real_and_be_lost_after(0);
  std::string errors = rendered("auto");
  for (const char* const view : {"/view_000.png", "/view_099.png"})
    need(read_image(folder / ("auto" + std::string(view))) == read_image(folder / ("cpu" + std::string(view))), view);
  return errors;
}

TEST(LostGpuDeathTest, ViewsAreRenderedByTheProcessor) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(end_with(render_and_lose()), testing::ExitedWithCode(0), finished);
}

std::string paint_and_lose() {
  const TemporaryFolder folder;
  run(folder, {"synth", "film", "-o", "film", "--size", "272x256", "--frames", "3", "--samples", "1", "--quiet"});
  pass_for_real_and_be_lost_after(3);
  return run(folder, {"rotoscope", "film/left_%04d.png", "film/right_%04d.png", "--style", "posterise", "--device",
                      "auto", "-o", "painted.mkv"});
}

TEST(LostGpuDeathTest, FilmsArePaintedToTheirEnd) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(end_with(paint_and_lose()), testing::ExitedWithCode(0), finished);
}

}  // namespace wheatstone::lost_gpu_test
