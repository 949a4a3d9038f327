// GADGET's HDF5 snapshots and those of its relatives: GADGET-2, -3, -4, AREPO, SWIFT.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/gas_temperature_internal.h"
#include "wheatstone/particles/hdf5_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {
namespace {

/// The first of several names that a group has; empty where it has none.
std::string first_of(hid_t group, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (hdf5_has(group, name)) return name;
  return {};
}

/// The columns of one file's particles of one type.
struct Part {
  std::string path;
  Hdf5Handle file, group;
  hsize_t count = 0;
  Hdf5Column position, density, temperature, energy, electrons, smoothing_length, volume, mass, quantity;
  Hdf5Column id, velocity;
  std::vector<NamedHdf5Column> named;  // of CloudChoice::where
  double rate_of_velocity = 1;
  int component = -1;          // of the quantity, where it is a vector
  double mass_of_each = 0;     // where the header says it
  float radius_of_length = 1;  // of the kernel, over what the file calls the smoothing length
};

/// SWIFT's smoothing lengths measure its kernels' widths, not the radii where they end. How many of them these are:
/// Dehnen & Aly 2012, table 1, in three dimensions.
float radius_of_swift_length(hid_t file) {
  constexpr std::array<std::pair<const char*, float>, 6> kernels{{{"Cubic spline (M4)", 1.825742f},
                                                                  {"Quartic spline (M5)", 2.018932f},
                                                                  {"Quintic spline (M6)", 2.195775f},
                                                                  {"Wendland C2", 1.936492f},
                                                                  {"Wendland C4", 2.207940f},
                                                                  {"Wendland C6", 2.449490f}}};
  if (!hdf5_has(file, "HydroScheme")) return 1;
  const Hdf5Handle scheme(H5Gopen2(file, "HydroScheme", H5P_DEFAULT), H5Gclose);
  const std::string name = hdf5_text(scheme, "Kernel function");
  const auto* const found = std::ranges::find(kernels, name, [](const auto& kernel) { return kernel.first; });
  return found == kernels.end() ? kernels.front().second : found->second;
}

double box_size_of(hid_t file) {
  if (!hdf5_has(file, "Header")) return 0;
  const Hdf5Handle header(H5Gopen2(file, "Header", H5P_DEFAULT), H5Gclose);
  const double size = hdf5_number(header, "BoxSize").value_or(0);
  return std::isfinite(size) && size > 0 ? size : 0;
}

/// The mass that the header gives to every particle of a type; 0 where they have their own.
double header_mass(hid_t file, int type) {
  if (!hdf5_has(file, "Header")) return 0;
  const Hdf5Handle header(H5Gopen2(file, "Header", H5P_DEFAULT), H5Gclose);
  const std::vector<double> masses = hdf5_numbers(header, "MassTable");
  const auto entry = static_cast<std::size_t>(type);
  return entry < masses.size() && std::isfinite(masses[entry]) && masses[entry] > 0 ? masses[entry] : 0;
}

std::string refuse_missing(const Part& part, const std::string& name) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: has no '{}' for these particles, but {}", part.path, name,
                                                fmt::join(hdf5_datasets(part.group), ", ")));
}

/// Opens the column that the user named, or the first of the usual names; an empty column where there is none.
Hdf5Column find_column(const Part& part, const std::string& wanted, std::initializer_list<const char*> usual) {
  std::string name = wanted;
  if (name.empty()) {
    name = first_of(part.group, usual);
    if (name.empty()) return {};
  }
  if (!hdf5_has(part.group, name)) refuse_missing(part, name);
  Hdf5Column column = open_column(part.group, name, part.path);
  if (column.rows != part.count)
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} has {} rows, but there are {} positions", part.path, name,
                                                  column.rows, part.count));
  return column;
}

/// Opens what tells how the particles move.
void find_motion(Part& part) {
  part.id = find_column(part, "ParticleIDs", {});
  part.velocity = find_column(part, {}, {"Velocities"});
  if (part.velocity.dataset && part.velocity.width != 3)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: Velocities has {} numbers per row, expected 3", part.path, part.velocity.width));
  part.rate_of_velocity = snapshot_time(part.file, part.group).rate_of_velocity;
}

