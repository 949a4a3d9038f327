#include "device_option.h"

#include <array>

#include "wheatstone/gpu/gpu.h"

namespace wheatstone::cli {

Row device_row(Device& device, const std::string& work, Reasons unless) {
  static constexpr std::array<Choice<Device>, 3> devices{
      {{"cpu", Device::processor}, {"gpu", Device::graphics}, {"auto", Device::automatic}}};
  return row("--device", choice(device, devices),
             work +
                 ": the processor, the graphics processor (OpenGL 4.5), or a graphics processor where the work is "
                 "worth it; 'wheatstone info --devices' lists what is there",
             std::move(unless));
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
  remark(session, fmt::format("wheatstone: --device auto takes the cpu; {}", why_not));
  return "cpu";
}

}  // namespace wheatstone::cli
