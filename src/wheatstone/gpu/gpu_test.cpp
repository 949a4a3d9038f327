#include "wheatstone/gpu/gpu.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <numeric>
#include <utility>
#include <vector>

#include "needs_gpu.h"
#include "throws_error.h"
#include "wheatstone/gpu/program.h"

namespace wheatstone::gpu_test {

constexpr GpuSource doubling{"doubling.comp", R"(#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Numbers { uint numbers[]; };
void main() {
  if (gl_GlobalInvocationID.x < numbers.length()) numbers[gl_GlobalInvocationID.x] *= 2;
})"};

class Gpu : public NeedsGpu {};

/// Ends the process with the exit code and the message of the error that says why there is no graphics processor.
[[noreturn]] void end_with_reason(std::initializer_list<std::pair<const char*, const char*>> variables) {
  for (const auto& [name, value] : variables) setenv(name, value, 1);
  try {
    gpu_facts();
  } catch (const Error& error) {
    std::fputs(error.what(), stderr);
    std::exit(has_real_gpu() ? 0 : static_cast<int>(error.kind()));
  }
  std::exit(0);
}

TEST(GpuDeathTest, SaysThatNoDriverIsThere) {
  EXPECT_EXIT(end_with_reason({{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere"}}), testing::ExitedWithCode(2),
              "none was found");
}

TEST(GpuDeathTest, SaysThatADriverIsTooOld) {
  const char* const mesa = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";
  if (!std::filesystem::exists(mesa)) GTEST_SKIP() << "Mesa is not there, which can be told to be an older driver";
  EXPECT_EXIT(end_with_reason({{"__EGL_VENDOR_LIBRARY_FILENAMES", mesa}, {"MESA_GL_VERSION_OVERRIDE", "4.3"}}),
              testing::ExitedWithCode(2), "no OpenGL 4.5");
}

TEST(GpuChoice, IsAskedForOrWorthwhileAndReal) {
  EXPECT_TRUE(chooses_gpu(Device::graphics, false));
  EXPECT_FALSE(chooses_gpu(Device::processor, true));
  EXPECT_FALSE(chooses_gpu(Device::automatic, false));
  EXPECT_EQ(chooses_gpu(Device::automatic, true), has_real_gpu());
}

TEST(GpuChoice, FallsBackToTheProcessorWhereNobodyAskedForAnother) {
  const auto refuse = [] { throw Error(ErrorKind::wrong_usage, "lost"); };
  why_left_by_gpu();
  EXPECT_FALSE(done_on_gpu(Device::automatic, refuse));
  EXPECT_FALSE(done_on_gpu(Device::automatic, [] { throw Error(ErrorKind::wrong_usage, "again"); }));
  EXPECT_EQ(why_left_by_gpu(), "lost");
  EXPECT_EQ(why_left_by_gpu(), "");
  expect_error(ErrorKind::wrong_usage, "lost", [&] { done_on_gpu(Device::graphics, refuse); });
  expect_error(ErrorKind::bad_input, "file",
               [] { done_on_gpu(Device::automatic, [] { throw Error(ErrorKind::bad_input, "file"); }); });
  EXPECT_TRUE(done_on_gpu(Device::automatic, [] {}));
}

TEST_F(Gpu, RunsEachVariantOfASource) {
  constexpr GpuSource multiplying{"multiplying.comp", R"(#version 450
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Number { uint number; };
void main() { number *= FACTOR; }
)"};
  const auto product = [&](int factor) {
    std::uint32_t number = 7;
    on_gpu([&](const GpuFacts&) {
      const GpuBuffer buffer(std::span<const std::uint32_t>(&number, 1));
      kept_program(multiplying, {{"FACTOR", factor}}).run({1}, {&buffer});
      buffer.read(std::span(&number, 1));
    });
    return number;
  };
  EXPECT_EQ(product(2), 14u);
  EXPECT_EQ(product(3), 21u);
  EXPECT_EQ(product(2), 14u);
}

TEST_F(Gpu, TellsWhatItIs) {
  const GpuFacts facts = gpu_facts();
  EXPECT_FALSE(facts.name.empty());
  EXPECT_NE(facts.version.find('.'), std::string::npos);
  EXPECT_GE(facts.largest_buffer, std::size_t{1} << 24);
  EXPECT_EQ(has_real_gpu(), !facts.imitated);
}

TEST_F(Gpu, RunsAProgramOnBuffersOfEverySize) {
  for (const std::size_t size : {1, 1000, 10'000, 100'000, 1'000'000}) {
    std::vector<std::uint32_t> numbers(size);
    std::iota(numbers.begin(), numbers.end(), 0u);
    on_gpu([&](const GpuFacts&) {
      const GpuBuffer buffer{std::span<const std::uint32_t>(numbers)};
      const GpuProgram program(doubling);
      program.run({groups_of(numbers.size(), 64)}, {&buffer});
      buffer.read(std::span(numbers));
    });
    for (std::uint32_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], 2 * i) << size;
  }
}

TEST_F(Gpu, BeginsWithBuffersOfZeros) {
  std::vector<std::uint32_t> numbers(77, 1);
  on_gpu([&](const GpuFacts&) { GpuBuffer(numbers.size() * sizeof(std::uint32_t)).read(std::span(numbers)); });
  EXPECT_EQ(numbers, std::vector<std::uint32_t>(77, 0));
}

TEST_F(Gpu, NamesTheProgramThatItsDriverRefuses) {
  expect_error(ErrorKind::wrong_usage, "broken.comp", [] {
    on_gpu([](const GpuFacts&) { GpuProgram({"broken.comp", "#version 450\nvoid main() { nonsense; }"}); });
  });
}

TEST_F(Gpu, SaysThatItsProgramsTakeNoBufferOfThatSize) {
  expect_error(ErrorKind::wrong_usage, "--device cpu needs no such room",
               [] { on_gpu([](const GpuFacts& facts) { GpuBuffer(facts.largest_buffer + 4); }); });
  expect_error(ErrorKind::wrong_usage, "4398046511104 MB",
               [] { on_gpu([](const GpuFacts&) { GpuBuffer::of_any_bytes(~std::size_t{0} >> 2); }); });
}

TEST_F(Gpu, IsOfUseAgainAfterAFault) {
  EXPECT_ANY_THROW(on_gpu([](const GpuFacts&) { throw 1; }));
  std::uint32_t number = 7;
  on_gpu([&](const GpuFacts&) { GpuBuffer(4).read(std::span(&number, 1)); });
  EXPECT_EQ(number, 0u);
}

}  // namespace wheatstone::gpu_test
