#include "wheatstone/multiview/cost_model_internal.h"

#include <fmt/format.h>

#include <limits>

namespace wheatstone {

Costs estimate_costs(const Workload& workload) {
  constexpr double ns = 1e-9;
  const auto particles = static_cast<double>(workload.particles);
  const auto pixels = static_cast<double>(workload.pixels);
  const double views = workload.views;
  const double planes = workload.planes;

  // A particle is projected, lit and put in order once; a splat is unpacked, and its fragments are added.
  const double project = (workload.mass ? 43 : 30) * ns;
  const double area = (workload.splat_px + 1) * (workload.splat_px + 1);
  // The share of a splat over a pixel takes an error function at each of the pixel's edges; the widest splats of mass
  // are drawn in smaller pictures.
  const double fragments = (workload.mass ? 22 + 0.23 * area : 35 + 0.33 * area) * ns;
  // Sorted, each one on its own, and each fragment looks at what is in front of it.
  const double blended = workload.absorbs ? (92 + 6.9 * area) * ns : fragments;
  // Planes of mass are those of smaller pictures, too, and hold less of what lies beside each other in the cache.
  const double tone_map = (workload.mass ? 6.5 : 4) * ns;
  const double take_plane = (workload.absorbs ? 27 : workload.mass ? 0.8 : 0.9) * ns;
  const double composite = (workload.absorbs ? 0.5 : workload.mass ? 0.03 : 0.045) * ns;
  const double in_planes = workload.mass ? 1.9 : 1.25;
  Costs costs;
  costs.exact = views * (particles * (project + blended) + pixels * tone_map);
  costs.incremental = particles * (project + views * blended) + views * pixels * tone_map;
  costs.layered = particles * (project + in_planes * fragments) +
                  pixels * (planes * take_plane + views * (planes * composite + tone_map));
  return costs;
}

MethodChoice choose_method(const Workload& workload) {
  const Costs costs = estimate_costs(workload);
  // Views that share the splats are faster than each on its own, and read the particles once.
  MethodChoice choice;
  if (workload.views > 1) choice.method = costs.layered < costs.incremental ? Method::layered : Method::incremental;
  choice.reason = fmt::format(
      "{}: for {} particles of about {:.0f} pixels in {} views of {} pixels with {} planes, estimated seconds of one "
      "thread "
      "are exact {:.3f}, incremental {:.3f}, layered {:.3f}",
      name_of(choice.method), workload.particles, workload.splat_px, workload.views, workload.pixels, workload.planes,
      costs.exact, costs.incremental, costs.layered);
  return choice;
}

Costs estimate_gpu_costs(const Workload& workload) {
  constexpr double ns = 1e-9;
  const auto particles = static_cast<double>(workload.particles);
  const auto pixels = static_cast<double>(workload.pixels);
  const double views = workload.views;
  // A plane of mass has smaller pictures, too. An invocation costs something though it gathers nothing.
  const double pictures = workload.mass ? 1.33 : 1;
  const double area = (workload.splat_px + 1) * (workload.splat_px + 1);
  const double gathered = (workload.mass ? 35 + 0.8 * area : 25 + 1.3 * area) * ns;
  const double list = 200 * ns;
  const double begin = 26 * ns, finish = 14 * ns, pack = 8.5 * ns, composite = 3 * ns;
  Costs costs;
  costs.exact = std::numeric_limits<double>::infinity();
  costs.incremental = particles * (list + views * gathered) + views * pictures * pixels * (begin + finish);
  costs.layered = particles * (list + gathered) +
                  pictures * pixels * (workload.planes * (begin + pack + views * composite) + views * finish);
  return costs;
}

MethodChoice choose_gpu_method(const Workload& workload) {
  const Costs costs = estimate_gpu_costs(workload);
  const Method method = costs.layered < costs.incremental ? Method::layered : Method::incremental;
  return {.method = method,
          .reason = fmt::format("on a graphics processor, {}: for {} particles in {} views with {} planes, layered is "
                                "estimated to take {:.2f} of the time of incremental",
                                name_of(method), workload.particles, workload.views, workload.planes,
                                costs.layered / costs.incremental)};
}

}  // namespace wheatstone
