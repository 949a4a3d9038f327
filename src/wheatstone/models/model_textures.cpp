#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <map>
#include <optional>

#include "wheatstone/error.h"
#include "wheatstone/models/assemble_model_internal.h"
#include "wheatstone/models/model_folder_internal.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone {
namespace {

/// A picture's file that the model itself holds, as a file without a name.
class HeldFile {
 public:
  explicit HeldFile(const std::string& bytes) : file_(::memfd_create("texture", MFD_CLOEXEC)) {
    for (std::size_t at = 0; file_ >= 0 && at < bytes.size();) {
      const ssize_t written = ::write(file_, bytes.data() + at, bytes.size() - at);
      if (written <= 0) throw Error(ErrorKind::cannot_read_write, "a texture cannot be kept in memory");
      at += static_cast<std::size_t>(written);
    }
  }
  HeldFile(const HeldFile&) = delete;
  HeldFile& operator=(const HeldFile&) = delete;
  ~HeldFile() {
    if (file_ >= 0) ::close(file_);
  }
  std::string name() const { return fmt::format("/proc/self/fd/{}", file_); }

 private:
  int file_;
};

Image<Rgb8> read_held(const RawMaterial& material, const std::filesystem::path& path) {
  const HeldFile file(material.texture_bytes);
  try {
    return read_image(file.name());
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::interrupted) throw;
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: the texture of its material '{}' is damaged", path.string(), material.name));
  }
}

Image<Rgb8> read_beside(const RawMaterial& material, const std::filesystem::path& path) {
  const std::optional<std::filesystem::path> file = file_beside_model(path, material.texture);
  if (!file)
    throw Error(ErrorKind::bad_input, fmt::format("{}: its texture '{}' is missing, expected in the model's folder",
                                                  path.string(), material.texture));
  return read_image(*file);
}

}  // namespace

void read_textures(const RawModel& raw, const std::filesystem::path& path, const ModelChoice& choice, Model& model) {
  if (!choice.texture.empty()) {
    if (model.texture_places.empty())
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: has no places in a texture, expected a model with them for '{}'", path.string(),
                              choice.texture.string()));
    model.textures.push_back(read_image(choice.texture));
    for (ModelMaterial& material : model.materials) {
      material.texture = 0;
      material.colour = {1, 1, 1};
    }
    return;
  }
  if (!choice.textures || model.texture_places.empty()) return;
  std::vector<bool> is_used(model.materials.size());
  for (const std::uint32_t material : model.material_of) is_used[material] = true;
  std::map<std::string, int> known;
  for (std::size_t m = 0; m < raw.materials.size(); ++m) {
    const RawMaterial& material = raw.materials[m];
    if (material.texture.empty() || !is_used[m]) continue;
    const auto [entry, is_new] = known.try_emplace(material.texture, static_cast<int>(model.textures.size()));
    if (is_new)
      model.textures.push_back(material.texture_bytes.empty() ? read_beside(material, path)
                                                              : read_held(material, path));
    model.materials[m].texture = entry->second;
  }
}

}  // namespace wheatstone
