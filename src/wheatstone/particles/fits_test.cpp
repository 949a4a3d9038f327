// Tables and volumes in FITS.

#include <fitsio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/cloud_source.h"

namespace wheatstone::fits_test {

using testing::ElementsAre;
using testing::Pair;

struct FitsColumn {
  const char* name;
  const char* form;
  const char* unit;
  std::vector<double> numbers;
};

/// A file with an empty first part, and tables behind it, of three rows or none.
void write_tables(const std::filesystem::path& path, const std::vector<std::vector<FitsColumn>>& tables) {
  std::filesystem::remove(path);
  fitsfile* file = nullptr;
  int status = 0;
  fits_create_diskfile(&file, path.c_str(), &status);
  fits_create_img(file, BYTE_IMG, 0, nullptr, &status);
  for (const std::vector<FitsColumn>& columns : tables) {
    std::vector<char*> names;
    std::vector<char*> forms;
    std::vector<char*> units;
    for (const FitsColumn& column : columns) {
      names.push_back(const_cast<char*>(column.name));
      forms.push_back(const_cast<char*>(column.form));
      units.push_back(const_cast<char*>(column.unit));
    }
    fits_create_tbl(file, BINARY_TBL, columns.front().numbers.empty() ? 0 : 3, static_cast<int>(columns.size()),
                    names.data(), forms.data(), units.data(), "PARTICLES", &status);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      std::vector<double> numbers = columns[i].numbers;
      fits_write_col(file, TDOUBLE, static_cast<int>(i) + 1, 1, 1, static_cast<LONGLONG>(numbers.size()),
                     numbers.data(), &status);
    }
  }
  fits_close_file(file, &status);
  ASSERT_EQ(status, 0);
}

void write_volume(const std::filesystem::path& path, std::vector<long> size, std::vector<float> values) {
  std::filesystem::remove(path);
  fitsfile* file = nullptr;
  int status = 0;
  fits_create_diskfile(&file, path.c_str(), &status);
  fits_create_img(file, FLOAT_IMG, static_cast<int>(size.size()), size.data(), &status);
  fits_write_img(file, TFLOAT, 1, static_cast<LONGLONG>(values.size()), values.data(), &status);
  fits_close_file(file, &status);
  ASSERT_EQ(status, 0);
}

const std::vector<FitsColumn> by_axis{{"rho", "1E", "", {10, 20, 30}},
                                      {"X", "1D", "kpc", {1e9 + 1, 1e9 + 4, 1e9 + 7}},
                                      {"Y", "1J", "kpc", {2, 5, 8}},
                                      {"Z", "1E", "kpc", {3, 6, 9.5}}};

TEST(Fits, ReadsTheFirstTableWithAPosition) {
  const TemporaryFolder folder;
  write_tables(folder / "a.fits", {{{"time", "1D", "s", {1, 2}}}, by_axis});
  const Cloud cloud = read_cloud(folder / "a.fits", {.origin = {{1e9, 0, 0}}});
  EXPECT_THAT(cloud.x, ElementsAre(1, 4, 7));
  EXPECT_THAT(cloud.y, ElementsAre(2, 5, 8));
  EXPECT_THAT(cloud.z, ElementsAre(3, 6, 9.5f));
  EXPECT_THAT(cloud.density, ElementsAre(10, 20, 30));
  EXPECT_THAT(read_cloud(folder / "a.fits", {.where = parse_condition("rho <= 20 and x > 1000000003")}).chosen,
              ElementsAre(0, 1, 0));
  const CloudSource source = open_cloud(folder / "a.fits");
  EXPECT_EQ(source.format, "FITS table");
  EXPECT_EQ(source.count, 3u);
  EXPECT_THAT(source.fields, ElementsAre("rho", "X", "Y", "Z"));
  EXPECT_THAT(source.units, ElementsAre(Pair("X", "kpc"), Pair("Y", "kpc"), Pair("Z", "kpc")));
  EXPECT_TRUE(holds_particles(folder / "a.fits"));
  EXPECT_THAT(read_cloud(folder / "a.fits", {.position = "Z,Y,rho"}).x, ElementsAre(3, 6, 9.5f));
}

TEST(Fits, ReadsAPositionOfOneColumn) {
  const TemporaryFolder folder;
  write_tables(folder / "a.fits", {{{"where", "3D", "", {1, 2, 3, 4, 5, 6, 7, 8, 9}}, {"mass", "1E", "", {1, 2, 3}}}});
  EXPECT_THAT(read_cloud(folder / "a.fits", {.position = "where"}).y, ElementsAre(2, 5, 8));
  write_tables(folder / "a.fits", {{{"Coordinates", "3E", "", {1, 2, 3, 4, 5, 6, 7, 8, 9}}}});
  EXPECT_THAT(read_cloud(folder / "a.fits").z, ElementsAre(3, 6, 9));
}

TEST(Fits, AnImageOfThreeDimensionsIsAVolumeOfDensities) {
  const TemporaryFolder folder;
  write_volume(folder / "a.fits", {3, 2, 2}, {0, 5, -1, 0, 0, 0, NAN, 0, 0, 0, 0, 7});
  const Cloud cloud = read_cloud(folder / "a.fits");
  EXPECT_THAT(cloud.x, ElementsAre(1.5f, 2.5f));
  EXPECT_THAT(cloud.y, ElementsAre(0.5f, 1.5f));
  EXPECT_THAT(cloud.z, ElementsAre(0.5f, 1.5f));
  EXPECT_THAT(cloud.density, ElementsAre(5, 7));
}

TEST(Fits, WithoutATableOfPositionsIsRefusedAndToldWhatItHas) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& part, const CloudChoice& choice = {}) {
    expect_error(ErrorKind::bad_input, part, [&] { read_cloud(folder / "a.fits", choice); });
  };
  write_volume(folder / "a.fits", {3, 2}, {1, 2, 3, 4, 5, 6});
  refused("a.fits: has no table with the columns x, y and z and no image of three dimensions");
  write_tables(folder / "a.fits", {{{"time", "1D", "s", {1, 2}}, {"flux", "1D", "", {1, 2}}}});
  refused("has no table with the columns x, y and z and no image of three dimensions, but a table of time, flux");
  write_tables(folder / "a.fits", {by_axis});
  refused("no column 'mass', but rho, X, Y, Z", {.density = "mass"});
  write_tables(folder / "a.fits", {{{"x", "2D", "", {1, 2}}, {"y", "1D", "", {1}}, {"z", "1D", "", {1}}}});
  refused("column x does not hold one number per row");
  write_tables(folder / "a.fits", {{{"x", "1D", "", {}}, {"y", "1D", "", {}}, {"z", "1D", "", {}}}});
  refused("its table has no rows");
}

TEST(Fits, CutShortIsRefused) {
  const TemporaryFolder folder;
  std::vector<FitsColumn> columns = by_axis;
  for (FitsColumn& column : columns) column.numbers.resize(500, 1.);
  write_tables(folder / "a.fits", {columns});
  const std::string bytes = read_whole_file(folder / "a.fits", 1 << 20);
  for (std::size_t length = 10; length < bytes.size() - 2880; length += 700) {
    write_whole_file(folder / "cut.fits", std::string_view(bytes).substr(0, length));
    expect_error(ErrorKind::bad_input, "cut.fits", [&] { read_cloud(folder / "cut.fits"); });
  }
}

}  // namespace wheatstone::fits_test
