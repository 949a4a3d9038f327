#pragma once

#include <string>

#include "command.h"
#include "wheatstone/gpu/gpu.h"

namespace wheatstone::cli {

/// --device. `work` says what it does: "What renders".
Row device_row(Device& device, const std::string& work, Reasons unless = {});

/// The device that --device comes to on this machine, as files that depend on it name it: "cpu", or the name of the
/// graphics processor. Where `auto` finds no real one, it becomes the processor, and a line says so. Throws
/// Error{wrong_usage} where a graphics processor was asked for and there is none.
std::string settle_device(Device& device, const Session& session);

}  // namespace wheatstone::cli
