#include "wheatstone/photograph/carried_depth.h"
#include "one_file.h"
#include "wheatstone/photograph/xmp_internal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const wheatstone::Xmp xmp = wheatstone::read_xmp(bytes, "a.jpg");
    if (xmp.packet.size() + xmp.extended.size() > size) std::abort();
  } catch (const wheatstone::Error&) {
  }
  const std::filesystem::path path = wheatstone::fuzz::as_file(data, size, ".jpg");
  try {
    const auto found = wheatstone::find_carried_depth(path);
    if (found && (found->picture.empty() || found->depth.empty())) std::abort();
  } catch (const wheatstone::Error&) {
  }
  std::filesystem::remove(path);
  return 0;
}
