#include "one_file.h"
#include "wheatstone/app/shots_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    wheatstone::parse_shots({reinterpret_cast<const char*>(data), size}, "input.toml", {});
  } catch (const wheatstone::Error&) {
  }
  return 0;
}
