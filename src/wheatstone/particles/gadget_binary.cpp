// The particles of GADGET's own binary snapshots, formats 1 and 2.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/gadget_blocks_internal.h"
#include "wheatstone/particles/gas_temperature_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {
namespace {

/// The numbers of `count` particles of a block from number `first` on.
QuantityColumn read_numbers(const GadgetPart& part, std::ifstream& file, const GadgetBlock& block, std::uint64_t first,
                            std::size_t count) {
  const std::uint64_t numbers = part.particles(block) * block.width;
  const std::uint64_t bytes = numbers == 0 ? 0 : block.bytes / numbers;
  if ((bytes != 4 && bytes != 8) || bytes * numbers != block.bytes)
    refuse_gadget(part,
                  fmt::format("its record {} has {} bytes, expected {} numbers", block.name, block.bytes, numbers));
  std::vector<char> raw(count * block.width * bytes);
  file.seekg(static_cast<std::streamoff>(block.begin + first * block.width * bytes));
  if (!file.read(raw.data(), static_cast<std::streamsize>(raw.size()))) refuse_gadget(part, "is cut short");
  const auto decoded = [&](auto narrow, auto wide, std::size_t i) {
    return bytes == 4 ? static_cast<double>(decode_gadget<decltype(narrow)>(raw.data() + 4 * i, part.swapped))
                      : static_cast<double>(decode_gadget<decltype(wide)>(raw.data() + 8 * i, part.swapped));
  };
  QuantityColumn read{std::vector<double>(count * block.width), bytes == 4 && !block.whole};
  for (std::size_t i = 0; i < read.values.size(); ++i)
    read.values[i] = block.whole ? decoded(std::uint32_t{}, std::uint64_t{}, i) : decoded(float{}, double{}, i);
  return read;
}

/// A record that a quantity names, and the component of its vectors; −1: their length.
struct NamedBlock {
  const GadgetBlock* block = nullptr;
  int component = -1;
};

NamedBlock block_of_quantity(const GadgetPart& part, const std::string& wanted) {
  if (const GadgetBlock* block = part.find(wanted)) return {block};
  const QuantityName name = quantity_name(wanted);
  return {part.find(lower_case(name.base) == "velocity" ? "VEL" : name.base), name.component};
}

std::vector<std::string> names_of(const GadgetPart& part) {
  std::vector<std::string> names;
  for (const GadgetBlock& block : part.blocks)
    if (block.name != "INFO" && !block.name.empty()) names.push_back(block.name);
  return names;
}

struct BinaryReading {
  std::vector<GadgetPart> parts;
  std::size_t type = 0;
  CloudChoice choice;
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
    const GadgetPart& here = parts[part];
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

  ParticleRows read(const GadgetPart& here, std::size_t count) {
    ParticleRows rows;
    Cloud& cloud = rows.others;
    cloud.box_size = here.box_size;
    put_positions(read_record(here, *here.find("POS"), count).values, 3, rows);
    cloud.density = column(here, choice.density, "RHO", count);
    cloud.smoothing_length = column(here, choice.smoothing_length, "HSML", count);
    put_temperature(here, count, cloud);
    cloud.mass = column(here, choice.mass, "MASS", count);
    if (choice.mass.empty() && here.mass[type] > 0) cloud.mass.assign(count, in_single_precision(here.mass[type]));
    if (!choice.quantity.empty()) cloud.quantity = column(here, choice.quantity, "", count);
    for (const std::string& name : names_in_condition(choice)) {
      const NamedBlock named = block_of_quantity(here, name);
      rows.named.push_back(named.block == nullptr ? QuantityColumn{}
                                                  : read_record(here, *named.block, count, named.component));
    }
    return rows;
  }

  /// The numbers of a record, one for each of the next particles; of vectors all, or a component, or with −1 the
  /// length.
  QuantityColumn read_record(const GadgetPart& here, const GadgetBlock& block, std::size_t count,
                             std::optional<int> component = {}) {
    if (!block.has[type])
      refuse_gadget(here, fmt::format("its record {} has no numbers for particles of this type", block.name));
    QuantityColumn read = read_numbers(here, file, block, at + here.particles(block, type), count);
    if (!component) return read;
    check_component(block.width, {block.name, *component}, here.path);
    take_component(block.width, *component, read.values);
    return read;
  }

