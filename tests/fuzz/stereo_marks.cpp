#include <cstddef>
#include <cstdint>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/photograph/stereo_marks_internal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    wheatstone::read_stereo_chunk(bytes);
    wheatstone::read_jps_descriptor(bytes, "a.jps");
  } catch (const wheatstone::Error&) {
  }
  return 0;
}
