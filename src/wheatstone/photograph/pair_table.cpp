#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <string_view>

#include "wheatstone/files/whole_file.h"
#include "wheatstone/photograph/find_photographs.h"

namespace wheatstone {

std::vector<FoundPhotograph> read_pair_table(const std::filesystem::path& table) {
  constexpr std::size_t most_table_bytes = 16 << 20;
  const std::string text = read_whole_file(table, most_table_bytes);
  std::vector<FoundPhotograph> pairs;
  std::map<std::filesystem::path, int> line_of;
  int number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    const auto refuse = [&](const std::string& what) {
      throw Error(ErrorKind::bad_input, fmt::format("{}:{}: {}", table.string(), number, what));
    };
    const std::size_t tab = line.find('\t');
    if (tab == 0 || tab == std::string_view::npos || tab + 1 == line.size() || line.find('\t', tab + 1) < line.size())
      refuse("expected LEFT, one tab and RIGHT");
    FoundPhotograph pair{.stem = {},
                         .left = table.parent_path() / line.substr(0, tab),
                         .right = table.parent_path() / line.substr(tab + 1),
                         .depth = {},
                         .why = {}};
    for (const std::filesystem::path& file : {pair.left, pair.right}) {
      std::error_code error;
      if (!std::filesystem::is_regular_file(file, error)) refuse(fmt::format("{} is no file", file.string()));
      const auto [known, is_new] = line_of.emplace(std::filesystem::weakly_canonical(file), number);
      if (!is_new) refuse(fmt::format("{} already stands in line {}", file.string(), known->second));
    }
    pair.why = fmt::format("pair with {}, by {}:{}", pair.right.string(), table.string(), number);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace wheatstone
