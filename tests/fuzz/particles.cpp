// The readers of particles, each in a program of its own: PARTICLE_READER is its name, as that of its corpus.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "one_file.h"
#include "wheatstone/particles/cloud_source.h"

namespace wheatstone::fuzz {
namespace {

struct ParticleReader {
  std::string_view name;
  std::string_view magic;                   ///< the first bytes by which the reader is told; put before every input
  std::vector<CloudChoice> choices = {{}};  ///< one after the other, and with a condition
};

const ParticleReader& the_reader() {
  static const std::vector<ParticleReader> readers{
      {"fits", "SIMPLE  ="},
      {"gadget_binary", "", {{}, {.type = "halo"}, {.temperature = "RHO", .mass = "Z", .quantity = "ACCE-y"}}},
      {"gadget_hdf5", "\x89HDF\r\n\x1a\n"},
      {"hdf5_dataset", "\x89HDF\r\n\x1a\n", {{.position = "/PartType0/Coordinates", .density = "/PartType0/Density"}}},
      {"las", "LASF"},
      {"npy", "\x93NUMPY"},
      {"npz", "PK\3\4"},
      {"ply", "ply\n"},
      {"text_table", "# "}};
  return *std::ranges::find(readers, PARTICLE_READER, &ParticleReader::name);
}

/// Reads the input as particles to its end. Refusing it is right; anything else than an Error is not.
void read_particles(const std::uint8_t* data, std::size_t size, std::string_view magic, const CloudChoice& choice) {
  // Of the formats that are told by their first bytes only the one in question.
  const std::string text = std::string(magic) + std::string(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path path = as_file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), ".bin");
  try {
    const CloudSource source = open_cloud(path, choice);
    std::uint64_t count = 0;
    while (count < 100'000) {
      const Cloud cloud = source.next(1000);
      if (cloud.size() == 0) break;
      count += cloud.size();
    }
  } catch (const Error&) {
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace wheatstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const wheatstone::fuzz::ParticleReader& reader = wheatstone::fuzz::the_reader();
  for (wheatstone::CloudChoice choice : reader.choices) {
    wheatstone::fuzz::read_particles(data, size, reader.magic, choice);
    choice.where = wheatstone::parse_condition("x > 0 or velocity-x < 1 and Density != 2");
    wheatstone::fuzz::read_particles(data, size, reader.magic, choice);
  }
  return 0;
}
