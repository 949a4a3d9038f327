// GADGET's own binary snapshots, formats 1 and 2: Fortran records, each between two markers that say its length.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <numeric>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/gas_temperature_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t particle_types = 6;
constexpr std::uint32_t header_bytes = 256;
constexpr std::uint32_t label_bytes = 8;

template <class Number>
Number decode(const char* from, bool swapped) {
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), from, sizeof(Number));
  if (swapped) std::ranges::reverse(bytes);
  return std::bit_cast<Number>(bytes);
}

struct Block {
  std::string name;
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;
};

/// One file of a snapshot.
struct BinaryPart {
  std::string path;
  std::uint64_t length = 0;
  bool swapped = false;
  bool labelled = false;
  std::array<std::uint64_t, particle_types> count{}, total{};
  std::array<double, particle_types> mass{};
  double redshift = 0, box_size = 0;
  int files = 1;
  std::vector<Block> blocks;

  std::uint64_t all() const { return std::accumulate(count.begin(), count.end(), std::uint64_t{0}); }
  const Block* find(const std::string& name) const {
    const auto found = std::ranges::find(blocks, name, &Block::name);
    return found == blocks.end() ? nullptr : &*found;
  }
};

[[noreturn]] void refuse(const BinaryPart& part, const std::string& what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", part.path, what));
}

std::uint32_t read_marker(const BinaryPart& part, std::ifstream& file) {
  std::array<char, 4> bytes{};
  if (!file.read(bytes.data(), bytes.size())) refuse(part, "is cut short, expected a record's marker");
  return decode<std::uint32_t>(bytes.data(), part.swapped);
}

/// Steps over one record and says where its data is.
Block step_over(const BinaryPart& part, std::ifstream& file) {
  Block block;
  block.bytes = read_marker(part, file);
  block.begin = static_cast<std::uint64_t>(file.tellg());
  if (block.bytes > part.length - block.begin)
    refuse(part, fmt::format("is cut short: a record of {} bytes begins at byte {}, but {} are left", block.bytes,
                             block.begin, part.length - block.begin));
  file.seekg(static_cast<std::streamoff>(block.begin + block.bytes));
  if (read_marker(part, file) != block.bytes)
    refuse(part, fmt::format("is damaged: the record at byte {} has different markers", block.begin));
  return block;
}

void read_header(BinaryPart& part, std::ifstream& file) {
  const Block block = step_over(part, file);
  if (block.bytes != header_bytes)
    refuse(part, fmt::format("has a header of {} bytes, expected {}", block.bytes, header_bytes));
  const auto after = file.tellg();
  std::array<char, header_bytes> bytes{};
  file.seekg(static_cast<std::streamoff>(block.begin));
  file.read(bytes.data(), bytes.size());
  file.seekg(after);
  const bool swapped = part.swapped;
  for (std::size_t type = 0; type < particle_types; ++type) {
    part.count[type] = decode<std::uint32_t>(bytes.data() + 4 * type, swapped);
    part.mass[type] = decode<double>(bytes.data() + 24 + 8 * type, swapped);
    part.total[type] = decode<std::uint32_t>(bytes.data() + 96 + 4 * type, swapped) +
                       (std::uint64_t{decode<std::uint32_t>(bytes.data() + 168 + 4 * type, swapped)} << 32);
  }
  part.redshift = decode<double>(bytes.data() + 80, swapped);
  part.files = decode<std::int32_t>(bytes.data() + 124, swapped);
  part.box_size = decode<double>(bytes.data() + 128, swapped);
  if (part.files < 1 || part.files > 1'000'000) part.files = 1;
  if (!std::isfinite(part.box_size) || part.box_size < 0) part.box_size = 0;
}

/// Without labels, records are known by their order: masses only where some type has none in the header.
std::vector<std::string> usual_order(const BinaryPart& part) {
  std::vector<std::string> names{"POS", "VEL", "ID"};
  for (std::size_t type = 0; type < particle_types; ++type)
    if (part.count[type] > 0 && part.mass[type] == 0) {
      names.emplace_back("MASS");
      break;
    }
  if (part.count[0] > 0) names.insert(names.end(), {"U", "RHO", "HSML"});
  return names;
}

void read_blocks(BinaryPart& part, std::ifstream& file) {
  if (part.labelled) step_over(part, file);  // the header's label
  read_header(part, file);
  const std::vector<std::string> names = usual_order(part);
  while (static_cast<std::uint64_t>(file.tellg()) < part.length) {
    std::string name;
    if (part.labelled) {
      const Block label = step_over(part, file);
      if (label.bytes != label_bytes) refuse(part, fmt::format("is damaged: no label at byte {}", label.begin));
      const auto after = file.tellg();
      name.resize(4);
      file.seekg(static_cast<std::streamoff>(label.begin));
      file.read(name.data(), 4);
      file.seekg(after);
      name.erase(name.find_last_not_of(' ') + 1);
      if (static_cast<std::uint64_t>(after) >= part.length) break;
    } else if (part.blocks.size() < names.size()) {
      name = names[part.blocks.size()];
    }
    Block block = step_over(part, file);
    block.name = name;
    part.blocks.push_back(block);
  }
}

