// FITS (Pence et al. 2010), by cfitsio: the first table with the columns of a position, or an image of three dimensions
// as a volume of densities.

#include <fitsio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"

namespace wheatstone {
namespace {

struct Close {
  void operator()(fitsfile* file) const {
    int status = 0;
    fits_close_file(file, &status);
    fits_clear_errmsg();
  }
};
using File = std::unique_ptr<fitsfile, Close>;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path, what));
}

/// A column of one number a row, or more.
struct Column {
  std::string name, unit;
  LONGLONG width = 0;  ///< 0 where it holds no numbers
  bool single_precision = false;
};

/// A table, or an image of three dimensions, that is open at it.
struct FitsRows {
  std::string path;
  File file;
  std::uint64_t count = 0;
  std::uint64_t at = 0;
  std::vector<Column> columns;
  ChosenColumns chosen;
  bool vector_position = false;         // one column holds all three coordinates
  std::array<std::uint64_t, 3> size{};  // of an image

  std::vector<double> read(int column, std::size_t some, LONGLONG width = 1) {
    std::vector<double> numbers(some * static_cast<std::size_t>(width));
    double none = std::numeric_limits<double>::quiet_NaN();
    int any_none = 0;
    int status = 0;
    fits_read_col(file.get(), TDOUBLE, column + 1, static_cast<LONGLONG>(at) + 1, 1,
                  static_cast<LONGLONG>(numbers.size()), &none, numbers.data(), &any_none, &status);
    if (status != 0)
      refuse(path, fmt::format("rows from {} on cannot be read, the file is damaged or cut short", at + 1));
    return numbers;
  }

  ParticleRows next_rows(std::size_t most) {
    ParticleRows rows;
    const auto some = static_cast<std::size_t>(std::min<std::uint64_t>(most, count - at));
    if (some == 0) return rows;
    if (vector_position) {
      const LONGLONG width = columns[chosen.position[0]].width;
      put_positions(read(chosen.position[0], some, width), static_cast<std::size_t>(width), rows);
    } else {
      rows.x = read(chosen.position[0], some);
      rows.y = read(chosen.position[1], some);
      rows.z = read(chosen.position[2], some);
    }
    const auto put = [&](int column, std::vector<float>& to) {
      if (column >= 0) to = in_single_precision(read(column, some));
    };
    put(chosen.density, rows.others.density);
    put(chosen.temperature, rows.others.temperature);
    put(chosen.smoothing_length, rows.others.smoothing_length);
    put(chosen.mass, rows.others.mass);
    put(chosen.quantity, rows.others.quantity);
    for (const int column : chosen.named)
      rows.named.push_back(column < 0 ? QuantityColumn{}
                                      : QuantityColumn{read(column, some), columns[column].single_precision});
    at += some;
    return rows;
  }

  /// Voxels that hold light, at their centres; at least one where any is left.
  ParticleRows next_voxels(std::size_t most) {
    ParticleRows rows;
    while (at < count && rows.size() == 0) {
      const auto some = static_cast<std::size_t>(std::min<std::uint64_t>(most, count - at));
      std::vector<double> values(some);
      double none = std::numeric_limits<double>::quiet_NaN();
      int any_none = 0;
      int status = 0;
      fits_read_img(file.get(), TDOUBLE, static_cast<LONGLONG>(at) + 1, static_cast<LONGLONG>(some), &none,
                    values.data(), &any_none, &status);
      if (status != 0) refuse(path, "its image cannot be read, the file is damaged or cut short");
      for (std::size_t i = 0; i < some; ++i) {
        if (!(values[i] > 0) || !std::isfinite(values[i])) continue;
        const std::uint64_t voxel = at + i;
        rows.x.push_back(static_cast<double>(voxel % size[0]) + 0.5);
        rows.y.push_back(static_cast<double>(voxel / size[0] % size[1]) + 0.5);
        const std::uint64_t layer = voxel / size[0] / size[1];
        rows.z.push_back(static_cast<double>(layer) + 0.5);
        rows.others.density.push_back(in_single_precision(values[i]));
      }
      at += some;
    }
    return rows;
  }
};

