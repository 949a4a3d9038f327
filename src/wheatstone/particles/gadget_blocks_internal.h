#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

namespace wheatstone {

/// A number in this machine's byte order or the other.
template <class Number>
Number decode_gadget(const char* from, bool swapped) {
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), from, sizeof(Number));
  if (swapped) std::ranges::reverse(bytes);
  return std::bit_cast<Number>(bytes);
}

/// A record of a GADGET binary file: `width` numbers for each particle of some types, one type after the other.
struct GadgetBlock {
  static constexpr std::size_t particle_types = 6;
  std::string name;
  std::uint64_t begin = 0;  ///< in the file, in bytes
  std::uint64_t bytes = 0;
  std::array<bool, particle_types> has{};  ///< which types; none where it is not known what the record holds
  std::size_t width = 1;
  bool whole = false;  ///< numbers without a fraction
};

/// One file of a GADGET binary snapshot.
struct GadgetPart {
  static constexpr std::size_t particle_types = GadgetBlock::particle_types;
  std::string path;
  std::uint64_t length = 0;
  bool swapped = false;
  bool labelled = false;  ///< format 2, whose records have names
  std::array<std::uint64_t, particle_types> count{}, total{};
  std::array<double, particle_types> mass{};  ///< of each particle of a type; 0 where they have their own
  double redshift = 0, box_size = 0;
  int files = 1;
  std::vector<GadgetBlock> blocks;

  std::uint64_t all() const { return std::accumulate(count.begin(), count.end(), std::uint64_t{0}); }
  /// Particles of the types that a block has, before a type or in all.
  std::uint64_t particles(const GadgetBlock& block, std::size_t before_type = particle_types) const {
    std::uint64_t sum = 0;
    for (std::size_t type = 0; type < before_type; ++type) sum += block.has[type] ? count[type] : 0;
    return sum;
  }
  /// By its name, in small letters or capitals; nullptr where there is none.
  const GadgetBlock* find(const std::string& name) const;
};

/// Reads what a file has, and checks its records against its length. What each record holds is told by the record INFO
/// that GADGET-3 writes, else by the name of the record, else by its length. Throws Error{bad_input}.
GadgetPart open_gadget_part(const std::filesystem::path& path);

/// Throws Error{bad_input} that begins with the file's name.
[[noreturn]] void refuse_gadget(const GadgetPart& part, const std::string& what);

/// Lengths of the header's record, and of the records before others that name them.
inline constexpr std::uint32_t gadget_header_bytes = 256, gadget_label_bytes = 8;

}  // namespace wheatstone
