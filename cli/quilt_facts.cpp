#include "quilt_facts.h"

#include <fmt/format.h>

#include "wheatstone/display/quilt.h"

namespace wheatstone::cli {

bool put_quilt(nlohmann::ordered_json& facts, const std::filesystem::path& path, int width, int height) {
  const std::optional<NamedQuilt> quilt = quilt_of_name(path.filename().string());
  if (!quilt) return false;
  const auto [columns, rows] = quilt->layout;
  facts["quilt"] = fmt::format("{}x{}", columns, rows);
  facts["views"] = columns * rows;
  facts["view_width"] = width / columns;
  facts["view_height"] = height / rows;
  facts["view_aspect"] = quilt->aspect;
  return true;
}

}  // namespace wheatstone::cli
