#include "wheatstone/models/read_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/error.h"
#include "wheatstone/models/import_in_child_internal.h"
#include "wheatstone/models/write_obj.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_models.h"

namespace wheatstone::read_model_test {

template <class Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

const std::string triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A binary STL file of one triangle, whose header says that it has so many.
std::string stl(std::uint32_t said, float corner = 1) {
  std::string bytes(80, ' ');
  append(bytes, said);
  for (const float number : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, corner, 0.f, 0.f, 0.f, 1.f, 0.f}) append(bytes, number);
  append(bytes, std::uint16_t{0});
  return bytes;
}

std::string ply(const std::string& vertices, const std::string& faces, int vertex_count, long face_count) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty "
         "uchar blue\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

/// A glTF 2 file in one piece: a triangle with colours, moved by 10 along y, of a green material.
std::string glb(const std::string& texture = "") {
  std::string data;
  for (const float number : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(data, number);  // 36 bytes
  for (const float number : {0.f, 0.f, 1.f, 0.f, 0.f, 1.f}) append(data, number);                 // 24 bytes
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[0,10,0]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],)"
      R"("materials":[{"name":"leaf","pbrMetallicRoughness":{"baseColorFactor":[0,0.5,0,1])" +
      (texture.empty() ? std::string() : R"(,"baseColorTexture":{"index":0})") + R"(}}],)" +
      (texture.empty() ? std::string() : R"("textures":[{"source":0}],"images":[{"uri":")" + texture + R"("}],)") +
      R"("buffers":[{"byteLength":60}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
      R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}]})";
  while (json.size() % 4 != 0) json += ' ';
  std::string file = "glTF";
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size()));
  append(file, static_cast<std::uint32_t>(json.size()));
  file += "JSON" + json;
  append(file, static_cast<std::uint32_t>(data.size()));
  file += std::string("BIN\0", 4) + data;
  return file;
}

class ReadModelTest : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& bytes) const {
    put_bytes(folder_ / name, bytes);
    return folder_ / name;
  }
  void expect_refused(const std::string& name, const std::string& bytes, const std::string& part) const {
    const std::filesystem::path path = file(name, bytes);
    expect_error(ErrorKind::bad_input, part, [&] { read_model(path); });
    expect_error(ErrorKind::bad_input, name, [&] { read_model(path); });
  }
  TemporaryFolder folder_;
};

TEST_F(ReadModelTest, ObjIsTurnedSoThatItsUpIsUp) {
  const ReadModel read = read_model(file("a.obj", "v 0 0 0\nv 0 2 0\nv 0 0 3\nv 0 2 3\nf 1 2 4 3\n"));
  EXPECT_EQ(read.format, "OBJ");
  EXPECT_EQ(read.model.triangles.size(), 2u);
  EXPECT_FALSE(read.has_normals);
  const ModelBounds bounds = bounds_of(read.model);
  EXPECT_EQ(bounds.size(), (std::array<double, 3>{3, 0, 2}));  // z, x, y of the file
  for (const auto& normal : read.model.normals) EXPECT_NEAR(std::abs(normal[1]), 1, 1e-6);
  const ReadModel as_it_is = read_model(folder_ / "a.obj", {.up = UpAxis::z});
  EXPECT_EQ(bounds_of(as_it_is.model).size(), (std::array<double, 3>{0, 2, 3}));
}

TEST_F(ReadModelTest, TellsFormatsByTheirContent) {
  const std::string green = "0 0 0 0 255 0\n1 0 0 0 255 0\n0 1 0 0 255 0\n";
  EXPECT_TRUE(holds_model(file("a", triangle_obj)));
  EXPECT_TRUE(holds_model(file("b", stl(1))));
  EXPECT_TRUE(holds_model(file("c", glb())));
  EXPECT_TRUE(holds_model(file("d", ply(green, "3 0 1 2\n", 3, 1))));
  EXPECT_FALSE(holds_model(file("points.ply", ply(green, "", 3, 0))));
  EXPECT_FALSE(holds_model(file("table.txt", "x y z\n1 2 3\n")));
  EXPECT_FALSE(holds_model(folder_ / "missing"));
  EXPECT_EQ(read_model(folder_ / "b").format, "STL");
  const ReadModel read = read_model(folder_ / "d");
  EXPECT_EQ(read.format, "PLY");
  EXPECT_EQ(read.model.colours.front(), (Rgb8{0, 255, 0}));
}

