// Any HDF5 file whose datasets the user names.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/hdf5_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {
namespace {

struct Datasets {
  std::string path;
  Hdf5Handle file;
  std::vector<Hdf5Column> position;  // one of three numbers a row, or three of one
  Hdf5Column density, temperature, smoothing_length, mass, quantity;
  int component = -1;                  // of the quantity, where it is a vector
  std::vector<NamedHdf5Column> named;  // of CloudChoice::where
  hsize_t count = 0;
  hsize_t at = 0;  // of the next row
};

herr_t note_path(hid_t /*file*/, const char* name, const H5O_info_t* about, void* names) {
  if (about->type == H5O_TYPE_DATASET)
    static_cast<std::vector<std::string>*>(names)->push_back(fmt::format("/{}", name));
  return 0;
}

std::vector<std::string> all_datasets(hid_t file) {
  std::vector<std::string> names;
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, note_path, &names);
  return names;
}

/// Whether a dataset has rows of three numbers.
bool has_rows_of_three(hid_t file, const std::string& name) {
  const Hdf5Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset) return false;
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type);
  std::array<hsize_t, 2> extent{};
  if (H5Sget_simple_extent_ndims(space) != 2 || (kind != H5T_FLOAT && kind != H5T_INTEGER)) return false;
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  return extent[1] == 3 && extent[0] > 0;
}

/// The dataset of the positions where there can be no doubt: the only one of its name, or the only one with rows of
/// three numbers. Throws Error{bad_input} where there is doubt.
std::string only_position(const Datasets& datasets) {
  const std::vector<std::string> all = all_datasets(datasets.file);
  std::vector<std::string> candidates;
  std::vector<std::string> named;
  for (const std::string& name : all) {
    if (!has_rows_of_three(datasets.file, name)) continue;
    candidates.push_back(name);
    const std::string last = lower_case(name.substr(name.rfind('/') + 1));
    if (last == "coordinates" || last == "positions" || last == "position" || last == "pos") named.push_back(name);
  }
  if (named.size() == 1) return named.front();
  if (candidates.size() == 1) return candidates.front();
  throw Error(
      ErrorKind::bad_input,
      fmt::format(
          "{}: is not a snapshot, and {}, so --position must name the dataset of the positions; it has {}",
          datasets.path,
          candidates.empty() ? "no dataset has rows of three numbers" : "more than one dataset may hold the positions",
          fmt::join(all, ", ")));
}

std::vector<std::string> split(const std::string& names) {
  std::vector<std::string> parts;
  std::size_t first = 0;
  for (std::size_t comma = names.find(','); comma != std::string::npos; comma = names.find(',', first)) {
    parts.push_back(names.substr(first, comma - first));
    first = comma + 1;
  }
  parts.push_back(names.substr(first));
  return parts;
}

Hdf5Column open_named(const Datasets& datasets, const std::string& name) {
  if (name.empty()) return {};
  if (!hdf5_has(datasets.file, name))
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no dataset '{}', but {}", datasets.path, name,
                                                  fmt::join(all_datasets(datasets.file), ", ")));
  Hdf5Column column = open_column(datasets.file, name, datasets.path);
  if (datasets.count != 0 && column.rows != datasets.count)
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} has {} rows, but there are {} positions", datasets.path, name,
                                                  column.rows, datasets.count));
  return column;
}

/// The numbers of a column, if there is one; of vectors, one component.
void read_scalars(const Datasets& datasets, const Hdf5Column& column, int component, hsize_t count,
                  std::vector<float>& to) {
  if (!column.dataset) return;
  read_rows(column, datasets.at, count, to, datasets.path);
  take_component(column.width, component, to);
}

std::vector<double> read_axis(const Datasets& datasets, const Hdf5Column& column, hsize_t first, hsize_t count) {
  std::vector<double> values;
  read_rows(column, first, count, values, datasets.path);
  for (hsize_t i = 1; column.width > 1 && i < count; ++i) values[i] = values[i * column.width];
  values.resize(count);
  return values;
}

