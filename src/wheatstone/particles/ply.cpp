// PLY: ascii, and binary of either byte order. The vertices must stand first.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include "wheatstone/error.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"
#include "wheatstone/particles/records_internal.h"

namespace wheatstone {
namespace {

struct Property {
  std::string name;
  NumberType type;
};

struct PlyHeader {
  std::string format;
  std::uint64_t vertices = 0;
  std::vector<Property> properties;
  std::uint64_t bytes = 0;  ///< of the header itself
};

std::optional<NumberType> type_of(const std::string& name) {
  constexpr std::pair<const char*, NumberType> types[] = {
      {"char", NumberType::i8},    {"int8", NumberType::i8},     {"uchar", NumberType::u8},
      {"uint8", NumberType::u8},   {"short", NumberType::i16},   {"int16", NumberType::i16},
      {"ushort", NumberType::u16}, {"uint16", NumberType::u16},  {"int", NumberType::i32},
      {"int32", NumberType::i32},  {"uint", NumberType::u32},    {"uint32", NumberType::u32},
      {"float", NumberType::f32},  {"float32", NumberType::f32}, {"double", NumberType::f64},
      {"float64", NumberType::f64}};
  for (const auto& [known, type] : types)
    if (name == known) return type;
  return std::nullopt;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), what));
}

void add_property(const std::filesystem::path& path, std::istringstream& words, PlyHeader& header) {
  std::string type;
  std::string name;
  words >> type >> name;
  if (type == "list") refuse(path, "its vertices have lists, expected numbers only");
  const std::optional<NumberType> known = type_of(type);
  if (!known) refuse(path, fmt::format("has a property of the unknown type '{}'", type.substr(0, 40)));
  header.properties.push_back({name, *known});
}

PlyHeader read_header(const std::filesystem::path& path, std::ifstream& file) {
  PlyHeader header;
  std::string line;
  std::string element;
  bool first_element = true;
  constexpr int most_lines = 10000;
  for (int i = 0; i < most_lines && std::getline(file, line); ++i) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "end_header") {
      header.bytes = static_cast<std::uint64_t>(file.tellg());
      return header;
    }
    if (word == "format") words >> header.format;
    if (word == "element") {
      words >> element;
      if (element == "vertex") {
        if (!first_element) refuse(path, "has other elements before its vertices");
        if (!(words >> header.vertices)) refuse(path, "does not give the number of vertices");
      }
      first_element = false;
    }
    if (word == "property" && element == "vertex") add_property(path, words, header);
  }
  refuse(path, "its PLY header has no end");
}

/// Finds the fields of a record by the properties' names.
class Finder {
 public:
  Finder(const std::filesystem::path& path, const PlyHeader& header) : path_(path) {
    for (const Property& property : header.properties) {
      names_.push_back(property.name);
      fields_.push_back({.at = bytes_, .type = property.type});
      bytes_ += bytes_of(property.type);
    }
  }
  std::size_t record_bytes() const { return bytes_; }
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<RecordField>& fields() const { return fields_; }

  std::optional<RecordField> find(std::initializer_list<const char*> usual) const {
    for (const char* name : usual) {
      const auto found = std::ranges::find(names_, name);
      if (found != names_.end()) return fields_[static_cast<std::size_t>(found - names_.begin())];
    }
    return std::nullopt;
  }
  std::optional<RecordField> find(const std::string& wanted, std::initializer_list<const char*> usual) const {
    if (wanted.empty()) return find(usual);
    const std::optional<RecordField> found = find({wanted.c_str()});
    if (!found) refuse(path_, fmt::format("has no property '{}', but {}", wanted, fmt::join(names_, ", ")));
    return found;
  }
  RecordField need(const std::string& name) const { return *find(name, {}); }

 private:
  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<RecordField> fields_;
  std::size_t bytes_ = 0;
};

RecordLayout layout_of(const std::filesystem::path& path, const PlyHeader& header, const Finder& finder,
                       const CloudChoice& choice) {
  RecordLayout layout{
      .path = path, .begin = header.bytes, .record_bytes = finder.record_bytes(), .count = header.vertices};
  const std::array<std::string, 3> axes = position_names(path.string(), choice);
  layout.position = {finder.need(axes[0]), finder.need(axes[1]), finder.need(axes[2])};
  layout.density = finder.find(choice.density, {"density"});
  layout.temperature = finder.find(choice.temperature, {"temperature", "scalar", "intensity", "scalar_Intensity"});
  layout.smoothing_length = finder.find(choice.smoothing_length, {"smoothing_length"});
  layout.mass = finder.find(choice.mass, {"mass"});
  if (!choice.quantity.empty()) layout.quantity = finder.find(choice.quantity, {});
  for (const std::string& wanted : names_in_condition(choice)) {
    const int field = index_of_name(finder.names(), wanted);
    layout.named.push_back(field < 0 ? std::nullopt : std::optional(finder.fields()[static_cast<std::size_t>(field)]));
  }
  std::array<std::optional<RecordField>, 3> colour{finder.find({"red", "r", "diffuse_red"}),
                                                   finder.find({"green", "g", "diffuse_green"}),
                                                   finder.find({"blue", "b", "diffuse_blue"})};
  if (colour[0] && colour[1] && colour[2] && choice.temperature.empty()) {
    // Whole numbers are 0..255, or 0..65535; floats are 0..1.
    for (auto& channel : colour)
      channel->scale = channel->type == NumberType::u16                                       ? 1. / 257
                       : channel->type == NumberType::f32 || channel->type == NumberType::f64 ? 255.
                                                                                              : 1.;
    layout.colour = {*colour[0], *colour[1], *colour[2]};
  }
  return layout;
}