/// The dataset that the user wants to be shown.
void open_quantity(Part& part, const std::string& wanted) {
  if (wanted.empty()) return;
  QuantityName name{wanted, -1};
  if (!hdf5_has(part.group, wanted)) name = quantity_name(wanted);
  if (name.base == "velocity" && !hdf5_has(part.group, name.base))
    name.base = first_of(part.group, {"Velocities", "Velocity"});
  part.quantity = find_column(part, name.base.empty() ? wanted : name.base, {});
  part.component = name.component;
  check_component(part.quantity.width, name, part.path);
}

/// The datasets that the user's condition asks for, as far as there are such.
void open_named(Part& part, const CloudChoice& choice) {
  const std::vector<std::string> datasets = hdf5_datasets(part.group);
  for (const std::string& wanted : names_in_condition(choice)) {
    std::optional<QuantityName> name = find_quantity(part.group, datasets, wanted);
    const QuantityName velocity = quantity_name(lower_case(wanted));
    const std::string velocities = first_of(part.group, {"Velocities", "Velocity"});
    if (!name && velocity.base == "velocity" && !velocities.empty()) name = {velocities, velocity.component};
    part.named.push_back(name ? NamedHdf5Column{find_column(part, name->base, {}), name->component}
                              : NamedHdf5Column{});
    if (name) check_component(part.named.back().column.width, *name, part.path);
  }
}

Part open_part(const std::filesystem::path& path, int type, const CloudChoice& choice) {
  Part part;
  part.path = path.string();
  part.file = open_hdf5(path);
  const std::string group = fmt::format("PartType{}", type);
  if (!hdf5_has(part.file, group)) return part;  // a part of a snapshot may have none of this type
  part.group = Hdf5Handle(H5Gopen2(part.file, group.c_str(), H5P_DEFAULT), H5Gclose);
  const std::string position = choice.position.empty() ? "Coordinates" : choice.position;
  if (!hdf5_has(part.group, position)) refuse_missing(part, position);
  part.position = open_column(part.group, position, part.path);
  if (part.position.width != 3)
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}/{} has {} numbers per row, expected 3", part.path, group,
                                                  position, part.position.width));
  part.count = part.position.rows;
  part.density = find_column(part, choice.density, {"Density", "Densities"});
  part.temperature = find_column(part, choice.temperature, {"Temperature", "Temperatures"});
  if (!part.temperature.dataset) part.energy = find_column(part, {}, {"InternalEnergy", "InternalEnergies"});
  part.electrons = find_column(part, {}, {"ElectronAbundance"});
  part.smoothing_length = find_column(part, choice.smoothing_length, {"SmoothingLength", "SmoothingLengths"});
  if (choice.smoothing_length.empty()) part.radius_of_length = radius_of_swift_length(part.file);
  if (!part.smoothing_length.dataset) part.volume = find_column(part, {}, {"Volume"});  // AREPO's cells
  part.mass = find_column(part, choice.mass, {"Masses", "Mass"});
  if (!part.mass.dataset) part.mass_of_each = header_mass(part.file, type);
  open_quantity(part, choice.quantity);
  open_named(part, choice);
  if (choice.motion) find_motion(part);
  return part;
}

/// A column of one number a row; of vectors, their length.
void put_scalars(const Part& part, const Hdf5Column& column, hsize_t first, hsize_t count, std::vector<float>& to) {
  if (!column.dataset) return;
  read_rows(column, first, count, to, part.path);
  take_component(column.width, -1, to);
}

void put_temperature(const Part& part, hsize_t first, hsize_t count, Cloud& cloud) {
  put_scalars(part, part.temperature, first, count, cloud.temperature);
  if (!part.energy.dataset) return;
  put_scalars(part, part.energy, first, count, cloud.temperature);
  std::vector<float> electrons;
  put_scalars(part, part.electrons, first, count, electrons);
  for (std::size_t i = 0; i < cloud.temperature.size(); ++i)
    cloud.temperature[i] =
        electrons.empty() ? gas_temperature(cloud.temperature[i]) : gas_temperature(cloud.temperature[i], electrons[i]);
}

