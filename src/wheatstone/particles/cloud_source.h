#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/particles/condition.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// The colour of all particles of a type; types as in CloudChoice::type.
struct TypeColour {
  std::string type;
  Rgb8 colour;
  float light = 1;  ///< that they give, as a multiple of what their mass gives (Cloud::presence)
  friend bool operator==(const TypeColour&, const TypeColour&) = default;
};

/// Types as they are written, "gas=FFB347:6,stars=FFFFFF": each with a colour and, after a colon, its light. Throws
/// Error{wrong_usage}, beginning with `name`.
std::vector<TypeColour> parse_type_colours(std::string_view text, std::string_view name = "type colours");

/// What of a file becomes the cloud. Names that are empty are found by the format's own conventions.
struct CloudChoice {
  std::string type;  ///< of a snapshot's particles: gas, halo, disk, bulge, stars, bndry, or 0..5; empty: gas
  /// Several types of a snapshot, one after the other, each in a colour of its own, in place of `type`. Of densities,
  /// temperatures, smoothing lengths and masses only those are read that all of them have.
  std::vector<TypeColour> type_colours;
  std::string position;          ///< name of the dataset or column ("/Coordinates"); "x,y,z" for three columns
  std::string density;           ///< name of the dataset or column
  std::string temperature;       ///< name of the dataset or column; any scalar
  std::string smoothing_length;  ///< name of the dataset or column
  std::string mass;              ///< name of the dataset or column
  /// Name of a dataset or column that becomes Cloud::quantity. Of a vector, its length; with "-x", "-y" or "-z" behind
  /// the name, one component; "velocity" is a snapshot's velocity, whatever it calls it. Empty: none.
  std::string quantity;
  /// Which particles are to be kept: told in Cloud::chosen, by which select_particles keeps them. Its quantities are
  /// named as `quantity`, in small letters or capitals; what the file does not have is the cloud's own column of that
  /// name: x, y, z, density, temperature, smoothing_length, mass, quantity. Of several types, one must have each
  /// quantity; for the others it is not a number (NaN).
  std::optional<Condition> where;
  bool where_may_lack = false;  ///< quantities that the file does not have are not a number, instead of an error
  /// What the positions are to be relative to (Cloud::origin), where it is known which part of the file is looked at;
  /// else it is chosen from the first particles.
  std::optional<std::array<double, 3>> origin;
  /// Also read what tells how particles move from one snapshot to the next: IDs and velocities (Cloud::id, rate_x).
  bool motion = false;
  friend bool operator==(const CloudChoice&, const CloudChoice&) = default;
};

/// A file of particles, opened, its header checked against its length. Reading goes forward only, chunk by chunk.
struct CloudSource {
  std::string format;                  ///< "GADGET HDF5", "PLY", …, for people
  std::optional<std::uint64_t> count;  ///< particles in all; unknown for text until it is read
  double box_size = 0;                 ///< of the periodic box, 0 where there is none
  std::optional<double> redshift;      ///< of a snapshot of a universe that expands
  std::optional<double> time;  ///< of a snapshot; the scale factor of a universe that expands, else in its own unit
  std::vector<std::string> fields;  ///< every column that the chosen particles have, as the file names them
  /// Units that the file tells, each with the name of a column or of a quantity: "x", "kpc"; "length", "1 kpc/h".
  std::vector<std::pair<std::string, std::string>> units;
  std::uint64_t bytes = 0;  ///< of all files together
  /// The next particles, at most so many; an empty cloud at the end. Throws Error{bad_input} where the file is damaged.
  std::function<Cloud(std::size_t most)> next;
  /// Takes back a cloud that `next` gave and that is not needed any more, for its memory: fresh memory takes longer to
  /// get than the particles to read. Not while `next` reads. May be empty.
  std::function<void(Cloud used)> reuse;
  /// Goes past the particles that `next` would give, and says how many they are. Only where the choice had an origin;
  /// empty where they must be read to be passed.
  std::function<std::size_t(std::size_t most)> skip;
};

/// Whether a file holds particles by its content, whatever its name; not where it cannot be read. Text counts only
/// where it begins with a row of three numbers or more, or with names above one.
bool holds_particles(const std::filesystem::path& path);

/// Opens a file, the first part of a snapshot in several ("snap_007.0.hdf5"), or a folder of parts. The format is told
/// by the content. Throws Error{bad_input}, naming the file, what is wrong and
/// what was expected; a field that is missing is named, with those that the file has.
CloudSource open_cloud(const std::filesystem::path& path, const CloudChoice& choice = {});

/// All particles of a file at once. Throws as open_cloud does, and Error{bad_input} where there is none.
Cloud read_cloud(const std::filesystem::path& path, const CloudChoice& choice = {}, const Progress& progress = {});

/// The same of a file that was opened, which `path` names for messages.
Cloud read_cloud(const CloudSource& source, const std::filesystem::path& path, const Progress& progress = {});

}  // namespace wheatstone
