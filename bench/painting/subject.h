#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone::bench {

/// A pair of photographs whose disparity is known.
struct Subject {
  std::string name;
  StereoPair photographs;
  Image<float> left_disparity;
};

/// The pair in a folder of the shared data, whose disparities are stored times `scale`. Nothing where it is not here,
/// which is printed.
std::optional<Subject> read_subject(const std::filesystem::path& folder, std::optional<float> scale);

}  // namespace wheatstone::bench