  /// The record that the user named, or the usual one where these particles have it.
  std::vector<float> column(const GadgetPart& here, const std::string& wanted, const char* usual, std::size_t count) {
    NamedBlock named{here.find(usual)};
    if (!wanted.empty()) named = block_of_quantity(here, wanted);
    if (!wanted.empty() && named.block == nullptr)
      refuse_gadget(here, fmt::format("has no record '{}', but {}", wanted, fmt::join(names_of(here), ", ")));
    if (named.block == nullptr || (wanted.empty() && !named.block->has[type])) return {};
    return in_single_precision(read_record(here, *named.block, count, named.component).values);
  }

  void put_temperature(const GadgetPart& here, std::size_t count, Cloud& cloud) {
    cloud.temperature = column(here, choice.temperature, "U", count);
    if (!choice.temperature.empty()) return;
    const std::vector<float> electrons = column(here, {}, "NE", count);
    for (std::size_t i = 0; i < cloud.temperature.size(); ++i)
      cloud.temperature[i] = electrons.empty() ? gas_temperature(cloud.temperature[i])
                                               : gas_temperature(cloud.temperature[i], electrons[i]);
  }
};

}  // namespace

bool looks_like_gadget_binary(std::string_view first_bytes) {
  if (first_bytes.size() < 16) return false;
  for (const bool swapped : {false, true}) {
    const auto marker = decode_gadget<std::uint32_t>(first_bytes.data(), swapped);
    if (marker == gadget_header_bytes) return true;
    if (marker == gadget_label_bytes && first_bytes.substr(4, 4) == "HEAD") return true;
  }
  return false;
}

CloudSource open_gadget_binary(const std::filesystem::path& path, const CloudChoice& choice) {
  auto reading = std::make_shared<BinaryReading>();
  reading->choice = choice;
  reading->type = static_cast<std::size_t>(snapshot_type(choice.type));
  const GadgetPart first = open_gadget_part(path);
  for (const std::string& wanted : {choice.density, choice.temperature, choice.smoothing_length, choice.mass})
    if (!wanted.empty() && !first.labelled)
      throw Error(
          ErrorKind::wrong_usage,
          fmt::format("{}: the records of a GADGET binary file of format 1 have no names, but '{}' was requested",
                      path.string(), wanted));
  if (!choice.position.empty())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: the positions of a GADGET binary file are its record POS, but '{}' was requested",
                            path.string(), choice.position));
  CloudSource source{.format = first.labelled ? "GADGET binary 2" : "GADGET binary 1",
                     .box_size = first.box_size,
                     .redshift = first.redshift};
  std::uint64_t count = 0;
  for (const std::filesystem::path& file : snapshot_files(path, first.files)) {
    reading->parts.push_back(open_gadget_part(file));
    const GadgetPart& part = reading->parts.back();
    if (part.all() > 0 && part.find("POS") == nullptr) refuse_gadget(part, "has no positions");
    count += part.count[reading->type];
    source.bytes += part.length;
  }
  source.fields = names_of(first);
  if (count == 0) {
    std::string present;
    for (std::size_t type = 0; type < GadgetPart::particle_types; ++type)
      if (first.count[type] > 0)
        present += fmt::format("{}{}: {}", present.empty() ? "" : ", ", type, first.count[type]);
    refuse_gadget(first, fmt::format("has no particles of type '{}'; by type it has {}", choice.type,
                                     present.empty() ? "none" : present));
  }
  if (first.total[reading->type] > count)
    refuse_gadget(
        first, fmt::format("its header says {} particles, but there are only {}", first.total[reading->type], count));
  source.count = count;
  give_rows([reading](std::size_t most, ParticleRows& rows) { rows = reading->next(most); }, path, choice, source);
  source.skip = [reading](std::size_t most) { return reading->skip(most); };
  return source;
}

}  // namespace wheatstone