void put_smoothing_length(const Part& part, hsize_t first, hsize_t count, Cloud& cloud) {
  put_scalars(part, part.smoothing_length, first, count, cloud.smoothing_length);
  for (float& length : cloud.smoothing_length) length *= part.radius_of_length;
  std::vector<float> volume;
  put_scalars(part, part.volume, first, count, volume);
  // The radius of the ball that holds as many cells as a kernel does particles, 32, over the side of a cell.
  constexpr float radius_of_side = 1.9695f;
  if (!part.smoothing_length.dataset && !volume.empty()) {
    for (const float cell : volume) cloud.smoothing_length.push_back(radius_of_side * std::cbrt(cell));
  } else if (!part.smoothing_length.dataset && !cloud.mass.empty() && !cloud.density.empty()) {
    for (std::size_t i = 0; i < cloud.mass.size(); ++i)
      cloud.smoothing_length.push_back(radius_of_side * std::cbrt(cloud.mass[i] / cloud.density[i]));
  }
}

void put_motion(const Part& part, hsize_t first, hsize_t count, Cloud& cloud) {
  if (part.id.dataset) read_rows(part.id, first, count, cloud.id, part.path);
  if (!part.velocity.dataset) return;
  std::vector<double> velocities;
  read_rows(part.velocity, first, count, velocities, part.path);
  const std::array<std::vector<float>*, 3> rates{&cloud.rate_x, &cloud.rate_y, &cloud.rate_z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rates[axis]->resize(count);
    for (std::size_t i = 0; i < count; ++i)
      (*rates[axis])[i] = in_single_precision(velocities[3 * i + axis] * part.rate_of_velocity);
  }
}

/// Masses, and what the user wants to be shown.
void put_mass_and_quantity(const Part& part, hsize_t first, hsize_t count, Cloud& cloud) {
  put_scalars(part, part.mass, first, count, cloud.mass);
  if (part.mass_of_each > 0) cloud.mass.assign(count, in_single_precision(part.mass_of_each));
  if (!part.quantity.dataset) return;
  read_rows(part.quantity, first, count, cloud.quantity, part.path);
  take_component(part.quantity.width, part.component, cloud.quantity);
}

void read_part(const Part& part, hsize_t first, hsize_t count, ParticleRows& rows) {
  read_points(part.position, first, count, rows, part.path);
  Cloud& cloud = rows.others;
  put_scalars(part, part.density, first, count, cloud.density);
  put_temperature(part, first, count, cloud);
  put_mass_and_quantity(part, first, count, cloud);
  put_smoothing_length(part, first, count, cloud);
  put_motion(part, first, count, cloud);
  for (const NamedHdf5Column& named : part.named) rows.named.push_back(read_quantity(named, first, count, part.path));
}

/// Which columns a part has: those of one snapshot have the same.
std::array<bool, 8> columns_of(const Part& part) {
  const auto has = [](const Hdf5Column& column) { return static_cast<bool>(column.dataset); };
  return {has(part.density),          has(part.temperature), has(part.energy), has(part.electrons),
          has(part.smoothing_length), has(part.volume),      has(part.mass),   has(part.velocity)};
}

/// Particles of one type in all files of a snapshot. One file is open at a time: there may be thousands.
struct Snapshot {
  CloudChoice choice;
  int type = 0;
  double box_size = 0;
  std::vector<std::filesystem::path> files;  // those that have such particles
  std::size_t next_file = 0;
  Part part;
  hsize_t at = 0;

  /// How many of the next particles are in one file, at most so many; 0 at the end.
  hsize_t ahead(std::size_t most) {
    while (at >= part.count) {
      if (next_file == files.size()) return 0;
      part = {};  // closes it before the next one is opened
      part = open_part(files[next_file++], type, choice);
      at = 0;
    }
    return std::min<hsize_t>(most, part.count - at);
  }

  void next(std::size_t most, ParticleRows& rows) {
    const hsize_t count = ahead(most);
    if (count == 0) return;
    read_part(part, at, count, rows);
    rows.others.box_size = box_size;
    at += count;
  }

