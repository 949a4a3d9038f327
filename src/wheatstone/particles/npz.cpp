// NumPy's .npz: a zip archive of .npy arrays, stored or deflated. Either one of them has a row for each particle, or x,
// y and z are arrays of their own.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <memory>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/npy_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"

namespace wheatstone {
namespace {

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;
using Entry = std::unique_ptr<zip_file_t, CloseEntry>;

/// An array of the archive that holds numbers of one type in one or two dimensions.
struct Array {
  std::string name;
  zip_uint64_t index = 0;
  NpyHeader header;

  std::uint64_t rows() const { return header.shape[0]; }
  std::uint64_t columns() const { return header.shape.size() > 1 ? header.shape[1] : 1; }
};

struct Arrays {
  std::string path;
  Archive archive;
  std::vector<Array> all;
  std::vector<std::string> others;  // what cannot be read as numbers

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path, what));
  }
  std::string words() const {
    std::vector<std::string> names = others;
    for (const Array& array : all) names.push_back(fmt::format("{} {}", array.name, array.header.shape_words));
    return names.empty() ? "no arrays" : fmt::format("{}", fmt::join(names, ", "));
  }
  const Array* find(const std::string& name) const {
    const auto found =
        std::ranges::find_if(all, [&](const Array& array) { return lower_case(array.name) == lower_case(name); });
    return found == all.end() ? nullptr : &*found;
  }
};

/// Reads so many bytes, or fewer at the end.
std::size_t read_bytes(zip_file_t* entry, char* to, std::size_t count) {
  std::size_t read = 0;
  while (read < count) {
    const zip_int64_t more = zip_fread(entry, to + read, count - read);
    if (more <= 0) break;
    read += static_cast<std::size_t>(more);
  }
  return read;
}

void add_array(Arrays& arrays, zip_uint64_t index) {
  zip_stat_t about;
  if (zip_stat_index(arrays.archive.get(), index, 0, &about) != 0 || (about.valid & ZIP_STAT_NAME) == 0) return;
  std::string name = about.name;
  if (!name.ends_with(".npy")) return;
  name.resize(name.size() - 4);
  const Entry entry(zip_fopen_index(arrays.archive.get(), index, 0));
  if (!entry) arrays.refuse(fmt::format("{} cannot be unpacked", name));
  std::string first_bytes(most_npy_header_bytes, '\0');
  first_bytes.resize(read_bytes(entry.get(), first_bytes.data(), first_bytes.size()));
  Array array{.name = name, .index = index, .header = parse_npy_header(first_bytes, arrays.path + ": " + name)};
  const NpyHeader& header = array.header;
  const bool plain = header.element && header.element->names.empty();
  if (!plain || header.shape.empty() || header.shape.size() > 2 || array.columns() == 0 ||
      array.columns() > most_columns) {
    arrays.others.push_back(fmt::format("{} {}", name, header.shape_words));
    return;
  }
  // Every length is checked before it is believed.
  const std::uint64_t bytes = about.size > header.bytes ? about.size - header.bytes : 0;
  if ((about.valid & ZIP_STAT_SIZE) == 0 || array.rows() > bytes / array.columns() / header.element->bytes)
    arrays.refuse(fmt::format("{} is cut short: its header says {} rows of {} numbers, but there are {} bytes", name,
                              array.rows(), array.columns(), bytes));
  arrays.all.push_back(std::move(array));
}

Arrays open_arrays(const std::filesystem::path& path) {
  Arrays arrays{.path = path.string()};
  int error = 0;
  arrays.archive.reset(zip_open(path.c_str(), ZIP_RDONLY, &error));
  if (!arrays.archive) arrays.refuse("is damaged or cut short, expected a whole archive of NumPy arrays");
  const zip_int64_t entries = zip_get_num_entries(arrays.archive.get(), 0);
  constexpr zip_int64_t most_entries = 10000;
  for (zip_int64_t i = 0; i < std::min(entries, most_entries); ++i) add_array(arrays, static_cast<zip_uint64_t>(i));
  return arrays;
}

/// The numbers of an array's rows, or of one of its columns, one after the other.
class Numbers {
 public:
  Numbers(const Arrays& arrays, const Array& array, std::uint64_t first_number, std::uint64_t width)
      : path_(arrays.path), name_(array.name), element_(*array.header.element), width_(width) {
    entry_.reset(zip_fopen_index(arrays.archive.get(), array.index, 0));
    std::uint64_t skipped = array.header.bytes + first_number * element_.bytes;
    std::vector<char> scratch(1 << 16);
    while (entry_ && skipped > 0) {
      const std::size_t some = std::min<std::uint64_t>(skipped, scratch.size());
      if (read_bytes(entry_.get(), scratch.data(), some) != some) refuse();
      skipped -= some;
    }
  }
  std::uint64_t width() const { return width_; }
  bool is_single_precision() const { return element_.fields[0].is_single_precision(); }
  std::vector<double> next(std::size_t rows) {
    std::vector<char> raw(rows * width_ * element_.bytes);
    if (!entry_ || read_bytes(entry_.get(), raw.data(), raw.size()) != raw.size()) refuse();
    std::vector<double> numbers(rows * width_);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = decode_number(raw.data() + i * element_.bytes, element_.fields[0].type, element_.swapped);
    return numbers;
  }

 private:
  [[noreturn]] void refuse() const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} is damaged or cut short", path_, name_));
  }
  std::string path_, name_;
  NpyElement element_;
  std::uint64_t width_;
  Entry entry_;
};

/// What is read of the archive, which has to stay open.
struct NpzRows {
  Arrays arrays;
  std::uint64_t count = 0;
  std::uint64_t at = 0;
  std::vector<Numbers> position;  // of rows, or three of columns
  std::vector<Numbers> density, temperature, smoothing_length, mass, quantity;
  std::vector<std::vector<Numbers>> named;  // of CloudChoice::where: none or one

