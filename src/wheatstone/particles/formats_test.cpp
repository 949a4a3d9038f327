// Every format that particles come in, written here byte by byte, and what damaged files get.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "shared_data.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/particles/gas_temperature_internal.h"

namespace wheatstone::formats_test {

using testing::ElementsAre;

/// Bytes of numbers, in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big_endian = false) : big_(big_endian) {}
  template <class Number>
  Bytes& put(Number number) {
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), &number, sizeof(Number));
    if (big_) std::ranges::reverse(raw);
    text.append(raw.data(), raw.size());
    return *this;
  }
  Bytes& put_text(const std::string& more) {
    text += more;
    return *this;
  }
  /// A Fortran record.
  Bytes& put_record(const std::string& data) {
    put(static_cast<std::uint32_t>(data.size()));
    text += data;
    return put(static_cast<std::uint32_t>(data.size()));
  }
  std::string text;

 private:
  bool big_;
};

void expect_three_points(const Cloud& cloud) {
  EXPECT_THAT(cloud.x, ElementsAre(1, 4, 7));
  EXPECT_THAT(cloud.y, ElementsAre(2, 5, 8));
  EXPECT_THAT(cloud.z, ElementsAre(3, 6, 9.5f));
}

/// Every file that is cut short is refused, or gives no more than it has; none is read beyond.
void expect_truncations_refused(const std::string& bytes, const std::string& name) {
  const TemporaryFolder folder;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    write_whole_file(folder / name, std::string_view(bytes).substr(0, length));
    expect_error(ErrorKind::bad_input, name, [&] { read_cloud(folder / name); });
  }
}

TEST(HoldsParticles, ByContentWhateverTheName) {
  const TemporaryFolder folder;
  const auto holds = [&](const std::string& bytes) {
    write_whole_file(folder / "snap_000", bytes);
    return holds_particles(folder / "snap_000");
  };
  for (const std::string particles :
       {"x,y,z\n1,2,3\n", "# by hand\n\n1 2 3\n", "ply\nformat ascii 1.0\n", "ply\r\n", "LASF",
        "# x [kpc] y [kpc] z [kpc]\n1.0D0 2.0D0 3.0D0\n", "\x93NUMPY", "\x89HDF\r\n\x1a\n"})
    EXPECT_TRUE(holds(particles)) << particles;
  EXPECT_TRUE(holds(Bytes().put_record(std::string(256, '\1')).text));
  EXPECT_TRUE(holds(Bytes(true).put_record(std::string(256, '\1')).text));
  for (const std::string other : {"", "one line of words", "<svg width=\"1\" height=\"1\" viewBox=\"0 0 1 1\">\n",
                                  "P3\n2 2\n255\n1 2 3\n", "{\"a\": [1, 2, 3]}\n", "\x89PNG\r\n\x1a\n"})
    EXPECT_FALSE(holds(other)) << other;
  EXPECT_FALSE(holds_particles(folder / "none"));
  EXPECT_FALSE(holds_particles(folder / ""));
}

std::string npy(const std::string& header, const std::string& data) {
  const std::string padded = header + std::string((64 - (10 + header.size() + 1) % 64) % 64, ' ') + "\n";
  return Bytes()
             .put_text("\x93NUMPY")
             .put<std::uint8_t>(1)
             .put<std::uint8_t>(0)
             .put<std::uint16_t>(static_cast<std::uint16_t>(padded.size()))
             .text +
         padded + data;
}

TEST(Npy, ReadsFloatsOfEitherOrderAndLayout) {
  const TemporaryFolder folder;
  const std::array<float, 9> rows{1, 2, 3, 4, 5, 6, 7, 8, 9.5f};
  for (const bool big : {false, true}) {
    Bytes by_row(big);
    Bytes by_column(big);
    for (std::size_t i = 0; i < 9; ++i) {
      by_row.put(static_cast<double>(rows[i]));
      by_column.put(rows[i % 3 * 3 + i / 3]);
    }
    const std::string order = big ? ">" : "<";
    write_whole_file(folder / "a.npy",
                     npy("{'descr': '" + order + "f8', 'fortran_order': False, 'shape': (3, 3), }", by_row.text));
    expect_three_points(read_cloud(folder / "a.npy"));
    write_whole_file(folder / "a.npy",
                     npy("{'descr': '" + order + "f4', 'fortran_order': True, 'shape': (3, 3), }", by_column.text));
    expect_three_points(read_cloud(folder / "a.npy"));
  }
}

