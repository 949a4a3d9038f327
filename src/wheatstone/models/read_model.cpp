#include "wheatstone/models/read_model.h"

#include <fmt/format.h>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/models/assemble_model_internal.h"
#include "wheatstone/models/import_in_child_internal.h"
#include "wheatstone/models/model_format_internal.h"

namespace wheatstone {

ReadModel read_model(const std::filesystem::path& path, const ModelChoice& choice, const Progress& progress) {
  check_number("crease", choice.crease_deg, crease_range_deg);
  check_plain_file(path, "a model");
  const ModelFormat* const format = format_of_model(path);
  if (format == nullptr)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is no model, expected OBJ, PLY with faces, STL or glTF 2", path.string()));
  if (format->ending == std::string_view("ply")) check_ply_counts(path);
  ReadModel read;
  read.format = format->name;
  read.bytes = std::filesystem::file_size(path);
  const RawModel raw = import_in_child(path, std::string(format->ending), import_limits(read.bytes), progress);
  assemble_model(raw, *format, path, choice, read);
  read_textures(raw, path, choice, read.model);
  for (const std::string& name : raw.missing)
    read.warnings.push_back(fmt::format("'{}', which the model names, is not in its folder", name));
  return read;
}

}  // namespace wheatstone
