#include "shared_data.h"

namespace wheatstone {

std::filesystem::path shared_data() { return WHEATSTONE_SHARED_DATA; }

}  // namespace wheatstone
