#include "one_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return wheatstone::fuzz::read_particles(data, size, "PK\3\4");
}
