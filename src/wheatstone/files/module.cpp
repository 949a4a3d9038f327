#include "wheatstone/files/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "wheatstone/error.h"

namespace wheatstone {

void* function_of_module(const std::string& module, const std::string& function) {
  const std::string file = fmt::format("lib{}.so", module);
  // Never closed: the libraries behind a module have threads and handlers of their own.
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw Error(ErrorKind::cannot_read_write, fmt::format("a part of Wheatstone is not installed: {}", ::dlerror()));
  void* const found = ::dlsym(library, function.c_str());
  if (found == nullptr)
    throw Error(ErrorKind::cannot_read_write, fmt::format("{} is of another version than this program", file));
  return found;
}

}  // namespace wheatstone
