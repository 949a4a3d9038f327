#include "one_file.h"
#include "wheatstone/multiview/slice_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path path = wheatstone::fuzz::as_file(data, size, ".exr");
  try {
    wheatstone::read_slices(path);
  } catch (const wheatstone::Error&) {
  }
  std::filesystem::remove(path);
  return 0;
}