std::string text_of(fitsfile* file, const std::string& key) {
  std::array<char, FLEN_VALUE> value{};
  int status = 0;
  if (fits_read_key(file, TSTRING, key.c_str(), value.data(), nullptr, &status) != 0) return {};
  std::string text(value.data());
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::vector<Column> columns_of(fitsfile* file) {
  int count = 0;
  int status = 0;
  if (fits_get_num_cols(file, &count, &status) != 0) return {};
  std::vector<Column> columns;
  for (int i = 1; i <= count; ++i) {
    int type = 0;
    LONGLONG repeat = 0;
    LONGLONG bytes = 0;
    status = 0;
    fits_get_coltypell(file, i, &type, &repeat, &bytes, &status);
    constexpr std::array numbers{TBYTE, TSBYTE, TSHORT,    TUSHORT, TINT,   TUINT,
                                 TLONG, TULONG, TLONGLONG, TFLOAT,  TDOUBLE};
    constexpr LONGLONG widest = 1024;
    const bool is_numbers =
        status == 0 && std::ranges::find(numbers, type) != numbers.end() && repeat >= 1 && repeat <= widest;
    columns.push_back({text_of(file, fmt::format("TTYPE{}", i)), text_of(file, fmt::format("TUNIT{}", i)),
                       is_numbers ? repeat : 0, type == TFLOAT});
  }
  return columns;
}

std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.name);
  return names;
}

bool is_table(int kind) { return kind == BINARY_TBL || kind == ASCII_TBL; }

/// The column that holds all three coordinates: the one that the user named, or one with a usual name; −1 for none.
int vector_column(const std::vector<Column>& columns, const std::string& wanted) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string name = lower_case(columns[i].name);
    const bool meant = wanted.empty() ? name == "position" || name == "positions" || name == "pos" ||
                                            name == "coordinates" || name == "xyz"
                                      : name == lower_case(wanted);
    if (meant && columns[i].width >= 3) return static_cast<int>(i);
  }
  return -1;
}

bool has_position(const std::vector<Column>& columns, const std::string& wanted) {
  if (vector_column(columns, wanted) >= 0) return true;
  const std::vector<std::string_view> axes =
      wanted.empty() ? std::vector<std::string_view>{"x", "y", "z"} : fields_of(wanted);
  return axes.size() == 3 && std::ranges::all_of(axes, [&](std::string_view axis) {
           return std::ranges::any_of(
               columns, [&](const Column& column) { return lower_case(column.name) == lower_case(std::string(axis)); });
         });
}

/// Opens the table that the file stands at. Throws Error{bad_input}.
CloudSource open_table(const std::shared_ptr<FitsRows>& reading, const CloudChoice& choice) {
  FitsRows& table = *reading;
  const int vector = vector_column(table.columns, choice.position);
  CloudChoice scalars = choice;
  if (vector >= 0) scalars.position = fmt::format("{0},{0},{0}", table.columns[vector].name);
  table.vector_position = vector >= 0;
  table.chosen = choose_columns(table.path, names_of(table.columns), scalars);
  if (vector >= 0) table.chosen.position = {vector, vector, vector};
  const auto check = [&](int column) {
    if (column >= 0 && table.columns[column].width != 1)
      refuse(table.path, fmt::format("its column {} does not hold one number per row", table.columns[column].name));
  };
  if (vector < 0)
    for (const int column : table.chosen.position) check(column);
  for (const int column : {table.chosen.density, table.chosen.temperature, table.chosen.smoothing_length,
                           table.chosen.mass, table.chosen.quantity})
    check(column);
  std::ranges::for_each(table.chosen.named, check);
  LONGLONG rows = 0;
  LONGLONG bytes = 0;
  int status = 0;
  fits_get_num_rowsll(table.file.get(), &rows, &status);
  fits_read_key(table.file.get(), TLONGLONG, "NAXIS1", &bytes, nullptr, &status);
  const std::uint64_t length = std::filesystem::file_size(table.path);
  if (status != 0 || rows < 0 || bytes <= 0) refuse(table.path, "the header of its table is damaged");
  if (rows == 0) refuse(table.path, "its table has no rows");
  if (static_cast<std::uint64_t>(rows) > length / static_cast<std::uint64_t>(bytes))
    refuse(table.path,
           fmt::format("is cut short or damaged: its header says {} rows of {} bytes, but there are {} bytes", rows,
                       bytes, length));
  table.count = static_cast<std::uint64_t>(rows);
  CloudSource source{.format = "FITS table", .count = table.count, .fields = names_of(table.columns)};
  for (const Column& column : table.columns)
    if (!column.unit.empty()) source.units.emplace_back(column.name, column.unit);
  give_rows([reading](std::size_t most, ParticleRows& next) { next = reading->next_rows(most); }, reading->path, choice,
            source);
  return source;
}