TEST(Npy, RefusesWhatIsNoTableOfNumbers) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& header, const std::string& part) {
    write_whole_file(folder / "a.npy", npy(header, std::string(100, '\0')));
    expect_error(ErrorKind::bad_input, part, [&] { read_cloud(folder / "a.npy"); });
  };
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': (99, 3), }", "cut short");
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': (9223372036854775807, 3), }", "cut short");
  refused("{'descr': '<f4', 'fortran_order': True, 'shape': (9223372036854775807, 3), }", "rows");
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': (12,), }", "shape (12,), expected rows of three numbers");
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 3), }", "shape (2, 2, 3), expected rows");
  refused("{'descr': '<c8', 'fortran_order': False, 'shape': (3, 3), }",
          "an array of type '<c8' and shape (3, 3), expected");
  refused("{'descr': '<f16', 'fortran_order': False, 'shape': (3, 3), }", "numbers may be f2, f4, f8");
  refused("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (3,), }", "no column 'y', but x");
  refused("{'descr': [('p', '<f4', (3,))], 'fortran_order': False, 'shape': (3,), }", "[('p', '<f4', (3,))]");
  refused("{'descr': [('x', '<f4'), ('y', '>f4'), ('z', '<f4')], 'fortran_order': False, 'shape': (3,), }", "expected");
}

TEST(Npy, AllXAllYAndAllZAreRefusedWithAHintUnlessTheyCanBeNothingElse) {
  const TemporaryFolder folder;
  for (const char* order : {"False", "True"}) {
    write_whole_file(folder / "a.npy",
                     npy("{'descr': '<f8', 'fortran_order': " + std::string(order) + ", 'shape': (3, 900), }",
                         std::string(std::size_t{3} * 900 * 8, '\0')));
    expect_error(ErrorKind::bad_input, "has the shape (3, 900), expected one row per particle",
                 [&] { read_cloud(folder / "a.npy"); });
  }
  Bytes by_axis;
  Bytes by_particle;
  for (int i = 0; i < 6000; ++i) {
    const int axis = i % 3, particle = i / 3;
    by_axis.put(static_cast<float>(i));
    by_particle.put(static_cast<float>(axis * 2000 + particle));
  }
  const Bytes* of_order[] = {&by_axis, &by_particle};
  for (const bool fortran : {false, true}) {
    write_whole_file(
        folder / "a.npy",
        npy("{'descr': '<f4', 'fortran_order': " + std::string(fortran ? "True" : "False") + ", 'shape': (3, 2000), }",
            of_order[fortran]->text));
    const Cloud cloud = read_cloud(folder / "a.npy", {.origin = {{0, 0, 0}}});
    ASSERT_EQ(cloud.size(), 2000u);
    EXPECT_EQ(cloud.x[1999], 1999);
    EXPECT_EQ(cloud.y[0], 2000);
    EXPECT_EQ(cloud.z[1999], 5999);
  }
}

TEST(Npy, ReadsHalfFloatsAndRecords) {
  const TemporaryFolder folder;
  Bytes halves;  // binary16 of 1 to 8 and 9.5
  for (const int bits : {0x3C00, 0x4000, 0x4200, 0x4400, 0x4500, 0x4600, 0x4700, 0x4800, 0x48C0})
    halves.put(static_cast<std::uint16_t>(bits));
  write_whole_file(folder / "a.npy", npy("{'descr': '<f2', 'fortran_order': False, 'shape': (3, 3), }", halves.text));
  expect_three_points(read_cloud(folder / "a.npy"));
  for (const bool big : {false, true}) {
    Bytes records(big);
    for (const float x : {1.f, 4.f, 7.f})
      records.put(static_cast<std::int16_t>(10 * x))
          .put_text("..")
          .put(static_cast<double>(x == 7 ? 9.5f : x + 2))
          .put(x)
          .put(x + 1);
    const std::string order = big ? ">" : "<";
    write_whole_file(folder / "a.npy",
                     npy("{'descr': [('rho', '" + order + "i2'), ('', '|V2'), ('z', '" + order + "f8'), ('x', '" +
                             order + "f4'), ('y', '" + order + "f4')], 'fortran_order': False, 'shape': (3,), }",
                         records.text));
    const Cloud cloud = read_cloud(folder / "a.npy");
    expect_three_points(cloud);
    EXPECT_THAT(cloud.density, ElementsAre(10, 40, 70));
    EXPECT_THAT(read_cloud(folder / "a.npy", {.position = "rho,y,z"}).x, ElementsAre(10, 40, 70));
    EXPECT_THAT(read_cloud(folder / "a.npy", {.where = parse_condition("rho > 10 and Z < 9")}).chosen,
                ElementsAre(0, 1, 0));
  }
}

