#include "one_file.h"
#include "wheatstone/files/field_bytes.h"
#include "wheatstone/models/assemble_model_internal.h"
#include "wheatstone/models/read_model.h"

// The first byte says which: a file of one of the formats, or what the child process hands on, which is not trusted
// either.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr const char* endings[] = {".obj", ".ply", ".stl", ".glb", ".gltf"};
  const std::size_t which = data[0] % 6;
  try {
    if (which < 5) {
      wheatstone::read_model(wheatstone::fuzz::as_file(data + 1, size - 1, endings[which]));
    } else {
      wheatstone::RawModel raw;
      wheatstone::FieldReader reader({reinterpret_cast<const char*>(data + 1), size - 1}, "damaged");
      reader(raw);
      reader.expect_end();
      wheatstone::ReadModel read;
      wheatstone::assemble_model(raw, {"OBJ", "obj", true}, "model.obj", {}, read);
    }
  } catch (const wheatstone::Error&) {
  }
  if (which < 5) std::filesystem::remove(wheatstone::fuzz::as_file(data, 0, endings[which]));
  return 0;
}
