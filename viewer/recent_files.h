#pragma once

#include <span>
#include <vector>

#include "session.h"

namespace wheatstone::viewer {

/// What was opened last, the newest first: what a session has opened, and what earlier ones had. Nothing twice, and at
/// most ten. Paths are made absolute, because the next session may begin in another folder.
std::vector<Item> recent_items(std::span<const Item> opened, std::span<const Item> before);

}  // namespace wheatstone::viewer
