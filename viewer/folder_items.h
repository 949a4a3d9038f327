#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "session.h"
#include "wheatstone/image/image.h"

namespace wheatstone::viewer {

/// Whether people sort one name before another: 2 comes before 10, and capitals do not count.
bool comes_before(std::string_view name, std::string_view other);

/// The photographs and paintings in a folder, in the order in which people sort their names. Two pictures that are
/// named as the eyes of one are one item; depth maps beside their picture, and hidden files, are left out. Throws
/// Error{cannot_read_write} that names the folder.
std::vector<Item> items_in(const std::filesystem::path& folder);

/// The same for the folder in which an item's file lies, with paths as the item has them; none where it cannot be read.
std::vector<Item> items_beside(const Item& item);

/// Where an item is among others, from 0: the one that has its first file. None where there is no such.
std::optional<std::size_t> place_among(std::span<const Item> items, const Item& item);

/// Whether a folder is opened as a film: it has numbered frames, two at least, and no photographs.
bool holds_film(const std::filesystem::path& folder);

/// A small picture of what files hold: the left eye's. Empty where they hold none that is quickly made: particles,
/// films, and what cannot be read. Reads files: not for the window's thread.
Image<Rgb8> thumbnail_of(const Item& files, PictureSize largest);

}  // namespace wheatstone::viewer
