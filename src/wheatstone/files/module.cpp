#include "wheatstone/files/module.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <new>

#include "wheatstone/error.h"

namespace wheatstone {

void require_address_space(std::size_t bytes) {
  if (bytes == 0) return;
  // Addresses alone: without access there is no memory behind them.
  void* const place = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) throw std::bad_alloc();
  ::munmap(place, bytes);
}

namespace {

/// Says in the loader's words why a library is not loaded. The words tell a lack of memory from everything else: the
/// loader gives no number of the error.
[[noreturn]] void fail_to_load(const std::string& file, std::string_view why) {
  for (const std::string_view of_memory : {"failed to map segment", "annot allocate memory", "annot map zero-fill",
                                           "annot create", "out of memory", "annot change memory protections"})
    if (why.find(of_memory) != std::string_view::npos) throw std::bad_alloc();
  const bool is_missing = why.find("No such file") != std::string_view::npos;
  throw Error(ErrorKind::cannot_read_write, is_missing ? fmt::format("a part of Wheatstone is not installed: {}", why)
                                                       : fmt::format("{}: cannot be loaded: {}", file, why));
}

}  // namespace

void* function_of_module(const std::string& module, const std::string& function, std::size_t address_space_bytes) {
  const std::string file = fmt::format("lib{}.so", module);
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
  if (library == nullptr) {
    // Libraries that begin with too little memory crash.
    require_address_space(address_space_bytes);
    // Never closed: the libraries behind a module have threads and handlers of their own.
    library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  }
  if (library == nullptr) fail_to_load(file, ::dlerror());
  void* const found = ::dlsym(library, function.c_str());
  if (found == nullptr)
    throw Error(ErrorKind::cannot_read_write, fmt::format("{} is of another version than this program", file));
  return found;
}

}  // namespace wheatstone
