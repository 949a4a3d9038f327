// Positions far from 0, in every format that holds double precision.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/particles/hdf5_internal.h"
#include "wheatstone/particles/select.h"
#include "wheatstone/random.h"

namespace wheatstone::positions_test {

using testing::ElementsAre;

/// Coordinates of 2000 points within ±size/2 of the offset, rounded as double precision has them there.
std::vector<double> cluster(double size, double offset) {
  std::vector<double> numbers;
  for (std::uint64_t i = 0; i < 6000; ++i) numbers.push_back((unit_float(hash_keys({i})) - 0.5) * size + offset);
  return numbers;
}

std::string bytes_of(const std::vector<double>& numbers) {
  std::string bytes(numbers.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

void write_npy(const std::filesystem::path& path, const std::vector<double>& numbers) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2000, 3), }";
  header += std::string((64 - (10 + header.size() + 1) % 64) % 64, ' ') + "\n";
  write_whole_file(
      path, std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header + bytes_of(numbers));
}

std::string rows_of(const std::vector<double>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g%c", numbers[i], i % 3 == 2 ? '\n' : ' ');
    text += digits.data();
  }
  return text;
}

void write_ply(const std::filesystem::path& path, const std::vector<double>& numbers, bool ascii) {
  write_whole_file(path, std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") +
                             " 1.0\nelement vertex 2000\nproperty double x\nproperty double y\nproperty double z\n"
                             "end_header\n" +
                             (ascii ? rows_of(numbers) : bytes_of(numbers)));
}