BinaryPart open_part(const std::filesystem::path& path) {
  check_plain_file(path, "a GADGET snapshot");
  BinaryPart part{.path = path.string()};
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> first{};
  file.read(first.data(), first.size());
  if (!file) refuse(part, "cannot be read, expected a GADGET snapshot");
  const auto native = decode<std::uint32_t>(first.data(), false);
  part.swapped = native != header_bytes && native != label_bytes;
  part.labelled = decode<std::uint32_t>(first.data(), part.swapped) == label_bytes;
  part.length = std::filesystem::file_size(path);
  file.seekg(0);
  read_blocks(part, file);
  return part;
}

/// A block as what it holds: `width` numbers for each of so many particles.
struct BinaryColumn {
  const Block& block;
  std::uint64_t particles;
  std::size_t width;
};

/// The numbers of `count` particles from number `first` on.
std::vector<double> read_numbers(const BinaryPart& part, std::ifstream& file, const BinaryColumn& column,
                                 std::uint64_t first, std::size_t count) {
  const auto& [block, particles, width] = column;
  const std::uint64_t numbers = particles * width;
  const std::uint64_t bytes = numbers == 0 ? 0 : block.bytes / numbers;
  if ((bytes != 4 && bytes != 8) || bytes * numbers != block.bytes)
    refuse(part, fmt::format("its record {} has {} bytes, expected {} numbers", block.name, block.bytes, numbers));
  std::vector<char> raw(count * width * bytes);
  file.seekg(static_cast<std::streamoff>(block.begin + first * width * bytes));
  if (!file.read(raw.data(), static_cast<std::streamsize>(raw.size()))) refuse(part, "is cut short");
  std::vector<double> values(count * width);
  if (block.name == "ID") {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = bytes == 4 ? static_cast<double>(decode<std::uint32_t>(raw.data() + 4 * i, part.swapped))
                             : static_cast<double>(decode<std::uint64_t>(raw.data() + 8 * i, part.swapped));
    return values;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = bytes == 4 ? static_cast<double>(decode<float>(raw.data() + 4 * i, part.swapped))
                           : decode<double>(raw.data() + 8 * i, part.swapped);
  return values;
}

struct BinaryReading {
  std::vector<BinaryPart> parts;
  std::size_t type = 0;
  QuantityName quantity;
  std::vector<std::string> named;  // of CloudChoice::where
  std::size_t part = 0;
  std::uint64_t at = 0;
  std::ifstream file;

  /// How many of the next particles are in one file, at most so many; 0 at the end.
  std::size_t ahead(std::size_t most) {
    while (part < parts.size() && at >= parts[part].count[type]) {
      ++part;
      at = 0;
      file.close();
    }
    if (part == parts.size()) return 0;
    return static_cast<std::size_t>(std::min<std::uint64_t>(most, parts[part].count[type] - at));
  }

  ParticleRows next(std::size_t most) {
    const std::size_t count = ahead(most);
    if (count == 0) return {};
    const BinaryPart& here = parts[part];
    if (!file.is_open()) file.open(here.path, std::ios::binary);
    ParticleRows rows = read(here, count);
    at += count;
    return rows;
  }

  std::size_t skip(std::size_t most) {
    const std::size_t count = ahead(most);
    at += count;
    return count;
  }

  ParticleRows read(const BinaryPart& here, std::size_t count) {
    ParticleRows rows;
    Cloud& cloud = rows.others;
    cloud.box_size = here.box_size;
    std::uint64_t before = at;
    for (std::size_t lower = 0; lower < type; ++lower) before += here.count[lower];
    put_positions(read_numbers(here, file, {*here.find("POS"), here.all(), 3}, before, count), 3, rows);
    put_mass(here, count, cloud);
    put_quantity(here, count, before, cloud);
    put_named(here, count, before, rows);
    if (type != 0) return rows;
    const auto gas = [&](const char* name) {
      const Block* block = here.find(name);
      return block == nullptr ? std::vector<float>{}
                              : in_single_precision(read_numbers(here, file, {*block, here.count[0], 1}, at, count));
    };
    cloud.temperature = gas("U");
    for (float& value : cloud.temperature) value = gas_temperature(value);
    cloud.density = gas("RHO");
    cloud.smoothing_length = gas("HSML");
    return rows;
  }

  /// Masses stand in their record only for the types to which the header gives none.
  void put_mass(const BinaryPart& here, std::size_t count, Cloud& cloud) {
    if (here.mass[type] > 0) {
      cloud.mass.assign(count, in_single_precision(here.mass[type]));
      return;
    }
    std::uint64_t particles = 0;
    std::uint64_t before = at;
    for (std::size_t other = 0; other < particle_types; ++other) {
      if (here.mass[other] > 0) continue;
      if (other < type) before += here.count[other];
      particles += here.count[other];
    }
    if (const Block* block = here.find("MASS"))
      cloud.mass = in_single_precision(read_numbers(here, file, {*block, particles, 1}, before, count));
  }

  /// The numbers of a record of all particles, or of the gas, one for each of the next particles. `before` is the
  /// number of the first among all.
  QuantityColumn read_record(const BinaryPart& here, const Block& block, int component, std::size_t count,
                             std::uint64_t before) {
    const bool vector = block.name == "VEL" || block.name == "POS";
    const bool of_all = vector || block.name == "ID" || block.name == "POT";
    const std::size_t width = vector ? 3 : 1;
    if (!of_all && type != 0) refuse(here, fmt::format("its record {} is of the gas only", block.name));
    const BinaryColumn column{block, of_all ? here.all() : here.count[0], width};
    QuantityColumn read{read_numbers(here, file, column, of_all ? before : at, count),
                        block.name != "ID" && block.bytes == sizeof(float) * column.particles * width};
    take_component(width, component, read.values);
    return read;
  }

  void put_quantity(const BinaryPart& here, std::size_t count, std::uint64_t before, Cloud& cloud) {
    if (quantity.base.empty()) return;
    const Block* block = here.find(quantity.base);
    if (block == nullptr) {
      std::vector<std::string_view> names;
      for (const Block& other : here.blocks) names.emplace_back(other.name);
      refuse(here, fmt::format("has no record '{}', but {}", quantity.base, fmt::join(names, ", ")));
    }
    cloud.quantity = in_single_precision(read_record(here, *block, quantity.component, count, before).values);
  }

  /// What the user's condition asks for, where there is such a record.
  void put_named(const BinaryPart& here, std::size_t count, std::uint64_t before, ParticleRows& rows) {
    for (const std::string& wanted : named) {
      QuantityName name = quantity_name(lower_case(wanted));
      if (name.base == "velocity") name.base = "vel";
      const auto block = std::ranges::find(here.blocks, name.base, [](const Block& b) { return lower_case(b.name); });
      rows.named.push_back(block == here.blocks.end() ? QuantityColumn{}
                                                      : read_record(here, *block, name.component, count, before));
    }
  }
};

}  // namespace

