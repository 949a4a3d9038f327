#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/marks/surfaces.h"
#include "wheatstone/share/page.h"

namespace wheatstone {

using Json = nlohmann::ordered_json;

inline constexpr int still_quality = 60;  ///< of the still picture as a JPEG file

/// Surfaces as parts, and what is told of them.
Json add_surfaces(const Surfaces& surfaces, std::vector<PagePart>& parts);

/// A picture for each surface, of its size, as parts.
void add_pictures(std::span<const Image<Rgb8>> pictures, const Surfaces& surfaces, std::vector<PagePart>& parts);

/// Facts as a page holds them. What is no UTF-8 in names is replaced.
std::string text_of(const Json& facts);

}  // namespace wheatstone