CloudSource open_image(const std::shared_ptr<FitsRows>& reading, const CloudChoice& choice) {
  for (const std::string& wanted :
       {choice.position, choice.density, choice.temperature, choice.smoothing_length, choice.mass, choice.quantity})
    if (!wanted.empty())
      refuse(reading->path, fmt::format("is an image, which has no columns, but '{}' was requested", wanted));
  reading->count = 1;
  for (const std::uint64_t side : reading->size) {
    constexpr std::uint64_t most_voxels = std::uint64_t{1} << 40;
    if (side == 0 || side > most_voxels / reading->count)
      refuse(reading->path,
             fmt::format("its image has {} voxels, expected at most {}", fmt::join(reading->size, "x"), most_voxels));
    reading->count *= side;
  }
  CloudSource source{.format = "FITS image", .fields = {"density"}};
  if (const std::string unit = text_of(reading->file.get(), "BUNIT"); !unit.empty())
    source.units.emplace_back("density", unit);
  give_rows([reading](std::size_t most, ParticleRows& next) { next = reading->next_voxels(most); }, reading->path,
            choice, source);
  return source;
}

/// Whether the file stands at an image of three dimensions, whose size is noted.
bool is_volume(FitsRows& reading) {
  int status = 0;
  int type = 0;
  int dimensions = 0;
  std::array<LONGLONG, 3> size{};
  fits_get_img_paramll(reading.file.get(), 3, &type, &dimensions, size.data(), &status);
  if (status != 0 || dimensions != 3) return false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    reading.size[axis] = size[axis] > 0 ? static_cast<std::uint64_t>(size[axis]) : 0;
  return true;
}

}  // namespace

CloudSource open_fits(const std::filesystem::path& path, const CloudChoice& choice) {
  auto reading = std::make_shared<FitsRows>();
  reading->path = path.string();
  int status = 0;
  fitsfile* opened = nullptr;
  fits_open_diskfile(&opened, path.c_str(), READONLY, &status);
  reading->file.reset(opened);
  if (status != 0) refuse(reading->path, "is damaged or cut short, expected a whole FITS file");
  std::vector<std::string> found;
  int volume = 0;
  constexpr int most_parts = 1000;
  for (int part = 1; part <= most_parts; ++part) {
    int kind = 0;
    if (fits_movabs_hdu(opened, part, &kind, &status) != 0) break;
    if (is_table(kind)) {
      reading->columns = columns_of(opened);
      if (has_position(reading->columns, choice.position)) {
        CloudSource source = open_table(reading, choice);
        source.bytes = std::filesystem::file_size(path);
        return source;
      }
      found.push_back(fmt::format("a table of {}", fmt::join(names_of(reading->columns), ", ")));
    } else if (volume == 0 && is_volume(*reading)) {
      volume = part;
    }
  }
  // Only a file without tables is a volume: an image beside tables is something else.
  status = 0;
  int kind = 0;
  if (volume != 0 && found.empty() && fits_movabs_hdu(opened, volume, &kind, &status) == 0) {
    CloudSource source = open_image(reading, choice);
    source.bytes = std::filesystem::file_size(path);
    return source;
  }
  refuse(reading->path, fmt::format("has no table with the columns {} and no image of three dimensions{}{}",
                                    choice.position.empty() ? "x, y and z" : choice.position,
                                    found.empty() ? "" : ", but ", fmt::format("{}", fmt::join(found, "; "))));
}

}  // namespace wheatstone
