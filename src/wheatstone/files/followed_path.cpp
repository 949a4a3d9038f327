#include <system_error>

#include "wheatstone/files/followed_path.h"

namespace wheatstone {

namespace fs = std::filesystem;

fs::path followed(const fs::path& path) {
  constexpr int most_links = 40;  // as Linux has it
  std::error_code error;
  fs::path place = fs::absolute(path);
  for (int links = 0; links < most_links; ++links) {
    const fs::path target = fs::read_symlink(place, error);
    if (error) {
      const fs::path whole = fs::weakly_canonical(place, error);
      return error ? place : whole;
    }
    place = place.parent_path() / target;
  }
  return fs::absolute(path);
}

}  // namespace wheatstone
