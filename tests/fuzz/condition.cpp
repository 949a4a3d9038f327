// Conditions that particles are chosen by. What is understood holds for the same particles in a block and one by one.

#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/particles/condition.h"

namespace wheatstone::fuzz {
namespace {

/// Numbers that differ from name to name, some of them none.
double number_of(std::size_t name, std::size_t particle) {
  const std::size_t mixed = (particle + 1) * (2 * name + 3) % 17;
  return mixed == 0 ? NAN : static_cast<double>(mixed) - 8;
}

std::vector<QuantityColumn> columns_of(const Condition& condition, std::size_t first, std::size_t count) {
  std::vector<QuantityColumn> columns(condition.names.size());
  for (std::size_t name = 0; name < columns.size(); ++name) {
    columns[name].single_precision = name % 2 == 1;
    for (std::size_t i = 0; i < count; ++i) columns[name].values.push_back(number_of(name, first + i));
  }
  return columns;
}

void check(std::string_view text) {
  try {
    const Condition condition = parse_condition(text);
    constexpr std::size_t count = 40;
    const std::vector<std::uint8_t> together = where_holds(condition, columns_of(condition, 0, count), count);
    for (std::size_t i = 0; i < count; ++i)
      if (where_holds(condition, columns_of(condition, i, 1), 1).front() != together[i] || together[i] > 1)
        std::abort();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::wrong_usage) std::abort();
  }
}

}  // namespace
}  // namespace wheatstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wheatstone::fuzz::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
