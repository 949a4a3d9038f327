#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/motion/flow_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const wheatstone::Flow flow = wheatstone::decode_flow(bytes, "a.flo");
    if (flow.x.empty() || !wheatstone::same_size(flow.x, flow.y)) std::abort();
  } catch (const wheatstone::Error&) {
  }
  return 0;
}
