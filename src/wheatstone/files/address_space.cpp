#include "wheatstone/files/address_space.h"

#include <sys/mman.h>

#include <new>

namespace wheatstone {

void require_address_space(std::size_t bytes) {
  if (bytes == 0) return;
  // Addresses alone: without access there is no memory behind them.
  void* const place = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) throw std::bad_alloc();
  ::munmap(place, bytes);
}

}  // namespace wheatstone
