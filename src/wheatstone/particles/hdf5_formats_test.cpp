// Snapshots and other tables of particles in HDF5.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <cmath>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/particles/gas_temperature_internal.h"
#include "wheatstone/particles/hdf5_internal.h"

namespace wheatstone::hdf5_formats_test {

using testing::ElementsAre;
using testing::FloatNear;
using testing::Pair;

void expect_three_points(const Cloud& cloud) {
  EXPECT_THAT(cloud.x, ElementsAre(1, 4, 7));
  EXPECT_THAT(cloud.y, ElementsAre(2, 5, 8));
  EXPECT_THAT(cloud.z, ElementsAre(3, 6, 9.5f));
}

/// Writes HDF5 files as simulation codes do.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose) {}
  void group(const std::string& name) {
    const Hdf5Handle made(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  }
  void attribute(const std::string& group, const std::string& name, std::vector<double> values) {
    const Hdf5Handle where(H5Oopen(file_, group.c_str(), H5P_DEFAULT), H5Oclose);
    const hsize_t size = values.size();
    const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Hdf5Handle made(H5Acreate2(where, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    H5Awrite(made, H5T_NATIVE_DOUBLE, values.data());
  }
  void text(const std::string& group, const std::string& name, const std::string& text) {
    const Hdf5Handle where(H5Oopen(file_, group.c_str(), H5P_DEFAULT), H5Oclose);
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, text.size() + 3);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle made(H5Acreate2(where, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    H5Awrite(made, type, (text + std::string(3, '\0')).c_str());
  }
  void dataset(const std::string& name, std::vector<float> values, hsize_t width = 1) {
    const std::array<hsize_t, 2> size{values.size() / width, width};
    const Hdf5Handle space(H5Screate_simple(width > 1 ? 2 : 1, size.data(), nullptr), H5Sclose);
    const Hdf5Handle made(H5Dcreate2(file_, name.c_str(), H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          H5Dclose);
    H5Dwrite(made, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  /// A dataset that takes no room in the file.
  void unwritten(const std::string& name, hsize_t rows, hsize_t width) {
    const std::array<hsize_t, 2> size{rows, width};
    const std::array<hsize_t, 2> chunk{1024, width};
    const Hdf5Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
    const Hdf5Handle chunked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(chunked, 2, chunk.data());
    const Hdf5Handle made(H5Dcreate2(file_, name.c_str(), H5T_IEEE_F32LE, space, H5P_DEFAULT, chunked, H5P_DEFAULT),
                          H5Dclose);
  }

 private:
  Hdf5Handle file_;
};

void write_snapshot(const std::filesystem::path& path, std::size_t header_entries, int files = 1, double total = 3,
                    double box_size = 50) {
  Hdf5Writer file(path);
  file.group("Header");
  std::vector<double> totals(header_entries, 0.);
  totals[0] = total;
  file.attribute("Header", "NumPart_Total", totals);
  file.attribute("Header", "MassTable", std::vector<double>(header_entries, 1.));
  file.attribute("Header", "NumFilesPerSnapshot", {static_cast<double>(files)});
  file.attribute("Header", "BoxSize", {box_size});
  file.attribute("Header", "Redshift", {2.});
  file.group("PartType0");
  file.dataset("PartType0/Coordinates", {1, 2, 3, 4, 5, 6, 7, 8, 9.5f}, 3);
  file.dataset("PartType0/Density", {10, 20, 30});
  file.dataset("PartType0/InternalEnergy", {100, 200, 300});
}

TEST(GadgetHdf5, ReadsHeadersOfAnyNumberOfTypes) {
  const TemporaryFolder folder;
  for (const std::size_t entries : {1, 2, 6}) {
    write_snapshot(folder / "snap.hdf5", entries);
    const CloudSource source = open_cloud(folder / "snap.hdf5");
    EXPECT_EQ(source.count, 3u);
    EXPECT_EQ(source.box_size, 50);
    EXPECT_EQ(source.redshift, 2);
    EXPECT_THAT(source.fields, ElementsAre("Coordinates", "Density", "InternalEnergy"));
    const Cloud cloud = read_cloud(folder / "snap.hdf5");
    expect_three_points(cloud);
    EXPECT_THAT(cloud.density, ElementsAre(10, 20, 30));
    EXPECT_THAT(cloud.temperature, ElementsAre(gas_temperature(100), gas_temperature(200), gas_temperature(300)));
  }
}

/// Three particles that move, of which the caller adds what the header tells.
void write_moving(Hdf5Writer& file, double time, double redshift) {
  file.group("Header");
  file.attribute("Header", "Time", {time});
  file.attribute("Header", "Redshift", {redshift});
  file.group("PartType0");
  file.dataset("PartType0/Coordinates", {1, 2, 3, 4, 5, 6, 7, 8, 9.5f}, 3);
  file.dataset("PartType0/ParticleIDs", {30, 10, 20});
  file.dataset("PartType0/Velocities", {1, 2, 3, 4, 5, 6, 7, 8, 9}, 3);
}

TEST(GadgetHdf5, TellsHowParticlesMoveInTheTimeOfTheSimulation) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "snap.hdf5";
  const auto motion = [&] { return read_cloud(path, {.motion = true}); };
  {
    Hdf5Writer file(path);
    write_moving(file, 0.25, 0);
  }
  EXPECT_EQ(open_cloud(path).time, 0.25);
  EXPECT_FALSE(open_cloud(path).redshift) << "the time is no scale factor, so that the header's 0 means nothing";
  EXPECT_THAT(motion().id, ElementsAre(30, 10, 20));
  EXPECT_THAT(motion().rate_y, ElementsAre(2, 5, 8));
  EXPECT_TRUE(read_cloud(path).id.empty());
  {
    // Einstein and de Sitter's universe at half its size: H is √8 of 0.1 km/s a kpc/h; dx/da = u·√a / (a²·H).
    Hdf5Writer file(path);
    write_moving(file, 0.5, 1);
    file.attribute("Header", "Omega0", {1});
  }
  EXPECT_EQ(open_cloud(path).time, 0.5);
  EXPECT_EQ(open_cloud(path).redshift, 1);
  EXPECT_THAT(motion().rate_y, ElementsAre(FloatNear(20, 0.01f), FloatNear(50, 0.01f), FloatNear(80, 0.01f)));
  {
    // SWIFT: seconds as time, Mpc without h, peculiar velocities as they are.
    Hdf5Writer file(path);
    write_moving(file, 1e17, 1);
    file.group("Cosmology");
    file.attribute("Cosmology", "Cosmological run", {1});
    file.attribute("Cosmology", "Omega_m", {1});
    file.attribute("Cosmology", "h", {0.5});
    file.attribute("Header", "UnitLength_in_cm", {3.085678e24});
    file.attribute("PartType0/Coordinates", "h-scale exponent", {0});
    file.attribute("PartType0/Velocities", "a-scale exponent", {0});
  }
  EXPECT_EQ(open_cloud(path).time, 0.5);
  EXPECT_THAT(motion().rate_y, ElementsAre(FloatNear(0.05657f, 1e-4f), FloatNear(0.1414f, 1e-4f), testing::_));
}

TEST(GadgetHdf5, ReadsTheNamesOfItsRelatives) {
  const TemporaryFolder folder;
  {
    Hdf5Writer file(folder / "swift.hdf5");
    file.group("PartType0");
    file.dataset("PartType0/Coordinates", {1, 2, 3, 4, 5, 6, 7, 8, 9.5f}, 3);
    file.dataset("PartType0/Densities", {10, 20, 30});
    file.dataset("PartType0/Temperatures", {1e4f, 2e4f, 3e4f});
    file.dataset("PartType0/SmoothingLengths", {1, 2, 3});
  }
  const Cloud swift = read_cloud(folder / "swift.hdf5");
  EXPECT_THAT(swift.density, ElementsAre(10, 20, 30));
  EXPECT_THAT(swift.temperature, ElementsAre(1e4f, 2e4f, 3e4f));
  EXPECT_THAT(swift.smoothing_length, ElementsAre(1, 2, 3));
  {
    Hdf5Writer file(folder / "arepo.hdf5");
    file.group("PartType0");
    file.dataset("PartType0/Coordinates", {1, 2, 3}, 3);
    file.dataset("PartType0/Density", {2});
    file.dataset("PartType0/Masses", {16});
    file.dataset("PartType0/InternalEnergy", {100});
    file.dataset("PartType0/ElectronAbundance", {1.158f});
  }
  const Cloud arepo = read_cloud(folder / "arepo.hdf5");
  // A ball of 32 cells of volume 8.
  EXPECT_NEAR(std::pow(arepo.smoothing_length[0], 3) * 4 / 3 * 3.14159265f, 32 * 8, 0.1);
  EXPECT_NEAR(arepo.temperature[0], gas_temperature(100), 0.01 * gas_temperature(100));  // wholly ionised
}

TEST(GadgetHdf5, JoinsPartsAndNamesTheMissingOne) {
  const TemporaryFolder folder;
  write_snapshot(folder / "snap.0.hdf5", 6, 2, 6);
  expect_error(ErrorKind::bad_input, "snap.1.hdf5: is missing", [&] { read_cloud(folder / "snap.0.hdf5"); });
  write_snapshot(folder / "snap.1.hdf5", 6, 2, 6);
  EXPECT_THAT(read_cloud(folder / "snap.0.hdf5").x, ElementsAre(1, 4, 7, 1, 4, 7));
  write_snapshot(folder / "snap.hdf5", 6, 2, 6);
  expect_error(ErrorKind::bad_input, "expected a file number", [&] { read_cloud(folder / "snap.hdf5"); });
  write_snapshot(folder / "more.hdf5", 6, 1, 1e12);
  expect_error(ErrorKind::bad_input, "1000000000000 particles, but there are only 3",
               [&] { read_cloud(folder / "more.hdf5"); });
}

TEST(GadgetHdf5, JoinsMorePartsThanFilesMayBeOpen) {
  const TemporaryFolder folder;
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &usual), 0);
  const rlimit few{.rlim_cur = 24, .rlim_max = usual.rlim_max};
  for (int i = 0; i < 40; ++i) write_snapshot(folder / ("snap." + std::to_string(i) + ".hdf5"), 6, 40, 120);
  setrlimit(RLIMIT_NOFILE, &few);
  EXPECT_EQ(read_cloud(folder / "snap.0.hdf5").size(), 120u);
  setrlimit(RLIMIT_NOFILE, &usual);
}

TEST(GadgetHdf5, PartsWithOtherDatasetsAreRefused) {
  const TemporaryFolder folder;
  write_snapshot(folder / "snap.0.hdf5", 6, 2, 6);
  {
    Hdf5Writer file(folder / "snap.1.hdf5");
    file.group("PartType0");
    file.dataset("PartType0/Coordinates", {1, 2, 3, 4, 5, 6, 7, 8, 9.5f}, 3);
  }
  expect_error(ErrorKind::bad_input, "snap.1.hdf5: has other datasets than",
               [&] { read_cloud(folder / "snap.0.hdf5"); });
}

TEST(GadgetHdf5, PartsOfDifferentBoxesAreRefused) {
  const TemporaryFolder folder;
  write_snapshot(folder / "snap.0.hdf5", 6, 2, 6);
  write_snapshot(folder / "snap.1.hdf5", 6, 2, 6, 60);
  expect_error(ErrorKind::bad_input, "snap.1.hdf5: its box has a side of 60, expected 50, that of snap.0.hdf5",
               [&] { read_cloud(folder / "snap.0.hdf5"); });
}

TEST(GadgetHdf5, ADamagedPartAmongEightIsNamed) {
  const TemporaryFolder folder;
  for (int i = 0; i < 8; ++i) write_snapshot(folder / fmt::format("snap.{}.hdf5", i), 6, 8, 24);
  EXPECT_EQ(read_cloud(folder / "snap.0.hdf5").size(), 24u);
  std::filesystem::resize_file(folder / "snap.5.hdf5", std::filesystem::file_size(folder / "snap.5.hdf5") / 2);
  expect_error(ErrorKind::bad_input, "snap.5.hdf5: ", [&] { read_cloud(folder / "snap.0.hdf5"); });
}

TEST(GadgetHdf5, SmoothingLengthsOfSwiftBecomeTheKernelsRadii) {
  const TemporaryFolder folder;
  for (const auto& [kernel, factor] : {std::pair{"Cubic spline (M4)", 1.825742f}, {"Wendland C2", 1.936492f}}) {
    {
      Hdf5Writer file(folder / "swift.hdf5");
      file.group("HydroScheme");
      file.text("HydroScheme", "Kernel function", kernel);
      file.group("PartType0");
      file.dataset("PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
      file.dataset("PartType0/SmoothingLengths", {1, 2});
    }
    EXPECT_THAT(read_cloud(folder / "swift.hdf5").smoothing_length, ElementsAre(factor, 2 * factor));
    EXPECT_THAT(read_cloud(folder / "swift.hdf5", {.smoothing_length = "SmoothingLengths"}).smoothing_length,
                ElementsAre(1, 2));
  }
}

TEST(GadgetHdf5, RowsThatTheFileCannotHoldAreRefused) {
  const TemporaryFolder folder;
  {
    Hdf5Writer file(folder / "claims.hdf5");
    file.group("PartType0");
    file.unwritten("PartType0/Coordinates", 1'000'000'000'000, 3);
  }
  expect_error(ErrorKind::bad_input, "says 1000000000000 rows, which the file does not hold",
               [&] { read_cloud(folder / "claims.hdf5"); });
}

TEST(GadgetHdf5, ReadsMassesAndWhatIsToBeShown) {
  const TemporaryFolder folder;
  for (const bool in_header : {false, true}) {
    Hdf5Writer file(folder / (in_header ? "table.hdf5" : "own.hdf5"));
    file.group("Header");
    if (in_header) file.attribute("Header", "MassTable", {2.5, 0});
    file.group("PartType0");
    file.dataset("PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    file.dataset("PartType0/Velocities", {3, 0, 4, -1, 0, 0}, 3);
    file.dataset("PartType0/Metallicity", {0.5f, 0.25f});
    if (!in_header) file.dataset("PartType0/Masses", {1, 7});
  }
  EXPECT_THAT(read_cloud(folder / "table.hdf5").mass, ElementsAre(2.5f, 2.5f));
  EXPECT_THAT(read_cloud(folder / "own.hdf5").mass, ElementsAre(1, 7));
  const auto shown = [&](const std::string& name) {
    return read_cloud(folder / "own.hdf5", {.quantity = name}).quantity;
  };
  EXPECT_THAT(shown("velocity-x"), ElementsAre(3, -1));
  EXPECT_THAT(shown("Velocities-z"), ElementsAre(4, 0));
  EXPECT_THAT(shown("velocity"), ElementsAre(5, 1));
  EXPECT_THAT(shown("Metallicity"), ElementsAre(0.5f, 0.25f));
  expect_error(ErrorKind::bad_input, "'Spin' for these particles, but Coordinates, Masses, Metallicity, Velocities",
               [&] { shown("Spin"); });
  expect_error(ErrorKind::bad_input, "Metallicity has 1 numbers per row, but component y",
               [&] { shown("Metallicity-y"); });
  const Cloud generic = read_cloud(
      folder / "own.hdf5",
      {.position = "/PartType0/Coordinates", .mass = "/PartType0/Masses", .quantity = "/PartType0/Velocities-x"});
  EXPECT_THAT(generic.mass, ElementsAre(1, 7));
  EXPECT_THAT(generic.quantity, ElementsAre(3, -1));
}

/// For which of a file's particles a condition holds.
std::vector<std::uint8_t> chosen(const std::filesystem::path& file, const std::string& where, CloudChoice choice = {}) {
  choice.where = parse_condition(where);
  return read_cloud(file, choice).chosen;
}

TEST(GadgetHdf5, ChoosesByItsDatasetsAndByWhatIsMadeOfThem) {
  const TemporaryFolder folder;
  {
    Hdf5Writer file(folder / "snap.hdf5");
    file.group("PartType0");
    file.dataset("PartType0/Coordinates", {1, 2, 3, 4, 5, 6, 7, 8, 9.5f}, 3);
    file.dataset("PartType0/Velocities", {3, 0, 4, -1, 0, 0, 0, 0, 9}, 3);
    file.dataset("PartType0/InternalEnergy", {100, 200, 300});
    file.dataset("PartType0/Metallicity", {0.02f, 0.01f, NAN});
  }
  const auto expect_chosen = [&](const std::string& where, std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    EXPECT_THAT(chosen(folder / "snap.hdf5", where), ElementsAre(a, b, c)) << where;
    EXPECT_THAT(chosen(folder / "snap.hdf5", where, {.origin = {{100, 0, 0}}}), ElementsAre(a, b, c)) << where;
  };
  expect_chosen("Metallicity == 0.02", 1, 0, 0);
  expect_chosen("not metallicity == 0.02", 0, 1, 1);
  expect_chosen("velocity-x < 0", 0, 1, 0);
  expect_chosen("Velocities >= 5", 1, 0, 1);
  expect_chosen("Coordinates-z > 9 or x == 1", 1, 0, 1);
  expect_chosen(fmt::format("Temperature > {}", gas_temperature(150)), 0, 1, 1);
  expect_chosen("/PartType0/InternalEnergy < 250", 1, 1, 0);
  expect_error(ErrorKind::bad_input,
               "snap.hdf5: has no quantity 'Spin', but Coordinates, InternalEnergy, Metallicity, Velocities, x, y, z, "
               "temperature",
               [&] { chosen(folder / "snap.hdf5", "Spin > 1"); });
  expect_error(ErrorKind::bad_input, "Metallicity has 1 numbers per row, but component y",
               [&] { chosen(folder / "snap.hdf5", "Metallicity-y > 1"); });
  const CloudChoice generic{.position = "/PartType0/Coordinates"};
  EXPECT_THAT(chosen(folder / "snap.hdf5", "/PartType0/Velocities-z > 3 and y < 5", generic), ElementsAre(1, 0, 0));
  expect_error(ErrorKind::bad_input, "has no quantity 'Metallicity', but /PartType0/Coordinates",
               [&] { chosen(folder / "snap.hdf5", "Metallicity > 1", generic); });
}

TEST(GadgetHdf5, NamesWhatIsMissingAndWhatThereIs) {
  const TemporaryFolder folder;
  write_snapshot(folder / "snap.hdf5", 2);
  expect_error(ErrorKind::bad_input, "'Metallicity' for these particles, but Coordinates, Density, InternalEnergy",
               [&] { read_cloud(folder / "snap.hdf5", {.temperature = "Metallicity"}); });
  expect_error(ErrorKind::bad_input, "type 'halo'; by type it has 0: 3",
               [&] { read_cloud(folder / "snap.hdf5", {.type = "halo"}); });
  expect_error(ErrorKind::wrong_usage, "particle type is 'jellyfish'",
               [&] { read_cloud(folder / "snap.hdf5", {.type = "jellyfish"}); });
}

TEST(GadgetHdf5, TellsItsUnits) {
  const TemporaryFolder folder;
  {
    Hdf5Writer file(folder / "snap.hdf5");
    file.group("Parameters");
    file.attribute("Parameters", "UnitLength_in_cm", {3.085678e21});
    file.attribute("Parameters", "UnitMass_in_g", {1.989e43});
    file.attribute("Parameters", "UnitVelocity_in_cm_per_s", {1e5});
    file.attribute("Parameters", "HubbleParam", {0.7});
    file.group("PartType0");
    file.dataset("PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    file.dataset("PartType0/Density", {1, 2});
    for (const auto& [name, value] :
         {std::pair{"to_cgs", 6.75e-22}, std::pair{"a_scaling", -3.}, std::pair{"h_scaling", 2.},
          std::pair{"length_scaling", -3.}, std::pair{"mass_scaling", 1.}, std::pair{"velocity_scaling", 0.}})
      file.attribute("PartType0/Density", name, {value});
  }
  EXPECT_THAT(open_cloud(folder / "snap.hdf5", {.type = "gas"}).units,
              ElementsAre(Pair("length", "3.08568e+21 cm (kpc)"), Pair("mass", "1.989e+43 g (1e10 Msun)"),
                          Pair("velocity", "100000 cm/s (km/s)"), Pair("h", "0.7"),
                          Pair("Density", "6.75e-22 g cm^-3 a^-3 h^2")));
}

TEST(Hdf5Dataset, ThePositionNeedNotBeNamedWhereThereIsNoDoubt) {
  const TemporaryFolder folder;
  const std::vector<float> points{1, 2, 3, 4, 5, 6, 7, 8, 9.5f};
  const auto write = [&](const std::vector<std::string>& names) {
    std::filesystem::remove(folder / "a.hdf5");
    Hdf5Writer file(folder / "a.hdf5");
    file.group("sky");
    file.dataset("mass", {1, 2, 3});
    for (const std::string& name : names) file.dataset(name, points, 3);
  };
  write({"Coordinates"});
  expect_three_points(read_cloud(folder / "a.hdf5"));
  write({"sky/places"});
  expect_three_points(read_cloud(folder / "a.hdf5"));
  write({"velocity", "sky/Positions"});
  expect_three_points(read_cloud(folder / "a.hdf5"));
  write({"velocity", "sky/places"});
  expect_error(ErrorKind::bad_input, "more than one dataset may hold the positions, so --position must name",
               [&] { read_cloud(folder / "a.hdf5"); });
  write({});
  expect_error(ErrorKind::bad_input, "no dataset has rows of three numbers, so --position must name",
               [&] { read_cloud(folder / "a.hdf5"); });
}

TEST(GadgetHdf5, CutShortIsRefused) {
  const TemporaryFolder folder;
  write_snapshot(folder / "snap.hdf5", 2);
  const std::string bytes = read_whole_file(folder / "snap.hdf5", 1 << 20);
  for (std::size_t length = 0; length < bytes.size(); length += 97) {
    write_whole_file(folder / "cut.hdf5", bytes.substr(0, length));
    expect_error(ErrorKind::bad_input, "cut.hdf5", [&] { read_cloud(folder / "cut.hdf5"); });
  }
}

TEST(Hdf5Dataset, ReadsAnyByName) {
  const TemporaryFolder folder;
  {
    Hdf5Writer file(folder / "stars.h5");
    file.group("cat");
    file.dataset("cat/pos", {1, 2, 3, 4, 5, 6, 7, 8, 9.5f}, 3);
    file.dataset("cat/mag", {7, 8, 9});
    file.dataset("x", {1, 4, 7});
  }
  const Cloud cloud = read_cloud(folder / "stars.h5", {.position = "/cat/pos", .temperature = "/cat/mag"});
  expect_three_points(cloud);
  EXPECT_THAT(cloud.temperature, ElementsAre(7, 8, 9));
  EXPECT_THAT(read_cloud(folder / "stars.h5", {.position = "/x,/x,/cat/mag"}).z, ElementsAre(7, 8, 9));
  EXPECT_THAT(read_cloud(folder / "stars.h5").y, ElementsAre(2, 5, 8));
  expect_error(ErrorKind::bad_input, "no dataset '/none', but /cat/mag, /cat/pos, /x",
               [&] { read_cloud(folder / "stars.h5", {.position = "/none"}); });
  expect_error(ErrorKind::bad_input, "no dataset '/y'", [&] { read_cloud(folder / "stars.h5", {.position = "/y"}); });
  expect_error(ErrorKind::bad_input, "not a list of positions",
               [&] { read_cloud(folder / "stars.h5", {.position = "/x"}); });
}

TEST(CloudSource, GivesTheSameInTheMemoryOfChunksThatWereGivenBack) {
  const TemporaryFolder folder;
  write_snapshot(folder / "snap.hdf5", 2);
  const Cloud whole = read_cloud(folder / "snap.hdf5");
  const CloudSource source = open_cloud(folder / "snap.hdf5");
  Cloud first = source.next(2);
  // What others have put into a chunk does not come back.
  first.quantity = first.presence = {7, 8};
  first.x = {9, 9};
  first.colour = {{1, 2, 3}, {4, 5, 6}};
  source.reuse(std::move(first));
  const Cloud second = source.next(2);
  ASSERT_EQ(second.size(), 1u);
  for_each_column(second, whole, [](const auto& column, const auto& of_whole) {
    ASSERT_EQ(column.size(), of_whole.empty() ? 0u : 1u);
    EXPECT_TRUE(column.empty() || column[0] == of_whole[2]);
  });
}

TEST(CloudSource, ChunksAreTheWholeInOrder) {
  const TemporaryFolder folder;
  write_snapshot(folder / "snap.hdf5", 2);
  const CloudSource source = open_cloud(folder / "snap.hdf5");
  EXPECT_THAT(source.next(2).x, ElementsAre(1, 4));
  EXPECT_THAT(source.next(2).x, ElementsAre(7));
  EXPECT_EQ(source.next(2).size(), 0u);
}

}  // namespace wheatstone::hdf5_formats_test
