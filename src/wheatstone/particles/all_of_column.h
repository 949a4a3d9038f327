#pragma once

#include <vector>

namespace wheatstone {

/// Whether a rule without branches holds for all numbers of a column. It does not stop at the first for which it does
/// not, because nearly always there is none. The answers are gathered in an integer of a number's size: with a bool,
/// compilers do not take several numbers at a time.
template <class Rule>
bool all_of_column(const std::vector<float>& column, Rule rule) {
  int all = 1;
  for (const float number : column) all &= static_cast<int>(rule(number));
  return all != 0;
}

}  // namespace wheatstone
