#include "device_option.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <string_view>
#include <utility>

#include "typed_options.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"

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

std::string settle_device(Device& device, const Session& session) {
  if (device == Device::processor) return "cpu";
  std::string why_not;
  try {
    const GpuFacts gpu = gpu_facts();
    if (device == Device::graphics || !gpu.imitated) return gpu.name;
    why_not = fmt::format("{} is imitated by the cpu", gpu.name);
  } catch (const Error& error) {
    if (device == Device::graphics) throw;
    why_not = error.what();
  }
  device = Device::processor;
  if (!session.quiet) fmt::print(session.errors, "wheatstone: --device auto takes the cpu; {}\n", why_not);
  return "cpu";
}

}  // namespace wheatstone::cli
