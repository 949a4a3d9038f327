// What the files of GADGET's own binary snapshots hold, formats 1 and 2: Fortran records, each between two markers that
// say its length.

#include "wheatstone/particles/gadget_blocks_internal.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

constexpr std::size_t particle_types = GadgetPart::particle_types;

std::uint32_t read_marker(const GadgetPart& part, std::ifstream& file) {
  std::array<char, 4> bytes{};
  if (!file.read(bytes.data(), bytes.size())) refuse_gadget(part, "is cut short, expected a record's marker");
  return decode_gadget<std::uint32_t>(bytes.data(), part.swapped);
}

/// Steps over one record and says where its data is.
GadgetBlock step_over(const GadgetPart& part, std::ifstream& file) {
  GadgetBlock block;
  block.bytes = read_marker(part, file);
  block.begin = static_cast<std::uint64_t>(file.tellg());
  if (block.bytes > part.length - block.begin)
    refuse_gadget(part, fmt::format("is cut short: a record of {} bytes begins at byte {}, but {} are left",
                                    block.bytes, block.begin, part.length - block.begin));
  file.seekg(static_cast<std::streamoff>(block.begin + block.bytes));
  if (read_marker(part, file) != block.bytes)
    refuse_gadget(part, fmt::format("is damaged: the record at byte {} has different markers", block.begin));
  return block;
}

void read_header(GadgetPart& part, std::ifstream& file) {
  const GadgetBlock block = step_over(part, file);
  if (block.bytes != gadget_header_bytes)
    refuse_gadget(part, fmt::format("has a header of {} bytes, expected {}", block.bytes, gadget_header_bytes));
  const auto after = file.tellg();
  std::array<char, gadget_header_bytes> bytes{};
  file.seekg(static_cast<std::streamoff>(block.begin));
  file.read(bytes.data(), bytes.size());
  file.seekg(after);
  const bool swapped = part.swapped;
  for (std::size_t type = 0; type < particle_types; ++type) {
    part.count[type] = decode_gadget<std::uint32_t>(bytes.data() + 4 * type, swapped);
    part.mass[type] = decode_gadget<double>(bytes.data() + 24 + 8 * type, swapped);
    part.total[type] = decode_gadget<std::uint32_t>(bytes.data() + 96 + 4 * type, swapped) +
                       (std::uint64_t{decode_gadget<std::uint32_t>(bytes.data() + 168 + 4 * type, swapped)} << 32);
  }
  part.redshift = decode_gadget<double>(bytes.data() + 80, swapped);
  part.files = decode_gadget<std::int32_t>(bytes.data() + 124, swapped);
  part.box_size = decode_gadget<double>(bytes.data() + 128, swapped);
  if (part.files < 1 || part.files > 1'000'000) part.files = 1;
  if (!std::isfinite(part.box_size) || part.box_size < 0) part.box_size = 0;
}

/// Without labels, records are known by their order: masses only where some type has none in the header.
std::vector<std::string> usual_order(const GadgetPart& part) {
  std::vector<std::string> names{"POS", "VEL", "ID"};
  for (std::size_t type = 0; type < particle_types; ++type)
    if (part.count[type] > 0 && part.mass[type] == 0) {
      names.emplace_back("MASS");
      break;
    }
  if (part.count[0] > 0) names.insert(names.end(), {"U", "RHO", "HSML"});
  return names;
}