bool looks_like_gadget_binary(std::string_view first_bytes) {
  if (first_bytes.size() < 16) return false;
  for (const bool swapped : {false, true}) {
    const auto marker = decode<std::uint32_t>(first_bytes.data(), swapped);
    if (marker == header_bytes) return true;
    if (marker == label_bytes && first_bytes.substr(4, 4) == "HEAD") return true;
  }
  return false;
}

CloudSource open_gadget_binary(const std::filesystem::path& path, const CloudChoice& choice) {
  for (const std::string& wanted :
       {choice.position, choice.density, choice.temperature, choice.smoothing_length, choice.mass})
    if (!wanted.empty())
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: the fields of a GADGET binary file have no names, but '{}' was requested",
                              path.string(), wanted));
  auto reading = std::make_shared<BinaryReading>();
  reading->quantity = quantity_name(choice.quantity);
  if (reading->quantity.base == "velocity") reading->quantity.base = "VEL";
  reading->named = names_in_condition(choice);
  reading->type = static_cast<std::size_t>(snapshot_type(choice.type));
  const BinaryPart first = open_part(path);
  CloudSource source{.format = first.labelled ? "GADGET binary 2" : "GADGET binary 1",
                     .box_size = first.box_size,
                     .redshift = first.redshift};
  std::uint64_t count = 0;
  for (const std::filesystem::path& file : snapshot_files(path, first.files)) {
    reading->parts.push_back(open_part(file));
    const BinaryPart& part = reading->parts.back();
    if (part.all() > 0 && part.find("POS") == nullptr) refuse(part, "has no positions");
    count += part.count[reading->type];
    source.bytes += part.length;
  }
  for (const Block& block : first.blocks) source.fields.push_back(block.name);
  if (count == 0) {
    std::string present;
    for (std::size_t type = 0; type < particle_types; ++type)
      if (first.count[type] > 0)
        present += fmt::format("{}{}: {}", present.empty() ? "" : ", ", type, first.count[type]);
    refuse(first, fmt::format("has no particles of type '{}'; by type it has {}", choice.type,
                              present.empty() ? "none" : present));
  }
  if (first.total[reading->type] > count)
    refuse(first,
           fmt::format("its header says {} particles, but there are only {}", first.total[reading->type], count));
  source.count = count;
  give_rows([reading](std::size_t most, ParticleRows& rows) { rows = reading->next(most); }, path, choice, source);
  source.skip = [reading](std::size_t most) { return reading->skip(most); };
  return source;
}

}  // namespace wheatstone