  std::size_t skip(std::size_t most) {
    const hsize_t count = ahead(most);
    at += count;
    return count;
  }
};

/// Which types a file has, for the message when the chosen one is not among them.
std::string types_in(hid_t file) {
  std::string types;
  for (int type = 0; type < 8; ++type) {
    const std::string name = fmt::format("PartType{}/Coordinates", type);
    if (!hdf5_has(file, name)) continue;
    types += fmt::format("{}{}: {}", types.empty() ? "" : ", ", type, open_column(file, name, {}).rows);
  }
  return types.empty() ? "none" : types;
}

/// What a snapshot's header says of all its files.
struct Header {
  int files = 1;
  std::uint64_t total = 0;  ///< of the chosen type; 0 where it is not said
  std::optional<double> redshift;
};

Header read_header(const Hdf5Handle& file, int type) {
  Header header;
  if (!hdf5_has(file, "Header")) return header;
  const Hdf5Handle group(H5Gopen2(file, "Header", H5P_DEFAULT), H5Gclose);
  const double files = hdf5_number(group, "NumFilesPerSnapshot").value_or(1);
  header.files = files >= 1 && files < 1e6 ? static_cast<int>(files) : 1;
  header.redshift = hdf5_number(group, "Redshift");
  const std::vector<double> total = hdf5_numbers(group, "NumPart_Total");
  const std::vector<double> high = hdf5_numbers(group, "NumPart_Total_HighWord");
  const auto entry = static_cast<std::size_t>(type);
  double count = entry < total.size() ? total[entry] : 0;
  if (entry < high.size()) count += high[entry] * 4294967296.;
  header.total = count > 0 && count < 1e18 ? static_cast<std::uint64_t>(count) : 0;
  return header;
}

}  // namespace

bool is_snapshot_hdf5(hid_t file) {
  for (int type = 0; type < 8; ++type)
    if (hdf5_has(file, fmt::format("PartType{}", type))) return true;
  return false;
}

CloudSource open_gadget_hdf5(const std::filesystem::path& path, const CloudChoice& choice) {
  const int type = snapshot_type(choice.type);
  const Hdf5Handle first = open_hdf5(path);
  const Header header = read_header(first, type);
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->choice = choice;
  snapshot->type = type;
  snapshot->box_size = box_size_of(first);
  CloudSource source{.format = "GADGET HDF5", .count = {}, .box_size = snapshot->box_size, .redshift = header.redshift};
  std::uint64_t count = 0;
  std::array<bool, 8> columns{};
  for (const std::filesystem::path& file : snapshot_files(path, header.files)) {
    source.bytes += std::filesystem::file_size(file);
    const Part part = open_part(file, type, choice);
    if (part.count == 0) continue;
    if (snapshot->files.empty()) {
      columns = columns_of(part);
      source.fields = hdf5_datasets(part.group);
      source.units = snapshot_units(part.file, part.group);
      source.time = snapshot_time(part.file, part.group).time;
    } else if (columns_of(part) != columns) {
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: has other datasets than {}, expected the same in all files of a snapshot",
                              file.string(), snapshot->files.front().string()));
    }
    if (const double box = box_size_of(part.file); box != snapshot->box_size)
      throw Error(ErrorKind::bad_input, fmt::format("{}: its box has a side of {}, expected {}, that of {}",
                                                    file.string(), box, snapshot->box_size, path.filename().string()));
    snapshot->files.push_back(file);
    count += part.count;
  }
  if (count == 0)
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no particles of type '{}'; by type it has {}", path.string(),
                                                  choice.type, types_in(first)));
  if (header.total > count)
    throw Error(ErrorKind::bad_input, fmt::format("{}: its header says {} particles, but there are only {}",
                                                  path.string(), header.total, count));
  source.count = count;
  give_rows([snapshot](std::size_t most, ParticleRows& rows) { snapshot->next(most, rows); }, path, choice, source);
  source.skip = [snapshot](std::size_t most) { return snapshot->skip(most); };
  return source;
}

}  // namespace wheatstone