void read_blocks(GadgetPart& part, std::ifstream& file) {
  if (part.labelled) step_over(part, file);  // the header's label
  read_header(part, file);
  const std::vector<std::string> names = usual_order(part);
  while (static_cast<std::uint64_t>(file.tellg()) < part.length) {
    std::string name;
    if (part.labelled) {
      const GadgetBlock label = step_over(part, file);
      if (label.bytes != gadget_label_bytes)
        refuse_gadget(part, fmt::format("is damaged: no label at byte {}", label.begin));
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
    GadgetBlock block = step_over(part, file);
    block.name = name;
    part.blocks.push_back(block);
  }
}

/// What a record holds, as INFO tells it.
struct BlockTold {
  std::string name, kind;
  std::int32_t width;
  std::array<std::int32_t, particle_types> has;
};

std::string without_blanks(std::string text) {
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/// The entries of the record INFO: a name of 4 letters, a kind of number of 8, and 7 integers each.
std::vector<BlockTold> read_info(const GadgetPart& part, std::ifstream& file) {
  constexpr std::size_t entry_bytes = 40, most_entries = 1000;
  std::vector<BlockTold> told;
  const GadgetBlock* info = part.labelled ? part.find("INFO") : nullptr;
  if (info == nullptr || info->bytes / entry_bytes > most_entries) return told;
  std::string bytes(info->bytes, '\0');
  file.seekg(static_cast<std::streamoff>(info->begin));
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  for (std::size_t at = 0; at + entry_bytes <= bytes.size(); at += entry_bytes) {
    BlockTold& one = told.emplace_back();
    one.name = without_blanks(bytes.substr(at, 4));
    one.kind = without_blanks(bytes.substr(at + 4, 8));
    one.width = decode_gadget<std::int32_t>(bytes.data() + at + 12, part.swapped);
    for (std::size_t type = 0; type < particle_types; ++type)
      one.has[type] = decode_gadget<std::int32_t>(bytes.data() + at + 16 + 4 * type, part.swapped);
  }
  return told;
}

using Types = std::array<bool, particle_types>;
constexpr Types gas_only{true}, all_types{true, true, true, true, true, true},
    gas_and_stars{true, false, false, false, true};

/// Those that have masses of their own.
Types without_header_mass(const GadgetPart& part) {
  Types types{};
  for (std::size_t type = 0; type < particle_types; ++type) types[type] = part.mass[type] == 0;
  return types;
}

/// By the names that GADGET gives; false for others.
bool shape_by_name(const GadgetPart& part, GadgetBlock& block) {
  const auto is = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, block.name) != names.end();
  };
  if (is({"POS", "VEL", "ACCE"})) {
    block.has = all_types;
    block.width = 3;
  } else if (is({"ID", "POT", "TSTP"})) {
    block.has = all_types;
    block.whole = block.name == "ID";
  } else if (block.name == "MASS") {
    block.has = without_header_mass(part);
  } else if (is({"U", "RHO", "HSML", "NE", "NH", "SFR", "TEMP", "ENDT"})) {
    block.has = gas_only;
  } else {
    return false;
  }
  return true;
}

/// Of a name that is not known: the first types that its length fits, with numbers as long as those of the positions.
void shape_by_length(const GadgetPart& part, GadgetBlock& block) {
  const GadgetBlock* position = part.find("POS");
  if (position == nullptr || part.all() == 0) return;
  const std::uint64_t number = position->bytes / (3 * part.all());
  std::vector<Types> candidates{gas_only, all_types, gas_and_stars, without_header_mass(part)};
  for (std::size_t type = particle_types; type-- > 1;) candidates.emplace_back()[type] = true;
  for (const std::size_t width : {1, 3})
    for (const Types& types : candidates) {
      block.has = types;
      block.width = width;
      if (const std::uint64_t particles = part.particles(block);
          particles > 0 && particles * width * number == block.bytes)
        return;
    }
  block.has = {};
}

void tell_shapes(GadgetPart& part, std::ifstream& file) {
  const std::vector<BlockTold> told = read_info(part, file);
  for (GadgetBlock& block : part.blocks) {
    const auto info = std::ranges::find(told, block.name, &BlockTold::name);
    constexpr std::int32_t widest = 1024;
    // Positions are three numbers of every particle, whatever is told of them.
    if (info != told.end() && block.name != "POS" && info->width > 0 && info->width <= widest) {
      for (std::size_t type = 0; type < particle_types; ++type) block.has[type] = info->has[type] != 0;
      block.width = static_cast<std::size_t>(info->width);
      block.whole = info->kind.find("LONG") != std::string::npos;
    } else if (!shape_by_name(part, block)) {
      shape_by_length(part, block);
    }
  }
}

}  // namespace

void refuse_gadget(const GadgetPart& part, const std::string& what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", part.path, what));
}

const GadgetBlock* GadgetPart::find(const std::string& name) const {
  const auto found =
      std::ranges::find(blocks, lower_case(name), [](const GadgetBlock& block) { return lower_case(block.name); });
  return found == blocks.end() ? nullptr : &*found;
}

GadgetPart open_gadget_part(const std::filesystem::path& path) {
  check_plain_file(path, "a GADGET snapshot");
  GadgetPart part{.path = path.string()};
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> first{};
  file.read(first.data(), first.size());
  if (!file) refuse_gadget(part, "cannot be read, expected a GADGET snapshot");
  const auto native = decode_gadget<std::uint32_t>(first.data(), false);
  part.swapped = native != gadget_header_bytes && native != gadget_label_bytes;
  part.labelled = decode_gadget<std::uint32_t>(first.data(), part.swapped) == gadget_label_bytes;
  part.length = std::filesystem::file_size(path);
  file.seekg(0);
  read_blocks(part, file);
  tell_shapes(part, file);
  return part;
}

}  // namespace wheatstone