  ParticleRows next(std::size_t most) {
    ParticleRows rows;
    const auto some = static_cast<std::size_t>(std::min<std::uint64_t>(most, count - at));
    if (some == 0) return rows;
    if (position.size() == 1) {
      put_positions(position[0].next(some), position[0].width(), rows);
    } else {
      rows.x = position[0].next(some);
      rows.y = position[1].next(some);
      rows.z = position[2].next(some);
    }
    if (!density.empty()) rows.others.density = in_single_precision(density[0].next(some));
    if (!temperature.empty()) rows.others.temperature = in_single_precision(temperature[0].next(some));
    if (!smoothing_length.empty()) rows.others.smoothing_length = in_single_precision(smoothing_length[0].next(some));
    if (!mass.empty()) rows.others.mass = in_single_precision(mass[0].next(some));
    if (!quantity.empty()) rows.others.quantity = in_single_precision(quantity[0].next(some));
    for (std::vector<Numbers>& numbers : named)
      rows.named.push_back(numbers.empty() ? QuantityColumn{}
                                           : QuantityColumn{numbers[0].next(some), numbers[0].is_single_precision()});
    at += some;
    return rows;
  }
};

const Array& required(const Arrays& arrays, const std::string& name) {
  const Array* found = arrays.find(name);
  if (found == nullptr) arrays.refuse(fmt::format("has no array '{}', but {}", name, arrays.words()));
  return *found;
}

/// The arrays of the position: one of rows, or three.
std::vector<const Array*> position_arrays(const Arrays& arrays, const std::string& wanted) {
  if (!wanted.empty()) {
    std::vector<const Array*> named;
    for (const std::string_view name : fields_of(wanted)) named.push_back(&required(arrays, std::string(name)));
    return named;
  }
  if (arrays.find("x") != nullptr && arrays.find("y") != nullptr && arrays.find("z") != nullptr)
    return {arrays.find("x"), arrays.find("y"), arrays.find("z")};
  std::vector<const Array*> candidates;
  for (const Array& array : arrays.all)
    if (array.columns() == 3) candidates.push_back(&array);
  if (candidates.empty())
    for (const Array& array : arrays.all)
      if (array.columns() > 3) candidates.push_back(&array);
  if (candidates.size() == 1) return candidates;
  arrays.refuse(fmt::format(
      "{}, so --position must name the array of the positions, or three, for example x,y,z; it "
      "has {}",
      candidates.empty() ? "has no rows of three numbers" : "has more than one array of rows", arrays.words()));
}

void open_position(NpzRows& reading, const std::string& wanted) {
  const std::vector<const Array*> chosen = position_arrays(reading.arrays, wanted);
  const Array& first = *chosen[0];
  reading.count = first.rows();
  if (chosen.size() == 1 && first.columns() >= 3) {
    if (first.header.by_column) {
      for (std::uint64_t axis = 0; axis < 3; ++axis)
        reading.position.emplace_back(reading.arrays, first, axis * first.rows(), 1);
    } else {
      reading.position.emplace_back(reading.arrays, first, 0, first.columns());
    }
    return;
  }
  for (const Array* array : chosen) {
    if (chosen.size() != 3 || array->columns() != 1 || array->rows() != first.rows())
      reading.arrays.refuse(
          "the positions are expected as one array with a row of three numbers per particle, or as three arrays of one "
          "length");
    reading.position.emplace_back(reading.arrays, *array, 0, 1);
  }
}

void open_scalars(NpzRows& reading, const std::string& wanted, std::initializer_list<const char*> usual,
                  std::vector<Numbers>& to) {
  const Array* chosen = wanted.empty() ? nullptr : &required(reading.arrays, wanted);
  for (const char* name : usual)
    if (chosen == nullptr) chosen = reading.arrays.find(name);
  if (chosen == nullptr) return;
  const bool fits = chosen->columns() == 1 && chosen->rows() == reading.count;
  if (!fits && !wanted.empty())
    reading.arrays.refuse(
        fmt::format("{} has the shape {}, expected {} numbers", wanted, chosen->header.shape_words, reading.count));
  if (fits) to.emplace_back(reading.arrays, *chosen, 0, 1);
}

}  // namespace

CloudSource open_npz(const std::filesystem::path& path, const CloudChoice& choice) {
  auto reading = std::make_shared<NpzRows>();
  reading->arrays = open_arrays(path);
  if (reading->arrays.all.empty())
    reading->arrays.refuse(fmt::format("has no arrays of numbers, but {}", reading->arrays.words()));
  open_position(*reading, choice.position);
  if (reading->count == 0) reading->arrays.refuse("has no particles");
  open_scalars(*reading, choice.density, {"density", "rho"}, reading->density);
  open_scalars(*reading, choice.temperature, {"temperature", "temp"}, reading->temperature);
  open_scalars(*reading, choice.smoothing_length, {"smoothing_length", "hsml"}, reading->smoothing_length);
  open_scalars(*reading, choice.mass, {"mass", "masses"}, reading->mass);
  open_scalars(*reading, choice.quantity, {}, reading->quantity);
  for (const std::string& name : names_in_condition(choice))
    open_scalars(*reading, {}, {name.c_str()}, reading->named.emplace_back());
  CloudSource source{.format = "NumPy archive", .count = reading->count};
  for (const Array& array : reading->arrays.all) source.fields.push_back(array.name);
  source.bytes = std::filesystem::file_size(path);
  give_rows([reading](std::size_t most, ParticleRows& rows) { rows = reading->next(most); }, path, choice, source);
  return source;
}

}  // namespace wheatstone