TEST_F(ReadModelTest, GltfHasItsNodesMaterialsAndTextures) {
  const ReadModel read = read_model(file("a.glb", glb()));
  EXPECT_EQ(read.format, "glTF");
  ASSERT_EQ(read.model.triangles.size(), 1u);
  EXPECT_EQ(bounds_of(read.model).least[2], 10);
  const ModelMaterial& material = read.model.materials[read.model.material_of[0]];
  EXPECT_EQ(material.name, "leaf");
  EXPECT_FLOAT_EQ(material.colour[1], 0.5f);
  EXPECT_EQ(material.texture, -1);

  write_image(folder_ / "leaf.png", Image<Rgb8>(4, 2, {1, 2, 3}));
  const ReadModel textured = read_model(file("b.glb", glb("leaf.png")));
  ASSERT_EQ(textured.model.textures.size(), 1u);
  EXPECT_EQ(textured.model.textures[0].width(), 4);
  EXPECT_EQ(textured.model.materials[textured.model.material_of[0]].texture, 0);
  // The lower left corner of the picture is 0, 0.
  EXPECT_EQ(textured.model.texture_places[0], (std::array<float, 2>{0, 1}));
}

TEST_F(ReadModelTest, TextureMustBeInTheModelsFolder) {
  expect_refused("missing.glb", glb("nowhere.png"), "its texture 'nowhere.png' is missing");
  EXPECT_TRUE(read_model(folder_ / "missing.glb", {.textures = false}).model.textures.empty());
  std::filesystem::create_directory(folder_ / "inner");
  write_image(folder_ / "leaf.png", Image<Rgb8>(4, 2, {1, 2, 3}));
  expect_refused("inner/up.glb", glb("../leaf.png"), "its texture '../leaf.png' is missing");
  const std::string absolute = (folder_ / "leaf.png").string();
  expect_refused("inner/absolute.glb", glb(absolute), "is missing");
  std::filesystem::create_symlink(folder_ / "leaf.png", folder_ / "inner/link.png");
  expect_refused("inner/link.glb", glb("link.png"), "is missing");
}

TEST_F(ReadModelTest, ATextureCanBeGiven) {
  write_image(folder_ / "leaf.png", Image<Rgb8>(4, 2, {1, 2, 3}));
  const ReadModel read = read_model(file("a.glb", glb()), {.texture = folder_ / "leaf.png"});
  EXPECT_EQ(read.model.textures.size(), 1u);
  EXPECT_EQ(read.model.materials[0].texture, 0);
  const std::filesystem::path plain = file("plain.obj", triangle_obj);
  expect_error(ErrorKind::wrong_usage, "has no places in a texture",
               [&] { read_model(plain, {.texture = folder_ / "leaf.png"}); });
}

TEST_F(ReadModelTest, CoordinatesFarFromTheOriginKeepTheirMillimetres) {
  const std::string text =
      "v 4500000.001 100 5400000\nv 4500000.002 100 5400000\nv 4500000.001 100.003 5400000.5\nf 1 2 3\n";
  const ReadModel read = read_model(file("a.obj", text), {.up = UpAxis::z});
  const ModelBounds bounds = bounds_of(read.model);
  EXPECT_NEAR(bounds.least[0], 4500000.001, 1e-6);
  EXPECT_NEAR(bounds.size()[0], 0.001, 1e-6);
  EXPECT_NEAR(bounds.size()[1], 0.003, 1e-6);
}

/// A PLY file of one triangle far from the origin, whose vertices have their colour before their coordinates.
std::string far_ply(const std::string& format) {
  std::string bytes = "ply\nformat " + format +
                      " 1.0\nelement vertex 3\nproperty uchar red\nproperty double x\nproperty double y\nproperty "
                      "double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  if (format == "ascii")
    return bytes + "9 4500000.001 100 5400000\n9 4500000.002 100 5400000\n9 4500000.001 100.003 5400000.5\n3 0 1 2\n";
  const bool is_swapped = format == "binary_big_endian";
  const auto put = [&](auto number) {
    std::string of_number;
    append(of_number, number);
    if (is_swapped) std::ranges::reverse(of_number);
    bytes += of_number;
  };
  for (const std::array<double, 3>& at :
       {std::array{4500000.001, 100., 5400000.}, std::array{4500000.002, 100., 5400000.},
        std::array{4500000.001, 100.003, 5400000.5}}) {
    put(std::uint8_t{9});
    for (const double coordinate : at) put(coordinate);
  }
  put(std::uint8_t{3});
  for (const std::int32_t vertex : {0, 1, 2}) put(vertex);
  return bytes;
}

TEST_F(ReadModelTest, PlyCoordinatesFarFromTheOriginKeepTheirMillimetres) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const ModelBounds bounds = bounds_of(read_model(file("a.ply", far_ply(format))).model);
    EXPECT_NEAR(bounds.least[0], 4500000.001, 1e-6) << format;
    EXPECT_NEAR(bounds.size()[0], 0.001, 1e-6) << format;
    EXPECT_NEAR(bounds.size()[1], 0.003, 1e-6) << format;
    EXPECT_NEAR(bounds.least[2], 5400000, 1e-6) << format;
  }
  std::string damaged = far_ply("ascii");
  damaged.replace(damaged.find("4500000.002"), 11, "nan");
  expect_refused("nan.ply", damaged, "nan");
  const std::string binary = far_ply("binary_little_endian");
  expect_refused("cut.ply", binary.substr(0, binary.size() - 40), "cut.ply");
}