void read_positions(const Datasets& datasets, hsize_t first, hsize_t count, ParticleRows& rows) {
  if (datasets.position.size() == 3) {
    rows.x = read_axis(datasets, datasets.position[0], first, count);
    rows.y = read_axis(datasets, datasets.position[1], first, count);
    rows.z = read_axis(datasets, datasets.position[2], first, count);
    return;
  }
  read_points(datasets.position.front(), first, count, rows, datasets.path);
}

}  // namespace

CloudSource open_hdf5_cloud(const std::filesystem::path& path, const CloudChoice& choice) {
  auto datasets = std::make_shared<Datasets>();
  datasets->path = path.string();
  datasets->file = open_hdf5(path);
  // Names within a snapshot's group are a snapshot's; a path from the root is anybody's.
  if (is_snapshot_hdf5(datasets->file) && !choice.position.starts_with("/")) return open_gadget_hdf5(path, choice);
  const std::string position = choice.position.empty() ? only_position(*datasets) : choice.position;
  const std::vector<std::string> names = split(position);
  for (const std::string& name : names) {
    datasets->position.push_back(open_named(*datasets, name));
    datasets->count = datasets->position.back().rows;
  }
  if (names.size() != 3 && (names.size() != 1 || datasets->position.front().width < 3))
    throw Error(
        ErrorKind::bad_input,
        fmt::format(
            "{}: {} is not a list of positions, expected three numbers per row, or three datasets separated by commas",
            path.string(), position));
  datasets->density = open_named(*datasets, choice.density);
  datasets->temperature = open_named(*datasets, choice.temperature);
  datasets->smoothing_length = open_named(*datasets, choice.smoothing_length);
  datasets->mass = open_named(*datasets, choice.mass);
  // A dataset may have such a name itself.
  const bool as_named = choice.quantity.empty() || hdf5_has(datasets->file, choice.quantity);
  const QuantityName quantity = as_named ? QuantityName{choice.quantity, -1} : quantity_name(choice.quantity);
  datasets->quantity = open_named(*datasets, quantity.base);
  datasets->component = quantity.component;
  check_component(datasets->quantity.width, quantity, datasets->path);
  for (const std::string& name : names_in_condition(choice)) {
    const std::optional<QuantityName> found = find_quantity(datasets->file, all_datasets(datasets->file), name);
    datasets->named.push_back(found ? NamedHdf5Column{open_named(*datasets, found->base), found->component}
                                    : NamedHdf5Column{});
    check_component(datasets->named.back().column.width, found.value_or(QuantityName{}), datasets->path);
  }
  if (datasets->count == 0)
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} has no rows", path.string(), position));

  CloudSource source{.format = "HDF5", .count = datasets->count, .fields = all_datasets(datasets->file)};
  source.bytes = std::filesystem::file_size(path);
  const auto next = [datasets](std::size_t most, ParticleRows& rows) {
    const hsize_t count = std::min<hsize_t>(most, datasets->count - datasets->at);
    if (count == 0) return;
    read_positions(*datasets, datasets->at, count, rows);
    Cloud& cloud = rows.others;
    read_scalars(*datasets, datasets->density, 0, count, cloud.density);
    read_scalars(*datasets, datasets->temperature, 0, count, cloud.temperature);
    read_scalars(*datasets, datasets->smoothing_length, 0, count, cloud.smoothing_length);
    read_scalars(*datasets, datasets->mass, 0, count, cloud.mass);
    read_scalars(*datasets, datasets->quantity, datasets->component, count, cloud.quantity);
    for (const NamedHdf5Column& named : datasets->named)
      rows.named.push_back(read_quantity(named, datasets->at, count, datasets->path));
    datasets->at += count;
  };
  give_rows(next, path, choice, source);
  source.skip = [datasets](std::size_t most) -> std::size_t {
    const hsize_t count = std::min<hsize_t>(most, datasets->count - datasets->at);
    datasets->at += count;
    return count;
  };
  return source;
}

}  // namespace wheatstone
