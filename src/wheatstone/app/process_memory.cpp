#include "wheatstone/app/process_memory.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <opencv2/core/mat.hpp>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace wheatstone {
namespace {

std::atomic<bool> asks_for_huge_pages = false;

/// Returns the memory. The request may be refused, which costs time only.
void* in_huge_pages(void* memory, std::size_t bytes) {
#ifdef __GLIBC__
  constexpr std::size_t least_bytes = std::size_t{1} << 20;
  if (memory == nullptr || bytes < least_bytes || !asks_for_huge_pages.load(std::memory_order_relaxed)) return memory;
  static const auto page_bytes = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t to_page = (page_bytes - reinterpret_cast<std::uintptr_t>(memory) % page_bytes) % page_bytes;
  ::madvise(static_cast<char*>(memory) + to_page, (bytes - to_page) / page_bytes * page_bytes, MADV_HUGEPAGE);
#endif
  return memory;
}

/// OpenCV's own allocator, in huge pages.
class HugePages : public cv::MatAllocator {
 public:
  cv::UMatData* allocate(int dimensions, const int* sizes, int type, void* data, std::size_t* step,
                         cv::AccessFlag access, cv::UMatUsageFlags usage) const override {
    cv::UMatData* const made = cv::Mat::getStdAllocator()->allocate(dimensions, sizes, type, data, step, access, usage);
    if (data == nullptr) in_huge_pages(made->data, made->size);
    return made;
  }
  bool allocate(cv::UMatData* data, cv::AccessFlag access, cv::UMatUsageFlags usage) const override {
    return cv::Mat::getStdAllocator()->allocate(data, access, usage);
  }
  void deallocate(cv::UMatData* data) const override { cv::Mat::getStdAllocator()->deallocate(data); }
};

}  // namespace

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int large_bytes = 9 << 20, most_kept_bytes = 256 << 20;
  mallopt(M_MMAP_THRESHOLD, large_bytes);
  mallopt(M_TRIM_THRESHOLD, most_kept_bytes);
#endif
}

void use_huge_pages() {
  static auto* const huge_pages = new HugePages;  // pictures may be freed until the very end
  asks_for_huge_pages = true;
  cv::Mat::setDefaultAllocator(huge_pages);
}

}  // namespace wheatstone

// Sanitizers have their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WHEATSTONE_CHECKS_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define WHEATSTONE_CHECKS_MEMORY
#endif
#endif

#ifndef WHEATSTONE_CHECKS_MEMORY

void* operator new(std::size_t bytes) {
  for (;;) {
    if (void* const memory = std::malloc(std::max<std::size_t>(bytes, 1)))
      return wheatstone::in_huge_pages(memory, bytes);
    const std::new_handler free_some = std::get_new_handler();
    if (free_some == nullptr) throw std::bad_alloc();
    free_some();
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

#endif
