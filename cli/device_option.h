#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "wheatstone/gpu/device.h"

namespace wheatstone::cli {

/// Adds --device. `work` says what it does: "What renders".
CLI::Option* add_device_option(CLI::App& command, Device& device, const std::string& work);

}  // namespace wheatstone::cli
