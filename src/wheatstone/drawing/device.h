#pragma once

namespace wheatstone {

/// What draws.
enum class Device { processor };

}  // namespace wheatstone
