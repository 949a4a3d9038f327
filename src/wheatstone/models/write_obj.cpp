#include "wheatstone/models/write_obj.h"

#include <fmt/format.h>

#include <iterator>
#include <string>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

std::string texture_name(const std::filesystem::path& path, int texture) {
  return fmt::format("{}_{}.png", path.stem().string(), texture);
}

std::string materials_of(const std::filesystem::path& path, const Model& model) {
  std::string text;
  for (const ModelMaterial& material : model.materials) {
    const auto code = [&](std::size_t c) { return srgb_from_linear(material.colour[c]) / 255.; };
    fmt::format_to(std::back_inserter(text), "newmtl {}\nKd {:.5f} {:.5f} {:.5f}\n", material.name, code(0), code(1),
                   code(2));
    if (material.texture >= 0)
      fmt::format_to(std::back_inserter(text), "map_Kd {}\n", texture_name(path, material.texture));
  }
  return text;
}

std::string geometry_of(const std::filesystem::path& path, const Model& model) {
  std::string text = fmt::format("mtllib {}.mtl\n", path.stem().string());
  const auto out = std::back_inserter(text);
  for (std::size_t v = 0; v < model.positions.size(); ++v) {
    const auto& [x, y, z] = model.positions[v];
    fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}", y, z, x);
    if (!model.colours.empty()) {
      const Rgb8 colour = model.colours[v];
      fmt::format_to(out, " {:.5f} {:.5f} {:.5f}", colour.r / 255., colour.g / 255., colour.b / 255.);
    }
    text += '\n';
  }
  for (const auto& [x, y, z] : model.normals) fmt::format_to(out, "vn {:.6g} {:.6g} {:.6g}\n", y, z, x);
  for (const auto& [u, v] : model.texture_places) fmt::format_to(out, "vt {:.7g} {:.7g}\n", u, v);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    if (t == 0 || model.material_of[t] != model.material_of[t - 1])
      fmt::format_to(out, "usemtl {}\n", model.materials[model.material_of[t]].name);
    text += 'f';
    for (const std::uint32_t vertex : model.triangles[t]) {
      const std::size_t number = std::size_t{vertex} + 1;
      if (model.texture_places.empty())
        fmt::format_to(out, " {0}//{0}", number);
      else
        fmt::format_to(out, " {0}/{0}/{0}", number);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

void write_obj(const std::filesystem::path& path, const Model& model) {
  if (path.extension() != ".obj" || path.stem().string().find_first_of(" \t\"'") != std::string::npos)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: cannot be written, expected a name without blanks that ends in .obj", path.string()));
  const std::filesystem::path folder = path.parent_path();
  for (std::size_t t = 0; t < model.textures.size(); ++t)
    write_image(folder / texture_name(path, static_cast<int>(t)), model.textures[t]);
  write_whole_file(std::filesystem::path(path).replace_extension(".mtl"), materials_of(path, model));
  write_whole_file(path, geometry_of(path, model));
}

}  // namespace wheatstone
