#pragma once

#include <vector>

namespace wheatstone {

/// Rows of orders of 0 … n − 1, in which each number stands once at each place.
using OrderSquare = std::vector<std::vector<int>>;

/// The cyclic Latin square: n rows.
OrderSquare latin_square(int n);

/// Williams 1949: in addition each number follows each other one equally often. n rows where n is even, else 2n.
OrderSquare williams_square(int n);

}  // namespace wheatstone