TEST(Npy, PositionsAreInTheColumnsThatAreNamed) {
  const TemporaryFolder folder;
  Bytes rows;
  for (const float x : {1.f, 4.f}) rows.put(x + 2).put(-1.f).put(x).put(x + 1);
  write_whole_file(folder / "a.npy", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 4), }", rows.text));
  const Cloud cloud =
      read_cloud(folder / "a.npy", {.position = "2,3,0", .where = parse_condition("\"0\" > 3 and x == 4")});
  EXPECT_THAT(cloud.chosen, ElementsAre(0, 1));
  EXPECT_THAT(cloud.x, ElementsAre(1, 4));
  EXPECT_THAT(cloud.y, ElementsAre(2, 5));
  EXPECT_THAT(cloud.z, ElementsAre(3, 6));
  for (const char* wrong : {"x,y,z", "0,1,4", "1"})
    expect_error(ErrorKind::bad_input, "a.npy: ", [&] { read_cloud(folder / "a.npy", {.position = wrong}); });
}

std::string ply_header(const std::string& format, int vertices) {
  return "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
         "property uchar blue\nend_header\n";
}

TEST(Ply, ReadsAsciiAndBinaryOfEitherOrder) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.ply", ply_header("ascii", 3) + "1 2 3 255 0 7\n4 5 6 255 0 7\n7 8 9.5 255 0 7\n");
  const Cloud ascii = read_cloud(folder / "a.ply");
  expect_three_points(ascii);
  EXPECT_EQ(ascii.colour[2], (Rgb8{255, 0, 7}));
  EXPECT_THAT(read_cloud(folder / "a.ply", {.position = "z,x,y"}).x, ElementsAre(3, 6, 9.5f));
  expect_error(ErrorKind::bad_input, "no property 'w'", [&] { read_cloud(folder / "a.ply", {.position = "x,y,w"}); });
  for (const bool big : {false, true}) {
    Bytes data(big);
    for (const float x : {1.f, 4.f, 7.f})
      data.put(x)
          .put(static_cast<double>(x + 1))
          .put(x == 7 ? 9.5f : x + 2)
          .put<std::uint8_t>(255)
          .put<std::uint8_t>(0)
          .put<std::uint8_t>(7);
    const std::string bytes = ply_header(big ? "binary_big_endian" : "binary_little_endian", 3) + data.text;
    write_whole_file(folder / "b.ply", bytes);
    const Cloud cloud = read_cloud(folder / "b.ply");
    expect_three_points(cloud);
    EXPECT_EQ(cloud.colour, ascii.colour);
    expect_truncations_refused(bytes, "cut.ply");
  }
}

TEST(Ply, RefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& part) {
    write_whole_file(folder / "a.ply", text);
    expect_error(ErrorKind::bad_input, part, [&] { read_cloud(folder / "a.ply"); });
  };
  refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", "no property 'y', but x");
  refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int x\nend_header\n1\n", "lists");
  refused("ply\nformat ascii 1.0\nelement face 1\nelement vertex 1\n", "before its vertices");
  refused(ply_header("ascii", 3) + "1 2 3 255 0 7\n4 five", "damaged");
  refused(ply_header("ascii", 2000000000), "cut short");
  refused(ply_header("ascii", 0), "no vertices");
  refused(ply_header("utf-9", 1) + "1 2 3 4 5 6", "utf-9");
}

