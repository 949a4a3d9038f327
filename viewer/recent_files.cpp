#include "recent_files.h"

#include <algorithm>

namespace wheatstone::viewer {

std::vector<Item> recent_items(std::span<const Item> opened, std::span<const Item> before) {
  constexpr std::size_t most = 10;
  std::vector<Item> recent;
  const auto add = [&](Item item) {
    for (std::filesystem::path& file : item) file = std::filesystem::absolute(file).lexically_normal();
    if (recent.size() < most && std::ranges::find(recent, item) == recent.end()) recent.push_back(std::move(item));
  };
  for (auto item = opened.rbegin(); item != opened.rend(); ++item) add(*item);
  for (const Item& item : before) add(item);
  return recent;
}

}  // namespace wheatstone::viewer
