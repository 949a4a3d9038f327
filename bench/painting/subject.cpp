#include "painting/subject.h"

#include <fmt/format.h>

#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::bench {

std::optional<Subject> read_subject(const std::filesystem::path& folder, std::optional<float> scale) {
  if (!std::filesystem::exists(folder)) {
    fmt::print("\n{}: not here, left out\n", folder.filename().string());
    return {};
  }
  return Subject{folder.filename().string(),
                 {read_image(folder / "left.png"), read_image(folder / "right.png")},
                 read_disparity(folder / "disp_left.png", scale)};
}

}  // namespace wheatstone::bench
