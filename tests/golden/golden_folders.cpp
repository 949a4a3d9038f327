#include "golden/golden_folders.h"

// The folders' names are compiled into one file, so that all other objects are the same wherever the sources lie.
namespace wheatstone::golden {

std::filesystem::path kept_folder() { return WHEATSTONE_GOLDEN_KEPT; }

std::filesystem::path difference_folder() { return WHEATSTONE_GOLDEN_DIFFERENCE; }

}  // namespace wheatstone::golden
