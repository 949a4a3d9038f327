// The input is the content: a checksum over it would keep every change of it out.

#include "one_file.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = wheatstone::rotoscope_state_with_checksum({reinterpret_cast<const char*>(data), size});
  try {
    // What is believed can be kept again.
    wheatstone::encode_rotoscope_state(wheatstone::decode_rotoscope_state(bytes, "input"));
  } catch (const wheatstone::Error&) {
  }
  return 0;
}
