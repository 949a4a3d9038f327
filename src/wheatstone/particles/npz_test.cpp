// Archives of NumPy's arrays, written as numpy.savez and numpy.savez_compressed do.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <cstring>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/cloud_source.h"

namespace wheatstone::npz_test {

using testing::ElementsAre;

struct NamedArray {
  std::string name, shape;
  std::vector<double> numbers;
  bool by_column = false;
};

std::string npy(const NamedArray& array) {
  std::string header = "{'descr': '<f8', 'fortran_order': " + std::string(array.by_column ? "True" : "False") +
                       ", 'shape': " + array.shape + ", }";
  header += std::string((64 - (10 + header.size() + 1) % 64) % 64, ' ') + "\n";
  std::string numbers(array.numbers.size() * sizeof(double), '\0');
  std::memcpy(numbers.data(), array.numbers.data(), numbers.size());
  return std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header + numbers;
}

void write_npz(const std::filesystem::path& path, const std::vector<NamedArray>& arrays, bool deflated = false) {
  std::filesystem::remove(path);
  int error = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE, &error);
  std::vector<std::string> bytes;
  bytes.reserve(arrays.size());
  for (const NamedArray& array : arrays) {
    bytes.push_back(npy(array));
    zip_source_t* source = zip_source_buffer(archive, bytes.back().data(), bytes.back().size(), 0);
    const zip_int64_t at = zip_file_add(archive, (array.name + ".npy").c_str(), source, 0);
    zip_set_file_compression(archive, static_cast<zip_uint64_t>(at), deflated ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0);
  }
  zip_close(archive);
}

const std::vector<double> by_particle{1, 2, 3, 4, 5, 6, 7, 8, 9.5};

void expect_three_points(const Cloud& cloud) {
  EXPECT_THAT(cloud.x, ElementsAre(1, 4, 7));
  EXPECT_THAT(cloud.y, ElementsAre(2, 5, 8));
  EXPECT_THAT(cloud.z, ElementsAre(3, 6, 9.5f));
}

TEST(Npz, ReadsRowsColumnsAndThreeArrays) {
  const TemporaryFolder folder;
  const NamedArray density{"density", "(3,)", {10, 20, 30}};
  for (const bool deflated : {false, true}) {
    write_npz(folder / "a.npz", {{"places", "(3, 3)", by_particle}, density, {"box", "()", {5}}}, deflated);
    const Cloud cloud = read_cloud(folder / "a.npz");
    expect_three_points(cloud);
    EXPECT_THAT(cloud.density, ElementsAre(10, 20, 30));
    EXPECT_THAT(read_cloud(folder / "a.npz", {.where = parse_condition("Density > 10 and x < 7")}).chosen,
                ElementsAre(0, 1, 0));
    write_npz(folder / "a.npz", {density, {"places", "(3, 3)", {1, 4, 7, 2, 5, 8, 3, 6, 9.5}, true}}, deflated);
    expect_three_points(read_cloud(folder / "a.npz"));
    write_npz(folder / "a.npz", {{"z", "(3,)", {3, 6, 9.5}}, {"y", "(3,)", {2, 5, 8}}, {"x", "(3,)", {1, 4, 7}}},
              deflated);
    expect_three_points(read_cloud(folder / "a.npz"));
    EXPECT_THAT(read_cloud(folder / "a.npz", {.position = "z,y,x", .density = "x"}).density, ElementsAre(1, 4, 7));
  }
  EXPECT_TRUE(holds_particles(folder / "a.npz"));
  EXPECT_EQ(open_cloud(folder / "a.npz").format, "NumPy archive");
}

TEST(Npz, RefusesWhatIsInDoubtAndNamesTheArrays) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::vector<NamedArray>& arrays, const std::string& part,
                           const CloudChoice& choice = {}) {
    write_npz(folder / "a.npz", arrays);
    expect_error(ErrorKind::bad_input, part, [&] { read_cloud(folder / "a.npz", choice); });
  };
  const NamedArray places{"places", "(3, 3)", by_particle};
  NamedArray speeds = places;
  speeds.name = "speeds";
  refused({places, speeds}, "more than one array of rows, so --position must name");
  refused({{"mass", "(3,)", {1, 2, 3}}}, "has no rows of three numbers");
  refused({places}, "has no array 'mass', but places (3, 3)", {.density = "mass"});
  refused({places, {"mass", "(2,)", {1, 2}}}, "mass has the shape (2,), expected 3 numbers", {.density = "mass"});
  refused({{"x", "(3,)", {1, 2, 3}}, {"y", "(2,)", {1, 2}}, {"z", "(3,)", {1, 2, 3}}}, "three arrays of one length");
  refused({{"places", "(400000000000, 3)", by_particle}}, "cut short: its header says 400000000000 rows");
  write_npz(folder / "a.npz", {places, speeds});
  expect_three_points(read_cloud(folder / "a.npz", {.position = "speeds"}));
}

TEST(Npz, CutShortAnywhereIsRefused) {
  const TemporaryFolder folder;
  write_npz(folder / "a.npz", {{"places", "(3, 3)", by_particle}}, true);
  const std::string bytes = read_whole_file(folder / "a.npz", 1 << 20);
  for (std::size_t length = 40; length < bytes.size(); length += 3) {
    write_whole_file(folder / "cut.npz", std::string_view(bytes).substr(0, length));
    expect_error(ErrorKind::bad_input, "cut.npz", [&] { read_cloud(folder / "cut.npz"); });
  }
}

}  // namespace wheatstone::npz_test
