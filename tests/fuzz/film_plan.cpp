// The input is the content: a checksum over it would keep every change of it out.

#include "one_file.h"
#include "wheatstone/app/film_plan_file_internal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = wheatstone::film_plan_with_checksum({reinterpret_cast<const char*>(data), size});
  try {
    // What is believed can be kept again.
    wheatstone::encode_film_plan(wheatstone::decode_film_plan(bytes, "input"));
  } catch (const wheatstone::Error&) {
  }
  return 0;
}