TEST_F(ReadModelTest, DegenerateTrianglesAreLeftOutAndCounted) {
  const ReadModel read = read_model(file("a.obj", triangle_obj + "v 2 0 0\nf 1 1 2\nf 1 2 4\n"));
  EXPECT_EQ(read.model.triangles.size(), 1u);
  EXPECT_EQ(read.degenerate, 2u);
  expect_refused("b.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "only triangles without an area");
}

TEST_F(ReadModelTest, BadFilesAreRefusedInOneLine) {
  expect_refused("empty.obj", "", "empty");
  expect_refused("nothing.obj", "# nothing\n", "nothing.obj");
  expect_refused("points.obj", "v 0 0 0\nv 1 0 0\n", "points.obj");
  expect_refused("cut.glb", glb().substr(0, 200), "cannot be read as glb");
  expect_refused("few.stl", stl(1).substr(0, 100), "few.stl");
  expect_refused("text.glb", "hello", "text.glb");
  expect_refused("nan.stl", stl(1, std::numeric_limits<float>::quiet_NaN()), "nan");
  expect_refused("huge.stl", stl(1, 3e38f), "expected a number from -1e18 to 1e18");
  expect_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2147483648\n", "index.obj");
  expect_refused("index.ply", ply("0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n", "3 0 1 2147483647\n", 3, 1), "index.ply");
  // The importer would look for the end of the header as long as it is let.
  const std::string begun = ply("0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n", "3 0 1 2\n", 3, 1);
  for (const char* instead : {"", "end_headers\n", "comment end_header\n"}) {
    std::string unended = begun;
    unended.replace(unended.find("end_header\n"), std::strlen("end_header\n"), instead);
    expect_refused("unended.ply", unended, "no model");
    expect_refused("unended.glb", unended, "cannot be read as glb");
  }
  expect_error(ErrorKind::bad_input, "missing.obj", [&] { read_model(folder_ / "missing.obj"); });
  expect_error(ErrorKind::bad_input, "no model", [&] { read_model(file("table.txt", "1 2 3\n")); });
}

TEST_F(ReadModelTest, AbsurdCountsTakeNoMemoryOfThisProcess) {
  const std::string three = "0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n";
  expect_refused("faces.ply", ply(three, "3 0 1 2\n", 3, 2147483647), "2147483647 elements 'face'");
  expect_refused("vertices.ply", ply(three, "3 0 1 2\n", 2147483647, 1), "2147483647 elements 'vertex'");
  std::string of_nothing = ply(three, "3 0 1 2\n", 3, 1);
  of_nothing.insert(of_nothing.find("end_header"), "element nothing 2147483647\n");
  expect_refused("nothing.ply", of_nothing, "2147483647 elements 'nothing'");
  of_nothing.replace(of_nothing.find("2147483647"), 10, "100000000000000000001");
  expect_refused("more.ply", of_nothing, "elements 'nothing'");
}

TEST_F(ReadModelTest, LimitsOfTheChildHold) {
  const std::filesystem::path path = file("a.obj", triangle_obj);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they wait for memory in a child
  expect_error(ErrorKind::bad_input, "of memory",
               [&] { import_in_child(path, "obj", {.memory_bytes = 1 << 20, .seconds = 60}, {}); });
#endif
  EXPECT_EQ(import_in_child(path, "obj", {}, {}).meshes.size(), 1u);
}

TEST_F(ReadModelTest, WhatIsWrittenIsReadAgain) {
  for (const Model& model : {make_knot(1000), make_city(1000)}) {
    write_obj(folder_ / "model.obj", model);
    const ReadModel read = read_model(folder_ / "model.obj");
    EXPECT_EQ(read.model.triangles.size(), model.triangles.size());
    EXPECT_TRUE(read.has_normals);
    EXPECT_EQ(read.model.textures, model.textures);
    EXPECT_EQ(read.model.colours.empty(), model.colours.empty());
    const ModelBounds bounds = bounds_of(read.model), written = bounds_of(model);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(bounds.size()[axis], written.size()[axis], 1e-5);
  }
  expect_error(ErrorKind::wrong_usage, "ends in .obj", [&] { write_obj(folder_ / "model.glb", make_knot(1000)); });
}

TEST_F(ReadModelTest, CanBeInterrupted) {
  const std::filesystem::path path = file("a.obj", triangle_obj);
  expect_error(ErrorKind::interrupted, "stop", [&] {
    read_model(path, {}, [](std::string_view, double) { throw Error(ErrorKind::interrupted, "stop"); });
  });
}

}  // namespace wheatstone::read_model_test
