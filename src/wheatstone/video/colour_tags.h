#pragma once

#include <string>

namespace wheatstone {

/// How a film says its colours are coded, in libav's names ("bt709", "smpte170m", "bt2020nc", "gbr"; "tv", "pc");
/// empty where it does not say.
struct ColourTags {
  std::string matrix;
  std::string range;
  std::string primaries;
  std::string transfer;
  friend bool operator==(const ColourTags&, const ColourTags&) = default;
};

}  // namespace wheatstone
