#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/display/quilt.h"
#include "wheatstone/marks/surfaces.h"
#include "wheatstone/share/page.h"

namespace wheatstone {

using Json = nlohmann::ordered_json;

/// The still picture of a page as a JPEG file, of about 60 kB at most: it stands there until there is something better.
std::string still_of(ImageView<const Rgb8> picture);

/// Surfaces as parts, and what is told of them.
Json add_surfaces(const Surfaces& surfaces, std::vector<PagePart>& parts);

/// A picture for each surface, of its size, as parts.
void add_pictures(std::span<const Image<Rgb8>> pictures, const Surfaces& surfaces, std::vector<PagePart>& parts);

/// Facts as a page holds them. What is no UTF-8 in names is replaced.
std::string text_of(const Json& facts);

/// What every page of views from the left eye to the right one says of them; they lie as in a quilt.
Json facts_of_views(const std::string& title, int width, int height, const QuiltLayout& places);

}  // namespace wheatstone
