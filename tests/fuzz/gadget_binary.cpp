#include <string>

#include "one_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wheatstone::fuzz::read_particles(data, size, "");
  return wheatstone::fuzz::read_particles(data, size, "", {.type = "halo"});
}