/// LAS 1.2, point format 2: with colours.
std::string las(std::uint32_t count, std::uint8_t format = 2) {
  Bytes header;
  header.put_text("LASF").put_text(std::string(20, '\0')).put<std::uint8_t>(1).put<std::uint8_t>(2);
  header.put_text(std::string(94 - header.text.size(), '\0')).put<std::uint16_t>(227).put<std::uint32_t>(227);
  header.put_text(std::string(104 - header.text.size(), '\0')).put(format).put<std::uint16_t>(26).put(count);
  header.put_text(std::string(131 - header.text.size(), '\0'));
  for (int axis = 0; axis < 3; ++axis) header.put(0.5);                         // scale
  for (int axis = 0; axis < 3; ++axis) header.put(4'500'000.);                  // offset
  for (int axis = 0; axis < 3; ++axis) header.put(4'500'009.).put(4'500'000.);  // largest, least
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      header.put<std::int32_t>(2 * (3 * i + axis + 1) + (i == 2 && axis == 2 ? 1 : 0));
    header.put<std::uint16_t>(static_cast<std::uint16_t>(100 * (i + 1))).put_text(std::string(6, '\0'));
    header.put<std::uint16_t>(65535).put<std::uint16_t>(0).put<std::uint16_t>(257);
  }
  return header.text;
}

TEST(Las, KeepsCentimetresFarFromTheOrigin) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.las", las(3));
  const Cloud cloud = read_cloud(folder / "a.las", {.origin = {{4'500'000, 4'500'000, 4'500'000}}});
  expect_three_points(cloud);
  const Cloud chosen = read_cloud(folder / "a.las");
  EXPECT_EQ(chosen.x[0] + chosen.origin[0], 4'500'001);
  EXPECT_EQ(chosen.z[2] + chosen.origin[2], 4'500'009.5);
  EXPECT_EQ(cloud.colour[1], (Rgb8{255, 0, 1}));
  EXPECT_THAT(read_cloud(folder / "a.las", {.temperature = "intensity"}).temperature, ElementsAre(100, 200, 300));
  EXPECT_EQ(read_cloud(folder / "a.las", {.position = "x,y,z"}).x, chosen.x);
  EXPECT_THAT(read_cloud(folder / "a.las", {.where = parse_condition("intensity > 100 and red == 65535")}).chosen,
              ElementsAre(0, 1, 1));
  EXPECT_THAT(read_cloud(folder / "a.las", {.where = parse_condition("z >= 4500009.5")}).chosen, ElementsAre(0, 0, 1));
  expect_error(ErrorKind::bad_input, "a.las: has no positions 'z,y,x', but x,y,z",
               [&] { read_cloud(folder / "a.las", {.position = "z,y,x"}); });
  expect_truncations_refused(las(3), "cut.las");
}

