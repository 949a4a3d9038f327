#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/photograph/multi_picture_internal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    for (const wheatstone::MultiPictureEntry& entry : wheatstone::read_multi_picture_index(bytes, "a.mpo"))
      if (entry.begin > size || entry.length > size - entry.begin) std::abort();
  } catch (const wheatstone::Error&) {
  }
  return 0;
}
