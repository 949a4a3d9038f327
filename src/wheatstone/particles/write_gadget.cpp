#include "wheatstone/particles/write_gadget.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/temporary_file.h"
#include "wheatstone/particles/cosmology.h"
#include "wheatstone/particles/gas_temperature_internal.h"
#include "wheatstone/particles/hdf5_internal.h"

namespace wheatstone {

struct GadgetWriter::State {
  State(const std::filesystem::path& path_, const SnapshotHeader& header_)
      : path(path_), temporary(path_), header(header_) {}
  std::filesystem::path path;
  TemporaryFile temporary;
  SnapshotHeader header;
  std::uint64_t written = 0;
  Hdf5Handle file;
  Hdf5Handle position, density, energy, smoothing_length, id, velocity;

  void check(bool done) const;
  Hdf5Handle make_group(const char* name);
  Hdf5Handle make_dataset(hid_t group, const char* name, hsize_t width, hid_t type = H5T_IEEE_F32LE);
  void put_number(hid_t group, const char* name, double value);
  template <class Value>
  void put_numbers(hid_t group, const char* name, hid_t type, const std::vector<Value>& values);
  template <class Value>
  void write(const Hdf5Handle& dataset, hid_t type, const std::vector<Value>& rows, hsize_t width);
  void write_motion(const Cloud& cloud);
  void write_header();
};

void GadgetWriter::State::check(bool done) const {
  if (!done) throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write", path.string()));
}

Hdf5Handle GadgetWriter::State::make_group(const char* name) {
  Hdf5Handle group(H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  check(static_cast<bool>(group));
  return group;
}

Hdf5Handle GadgetWriter::State::make_dataset(hid_t group, const char* name, hsize_t width, hid_t type) {
  const std::array<hsize_t, 2> extent{header.particles, width};
  const Hdf5Handle space(H5Screate_simple(width > 1 ? 2 : 1, extent.data(), nullptr), H5Sclose);
  // The time of writing would make two runs' files differ.
  const Hdf5Handle timeless(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(timeless, false);
  Hdf5Handle dataset(H5Dcreate2(group, name, type, space, H5P_DEFAULT, timeless, H5P_DEFAULT), H5Dclose);
  check(static_cast<bool>(dataset));
  return dataset;
}

void GadgetWriter::State::put_number(hid_t group, const char* name, double value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(group, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(attribute && H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) >= 0);
}

template <class Value>
void GadgetWriter::State::put_numbers(hid_t group, const char* name, hid_t type, const std::vector<Value>& values) {
  const std::array<hsize_t, 1> extent{values.size()};
  const Hdf5Handle space(H5Screate_simple(1, extent.data(), nullptr), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(attribute && H5Awrite(attribute, type, values.data()) >= 0);
}

template <class Value>
void GadgetWriter::State::write(const Hdf5Handle& dataset, hid_t type, const std::vector<Value>& rows, hsize_t width) {
  const hsize_t count = rows.size() / width;
  const std::array<hsize_t, 2> start{written, 0};
  const std::array<hsize_t, 2> extent{count, width};
  const std::array<hsize_t, 1> values{rows.size()};
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const Hdf5Handle memory(H5Screate_simple(1, values.data(), nullptr), H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  check(H5Dwrite(dataset, type, memory, space, H5P_DEFAULT, rows.data()) >= 0);
}

void GadgetWriter::State::write_motion(const Cloud& cloud) {
  write(id, H5T_NATIVE_UINT64, cloud.id, 1);
  // Peculiar velocities v = a·dx/dt in km/s, divided by √a, where da/dt = a·H(a) and H0 is 0.1 km/s a kpc/h.
  const double scale = 1 / (1 + header.redshift);
  const double velocity_of_rate = 0.1 * expansion_rate(scale) * std::pow(scale, 1.5);
  std::vector<float> velocities(3 * cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    velocities[3 * i] = static_cast<float>(cloud.rate_x[i] * velocity_of_rate);
    velocities[3 * i + 1] = static_cast<float>(cloud.rate_y[i] * velocity_of_rate);
    velocities[3 * i + 2] = static_cast<float>(cloud.rate_z[i] * velocity_of_rate);
  }
  write(velocity, H5T_NATIVE_FLOAT, velocities, 3);
}

void GadgetWriter::State::write_header() {
  const Hdf5Handle group = make_group("Header");
  put_number(group, "BoxSize", header.box_size);
  put_number(group, "Redshift", header.redshift);
  put_number(group, "Time", 1 / (1 + header.redshift));
  // Two types, as GADGET-4 writes them where there are no more.
  const std::vector<std::uint64_t> counts{header.particles, 0};
  put_numbers(group, "NumPart_ThisFile", H5T_NATIVE_UINT64, counts);
  put_numbers(group, "NumPart_Total", H5T_NATIVE_UINT64, counts);
  put_numbers(group, "MassTable", H5T_NATIVE_DOUBLE, std::vector<double>{header.mass_of_a_particle, 0});
  put_numbers(group, "NumFilesPerSnapshot", H5T_NATIVE_INT, std::vector<int>{1});
  if (!header.motion) return;
  put_number(group, "Omega0", matter_share);
  put_number(group, "OmegaLambda", 1 - matter_share);
}

GadgetWriter::GadgetWriter(const std::filesystem::path& path, const SnapshotHeader& header)
    : state_(std::make_unique<State>(path, header)) {
  State& state = *state_;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  state.file = Hdf5Handle(H5Fcreate(state.temporary.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  state.check(static_cast<bool>(state.file));
  state.write_header();
  const Hdf5Handle gas = state.make_group("PartType0");
  state.position = state.make_dataset(gas, "Coordinates", 3);
  state.density = state.make_dataset(gas, "Density", 1);
  state.energy = state.make_dataset(gas, "InternalEnergy", 1);
  state.smoothing_length = state.make_dataset(gas, "SmoothingLength", 1);
  if (!header.motion) return;
  state.id = state.make_dataset(gas, "ParticleIDs", 1, H5T_STD_U64LE);
  state.velocity = state.make_dataset(gas, "Velocities", 3);
}

GadgetWriter::~GadgetWriter() = default;
GadgetWriter::GadgetWriter(GadgetWriter&&) noexcept = default;
GadgetWriter& GadgetWriter::operator=(GadgetWriter&&) noexcept = default;

void GadgetWriter::add(const Cloud& cloud) {
  State& state = *state_;
  std::vector<float> positions(3 * cloud.size());
  std::vector<float> energies(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    positions[3 * i] = static_cast<float>(cloud.x[i] + cloud.origin[0]);
    positions[3 * i + 1] = static_cast<float>(cloud.y[i] + cloud.origin[1]);
    positions[3 * i + 2] = static_cast<float>(cloud.z[i] + cloud.origin[2]);
    energies[i] = gas_internal_energy(cloud.temperature[i]);
  }
  state.write(state.position, H5T_NATIVE_FLOAT, positions, 3);
  state.write(state.density, H5T_NATIVE_FLOAT, cloud.density, 1);
  state.write(state.energy, H5T_NATIVE_FLOAT, energies, 1);
  state.write(state.smoothing_length, H5T_NATIVE_FLOAT, cloud.smoothing_length, 1);
  if (state.header.motion) state.write_motion(cloud);
  state.written += cloud.size();
}

void GadgetWriter::commit() {
  State& state = *state_;
  state.check(H5Fflush(state.file, H5F_SCOPE_LOCAL) >= 0);
  for (Hdf5Handle* handle : {&state.position, &state.density, &state.energy, &state.smoothing_length, &state.id,
                             &state.velocity, &state.file})
    *handle = Hdf5Handle();
  state.temporary.commit();
}

}  // namespace wheatstone