/// Ascii vertices, turned into records of doubles, which are then read like any others.
struct AsciiVertices {
  std::filesystem::path path;
  std::ifstream file;
  std::uint64_t left = 0;
  std::size_t properties = 0;
  RecordLayout layout;

  double value(const std::vector<double>& row, const RecordField& field) const {
    return row[field.at] * field.scale + field.offset;
  }
  void add(const std::vector<double>& row, ParticleRows& rows) const {
    rows.x.push_back(value(row, layout.position[0]));
    rows.y.push_back(value(row, layout.position[1]));
    rows.z.push_back(value(row, layout.position[2]));
    Cloud& cloud = rows.others;
    if (layout.density) cloud.density.push_back(in_single_precision(value(row, *layout.density)));
    if (layout.temperature) cloud.temperature.push_back(in_single_precision(value(row, *layout.temperature)));
    if (layout.smoothing_length)
      cloud.smoothing_length.push_back(in_single_precision(value(row, *layout.smoothing_length)));
    if (layout.mass) cloud.mass.push_back(in_single_precision(value(row, *layout.mass)));
    if (layout.quantity) cloud.quantity.push_back(in_single_precision(value(row, *layout.quantity)));
    for (std::size_t i = 0; i < layout.named.size(); ++i)
      if (layout.named[i]) rows.named[i].values.push_back(value(row, *layout.named[i]));
    if (layout.colour) {
      const auto byte = [&](std::size_t channel) {
        return static_cast<std::uint8_t>(std::clamp(value(row, (*layout.colour)[channel]), 0., 255.));
      };
      cloud.colour.push_back({byte(0), byte(1), byte(2)});
    }
  }
  ParticleRows next(std::size_t most) {
    ParticleRows rows;
    rows.named.resize(layout.named.size());
    std::vector<double> row(properties);
    for (; left > 0 && rows.size() < most; --left) {
      for (double& number : row)
        if (!(file >> number)) refuse(path, fmt::format("is damaged or cut short, {} vertices before its end", left));
      add(row, rows);
    }
    return rows;
  }
};

CloudSource open_ascii(const std::filesystem::path& path, const PlyHeader& header, const Finder& finder,
                       RecordLayout layout, const CloudChoice& choice) {
  auto vertices = std::make_shared<AsciiVertices>();
  // A field's place is its number within the row.
  const auto number_of = [&](RecordField& field) {
    const auto found = std::ranges::find(finder.fields(), field.at, &RecordField::at);
    field.at = static_cast<std::size_t>(found - finder.fields().begin());
  };
  for (RecordField& field : layout.position) number_of(field);
  for (auto* field : {&layout.density, &layout.temperature, &layout.smoothing_length, &layout.mass, &layout.quantity})
    if (*field) number_of(**field);
  for (std::optional<RecordField>& field : layout.named)
    if (field) number_of(*field);
  if (layout.colour)
    for (RecordField& field : *layout.colour) number_of(field);
  vertices->path = path;
  vertices->file.open(path);
  vertices->file.seekg(static_cast<std::streamoff>(header.bytes));
  vertices->left = header.vertices;
  vertices->properties = header.properties.size();
  vertices->layout = layout;
  if (header.vertices == 0) refuse(path, "has no vertices");
  // A number takes two bytes at least.
  if (header.vertices > std::filesystem::file_size(path) / 2 / header.properties.size())
    refuse(path, fmt::format("is cut short: its header says {} vertices", header.vertices));
  CloudSource source{.format = "PLY ascii", .count = header.vertices, .fields = finder.names()};
  source.bytes = std::filesystem::file_size(path);
  give_rows([vertices](std::size_t most, ParticleRows& rows) { rows = vertices->next(most); }, path, choice, source);
  return source;
}

}  // namespace

CloudSource open_ply(const std::filesystem::path& path, const CloudChoice& choice) {
  std::ifstream file(path, std::ios::binary);
  const PlyHeader header = read_header(path, file);
  const Finder finder(path, header);
  RecordLayout layout = layout_of(path, header, finder, choice);
  if (header.format == "ascii") return open_ascii(path, header, finder, layout, choice);
  const bool little = header.format == "binary_little_endian";
  if (!little && header.format != "binary_big_endian")
    refuse(path, fmt::format("is of format '{}', expected ascii or binary", header.format.substr(0, 40)));
  layout.swapped = little != (std::endian::native == std::endian::little);
  return open_records(layout, "PLY binary", finder.names(), choice);
}

}  // namespace wheatstone
