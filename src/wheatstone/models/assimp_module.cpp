#include <assimp/BaseImporter.h>
#include <assimp/GltfMaterial.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <utility>

#include "wheatstone/models/model_folder_internal.h"
#include "wheatstone/models/moved_vertices_internal.h"
#include "wheatstone/models/raw_model_internal.h"

namespace wheatstone {
namespace {

/// A file in memory.
class ReadBytes : public Assimp::IOStream {
 public:
  explicit ReadBytes(std::string bytes) : bytes_(std::move(bytes)) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t read = std::min(count, (bytes_.size() - at_) / size);
    if (read > 0) std::memcpy(to, bytes_.data() + at_, read * size);
    at_ += read * size;
    return read;
  }
  std::size_t Write(const void* /*from*/, std::size_t /*size*/, std::size_t /*count*/) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    if (offset > bytes_.size() - from) return aiReturn_FAILURE;
    at_ = from + offset;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Gives the importer the model under a name by which it knows the format, and files in the model's folder.
class ModelFolder : public Assimp::IOSystem {
 public:
  ModelFolder(std::string file, std::string shown_as, std::string bytes, std::vector<std::string>& missing)
      : file_(std::move(file)), shown_as_(std::move(shown_as)), bytes_(std::move(bytes)), missing_(missing) {}

  bool Exists(const char* name) const override { return name == shown_as_ || file_beside_model(file_, name); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (std::strchr(mode, 'w') != nullptr) return nullptr;
    if (name == shown_as_) return std::make_unique<ReadBytes>(bytes_).release();
    const std::optional<std::filesystem::path> beside = file_beside_model(file_, name);
    if (beside) return std::make_unique<ReadBytes>(bytes_of(*beside)).release();
    if (std::ranges::find(missing_, name) == missing_.end()) missing_.emplace_back(name);
    return nullptr;
  }
  void Close(Assimp::IOStream* stream) override { std::unique_ptr<Assimp::IOStream>(stream).reset(); }

 private:
  std::string file_, shown_as_, bytes_;
  std::vector<std::string>& missing_;
};

/// Of a node, in double precision: rows of a matrix that places its meshes in the scene.
using Placing = std::array<std::array<double, 4>, 3>;

Placing placed_in(const Placing& outer, const aiMatrix4x4& inner) {
  Placing placing{};
  for (unsigned row = 0; row < 3; ++row)
    for (unsigned column = 0; column < 4; ++column) {
      double sum = column == 3 ? outer[row][3] : 0;
      for (unsigned k = 0; k < 3; ++k) sum += outer[row][k] * static_cast<double>(inner[k][column]);
      placing[row][column] = sum;
    }
  return placing;
}

std::array<double, 3> placed(const Placing& placing, const aiVector3D& v, double one) {
  std::array<double, 3> to{};
  for (std::size_t row = 0; row < 3; ++row)
    to[row] = placing[row][0] * static_cast<double>(v.x) + placing[row][1] * static_cast<double>(v.y) +
              placing[row][2] * static_cast<double>(v.z) + placing[row][3] * one;
  return to;
}

/// A direction that is at right angles to a placed surface: by the matrix of cofactors.
std::array<float, 3> placed_normal(const Placing& m, const aiVector3D& n) {
  std::array<double, 3> to{};
  const std::array<double, 3> from{static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)};
  for (std::size_t row = 0; row < 3; ++row) {
    const std::size_t r1 = (row + 1) % 3, r2 = (row + 2) % 3;
    for (std::size_t column = 0; column < 3; ++column) {
      const std::size_t c1 = (column + 1) % 3, c2 = (column + 2) % 3;
      to[row] += (m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]) * from[column];
    }
  }
  return {static_cast<float>(to[0]), static_cast<float>(to[1]), static_cast<float>(to[2])};
}

void add_mesh(const aiMesh& mesh, const Placing& placing, const std::array<double, 3>& moved_by, RawModel& model) {
  RawMesh& raw = model.meshes.emplace_back();
  raw.material = mesh.mMaterialIndex;
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    std::array<double, 3> position = placed(placing, mesh.mVertices[v], 1);
    for (std::size_t axis = 0; axis < 3; ++axis) position[axis] += moved_by[axis];
    raw.positions.push_back(position);
    if (mesh.HasNormals()) raw.normals.push_back(placed_normal(placing, mesh.mNormals[v]));
    if (mesh.HasTextureCoords(0))
      raw.texture_places.push_back({mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y});
    if (mesh.HasVertexColors(0)) {
      const aiColor4D& colour = mesh.mColors[0][v];
      raw.colours.push_back({colour.r, colour.g, colour.b});
    }
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices == 3) raw.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
}

void add_node(const aiScene& scene, const aiNode& node, const Placing& outer, const std::array<double, 3>& moved_by,
              RawModel& model) {
  const Placing placing = placed_in(outer, node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    if (node.mMeshes[i] < scene.mNumMeshes) add_mesh(*scene.mMeshes[node.mMeshes[i]], placing, moved_by, model);
  for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(scene, *node.mChildren[i], placing, moved_by, model);
}

RawMaterial raw_material(const aiScene& scene, const aiMaterial& material) {
  RawMaterial raw;
  raw.name = material.GetName().C_Str();
  aiColor4D colour;
  if (material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS)
    raw.colour = {colour.r, colour.g, colour.b};
  aiString name;
  if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != aiReturn_SUCCESS &&
      material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS)
    return raw;
  raw.texture = name.C_Str();
  const aiTexture* held = scene.GetEmbeddedTexture(name.C_Str());
  if (held != nullptr && held->mHeight == 0)
    raw.texture_bytes.assign(reinterpret_cast<const char*>(held->pcData), held->mWidth);
  return raw;
}

bool reads(const aiImporterDesc* reader, const std::string& format) {
  if (reader == nullptr) return false;
  std::istringstream endings(reader->mFileExtensions);
  return std::find(std::istream_iterator<std::string>(endings), {}, format) != std::istream_iterator<std::string>();
}

/// Where the content is not what the name says, the library would try its other readers, of some seventy formats.
void keep_readers_of(const std::string& format, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (reads(importer.GetImporterInfo(i), format)) continue;
    const std::unique_ptr<Assimp::BaseImporter> left_out(importer.GetImporter(i));
    importer.UnregisterLoader(left_out.get());
  }
}

void import_model(const std::string& file, const std::string& format, RawModel& model) {
  std::string bytes = bytes_of(file);
  std::array<double, 3> moved_by{};
  if (format == "obj") moved_by = move_obj_to_origin(bytes);
  if (format == "ply") moved_by = move_ply_to_origin(bytes);
  const std::string shown_as = "model." + format;
  Assimp::Importer importer;
  keep_readers_of(format, importer);
  importer.SetIOHandler(
      std::make_unique<ModelFolder>(file, shown_as, std::move(bytes), model.missing).release());  // it owns it
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene =
      importer.ReadFile(shown_as, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    model.complaint = importer.GetErrorString();
    if (model.complaint.empty()) model.complaint = "it has no scene";
    return;
  }
  constexpr Placing as_it_is{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  add_node(*scene, *scene->mRootNode, as_it_is, moved_by, model);
  for (unsigned m = 0; m < scene->mNumMaterials; ++m)
    model.materials.push_back(raw_material(*scene, *scene->mMaterials[m]));
}

}  // namespace
}  // namespace wheatstone

extern "C" void wheatstone_import_model(const std::string& file, const std::string& format,
                                        wheatstone::RawModel& model) {
  wheatstone::import_model(file, format, model);
}
