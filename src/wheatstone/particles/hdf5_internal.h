#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"

namespace wheatstone {

/// An HDF5 identifier that closes itself. What could not be opened is false.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Opens a file to read; the library's own messages are silenced. Throws Error{bad_input}.
Hdf5Handle open_hdf5(const std::filesystem::path& path);

/// Whether a link of this name leads to something.
bool hdf5_has(hid_t where, const std::string& name);

/// An attribute's numbers; none where there is no such attribute or it holds no numbers.
std::vector<double> hdf5_numbers(hid_t object, const std::string& attribute);
std::optional<double> hdf5_number(hid_t object, const std::string& attribute);

/// An attribute's text; empty where there is no such attribute or it is no text.
std::string hdf5_text(hid_t object, const std::string& attribute);

/// The names of the datasets in a group.
std::vector<std::string> hdf5_datasets(hid_t group);

/// A dataset of numbers, N or N×k.
struct Hdf5Column {
  Hdf5Handle dataset;
  hsize_t rows = 0;
  hsize_t width = 1;
  bool single_precision = false;  ///< floating-point numbers that a float holds
};

/// A dataset that a condition asks for, or nothing.
struct NamedHdf5Column {
  Hdf5Column column;
  int component = -1;  ///< of a vector; −1: its length
};

/// The dataset of that name, whole or a component of it ("Velocities-x"), in small letters or capitals; `datasets` are
/// those that there are. Nothing where there is none.
std::optional<QuantityName> find_quantity(hid_t where, std::span<const std::string> datasets, const std::string& name);

/// Rows of such a dataset, one number each; none where there is no dataset.
QuantityColumn read_quantity(const NamedHdf5Column& named, hsize_t first, hsize_t count, const std::string& file);

/// Throws Error{bad_input} where it does not exist, holds no numbers, or has more than two dimensions. `file` and
/// `name` are for the message.
Hdf5Column open_column(hid_t where, const std::string& name, const std::string& file);

/// Rows `first` … `first + count − 1`, row by row. As floats they are finite where the file's numbers are. Throws
/// Error{bad_input} where they cannot be read.
void read_rows(const Hdf5Column& column, hsize_t first, hsize_t count, std::vector<double>& to,
               const std::string& file);
void read_rows(const Hdf5Column& column, hsize_t first, hsize_t count, std::vector<float>& to, const std::string& file);
void read_rows(const Hdf5Column& column, hsize_t first, hsize_t count, std::vector<std::uint64_t>& to,
               const std::string& file);

/// Positions, of which each row's first three numbers are one, in the precision of the file.
void read_points(const Hdf5Column& column, hsize_t first, hsize_t count, ParticleRows& rows, const std::string& file);

}  // namespace wheatstone
