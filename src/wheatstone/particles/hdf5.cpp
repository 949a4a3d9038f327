#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/hdf5_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"

namespace wheatstone {
namespace {

bool holds_numbers(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

herr_t note_dataset(hid_t group, const char* name, const H5L_info_t* /*link*/, void* names) {
  H5O_info_t about;
  if (H5Oget_info_by_name(group, name, &about, H5P_DEFAULT) >= 0 && about.type == H5O_TYPE_DATASET)
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// Whether the file can hold so many numbers: no filter packs a thousandfold and more, and rows that were never written
/// take no room at all. Of virtual datasets the library does not know what they take.
bool can_hold(hid_t dataset, hid_t type, hsize_t rows, hsize_t width) {
  const Hdf5Handle made(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(made) == H5D_VIRTUAL) return true;
  constexpr double most_packed = 1100;
  const double bytes = static_cast<double>(rows) * static_cast<double>(width) * static_cast<double>(H5Tget_size(type));
  return bytes <= most_packed * static_cast<double>(H5Dget_storage_size(dataset));
}

struct RowRange {
  hsize_t first, count;
};

template <class Number>
void read_as(hid_t type, const Hdf5Column& column, const RowRange& rows, std::vector<Number>& to,
             const std::string& file) {
  const hsize_t numbers = rows.count * column.width;
  to.resize(numbers);
  const Hdf5Handle space(H5Dget_space(column.dataset), H5Sclose);
  const std::array<hsize_t, 2> start{rows.first, 0};
  const std::array<hsize_t, 2> extent{rows.count, column.width};
  const Hdf5Handle memory(H5Screate_simple(1, &numbers, nullptr), H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  if (H5Dread(column.dataset, type, memory, space, H5P_DEFAULT, to.data()) < 0)
    throw Error(ErrorKind::bad_input, fmt::format("{}: rows {} to {} cannot be read, the file is damaged or cut short",
                                                  file, rows.first, rows.first + rows.count));
}

}  // namespace

Hdf5Handle open_hdf5(const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  check_plain_file(path, "a HDF5 file");
  Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is damaged or cut short, expected a whole HDF5 file", path.string()));
  return file;
}

bool hdf5_has(hid_t where, const std::string& name) {
  // Every link on the way has to be there: H5Lexists asks for the last one only.
  for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
    if (end > 0 && H5Lexists(where, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(where, name.c_str(), H5P_DEFAULT) > 0 && H5Oexists_by_name(where, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<double> hdf5_numbers(hid_t object, const std::string& attribute) {
  if (H5Aexists(object, attribute.c_str()) <= 0) return {};
  const Hdf5Handle opened(H5Aopen(object, attribute.c_str(), H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(opened), H5Tclose);
  const Hdf5Handle space(H5Aget_space(opened), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  constexpr hssize_t most = 1024;
  if (!holds_numbers(type) || count <= 0 || count > most) return {};
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (H5Aread(opened, H5T_NATIVE_DOUBLE, numbers.data()) < 0) return {};
  return numbers;
}

std::optional<double> hdf5_number(hid_t object, const std::string& attribute) {
  const std::vector<double> numbers = hdf5_numbers(object, attribute);
  if (numbers.empty()) return std::nullopt;
  return numbers.front();
}

std::string hdf5_text(hid_t object, const std::string& attribute) {
  if (H5Aexists(object, attribute.c_str()) <= 0) return {};
  const Hdf5Handle opened(H5Aopen(object, attribute.c_str(), H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(opened), H5Tclose);
  constexpr std::size_t most = 4096;
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || H5Tget_size(type) > most) return {};
  const Hdf5Handle space(H5Aget_space(opened), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1) return {};
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(opened, type, text.data()) < 0) return {};
  return text.substr(0, text.find('\0'));  // the rest is filled with zeros
}

std::vector<std::string> hdf5_datasets(hid_t group) {
  std::vector<std::string> names;
  H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, note_dataset, &names);
  return names;
}

Hdf5Column open_column(hid_t where, const std::string& name, const std::string& file) {
  const auto refuse = [&](const std::string& what) -> Hdf5Column {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} {}", file, name, what));
  };
  if (!hdf5_has(where, name)) return refuse("does not exist, expected a dataset");
  Hdf5Column column;
  column.dataset = Hdf5Handle(H5Dopen2(where, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!column.dataset) return refuse("is not a dataset");
  const Hdf5Handle type(H5Dget_type(column.dataset), H5Tclose);
  if (!holds_numbers(type)) return refuse("contains no numbers");
  const Hdf5Handle space(H5Dget_space(column.dataset), H5Sclose);
  std::array<hsize_t, 2> extent{0, 1};
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions < 1 || dimensions > 2)
    return refuse(fmt::format("has {} dimensions, expected one row per particle", dimensions));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  column.rows = extent[0];
  column.width = extent[1];
  column.single_precision = H5Tget_class(type) == H5T_FLOAT && H5Tget_size(type) <= sizeof(float);
  constexpr hsize_t widest = 1024;
  if (column.width == 0 || column.width > widest)
    return refuse(fmt::format("has {} numbers per row, expected at most {}", column.width, widest));
  if (!can_hold(column.dataset, type, column.rows, column.width))
    return refuse(fmt::format("says {} rows, which the file does not hold", column.rows));
  return column;
}

void read_rows(const Hdf5Column& column, hsize_t first, hsize_t count, std::vector<double>& to,
               const std::string& file) {
  read_as(H5T_NATIVE_DOUBLE, column, {first, count}, to, file);
}

void read_rows(const Hdf5Column& column, hsize_t first, hsize_t count, std::vector<std::uint64_t>& to,
               const std::string& file) {
  read_as(H5T_NATIVE_UINT64, column, {first, count}, to, file);
}

void read_rows(const Hdf5Column& column, hsize_t first, hsize_t count, std::vector<float>& to,
               const std::string& file) {
  const Hdf5Handle type(H5Dget_type(column.dataset), H5Tclose);
  if (H5Tget_size(type) <= sizeof(float)) {
    read_as(H5T_NATIVE_FLOAT, column, {first, count}, to, file);
    return;
  }
  std::vector<double> numbers;
  read_rows(column, first, count, numbers, file);
  to = in_single_precision(numbers);
}

std::optional<QuantityName> find_quantity(hid_t where, std::span<const std::string> datasets, const std::string& name) {
  for (const QuantityName& meant : {QuantityName{name, -1}, quantity_name(name)}) {
    if (hdf5_has(where, meant.base)) return meant;
    const int found = index_of_name(datasets, meant.base);
    if (found >= 0) return QuantityName{datasets[static_cast<std::size_t>(found)], meant.component};
  }
  return std::nullopt;
}

QuantityColumn read_quantity(const NamedHdf5Column& named, hsize_t first, hsize_t count, const std::string& file) {
  QuantityColumn column{.single_precision = named.column.single_precision};
  if (!named.column.dataset) return column;
  read_rows(named.column, first, count, column.values, file);
  take_component(named.column.width, named.component, column.values);
  return column;
}

void read_points(const Hdf5Column& column, hsize_t first, hsize_t count, ParticleRows& rows, const std::string& file) {
  if (column.single_precision && column.width == 3) {
    read_as(H5T_NATIVE_FLOAT, column, {first, count}, rows.single_points, file);
    return;
  }
  std::vector<double> numbers;
  read_rows(column, first, count, numbers, file);
  put_positions(std::move(numbers), column.width, rows);
}

}  // namespace wheatstone
