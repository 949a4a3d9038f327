#pragma once

#include <filesystem>
#include <string_view>

namespace wheatstone {

struct ModelFormat {
  std::string_view name;        ///< for people
  std::string_view ending;      ///< by which the importer knows it
  bool y_up = false;            ///< by convention; z is up otherwise
  bool linear_colours = false;  ///< colours of corners and materials are linear light, not sRGB
};

/// The format of a file by its content, or else by its name; null where it is no model.
const ModelFormat* format_of_model(const std::filesystem::path& path);

/// Throws Error{bad_input} where the header of a PLY file tells of more elements than the file has bytes: the importer
/// would count them all.
void check_ply_counts(const std::filesystem::path& path);

}  // namespace wheatstone
