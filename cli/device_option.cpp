#include "device_option.h"

#include <array>
#include <string_view>
#include <utility>

#include "typed_options.h"

namespace wheatstone::cli {
namespace {

constexpr std::array<std::pair<std::string_view, Device>, 3> devices{
    {{"cpu", Device::processor}, {"gpu", Device::graphics}, {"auto", Device::automatic}}};

}  // namespace

CLI::Option* add_device_option(CLI::App& command, Device& device, const std::string& work) {
  return add_choice<Device>(command, "--device", device, devices,
                            work +
                                ": the processor, the graphics processor (OpenGL 4.5), or a graphics processor where "
                                "the work is worth it; 'wheatstone info --devices' lists what is there");
}

}  // namespace wheatstone::cli