void write_hdf5(const std::filesystem::path& path, const std::vector<double>& numbers, hid_t type = H5T_IEEE_F64LE) {
  const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  const std::array<hsize_t, 2> size{numbers.size() / 3, 3};
  const Hdf5Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
  const Hdf5Handle group(H5Gcreate2(file, "PartType0", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  for (const char* name : {"points", "PartType0/Coordinates"}) {
    const Hdf5Handle made(H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
  }
}

void write_gadget(const std::filesystem::path& path, const std::vector<double>& numbers) {
  std::string header(256, '\0');
  const std::uint32_t count = 2000;
  std::memcpy(header.data(), &count, 4);
  std::memcpy(header.data() + 96, &count, 4);
  std::string file;
  for (const std::string& record : {header, bytes_of(numbers)}) {
    std::string marker(4, '\0');
    const auto length = static_cast<std::uint32_t>(record.size());
    std::memcpy(marker.data(), &length, 4);
    file += marker + record + marker;
  }
  write_whole_file(path, file);
}

/// The cloud has these points to within a share of their extent.
void expect_points(const Cloud& cloud, const std::vector<double>& numbers, double size) {
  ASSERT_EQ(cloud.size(), numbers.size() / 3);
  double worst = 0;
  const std::array<const std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double wanted = numbers[i] - cloud.origin[i % 3];
    worst = std::max(worst, std::abs(static_cast<double>((*axes[i % 3])[i / 3]) - wanted));
  }
  EXPECT_LT(worst, 1e-6 * size);
}

TEST(Positions, OfDoublePrecisionKeepTheirPlacesFarFromZeroInEveryFormat) {
  const TemporaryFolder folder;
  for (const auto& [size, offset] : {std::pair{1., 1e8}, std::pair{1000., 1e12}}) {
    const std::vector<double> numbers = cluster(size, offset);
    const auto expect_kept = [&, extent = size](const char* name, const CloudChoice& choice = {}) {
      SCOPED_TRACE(name);
      const Cloud cloud = read_cloud(folder / name, choice);
      EXPECT_NEAR(cloud.origin[0], numbers[0], extent);
      expect_points(cloud, numbers, extent);
    };
    write_npy(folder / "a.npy", numbers);
    expect_kept("a.npy");
    write_whole_file(folder / "a.txt", rows_of(numbers));
    expect_kept("a.txt");
    write_ply(folder / "a.ply", numbers, true);
    expect_kept("a.ply");
    write_ply(folder / "b.ply", numbers, false);
    expect_kept("b.ply");
    write_hdf5(folder / "a.hdf5", numbers);
    expect_kept("a.hdf5");
    expect_kept("a.hdf5", {.position = "/points"});
    write_gadget(folder / "snap", numbers);
    expect_kept("snap");
  }
}

TEST(Positions, OfSinglePrecisionAreThoseOfTheSameNumbersInDouble) {
  const TemporaryFolder folder;
  const auto bits_of = [&](const std::vector<double>& numbers, hid_t type, const CloudChoice& choice) {
    write_hdf5(folder / "a.hdf5", numbers, type);
    Cloud cloud = read_cloud(folder / "a.hdf5", choice);
    std::vector<double> all(cloud.origin.begin(), cloud.origin.end());
    all.push_back(cloud.farthest);
    for (const std::vector<float>* axis : {&cloud.x, &cloud.y, &cloud.z})
      all.insert(all.end(), axis->begin(), axis->end());
    std::vector<std::uint64_t> bits;
    for (const double number : all)
      bits.push_back(std::isnan(number) ? 0x7FF8000000000001u : std::bit_cast<std::uint64_t>(number));
    return bits;
  };
  for (const double offset : {0., 3e5}) {
    std::vector<double> numbers = cluster(1000, offset);
    for (double& number : numbers) number = static_cast<double>(static_cast<float>(number));
    // Once all are near, and once some are not.
    for (const bool far : {false, true}) {
      if (far) numbers[3000] = static_cast<double>(-3e30f);
      if (far) numbers[3001] = static_cast<double>(std::nanf(""));
      for (const CloudChoice& choice : {CloudChoice{}, CloudChoice{.origin = {{0.1, offset, 2e6}}}}) {
        const auto in_double = bits_of(numbers, H5T_IEEE_F64LE, choice);
        EXPECT_EQ(bits_of(numbers, H5T_IEEE_F32LE, choice), in_double);
        EXPECT_EQ(bits_of(numbers, H5T_IEEE_F32BE, choice), in_double);
      }
    }
  }
}

TEST(Positions, HaveTheSameOriginInChunksOfAnySize) {
  const TemporaryFolder folder;
  write_npy(folder / "a.npy", cluster(1, 1e8));
  const Cloud whole = read_cloud(folder / "a.npy");
  for (const std::size_t most : {7, 999, 1500}) {
    const CloudSource source = open_cloud(folder / "a.npy");
    std::vector<float> x;
    for (Cloud chunk = source.next(most); chunk.size() > 0; chunk = source.next(most)) {
      EXPECT_LE(chunk.size(), most);
      EXPECT_EQ(chunk.origin, whole.origin);
      x.insert(x.end(), chunk.x.begin(), chunk.x.end());
    }
    EXPECT_EQ(x, whole.x);
  }
}

TEST(Positions, AreRelativeToWhatIsAskedForAndElseToZeroWhereThatIsNear) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.csv", "x,y,z\n1e8,0.5,-3\n100000001,1.5,-4\n100000002.25,2.5,1e6\n");
  const Cloud chosen = read_cloud(folder / "a.csv", {.origin = {{1e8, 0, 0}}});
  EXPECT_THAT(chosen.x, ElementsAre(0, 1, 2.25f));
  const Cloud cloud = read_cloud(folder / "a.csv");
  EXPECT_THAT(cloud.origin, ElementsAre(100000001, 0, 0));
  EXPECT_THAT(cloud.x, ElementsAre(-1, 0, 1.25f));
  EXPECT_THAT(cloud.y, ElementsAre(0.5f, 1.5f, 2.5f));
}

TEST(Positions, OneFarOutlierDoesNotMoveTheOrigin) {
  const TemporaryFolder folder;
  std::vector<double> numbers = cluster(1, 1e8);
  numbers[300] = -1e15;
  write_npy(folder / "a.npy", numbers);
  EXPECT_NEAR(read_cloud(folder / "a.npy").origin[0], 1e8, 1);
}

TEST(Positions, AroundAChosenCentreOfAPeriodicBoxStayPrecise) {
  Cloud cloud;
  cloud.box_size = 1e9;
  cloud.origin = {5e8 + 1, 0, 0};
  cloud.x = {-0.25f, 0.5f};
  cloud.y = {0.125f, 1e9f - 64};
  cloud.z = {0, 0};
  select_particles(cloud, {.centre = {{5e8, 0, 0}}, .cut = Sphere{{5e8, 5e8, 5e8}, 1}});
  EXPECT_THAT(cloud.x, ElementsAre(0.75f));
  EXPECT_THAT(cloud.y, ElementsAre(0.125f));
  EXPECT_THAT(cloud.origin, ElementsAre(5e8, 5e8, 5e8));
}

TEST(Positions, BeyondSinglePrecisionAreKeptAndToldInDouble) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.csv", "x,y,z,rho\n1,2,3,1e200\n4,-1e200,6,1e-300\n7,8,9,0\n10,11,12,5\n");
  Cloud cloud = read_cloud(folder / "a.csv");
  EXPECT_EQ(cloud.farthest, -1e200);
  const SelectionCounts counts = select_particles(cloud, {});
  EXPECT_EQ(counts.dropped, 0u);
  EXPECT_EQ(counts.extreme, 2u);
  EXPECT_EQ(counts.mended, 1u);
  EXPECT_GT(cloud.density[0], 1e38f);
}

}  // namespace wheatstone::positions_test
