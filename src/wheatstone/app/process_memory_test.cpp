#include "wheatstone/app/process_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <sstream>
#include <string>

namespace wheatstone::process_memory_test {

/// Whether the system was asked for huge pages where an address lies (proc(5), smaps, VmFlags).
bool asked_for_huge_pages(const void* address) {
  std::ifstream maps("/proc/self/smaps");
  bool is_here = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    if (words >> std::hex >> begin >> dash >> end && dash == '-')
      is_here = begin <= reinterpret_cast<std::uintptr_t>(address) && reinterpret_cast<std::uintptr_t>(address) < end;
    else if (is_here && line.starts_with("VmFlags:"))
      return (line + ' ').find(" hg ") != std::string::npos;
  }
  return false;
}

TEST(ProcessMemory, LargeBlocksLieInHugePages) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers allocate by themselves";
#endif
  for (const char* needed : {"/sys/kernel/mm/transparent_hugepage/enabled", "/proc/self/smaps"})
    if (!std::filesystem::exists(needed)) GTEST_SKIP() << needed << " is missing: nothing tells of huge pages";
  constexpr int side = 4096, middle = side * side / 2;
  use_huge_pages();
  const auto ours = std::make_unique<char[]>(std::size_t{side} * side);
  EXPECT_TRUE(asked_for_huge_pages(&ours[middle]));
  const cv::Mat of_opencv(side, side, CV_8UC1);
  EXPECT_TRUE(asked_for_huge_pages(of_opencv.ptr(side / 2)));
}

}  // namespace wheatstone::process_memory_test
