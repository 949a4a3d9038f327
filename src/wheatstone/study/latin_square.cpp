#include "wheatstone/study/latin_square_internal.h"

#include <algorithm>

namespace wheatstone {
namespace {

/// All rows that begin with `first` moved on by one number at a time.
OrderSquare moved_on(const std::vector<int>& first) {
  const int n = static_cast<int>(first.size());
  OrderSquare square;
  for (int row = 0; row < n; ++row) {
    square.push_back(first);
    for (int& number : square.back()) number = (number + row) % n;
  }
  return square;
}

}  // namespace

OrderSquare latin_square(int n) {
  std::vector<int> first(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) first[static_cast<std::size_t>(i)] = i;
  return moved_on(first);
}

OrderSquare williams_square(int n) {
  // 0, 1, n−1, 2, n−2, …: every difference occurs once.
  std::vector<int> first;
  for (int i = 0; i < n; ++i) first.push_back(i % 2 == 1 ? (i + 1) / 2 : (n - i / 2) % n);
  OrderSquare square = moved_on(first);
  if (n % 2 == 0) return square;
  std::ranges::reverse(first);
  std::ranges::copy(moved_on(first), std::back_inserter(square));
  return square;
}

}  // namespace wheatstone