TEST(Las, RefusesCompressedAndDamagedFiles) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.las", las(3, 2 | 0x80));
  expect_error(ErrorKind::bad_input, "LAZ", [&] { read_cloud(folder / "a.las"); });
  write_whole_file(folder / "a.las", las(4'000'000'000));
  expect_error(ErrorKind::bad_input, "4000000000", [&] { read_cloud(folder / "a.las"); });
  write_whole_file(folder / "a.las", las(3, 31));
  expect_error(ErrorKind::bad_input, "format", [&] { read_cloud(folder / "a.las"); });
}

struct BinaryOptions {
  bool big = false;
  bool labelled = false;
  int files = 1;
  std::uint32_t total_gas = 2;
};

/// Two particles of gas and one of dark matter.
std::string gadget(const BinaryOptions& options) {
  Bytes header(options.big);
  const std::array<std::uint32_t, 6> count{2, 1, 0, 0, 0, 0};
  for (const std::uint32_t n : count) header.put(n);
  for (int type = 0; type < 6; ++type) header.put(type < 2 ? 0.5 : 0.);
  header.put(1.).put(0.25).put<std::int32_t>(0).put<std::int32_t>(0);
  for (std::size_t type = 0; type < 6; ++type)
    header.put(type == 0 ? options.total_gas : count[type] * static_cast<std::uint32_t>(options.files));
  header.put<std::int32_t>(0).put<std::int32_t>(options.files).put(1000.);
  header.put_text(std::string(256 - header.text.size(), '\0'));
  Bytes file(options.big);
  const auto block = [&](const std::string& label, const std::string& data) {
    if (options.labelled)
      file.put_record(Bytes(options.big).put_text(label).put(static_cast<std::uint32_t>(data.size() + 8)).text);
    file.put_record(data);
  };
  const auto floats = [&](std::initializer_list<float> values) {
    Bytes data(options.big);
    for (const float value : values) data.put(value);
    return data.text;
  };
  block("HEAD", header.text);
  block("POS ", floats({1, 2, 3, 4, 5, 6, 7, 8, 9.5f}));
  block("VEL ", floats({0, 0, 0, 0, 0, 0, 0, 0, 0}));
  block("ID  ", Bytes(options.big).put<std::uint32_t>(7).put<std::uint32_t>(4'000'000'000).put<std::uint32_t>(9).text);
  block("U   ", floats({100, 200}));
  block("RHO ", floats({10, 20}));
  block("HSML", floats({3, 4}));
  return file.text;
}

TEST(GadgetBinary, ReadsBothFormatsInBothByteOrders) {
  const TemporaryFolder folder;
  for (const bool big : {false, true})
    for (const bool labelled : {false, true}) {
      write_whole_file(folder / "snap", gadget({.big = big, .labelled = labelled}));
      const Cloud gas = read_cloud(folder / "snap");
      EXPECT_THAT(gas.x, ElementsAre(1, 4));
      EXPECT_THAT(gas.density, ElementsAre(10, 20));
      EXPECT_THAT(gas.smoothing_length, ElementsAre(3, 4));
      EXPECT_THAT(gas.temperature, ElementsAre(gas_temperature(100), gas_temperature(200)));
      EXPECT_EQ(gas.box_size, 1000);
      EXPECT_THAT(read_cloud(folder / "snap", {.where = parse_condition("ID == 4000000000 and rho > 10")}).chosen,
                  ElementsAre(0, 1));
      EXPECT_THAT(read_cloud(folder / "snap", {.where = parse_condition("POS-z < 4 or velocity-x > 0")}).chosen,
                  ElementsAre(1, 0));
      const Cloud dark = read_cloud(folder / "snap", {.type = "halo"});
      EXPECT_THAT(dark.z, ElementsAre(9.5f));
      EXPECT_THAT(read_cloud(folder / "snap", {.type = "halo", .where = parse_condition("id == 9")}).chosen,
                  ElementsAre(1));
      EXPECT_TRUE(dark.density.empty());
    }
}

/// What an entry of the record INFO says.
void put_info(Bytes& info, const std::string& name, const std::string& kind, std::int32_t width,
              std::array<std::int32_t, 6> types) {
  info.put_text(name).put_text(kind).put(width);
  for (const std::int32_t type : types) info.put(type);
}

TEST(GadgetBinary, FindsRecordsByName) {
  const TemporaryFolder folder;
  for (const bool big : {false, true}) {
    Bytes more(big);
    const auto block = [&](const std::string& label, const Bytes& data) {
      more.put_record(Bytes(big).put_text(label).put(static_cast<std::uint32_t>(data.text.size() + 8)).text);
      more.put_record(data.text);
    };
    block("ACCE", Bytes(big).put(1.f).put(2.f).put(2.f).put(0.f).put(3.f).put(4.f).put(5.f).put(0.f).put(0.f));
    block("AGE ", Bytes(big).put(13.f));                                    // by its length, of the dark matter
    block("NE  ", Bytes(big).put(1.f).put(0.f));                            // changes temperatures
    block("Z   ", Bytes(big).put(0.5).put(0.25).put(0.125));                // by INFO, of both, in double precision
    block("LEVL", Bytes(big).put<std::uint32_t>(6).put<std::uint32_t>(7));  // by INFO, whole numbers of the gas
    block("ODD ", Bytes(big).put<std::uint16_t>(6));
    Bytes info(big);
    put_info(info, "Z   ", "DOUBLE  ", 1, {1, 1, 0, 0, 0, 0});
    put_info(info, "POS ", "FLOAT   ", 1, {0, 0, 0, 0, 0, 0});  // which is not believed
    put_info(info, "LEVL", "LONG    ", 1, {1, 0, 0, 0, 0, 0});
    block("INFO", info);
    write_whole_file(folder / "snap", gadget({.big = big, .labelled = true}) + more.text);
    const auto shown = [&](const std::string& name, const std::string& type) {
      return read_cloud(folder / "snap", {.type = type, .quantity = name}).quantity;
    };
    EXPECT_THAT(shown("ACCE", "gas"), ElementsAre(3, 5));
    EXPECT_THAT(shown("acce-y", "gas"), ElementsAre(2, 3));
    EXPECT_THAT(shown("ACCE-x", "halo"), ElementsAre(5));
    EXPECT_THAT(shown("AGE", "halo"), ElementsAre(13));
    EXPECT_THAT(shown("Z", "halo"), ElementsAre(0.125f));
    EXPECT_THAT(shown("LEVL", "gas"), ElementsAre(6, 7));
    EXPECT_THAT(shown("velocity", "gas"), ElementsAre(0, 0));
    EXPECT_THAT(read_cloud(folder / "snap").temperature, ElementsAre(gas_temperature(100, 1), gas_temperature(200, 0)));
    const Cloud named = read_cloud(
        folder / "snap", {.density = "Z", .temperature = "rho", .mass = "U", .where = parse_condition("LEVL == 7")});
    EXPECT_THAT(named.density, ElementsAre(0.5f, 0.25f));
    EXPECT_THAT(named.temperature, ElementsAre(10, 20));
    EXPECT_THAT(named.mass, ElementsAre(100, 200));
    EXPECT_THAT(named.chosen, ElementsAre(0, 1));
    EXPECT_THAT(open_cloud(folder / "snap").fields,
                ElementsAre("POS", "VEL", "ID", "U", "RHO", "HSML", "ACCE", "AGE", "NE", "Z", "LEVL", "ODD"));
    expect_error(ErrorKind::bad_input, "snap: has no record 'SFR', but POS, VEL, ID, U", [&] { shown("SFR", "gas"); });
    expect_error(ErrorKind::bad_input, "record AGE has no numbers for particles of this type",
                 [&] { shown("AGE", "gas"); });
    expect_error(ErrorKind::bad_input, "record ODD has no numbers", [&] { shown("ODD", "gas"); });
    expect_error(ErrorKind::bad_input, "Z has 1 numbers per row, but component y", [&] { shown("Z-y", "gas"); });
    expect_error(ErrorKind::wrong_usage, "its record POS, but 'VEL' was requested",
                 [&] { read_cloud(folder / "snap", {.position = "VEL"}); });
  }
  write_whole_file(folder / "snap", gadget({}));
  expect_error(ErrorKind::wrong_usage, "of format 1 have no names, but 'RHO' was requested",
               [&] { read_cloud(folder / "snap", {.density = "RHO"}); });
}

TEST(GadgetBinary, CutShortAnywhereIsRefused) {
  for (const bool labelled : {false, true}) {
    const std::string bytes = gadget({.labelled = labelled});
    const TemporaryFolder folder;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      write_whole_file(folder / "cut", bytes.substr(0, length));
      // Without its last records a snapshot is a smaller one; what it has must be right.
      try {
        EXPECT_THAT(read_cloud(folder / "cut").x, ElementsAre(1, 4));
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_input) << error.what();
      }
    }
  }
}

TEST(GadgetBinary, JoinsPartsAndNamesTheMissingOne) {
  const TemporaryFolder folder;
  const std::string part = gadget({.files = 2, .total_gas = 4});
  write_whole_file(folder / "snap_1.0", part);
  expect_error(ErrorKind::bad_input, "snap_1.1: is missing", [&] { read_cloud(folder / "snap_1.0"); });
  write_whole_file(folder / "snap_1.1", part);
  EXPECT_THAT(read_cloud(folder / "snap_1.1").x, ElementsAre(1, 4, 1, 4));
  expect_error(ErrorKind::bad_input, "type 'stars'; by type it has 0: 2, 1: 1",
               [&] { read_cloud(folder / "snap_1.0", {.type = "stars"}); });
  write_whole_file(folder / "more", gadget({.total_gas = 99}));
  expect_error(ErrorKind::bad_input, "99 particles, but there are only 2", [&] { read_cloud(folder / "more"); });
}

TEST(TypesOfASnapshot, FollowEachOtherWithColoursAndWhatAllOfThemHave) {
  const TemporaryFolder folder;
  write_whole_file(folder / "snap", gadget({.labelled = true}));
  CloudChoice choice{.type_colours = {{"halo", {1, 2, 3}, 4}, {"0", {5, 6, 7}}}};
  const Cloud cloud = read_cloud(folder / "snap", choice);
  EXPECT_THAT(cloud.x, ElementsAre(7, 1, 4));
  EXPECT_THAT(cloud.colour, ElementsAre(Rgb8{1, 2, 3}, Rgb8{5, 6, 7}, Rgb8{5, 6, 7}));
  EXPECT_THAT(cloud.presence, ElementsAre(4, 1, 1));
  EXPECT_THAT(cloud.mass, ElementsAre(0.5f, 0.5f, 0.5f));
  EXPECT_TRUE(cloud.density.empty());
  EXPECT_TRUE(cloud.smoothing_length.empty());
  EXPECT_EQ(open_cloud(folder / "snap", choice).count, 3u);
  EXPECT_THAT(read_cloud(folder / "snap", {.type_colours = {{"gas", {}}}}).density, ElementsAre(10, 20));
  // Rows that are passed are the same as those that are read.
  const CloudSource source = open_cloud(folder / "snap", choice);
  EXPECT_EQ(source.skip(2), 1u);
  EXPECT_THAT(source.next(1).x, ElementsAre(1));
  EXPECT_THAT(source.next(5).x, ElementsAre(4));
  EXPECT_EQ(source.next(5).size(), 0u);
  choice.where = parse_condition("ID > 8");
  EXPECT_THAT(read_cloud(folder / "snap", choice).chosen, ElementsAre(1, 0, 1));
  // What only one type has is not a number for the others.
  choice.where = parse_condition("Density > 15");
  EXPECT_THAT(read_cloud(folder / "snap", choice).chosen, ElementsAre(0, 0, 1));
  choice.where = parse_condition("not (Density > 15)");
  EXPECT_THAT(read_cloud(folder / "snap", choice).chosen, ElementsAre(1, 1, 0));
  choice.where = parse_condition("ID > 0 and (Density != 10 or ID > 8)");
  EXPECT_THAT(read_cloud(folder / "snap", choice).chosen, ElementsAre(1, 0, 1));
  choice.where = parse_condition("metals > 8");
  expect_error(ErrorKind::bad_input, "no quantity 'metals', but POS, VEL",
               [&] { read_cloud(folder / "snap", choice); });
  expect_error(ErrorKind::bad_input, "for particles of type 'halo'", [&] { read_cloud(folder / "snap", choice); });
  expect_error(ErrorKind::bad_input, "no particles of type 'stars'", [&] {
    read_cloud(folder / "snap", {.type_colours = {{"gas", {}}, {"stars", {}}}});
  });
  expect_error(ErrorKind::wrong_usage, "type '0' has several colours", [&] {
    read_cloud(folder / "snap", {.type_colours = {{"gas", {}}, {"0", {}}}});
  });
  write_whole_file(folder / "points.txt", "1 2 3\n");
  expect_error(ErrorKind::wrong_usage, "expected a GADGET snapshot", [&] {
    read_cloud(folder / "points.txt", {.type_colours = {{"gas", {}}}});
  });
}

TEST(CloudSource, RefusesWhatIsNoFileOfParticles) {
  const TemporaryFolder folder;
  write_whole_file(folder / "empty", "");
  write_whole_file(folder / "noise", std::string("\x01\x02\x00\x03 noise", 10));
  expect_error(ErrorKind::bad_input, "empty", [&] { read_cloud(folder / "empty"); });
  expect_error(ErrorKind::bad_input, "no known format", [&] { read_cloud(folder / "noise"); });
  expect_error(ErrorKind::bad_input, "missing", [&] { read_cloud(folder / "missing"); });
  expect_error(ErrorKind::bad_input, "is a folder", [&] { read_cloud(folder / "."); });
}

TEST(CloudSource, ReadsARealSnapshot) {
  const std::filesystem::path path = shared_data() / "particles/gadget4_lcdm_gas_z0.hdf5";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no snapshot in shared/data";
  const Cloud gas = read_cloud(path);
  EXPECT_EQ(gas.size(), 32768u);
  EXPECT_EQ(gas.box_size, 50000);
  EXPECT_GT(std::ranges::min(gas.temperature), 1.f);
  EXPECT_LT(std::ranges::max(gas.temperature), 1e9f);
  const Cloud dark = read_cloud(path, {.type = "halo"});
  EXPECT_EQ(dark.size(), 32768u);
  EXPECT_TRUE(dark.density.empty());
}

}  // namespace wheatstone::formats_test
